"""Evaluations and trainings with Ray."""

import os
import signal
import subprocess
import threading
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
import ray

import ferry

SETTINGS: dict[str, Any] = {"map": ["posts", "open"], "disturbances": [0, 1], "episodes": 24, "seed": 3}


@pytest.fixture(scope="module", autouse=True)
def cluster() -> Iterator[None]:
    ray.init(num_cpus=2, include_dashboard=False, _node_ip_address="127.0.0.1", logging_level="ERROR")
    yield
    ray.shutdown()


class Straight(ferry.Controller):
    def act(self, percept: ferry.Percept) -> ferry.Step:
        return ferry.Step(tuple(percept.goal_m))


def untimed(report: Any) -> list[dict[str, Any]]:
    return [{key: value for key, value in row.items() if not key.startswith("decision_ms")} for row in report["rows"]]


def busy_workers() -> list[int]:
    listed = subprocess.run(["ps", "-eo", "pid,args"], capture_output=True, text=True, check=True).stdout
    return [int(line.split()[0]) for line in listed.splitlines() if "ray::part" in line]


def test_a_lost_worker_changes_nothing() -> None:
    alone = ferry.evaluate(["attractor", "errt"], **SETTINGS)
    killed: list[int] = []

    def kill() -> None:
        until = time.monotonic() + 60
        while not killed and time.monotonic() < until:
            time.sleep(0.5)
            for pid in busy_workers()[:1]:
                os.kill(pid, signal.SIGKILL)
                killed.append(pid)

    killer = threading.Thread(target=kill)
    killer.start()
    spread = ferry.evaluate(["attractor", "errt"], **SETTINGS, engine="ray")
    killer.join()
    assert killed, "no worker was found"
    assert untimed(spread.report) == untimed(alone.report)
    assert spread.failures == alone.failures


class Broken(ferry.Controller):
    def act(self, percept: ferry.Percept) -> ferry.Step:
        raise ZeroDivisionError("of zero")


def test_controllers_of_ones_own_run_on_the_workers() -> None:
    settings = {**SETTINGS, "map": "open", "episodes": 20}
    controllers = [Straight(), "attractor"]
    alone = ferry.evaluate(controllers, **settings)
    assert untimed(ferry.evaluate(controllers, **settings, engine="ray").report) == untimed(alone.report)
    with pytest.raises(ZeroDivisionError, match="of zero"):
        ferry.evaluate(Broken(), **settings, engine="ray")


def test_trainings_with_several_seeds_give_what_the_command_gives(tmp_path: Path) -> None:
    settings: dict[str, Any] = {"seeds": [1, 2], "recipe": "quick", "settings": {"updates": 60}, "episodes": 20}
    spread = ferry.train("u-turn", tmp_path / "ray", **settings, engine="ray")
    alone = ferry.train("u-turn", tmp_path / "alone", **settings)
    for one, other in zip(spread, alone, strict=True):
        assert one.read_bytes() == other.read_bytes() and one.name == other.name
        assert one.with_suffix(".curve.csv").stat().st_size > 0 and one.with_suffix(".log").stat().st_size > 0
    assert spread[0].read_bytes() != spread[1].read_bytes()
    with pytest.raises(ValueError, match="discount is 2"):
        ferry.train("u-turn", tmp_path, settings={"discount": 2})


def test_a_recovery_map_is_the_same() -> None:
    settings: dict[str, Any] = {"map": "posts", "grid": 8, "repeats": 2, "seed": 6}
    controllers: list[ferry.Controller | str] = [Straight(), "attractor"]
    alone = ferry.recovery(controllers, **settings, full=True)
    assert len(alone.cells) > 16
    assert ferry.recovery(controllers, **settings, engine="ray").report == alone.report
