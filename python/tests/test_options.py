"""Options and seeds of ``reset``."""

from typing import Any

import gymnasium
import numpy as np
import pytest
from gymnasium.vector import AutoresetMode

import ferry

# The start is the middle of a cell of `open`.
START_M, GOAL_M = (-0.195, -0.305), (0.103, -0.402)
SINGLE = [ferry.LatticeEnv, ferry.MazeEnv]
VECTOR = [ferry.LatticeVectorEnv, ferry.MazeVectorEnv]


def vector(place_m: tuple[float, float]) -> list[float]:
    """A place over the workspace of ``open``, as observations have it."""
    return [(place_m[0] + 0.3) / 0.58, (place_m[1] + 0.54) / 0.33]


@pytest.mark.parametrize("kind", SINGLE)
def test_start_and_goal_are_taken(kind: type) -> None:
    env = kind("open", observation="vector")
    seen, _ = env.reset(seed=7, options={"start_m": START_M, "goal_m": np.array(GOAL_M)})
    # One level of 255.
    assert seen == pytest.approx([*vector(GOAL_M), *vector(START_M)], abs=0.004)
    other, _ = env.reset(seed=7)
    assert not np.allclose(other, seen, atol=0.01)
    # The options were for one episode.
    plain, _ = kind("open", observation="vector").reset(seed=7)
    assert np.array_equal(other, plain)


@pytest.mark.parametrize("kind", SINGLE)
@pytest.mark.parametrize("given", ["start_m", "goal_m"])
def test_what_is_not_given_is_random(kind: type, given: str) -> None:
    env = kind("open", observation="vector")
    place_m = {"start_m": START_M, "goal_m": GOAL_M}[given]
    seen = np.array([env.reset(seed=seed, options={given: place_m})[0] for seed in range(5)])
    fixed, random = (seen[:, 2:], seen[:, :2]) if given == "start_m" else (seen[:, :2], seen[:, 2:])
    assert fixed == pytest.approx(np.array([vector(place_m)] * 5), abs=0.004)
    assert len(np.unique(random, axis=0)) == 5


def test_a_trial_takes_parameters_and_disturbances() -> None:
    def run(**options: Any) -> list[float]:
        env = ferry.MazeEnv("open", observation="vector", parameters={"tracker_noise_m": 0.002})
        _, info = env.reset(seed=3, options={"start_m": START_M, "goal_m": (0.1, -0.305), **options})
        beads = []
        for _ in range(24):
            info = env.step(0)[4]
            beads += info["bead_tracked_m"].tolist()
        return beads

    plain = run()
    assert plain == run(parameters={}) == run(parameters={"tracker_noise_m": 0.002}, disturbances=0)
    assert plain != run(parameters={"tracker_noise_m": 0.0})
    assert plain != run(disturbances=3)
    assert run(parameters={"friction": 0.9}) != run(parameters={"friction": 0.1})


@pytest.mark.parametrize("kind", VECTOR)
def test_options_are_for_all_lanes_or_each(kind: type) -> None:
    env = kind(2, "open", observation="vector", autoreset_mode=AutoresetMode.DISABLED)
    seen, _ = env.reset(seed=1, options={"start_m": START_M, "goal_m": [GOAL_M, (0.2, -0.3)]})
    assert seen[:, 2:] == pytest.approx(np.array([vector(START_M)] * 2), abs=0.004)
    assert seen[:, :2] == pytest.approx(np.array([vector(GOAL_M), vector((0.2, -0.3))]), abs=0.004)
    options = {"start_m": [START_M, None], "reset_mask": np.array([False, True])}
    again, _ = env.reset(seed=[None, 9], options=options)
    assert np.array_equal(again[0], seen[0]) and not np.array_equal(again[1], seen[1])
    assert set(options) == {"start_m", "reset_mask"}
    # An array with a row for each lane.
    seen, _ = env.reset(options={"start_m": np.array([START_M, (0.105, -0.405)])})
    assert seen[:, 2:] == pytest.approx(np.array([vector(START_M), vector((0.105, -0.405))]), abs=0.004)


def test_a_lane_takes_parameters_of_its_own() -> None:
    env = ferry.MazeVectorEnv(3, "open", autoreset_mode=AutoresetMode.DISABLED)
    each = {"parameters": [{"step_limit": 50}, None, {"step_limit": 60}], "disturbances": [0, 1, 2]}
    env.reset(seed=[5, 5, 5], options={"start_m": START_M, "goal_m": GOAL_M, **each})
    ended, steps = np.zeros(3, bool), 0
    while not ended.any():
        # Back and forth: nothing is delivered.
        *_, ended, _ = env.step(np.full(3, steps % 2))
        steps += 1
    assert ended.tolist() == [True, False, False] and steps >= 50


@pytest.mark.parametrize("context", ["forkserver", "spawn"])
def test_options_reach_other_processes(context: str) -> None:
    env = gymnasium.make_vec(
        "ferry/Maze-v0", 2, "async", vector_kwargs={"context": context}, map="open", observation="vector"
    )
    try:
        seen, _ = env.reset(seed=1, options={"start_m": START_M, "goal_m": GOAL_M})
        assert seen == pytest.approx(np.array([[*vector(GOAL_M), *vector(START_M)]] * 2), abs=0.004)
    finally:
        env.close()


@pytest.mark.parametrize(
    ("kind", "options", "text"),
    [
        *[(kind, {"gaol_m": (9, 9)}, "options has 'gaol_m'; there are start_m, goal_m") for kind in SINGLE + VECTOR],
        *[(kind, {"reset_mask": [True]}, "'reset_mask', which only vector environments take") for kind in SINGLE],
        *[(kind, {"start_m": 0.1}, r"start_m is 0\.1, it must be x and y in metres") for kind in SINGLE + VECTOR],
        *[(kind, {"start_m": (0.1, np.nan)}, r"start_m is \(0\.1, nan\)") for kind in SINGLE + VECTOR],
        *[(kind, {"goal_m": "left"}, "goal_m is 'left'") for kind in SINGLE + VECTOR],
        *[(kind, {"start_m": (9, 9)}, r"start_m \(9\.000, 9\.000\) m is") for kind in SINGLE + VECTOR],
        *[(kind, {"goal_m": (9, 9)}, r"goal(_m)? \(9\.000, 9\.000\) m is") for kind in SINGLE + VECTOR],
        *[(kind, {"goal_m": [GOAL_M] * 3}, "goal_m has 3 entries, it must have 2") for kind in VECTOR],
        *[(kind, {"goal_m": [GOAL_M, "left"]}, r"goal_m\[1\] is 'left'") for kind in VECTOR],
        *[(kind, {"reset_mask": np.ones(3, bool)}, r"reset_mask is array\(\[ True") for kind in VECTOR],
        *[(kind, {"reset_mask": [0, 1]}, r"reset_mask is \[0, 1\]") for kind in VECTOR],
        *[(kind, {"reset_mask": [False, False]}, "it must be True for one environment or more") for kind in VECTOR],
        (ferry.LatticeEnv, {"start_m": START_M, "goal_m": START_M}, "start_m and goal_m: no path"),
        (ferry.LatticeEnv, {"parameters": {"friction": 0.1}}, "options has 'parameters'"),
        (ferry.MazeEnv, {"parameters": {"wings": 2}}, "wings"),
        (ferry.MazeEnv, {"parameters": {"friction": 9.0}}, "friction is 9"),
        (ferry.MazeEnv, {"disturbances": -1}, "disturbances is -1"),
        (ferry.MazeVectorEnv, {"disturbances": [0, -1]}, r"disturbances\[1\] is -1"),
    ],
)
def test_bad_options_are_named_and_change_nothing(kind: type, options: dict[str, Any], text: str) -> None:
    env = kind("open", observation="vector") if kind in SINGLE else kind(2, "open", observation="vector")
    env.reset(seed=1)
    before = env._observed()
    with pytest.raises(ValueError, match=text):
        env.reset(options=options)
    assert np.array_equal(env._observed(), before)


@pytest.mark.parametrize("kind", [ferry.MazeEnv, ferry.MazeVectorEnv])
@pytest.mark.parametrize(
    ("options", "text"),
    [
        ([1], r"options is \[1\], it must be a dictionary"),
        ([], r"options is \[\], it must be a dictionary"),
        ({"parameters": 1}, "parameters is 1, it must be a dictionary"),
        ({"disturbances": 1.5}, r"disturbances is 1\.5, it must be a whole number"),
    ],
)
def test_options_of_a_wrong_type_are_named(kind: type, options: Any, text: str) -> None:
    with pytest.raises(TypeError, match=text):
        kind(map="open").reset(options=options)


@pytest.mark.parametrize("kind", VECTOR)
def test_seeds_are_numbers_lists_or_arrays(kind: type) -> None:
    env = kind(2, "open", observation="vector")
    first, _ = env.reset(seed=5)
    for seed in [np.int64(5), [5, 6], (5, 6), np.array([5, 6])]:
        assert np.array_equal(env.reset(seed=seed)[0], first)
    env.reset(seed=2**64 - 2)


@pytest.mark.parametrize("seed", [2**64, -1])
@pytest.mark.parametrize("kind", SINGLE + VECTOR)
def test_bad_seeds_are_named(kind: type, seed: int) -> None:
    env = kind("open") if kind in SINGLE else kind(2, "open")
    with pytest.raises(ValueError, match=f"seed is {seed}, it must be 0 to 184467440737095516"):
        env.reset(seed=seed)
    if kind in VECTOR:
        with pytest.raises(ValueError, match=rf"seed\[1\] is {seed}"):
            env.reset(seed=[1, seed])
        with pytest.raises(ValueError, match="seed has 3 entries, it must have 2"):
            env.reset(seed=[1, 2, 3])
    with pytest.raises(TypeError, match=r"seed is 1\.5, it must be a whole number"):
        env.reset(seed=1.5)
