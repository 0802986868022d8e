"""The environments as Gymnasium means them."""

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
        (lambda: ferry.LatticeVectorEnv(0), "lanes is 0"),
        (lambda: ferry.MazeEnv(action="jump"), "action is 'jump'"),
        (lambda: ferry.MazeEnv(parameters={"wings": 2}), "wings"),
        (lambda: ferry.MazeEnv(parameters={"friction": 9.0}), "friction"),
        (lambda: ferry.MazeVectorEnv(1000), "lanes is 1000"),
    ],
)
def test_bad_settings_are_named(make: object, text: str) -> None:
    with pytest.raises(ValueError, match=text):
        make()


def test_bad_actions_are_named_and_change_nothing() -> None:
    env = ferry.LatticeVectorEnv(2, "posts", observation="vector", autoreset_mode=AutoresetMode.DISABLED)
    before, _ = env.reset(seed=1)
    for actions, text in [([0, 4], r"action\[1\] is 4"), ([0, -1], r"action\[1\] is -1"), ([0], "action has 1")]:
        with pytest.raises(ValueError, match=text):
            env.step(np.array(actions))
    assert np.array_equal(env._observed(), before)
    maze = ferry.MazeEnv("posts")
    maze.reset(seed=1)
    with pytest.raises(ValueError, match="action is 7, it must be 0 to 3"):
        maze.step(7)
