"""Copies and pickles of environments go on like the original."""

import copy
import pickle
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import gymnasium
import numpy as np
import pytest

import ferry

WAYS = {"deepcopy": copy.deepcopy, "pickle": lambda env: pickle.loads(pickle.dumps(env))}
DRAWING = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="-300 210 580 330"><circle cx="45" cy="400" r="25"/></svg>'


def same(a: Any, b: Any) -> bool:
    if isinstance(a, dict):
        return a.keys() == b.keys() and all(same(a[key], b[key]) for key in a)
    return np.array_equal(a, b)


def go_on_alike(env: Any, other: Any, actions: Callable[[], Any], steps: int) -> None:
    for _ in range(steps):
        action = actions()
        results, others = env.step(action), other.step(action)
        assert all(same(a, b) for a, b in zip(results, others, strict=True))
        if np.any(results[2]) or np.any(results[3]):
            if not isinstance(env, gymnasium.vector.VectorEnv):
                assert same(env.reset()[0], other.reset()[0])


@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize("name", ["ferry/Lattice-v0", "ferry/Maze-v0"])
def test_a_copy_goes_on_like_the_original(name: str, way: str) -> None:
    env = gymnasium.make(name, map="posts", render_mode="rgb_array")
    random = np.random.default_rng(1)
    # Before the first reset, too.
    fresh = WAYS[way](env)
    assert same(env.reset(seed=3)[0], fresh.reset(seed=3)[0])
    for _ in range(5):
        env.step(int(random.integers(4)))
    other = WAYS[way](env)
    assert same(env.render(), other.render())
    go_on_alike(env, other, lambda: int(random.integers(4)), 60)
    # What happens to one does not happen to the other.
    seen, _ = env.reset(seed=8)
    other.step(0)
    assert same(env.unwrapped._observed(), seen)


@pytest.mark.parametrize("way", WAYS)
def test_noise_disturbances_and_moving_walls_are_copied(way: str) -> None:
    parameters = {"tracker_noise_m": 0.002, "camera_noise_levels": 8.0, "camera_latency_ticks": 12}
    env = ferry.MazeEnv("colon", parameters={**parameters, "peristalsis_amplitude_m": 0.005}, disturbances=2)
    env.reset(seed=4)
    env.step(1)
    random = np.random.default_rng(2)
    go_on_alike(env, WAYS[way](env), lambda: int(random.integers(4)), 40)


@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize("name", ["ferry/Lattice-v0", "ferry/Maze-v0"])
def test_a_copy_of_a_vector_goes_on_like_the_original(name: str, way: str) -> None:
    env = gymnasium.make_vec(name, num_envs=3, map="posts", observation="vector")
    random = np.random.default_rng(1)
    env.reset(seed=3)
    for _ in range(5):
        env.step(random.integers(4, size=3))
    go_on_alike(env, WAYS[way](env), lambda: random.integers(4, size=3), 60)


READER = """
import pickle, sys
import numpy as np
with open(sys.argv[1], "rb") as file:
    envs = pickle.load(file)
np.save(sys.argv[2], [env.step(1)[0] for env in envs for _ in range(3)])
"""


def test_a_pickle_needs_neither_the_process_nor_the_drawing(tmp_path: Path) -> None:
    drawing = tmp_path / "block.svg"
    drawing.write_text(DRAWING)
    envs = [kind(drawing, observation="vector") for kind in (ferry.LatticeEnv, ferry.MazeEnv)]
    for env in envs:
        env.reset(seed=2)
    (tmp_path / "envs").write_bytes(pickle.dumps(envs))
    drawing.unlink()
    results = tmp_path / "results.npy"
    subprocess.run([sys.executable, "-c", READER, tmp_path / "envs", results], check=True, timeout=120)
    assert np.array_equal(np.load(results), [env.step(1)[0] for env in envs for _ in range(3)])


def test_a_damaged_pickle_is_refused() -> None:
    env = ferry.MazeEnv("posts")
    env.reset(seed=1)
    make, (kept,) = env._native.__reduce__()
    with pytest.raises(ValueError, match="the pickle is damaged or of another version of Ferry"):
        make(kept[:1000])
    lattice, _ = ferry.LatticeEnv("posts")._native.__reduce__()
    with pytest.raises(ValueError, match="the pickle is damaged or of another version of Ferry"):
        lattice(kept)
