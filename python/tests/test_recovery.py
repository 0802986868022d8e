"""Recovery maps, with a controller of one's own and in shards."""

import json
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

import ferry
from ferry.evaluation import part


class Straight(ferry.Controller):
    """Goes straight to the goal."""

    def act(self, percept: ferry.Percept) -> ferry.Step | None:
        return ferry.Step(tuple(percept.goal_m))


def test_a_controller_of_ones_own_is_paired_with_ferrys() -> None:
    done = ferry.recovery([Straight(), "attractor"], map="open", grid=6, repeats=1, seed=4)
    assert [basin["controller"] for basin in done.basins] == ["straight", "attractor"]
    assert [basin["share"] for basin in done.basins] == [1.0, 1.0]
    assert {cell["controller"] for cell in done.cells} == {"straight", "attractor"}
    head, straight, attractor = str(done).splitlines()
    assert head == "RecoveryMap of open, kind place, seed 4 (shares with 95% intervals)"
    assert straight.startswith("straight: ") and ", share 100.0% (" in attractor
    assert (done.differences[0]["controller"], done.differences[0]["against"]) == ("straight", "attractor")


def test_shards_give_what_the_command_gives(tmp_path: Path) -> None:
    command = [sys.executable, "-m", "ferry", "recovery", "--map", "posts", "--controller", "attractor"]
    command += ["--kind", "push", "--grid", "4", "--repeats", "1", "--seed", "9"]

    def run(*more: str) -> Any:
        return subprocess.run([*command, *more], capture_output=True, text=True, check=True).stdout

    whole = json.loads(run("--json"))
    assert ferry.recovery("attractor", map="posts", kind="push", grid=4, repeats=1, seed=9).report == whole
    files = [str(tmp_path / f"{number}.json") for number in (1, 2)]
    for number, file in enumerate(files, 1):
        run("--shard", f"{number}/2", "--out", file)
    merge = [sys.executable, "-m", "ferry", "merge", "--json"]
    merged = subprocess.run([*merge, *files], capture_output=True, text=True, check=True).stdout
    assert json.loads(merged) == whole
    refused = subprocess.run([*merge, *files[:1]], capture_output=True, text=True)
    assert refused.returncode != 0 and "2/2" in refused.stderr


def test_bad_settings_are_refused() -> None:
    for settings, words in [
        ({"grid": 3}, "grid is 3"),
        ({"grid": -1}, "grid is -1"),
        ({"repeats": 2**32}, "repeats is 4294967296"),
        ({"seed": -1}, "seed is -1"),
        ({"kind": "shove"}, 'kind is "shove"'),
        ({"at_s": -1.0}, "at_s is -1"),
        ({"parameters": {"friction": 2}}, "friction is 2"),
        ({"engine": "spark"}, "engine is 'spark'"),
    ]:
        with pytest.raises(ValueError, match=words):
            ferry.recovery("attractor", map="open", **settings)  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="several of one's own"):
        ferry.recovery({"one": Straight(), "two": Straight()}, map="open")


def test_a_shard_needs_no_other(tmp_path: Path) -> None:
    settings = {
        "controllers": [("attractor", False)],
        "map": "open",
        "scenario": None,
        "at_s": 0.0,
        "kind": "place",
        "grid": 4,
        "repeats": 1,
        "seed": 1,
        "within_s": 60.0,
        "full": True,
        "changes": [],
    }
    parts = [json.loads(part("recovery", settings, [], number, 4, 1)) for number in (1, 2, 3, 4)]
    assert all(one["trials"] for one in parts)
    ended = [tuple(trial[:3]) for one in parts for trial in one["trials"]]
    assert len(ended) == len(set(ended)) == len(parts[0]["cells"])
