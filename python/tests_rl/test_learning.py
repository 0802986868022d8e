"""stable-baselines3 on Ferry's environments, and what it learned in a running Ferry."""

import subprocess
import sys
import time
import urllib.request
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import gymnasium
import numpy as np
import pytest
from gymnasium.wrappers import TransformObservation
from stable_baselines3 import PPO
from stable_baselines3.common.env_checker import check_env
from stable_baselines3.common.torch_layers import NatureCNN
from stable_baselines3.common.vec_env import VecMonitor

import ferry
from ferry.sb3 import FerryVecEnv

PYTHON = Path(__file__).parents[1]
EXAMPLES = PYTHON / "examples"
sys.path += [str(EXAMPLES), str(PYTHON / "tests")]

from test_controllers import Page, address, opened  # noqa: E402, F401

NAMES = ["ferry/Lattice-v0", "ferry/Maze-v0"]
# learn.py trains with the seeds 1 to 256.
HELD_OUT_SEED = 1_000_000
LIVE_SEED = 2_000_000
SPEED = 8
OVER = ("delivered", "lifted_off", "stopped")


def wilson(successes: int, trials: int) -> tuple[float, float]:
    """The 95 % interval of a rate."""
    z = 1.959964
    rate, spread = successes / trials, z * z / trials
    middle = (rate + spread / 2) / (1 + spread)
    half = z * ((rate * (1 - rate) + spread / 4) / trials) ** 0.5 / (1 + spread)
    return middle - half, middle + half


@pytest.mark.parametrize("name", NAMES)
def test_stable_baselines3_accepts_vectors(name: str) -> None:
    # Warnings are errors here.
    check_env(gymnasium.make(name, map="posts", observation="vector").unwrapped)


@pytest.mark.parametrize("name", NAMES)
def test_stable_baselines3_accepts_images_with_a_channel(name: str) -> None:
    env = gymnasium.make(name, map="posts").unwrapped
    with pytest.warns(UserWarning, match="observation image has an unconventional shape"):
        check_env(env)
    image = gymnasium.spaces.Box(0, 255, (1, 84, 84), np.uint8)
    space = gymnasium.spaces.Dict({**env.observation_space.spaces, "image": image})
    check_env(TransformObservation(env, lambda seen: {**seen, "image": seen["image"][None]}, space))


def test_boxes_as_actions_are_accepted() -> None:
    check_env(gymnasium.make("ferry/Maze-v0", map="posts", observation="vector", action="box").unwrapped)


@pytest.mark.parametrize(
    ("observation", "policy", "settings"),
    [("dict", "MultiInputPolicy", {}), ("paper", "CnnPolicy", {"normalize_images": False})],
)
@pytest.mark.parametrize("name", NAMES)
def test_learners_take_the_image_for_an_image(name: str, observation: str, policy: str, settings: Any) -> None:
    made = gymnasium.make_vec(name, 2, map="posts", observation=observation, autoreset_mode="SameStep")
    learner = PPO(policy, FerryVecEnv(made), n_steps=8, batch_size=16, n_epochs=1, policy_kwargs=settings, device="cpu")
    learner.learn(32)
    extractor = learner.policy.features_extractor
    assert isinstance(extractor.extractors["image"] if observation == "dict" else extractor, NatureCNN)


def equal(a: Any, b: Any) -> bool:
    if isinstance(a, dict):
        return a.keys() == b.keys() and all(equal(a[key], b[key]) for key in a)
    return bool(np.array_equal(a, b))


def lattice(seed: int) -> tuple[FerryVecEnv, list[gymnasium.Env]]:
    made = gymnasium.make_vec("ferry/Lattice-v0", 4, map="open", autoreset_mode="SameStep")
    return FerryVecEnv(made), [ferry.LatticeEnv("open") for _ in range(4)]


def maze(seed: int) -> tuple[FerryVecEnv, list[gymnasium.Env]]:
    few = {"map": "open", "parameters": {"step_limit": 20}}
    made = gymnasium.make_vec("ferry/Maze-v0", 2, autoreset_mode="SameStep", **few)
    return FerryVecEnv(made), [ferry.MazeEnv(**few) for _ in range(2)]


@pytest.mark.parametrize(("make", "steps", "ends"), [(lattice, 400, True), (maze, 100, False)])
def test_lanes_are_single_environments(make: Callable[[int], Any], steps: int, ends: bool) -> None:
    lanes, singles = make(7)
    lanes.seed(7)
    seen = lanes.reset()
    firsts = [single.reset(seed=7 + lane)[0] for lane, single in enumerate(singles)]
    random = np.random.default_rng(1)
    truncations = terminations = 0
    for step in range(steps):
        for lane, first in enumerate(firsts):
            assert equal({key: value[lane] for key, value in seen.items()}, {**first, "image": first["image"][None]})
        # The first half of the lanes goes to and fro until the time is up.
        actions = np.where(np.arange(len(singles)) < len(singles) / 2, step % 2, random.integers(4, size=len(singles)))
        seen, rewards, dones, infos = lanes.step(actions)
        assert rewards.dtype == np.float32 and dones.dtype == bool and len(infos) == len(singles)
        for lane, single in enumerate(singles):
            last, reward, terminated, truncated, info = single.step(actions[lane])
            assert rewards[lane] == pytest.approx(reward) and dones[lane] == (terminated or truncated)
            assert infos[lane]["TimeLimit.truncated"] == (truncated and not terminated)
            truncations, terminations = truncations + truncated, terminations + terminated
            if dones[lane]:
                assert equal(infos[lane]["terminal_observation"], {**last, "image": last["image"][None]})
                assert infos[lane]["is_success"] == info["is_success"]
                last, _ = single.reset()
            else:
                assert "terminal_observation" not in infos[lane]
            firsts[lane] = last
    assert truncations > 0 and (terminations > 0 or not ends)


def test_the_same_seed_gives_the_same_lanes() -> None:
    made = gymnasium.make_vec("ferry/Lattice-v0", 3, map="posts", observation="vector", autoreset_mode="SameStep")
    lanes = VecMonitor(FerryVecEnv(made))
    seen = []
    for seed in [5, 5, None, 6]:
        if seed is not None:
            lanes.seed(seed)
        seen.append(lanes.reset())
    assert equal(seen[0], seen[1]) and not equal(seen[0], seen[2]) and not equal(seen[0], seen[3])
    assert lanes.get_attr("num_envs") == [3] * 3 and lanes.get_attr("render_mode", [0, 1]) == [None] * 2


def test_options_are_for_the_next_episode() -> None:
    made = gymnasium.make_vec("ferry/Lattice-v0", 2, map="open", observation="vector", autoreset_mode="SameStep")
    lanes = FerryVecEnv(made)
    lanes.set_options([{"goal_m": (0.1, -0.4)}, {"start_m": (-0.1, -0.3), "goal_m": (0.2, -0.3)}])
    goals = lanes.reset()[:, :2]
    assert goals == pytest.approx(np.array([[0.4, 0.14], [0.5, 0.24]]) / [0.58, 0.33], abs=0.004)
    assert not np.allclose(lanes.reset()[:, :2], goals, atol=0.01)
    lanes.set_options({"gaol_m": (0.1, -0.4)})
    with pytest.raises(ValueError, match="options has 'gaol_m'"):
        lanes.reset()


@pytest.mark.parametrize("name", NAMES)
def test_frames_are_those_of_the_lanes(name: str) -> None:
    made = gymnasium.make_vec(name, 2, map="posts", render_mode="rgb_array", autoreset_mode="SameStep")
    lanes = FerryVecEnv(made)
    lanes.reset()
    assert lanes.render_mode == "rgb_array" and lanes.metadata["render_fps"] == 4
    assert equal(list(lanes.get_images()), list(made.render())) and lanes.render().ndim == 3
    assert FerryVecEnv(gymnasium.make_vec(name, 2, autoreset_mode="SameStep")).get_images() == [None, None]


def test_other_ways_to_begin_again_are_refused() -> None:
    with pytest.raises(ValueError, match="autoreset_mode is 'NextStep', it must be 'SameStep'"):
        FerryVecEnv(gymnasium.make_vec("ferry/Lattice-v0", 2, map="posts"))


@pytest.mark.parametrize("name", ["LatticeEnv", "MazeEnv"])
def test_torch_can_be_loaded_after_an_environment(name: str) -> None:
    text = f"import ferry; env = ferry.{name}('posts'); env.reset(seed=1); import torch._dynamo"
    assert subprocess.run([sys.executable, "-c", text], capture_output=True).returncode == 0


def example(name: str, *arguments: object) -> list[str]:
    return [sys.executable, str(EXAMPLES / name), *map(str, arguments)]


@pytest.fixture(scope="module")
def policy(tmp_path_factory: pytest.TempPathFactory) -> Path:
    file = tmp_path_factory.mktemp("policy") / "colon.zip"
    began = time.monotonic()
    subprocess.run(example("learn.py", "train", file), check=True, capture_output=True)
    print(f"\ntraining: {time.monotonic() - began:.0f} s, {file.stat().st_size} bytes")
    return file


def reached(file: Path, episodes: int) -> int:
    """How many episodes the policy ends at the goal."""
    env = gymnasium.make_vec("ferry/Lattice-v0", episodes, map="colon", observation="vector", autoreset_mode="SameStep")
    lanes, policy = FerryVecEnv(env), PPO.load(file, device="cpu").policy
    lanes.seed(HELD_OUT_SEED)
    seen = lanes.reset()
    successes: dict[int, bool] = {}
    while len(successes) < episodes:
        seen, _, dones, infos = lanes.step(policy.predict(seen, deterministic=True)[0])
        for lane in np.flatnonzero(dones):
            successes.setdefault(int(lane), infos[lane]["is_success"])
    return sum(successes.values())


def test_training_reaches_the_goal(policy: Path) -> None:
    count = reached(policy, 1000)
    low, high = wilson(count, 1000)
    print(f"\nheld-out episodes: {count} of 1000, {low:.4f} to {high:.4f}")
    assert count >= 950


@contextmanager
def running(command: list[str], address: str, name: str) -> Iterator[None]:  # noqa: F811
    """A program that has connected."""
    process = subprocess.Popen(command)
    try:
        until = time.monotonic() + 120
        while name not in urllib.request.urlopen(f"{address}/api/controllers", timeout=30).read().decode():
            assert process.poll() is None and time.monotonic() < until
            time.sleep(0.5)
        yield
        assert process.poll() is None
    finally:
        process.kill()
        process.wait()


def is_at(place: Any, goal_m: np.ndarray) -> bool:
    return place is not None and bool(np.allclose(place[:2], goal_m, atol=1e-6))


def carried(page: Page, name: str, start_m: np.ndarray, goal_m: np.ndarray) -> dict[str, Any]:
    """The state at the end of a trial."""
    page.send(type="load_scenario", map="colon", start_m=start_m.tolist(), goal_m=goal_m.tolist())
    page.send(type="select_controller", controller="program", program=name)
    page.send(type="set_speed", factor=SPEED)
    page.state(
        lambda state: (
            is_at(state["goal_m"], goal_m)
            and not state["phase"]["code"] in OVER
            and state["program"] is not None
            and state["program"]["name"] == name
            and state["program"]["is_connected"]
        )
    )
    page.send(type="run")
    return page.state(lambda state: is_at(state["goal_m"], goal_m) and state["phase"]["code"] in OVER, 180)


def delivered(address: str, name: str, trials: int) -> int:  # noqa: F811
    env = ferry.MazeEnv("colon", observation="vector")
    count, began, simulated_s = 0, time.monotonic(), 0.0
    with opened(address) as page:
        for seed in range(LIVE_SEED, LIVE_SEED + trials):
            _, info = env.reset(seed=seed)
            state = carried(page, name, info["tool_m"], info["goal_m"])
            count += state["phase"]["code"] == "delivered"
            simulated_s += state["sim_time_s"]
            if state["phase"]["code"] != "delivered":
                print(
                    f"\nseed {seed}: {state['phase']['text']}, {(state['refusal'] or state['trouble'] or {}).get('text')}",
                    end="",
                )
    program = state["program"]
    took_s = time.monotonic() - began
    low, high = wilson(count, trials)
    print(f"\n{name}: {count} of {trials} delivered, {low:.3f} to {high:.3f}; {simulated_s:.0f} s in {took_s:.0f} s")
    print(f"{program['answers']} answers, {program['missed']} missed")
    return count


def test_the_policy_delivers_in_a_running_ferry(policy: Path, address: str) -> None:  # noqa: F811
    with running(example("learn.py", "serve", policy, address), address, "learned"):
        assert delivered(address, "learned", 100) >= 90


def test_its_onnx_file_delivers_too(policy: Path, address: str, tmp_path: Path) -> None:  # noqa: F811
    file = tmp_path / "colon.onnx"
    subprocess.run(example("learn.py", "export", policy, file), check=True, capture_output=True)
    with running(example("onnx_policy.py", file, address), address, "onnx"):
        assert delivered(address, "onnx", 10) >= 8
