"""Evaluations with controllers of one's own, and with Ray."""

import json
import subprocess
import sys
from typing import Any

import pytest

import ferry


class Straight(ferry.Controller):
    """Goes straight; counts its steps, which must begin at 0 in each trial."""

    def __init__(self) -> None:
        self.steps = 0
        self.trial: str | None = None

    def act(self, percept: ferry.Percept) -> ferry.Step | None:
        assert self.trial in (None, percept.leg.trial), "a trial has its own copy"
        self.trial = percept.leg.trial
        self.steps += 1
        # Every fifth step holds: the result depends on the count.
        return None if self.steps % 5 == 0 else ferry.Step(tuple(percept.goal_m))


def untimed(value: Any) -> Any:
    """Without what depends on the machine's speed."""
    if isinstance(value, dict):
        return {key: untimed(item) for key, item in value.items() if not key.startswith("decision_ms")}
    return [untimed(item) for item in value] if isinstance(value, list) else value


def test_a_controller_of_ones_own_is_paired_with_ferrys() -> None:
    done = ferry.evaluate([Straight(), "attractor"], map="open", disturbances=[0, 1], episodes=6, seed=4)
    assert [(row["controller"], row["disturbances"]) for row in done.rows] == [
        ("straight", 0),
        ("attractor", 0),
        ("straight", 1),
        ("attractor", 1),
    ]
    assert [row["delivered"] for row in done.rows] == [6, 6, 6, 6]
    assert (done.comparisons[0]["controller"], done.comparisons[0]["against"]) == ("straight", "attractor")
    # Held steps cost steps.
    assert done.comparisons[0]["steps"]["mean"] > 1
    assert done.failures == []
    again = ferry.evaluate({"straight": Straight()}, map="open", disturbances=[0, 1], episodes=6, seed=4)
    assert untimed(again.rows) == untimed([done.rows[0], done.rows[2]])


def test_it_gives_what_the_command_gives() -> None:
    command = [sys.executable, "-m", "ferry", "evaluate", "--map", "posts", "--controller", "attractor,errt"]
    command += ["--episodes", "4", "--seed", "9", "--set", "tracker_noise_m=0.001", "--tool-apart", "--json"]
    printed = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    done = ferry.evaluate(
        ["attractor", "errt"], episodes=4, seed=9, parameters={"tracker_noise_m": 0.001}, tool_apart=True
    )
    assert untimed(done.report) == untimed(json.loads(printed))


def test_a_varied_parameter_has_rows_for_its_values() -> None:
    done = ferry.evaluate(["attractor", "errt"], map="open", episodes=2, vary={"friction": (0.2, 0.4, 3)})
    varied = [(row["controller"], row["varied"][0]["name"], row["varied"][0]["value"]) for row in done.rows]
    assert varied == [(name, "friction", value) for value in (0.2, 0.3, 0.4) for name in ("attractor", "errt")]
    assert [one["varied"][0]["value"] for one in done.comparisons] == [0.2, 0.3, 0.4]
    with pytest.raises(ValueError, match=r"friction is 1\.5"):
        ferry.evaluate("attractor", map="open", episodes=1, vary={"friction": (0.5, 1.5, 2)})


def test_a_result_is_printed_in_a_few_lines() -> None:
    done = ferry.evaluate(["attractor", "errt"], map="open", disturbances=[0, 1], episodes=4)
    lines = str(done).splitlines()
    assert lines[:2] == [
        "Evaluation with seed 1 (rates with 95% intervals)",
        "attractor on open, 0 disturbances: 4 of 4 delivered, 100.0% (51.0% to 100.0%)",
    ]
    assert lines[4].startswith("errt on open, 1 disturbance: ") and len(lines) == 5
    varied = ferry.evaluate("attractor", map="open", disturbances=[0, 1], episodes=1, vary={"friction": (0.1, 0.4, 12)})
    lines = repr(varied).splitlines()
    assert ", friction 0.1: 1 of 1 delivered" in lines[1] and lines[-1] == "… and 4 more rows"
    # It is what it was for programs.
    assert varied == ferry.Evaluation(varied.report) and len(varied.rows) == 24


class Broken(ferry.Controller):
    def act(self, percept: ferry.Percept) -> Any:
        return "left" if percept.leg.trial.endswith("1") else ferry.Step(tuple(percept.goal_m))


def test_what_act_raises_ends_the_evaluation() -> None:
    with pytest.raises(TypeError, match="act returned str"):
        ferry.evaluate(Broken(), map="open", episodes=4)


@pytest.mark.parametrize(
    ("change", "text"),
    [
        ({"controllers": []}, "controllers is empty"),
        ({"controllers": "attractr"}, 'no controller named "attractr"'),
        ({"controllers": "you"}, "needs a person"),
        ({"controllers": [Straight(), Straight()]}, "have the name 'straight'"),
        ({"controllers": {"Mine!": Straight()}}, "'Mine!' cannot be the name"),
        ({"map": "nowhere"}, "nowhere"),
        ({"episodes": 0}, "episodes is 0"),
        ({"episodes": -1}, "episodes is -1"),
        ({"seed": 2**64}, "seed is 18446744073709551616"),
        ({"disturbances": [0, -1]}, "disturbances is -1"),
        ({"parameters": {"threshold": 1}}, "threshold"),
        ({"engine": "dask"}, "engine is 'dask'"),
    ],
)
def test_bad_settings_are_named(change: dict[str, Any], text: str) -> None:
    settings: dict[str, Any] = {"controllers": "attractor", "map": "open", "episodes": 1, **change}
    with pytest.raises(ValueError, match=text):
        ferry.evaluate(**settings)
