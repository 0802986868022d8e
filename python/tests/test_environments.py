"""The environments as Gymnasium means them."""

import os
import re
import subprocess
import sys
from pathlib import Path
from typing import Any

import gymnasium
import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env
from gymnasium.vector import AutoresetMode

import ferry

KINDS = ["dict", "paper", "vector"]


@pytest.mark.parametrize("name", ["ferry/Lattice-v0", "ferry/Maze-v0"])
@pytest.mark.parametrize("observation", KINDS)
def test_gymnasium_accepts_each_environment(name: str, observation: str) -> None:
    # Warnings are errors here.
    check_env(gymnasium.make(name, map="posts", observation=observation, render_mode="rgb_array").unwrapped)


def test_gymnasium_accepts_boxes_as_actions() -> None:
    check_env(gymnasium.make("ferry/Maze-v0", map="posts", action="box").unwrapped, skip_render_check=True)


def equal(a: object, b: object) -> bool:
    if isinstance(a, dict):
        return all(equal(a[key], b[key]) for key in a)
    return np.array_equal(a, b)


@pytest.mark.parametrize("observation", KINDS)
@pytest.mark.parametrize("kind", [ferry.LatticeVectorEnv, ferry.MazeVectorEnv])
def test_a_lane_is_the_single_environment(kind: type, observation: str) -> None:
    single = ferry.LatticeEnv if kind is ferry.LatticeVectorEnv else ferry.MazeEnv
    many = kind(3, "posts", observation=observation, autoreset_mode=AutoresetMode.DISABLED)
    one = single("posts", observation=observation)
    seen, _ = many.reset(seed=7)
    alone, _ = one.reset(seed=8)
    random = np.random.default_rng(1)
    for _ in range(60):
        lane = {key: value[1] for key, value in seen.items()} if isinstance(seen, dict) else seen[1]
        assert equal(lane, alone)
        actions = random.integers(4, size=3)
        seen, rewards, terminated, truncated, _ = many.step(actions)
        alone, reward, *ended, _ = one.step(actions[1])
        assert rewards[1] == pytest.approx(reward) and [terminated[1], truncated[1]] == ended
        if (over := terminated | truncated).any():
            if over[1]:
                return
            many.reset(options={"reset_mask": over})


def test_lanes_begin_again_in_each_mode() -> None:
    runs = {}
    for mode in [AutoresetMode.NEXT_STEP, AutoresetMode.SAME_STEP]:
        env = gymnasium.make_vec("ferry/Lattice-v0", num_envs=16, map="posts", autoreset_mode=mode)
        assert env.metadata["autoreset_mode"] == mode
        env.reset(seed=3)
        random = np.random.default_rng(2)
        steps, firsts = np.zeros(16, int), []
        for _ in range(300):
            seen, _, terminated, truncated, info = env.step(random.integers(4, size=16))
            ended = terminated | truncated
            if mode == AutoresetMode.SAME_STEP and ended.any():
                lane = int(ended.argmax())
                assert (info["_final_obs"] == ended).all()
                final = info["final_obs"][lane]
                assert env.single_observation_space.contains(final)
                assert not equal(final, {key: value[lane] for key, value in seen.items()})
            if ended[0]:
                firsts.append(steps[0])
            steps += 1
        runs[mode] = len(firsts)
        env.close()
    # Each lane has many episodes; with NEXT_STEP, each takes one step more.
    assert runs[AutoresetMode.SAME_STEP] >= runs[AutoresetMode.NEXT_STEP] > 5


def test_the_same_seed_gives_the_same_run() -> None:
    def run() -> list[float]:
        env = ferry.MazeVectorEnv(2, "posts", observation="vector", progress_reward=0.1, disturbances=1)
        env.reset(seed=[4, 9])
        seen = []
        random = np.random.default_rng(5)
        for _ in range(40):
            observed, rewards, *_ = env.step(random.integers(4, size=2))
            seen += [*observed.ravel().tolist(), *rewards.tolist()]
        return seen

    assert run() == run()


def test_a_step_moves_the_tool_by_a_cell() -> None:
    env = ferry.MazeEnv("open")
    _, info = env.reset(seed=1)
    for action, offset in enumerate([(0.01, 0.0), (-0.01, 0.0), (0.0, 0.01), (0.0, -0.01)]):
        # The first step also goes to the middle of the cell.
        env.step(action)
        before = info["tool_m"]
        for _ in range(2):
            before, (_, _, _, _, info) = info["tool_m"], env.step(action)
        assert info["asks"] and info["refusal"] is None
        assert info["tool_m"] - before == pytest.approx(offset, abs=1e-3)


def test_a_wall_holds_the_arm_and_is_named() -> None:
    env = ferry.MazeEnv("posts")
    env.reset(seed=2)
    refusals = [env.step(0)[4]["refusal"] for _ in range(60)]
    assert any(refusal and ("obstacle" in refusal or "workspace" in refusal) for refusal in refusals)


@pytest.mark.parametrize(
    ("make", "text"),
    [
        (lambda: ferry.LatticeEnv("nowhere"), "nowhere"),
        (lambda: ferry.LatticeEnv(observation="smell"), "observation is 'smell'"),
        (lambda: ferry.LatticeEnv(progress_reward=2.0), "progress_reward is 2"),
        (lambda: ferry.LatticeEnv(step_penalty=float("nan")), "step_penalty is NaN"),
        (lambda: ferry.LatticeVectorEnv(0), "num_envs is 0, it must be 1 to 4096"),
        (lambda: ferry.LatticeVectorEnv(-1), "num_envs is -1, it must be 1 to 4096"),
        (lambda: ferry.MazeVectorEnv(-1), "num_envs is -1, it must be 1 to 256"),
        (lambda: ferry.MazeVectorEnv(2**70), "num_envs is 1180591620717411303424"),
        (lambda: ferry.MazeEnv(disturbances=-1), "disturbances is -1"),
        (lambda: ferry.MazeEnv(action="jump"), "action is 'jump'"),
        (lambda: ferry.MazeEnv(parameters={"wings": 2}), "wings"),
        (lambda: ferry.MazeEnv(parameters={"friction": 9.0}), "friction"),
        (lambda: ferry.MazeVectorEnv(1000), "num_envs is 1000, it must be 1 to 256"),
    ],
)
def test_bad_settings_are_named(make: object, text: str) -> None:
    with pytest.raises(ValueError, match=text):
        make()


@pytest.mark.parametrize(
    ("make", "text"),
    [
        (lambda: ferry.LatticeEnv(3), "map is 3, it must be the name of a map or the path of an SVG"),
        (lambda: ferry.LatticeVectorEnv(2.0), "num_envs is 2.0, it must be a whole number"),
        (lambda: ferry.LatticeEnv(clearance_m="near"), "clearance_m"),
        (lambda: ferry.MazeEnv(disturbances=1.5), "disturbances is 1.5, it must be a whole number"),
        (lambda: ferry.MazeEnv(parameters=["friction"]), r"parameters is \['friction'\], it must be a dictionary"),
    ],
)
def test_settings_of_a_wrong_type_are_named(make: object, text: str) -> None:
    with pytest.raises(TypeError, match=text):
        make()


SINGLE = [ferry.LatticeEnv, ferry.MazeEnv]
VECTOR = [ferry.LatticeVectorEnv, ferry.MazeVectorEnv]


@pytest.mark.parametrize("kind", SINGLE + VECTOR)
def test_maps_are_also_paths(kind: type, tmp_path: Path) -> None:
    drawing = Path(__file__).parents[2] / "assets" / "maps" / "posts.svg"
    other = tmp_path / "a map ä.svg"
    other.write_bytes(drawing.read_bytes())
    seen, _ = kind(map="posts", observation="vector").reset(seed=1)
    for map in (other, str(other), str(other).encode()):
        assert np.array_equal(kind(map=map, observation="vector").reset(seed=1)[0], seen)


def refuses(env: Any, actions: Any, text: str) -> None:
    before = env._observed()
    with pytest.raises(ValueError, match=text):
        env.step(actions)
    assert equal(before, env._observed())


@pytest.mark.parametrize("kind", SINGLE + VECTOR)
def test_bad_actions_are_named_and_change_nothing(kind: type) -> None:
    allowed = "it must be 0, 1, 2 or 3"
    env = kind(map="posts", observation="vector") if kind in SINGLE else kind(2, "posts", observation="vector")
    env.reset(seed=1)
    if kind in SINGLE:
        for action in (7, -1, 2**64 - 1, 1.7, 1.0, float("nan"), "left", None, True):
            refuses(env, action, f"action is {action!r}, {allowed}")
        for action, shape in [([1], "(1,)"), ([0, 1], "(2,)"), ([[1]], "(1, 1)")]:
            refuses(env, action, re.escape(f"action has the shape {shape}, it must be ()"))
        for action in (1, np.int64(1), np.array(1), np.uint8(1)):
            env.step(action)
        return
    refuses(env, np.array([0, 4]), rf"action\[1\] is 4, {allowed}")
    refuses(env, [-1, 0], rf"action\[0\] is -1, {allowed}")
    refuses(env, np.array([0.0, 1.7]), rf"action\[0\] is 0.0, {allowed}")
    refuses(env, [0, [1]], re.escape("action is [0, [1]], it must have the shape (2,)"))
    for actions, shape in [([0], "(1,)"), (0, "()"), (np.zeros((2, 2), int), "(2, 2)")]:
        refuses(env, actions, re.escape(f"action has the shape {shape}, it must be (2,)"))
    taken = np.array([1, 2])
    env.step(taken)
    assert taken.tolist() == [1, 2]


@pytest.mark.parametrize("kind", [ferry.MazeEnv, ferry.MazeVectorEnv])
def test_bad_boxes_are_named_and_change_nothing(kind: type) -> None:
    is_single = kind is ferry.MazeEnv
    env = ferry.MazeEnv("posts", action="box") if is_single else ferry.MazeVectorEnv(2, "posts", action="box")
    env.reset(seed=1)
    name = "action" if is_single else r"action\[1\]"
    good = (0.5, -1.0)
    for box in [(1.7, 0.0), (0.0, float("nan")), (float("-inf"), 0.0)]:
        text = re.escape(f" is {list(box)}, it must be two numbers from -1 to 1")
        refuses(env, np.array(box if is_single else [good, box]), name + text)
    refuses(env, 0.5, r"action has the shape \(\), it must be \((2, )?2,?\)")
    env.step(np.array(good if is_single else [good, good], np.float32))


def test_actions_of_lanes_that_begin_again_do_not_count() -> None:
    env = ferry.LatticeVectorEnv(2, "posts", observation="vector")
    env.reset(seed=1)
    ended = np.zeros(2, bool)
    while not ended.any() or ended.all():
        _, _, terminated, truncated, _ = env.step(np.zeros(2, int))
        ended = terminated | truncated
    env.step(np.where(ended, -9, 0))


ADAPTER = """
import ferry, sys
try:
    ferry.MazeEnv("open").reset(seed=1)
    print(ferry.evaluate("attractor", map="open", episodes=1).report["adapter"])
except Exception as fault:
    print(type(fault).__name__, fault)
"""


@pytest.mark.parametrize(
    ("value", "text"),
    [
        ("vulkan", "(Vulkan)"),
        ("gl", "(Gl)"),
        ("", "(Vulkan)"),
        ("abacus", 'ValueError FERRY_ADAPTER: unknown adapter "abacus": must be auto, vulkan or gl'),
    ],
)
def test_the_adapter_is_that_of_the_variable(value: str, text: str) -> None:
    variables = {**os.environ, "FERRY_ADAPTER": value}
    done = subprocess.run([sys.executable, "-c", ADAPTER], env=variables, capture_output=True, text=True, timeout=120)
    assert text in done.stdout, done.stdout + done.stderr


def test_without_a_home_the_folder_of_images_must_be_given(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def unknown(uid: int) -> None:
        raise KeyError(uid)

    monkeypatch.delenv("HOME")
    monkeypatch.delenv("XDG_CACHE_HOME", raising=False)
    monkeypatch.setattr("pwd.getpwuid", unknown)
    with pytest.raises(RuntimeError, match=r"no home folder .*: set HOME or XDG_CACHE_HOME, or give sweeps=FOLDER"):
        ferry.LatticeEnv("open")
    ferry.LatticeEnv("open", sweeps=tmp_path / "given")
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    ferry.LatticeEnv("open")
    assert (tmp_path / "ferry" / "sweeps").is_dir()
