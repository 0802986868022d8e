"""Steps per second on one core; docs/results.md has the figures.

taskset -c 0 python speed.py
"""

import json
import subprocess
import sys
import time
from collections.abc import Callable

import numpy as np

import ferry

LANES = 64
SECONDS = 5.0


def rate(step: Callable[[], int]) -> float:
    """Steps per second of a function that returns how many it took."""
    step()
    began, steps = time.perf_counter(), 0
    while (took_s := time.perf_counter() - began) < SECONDS:
        steps += step()
    return steps / took_s


def lattice(observation: ferry.environments.ObservationKind) -> float:
    env = ferry.LatticeVectorEnv(LANES, "colon", observation=observation)
    env.reset(seed=1)
    actions = np.random.default_rng(1).integers(4, size=(1000, LANES))
    turn = iter(range(10**9))

    def step() -> int:
        env.step(actions[next(turn) % 1000])
        return LANES

    return rate(step)


def maze() -> float:
    """Control steps per second toward a point that a controller without a map would choose."""
    env = ferry.MazeEnv("colon", action="box", observation="vector")
    random = np.random.default_rng(1)
    _, info = env.reset(seed=1)
    # Ferry's own count: steps that its evaluations count, too.
    state = {"info": info}

    def step() -> int:
        way = state["info"]["goal_m"] - state["info"]["tool_m"]
        action = way / max(float(np.abs(way).max()), 1e-9) + random.normal(0, 0.5, 2)
        _, _, terminated, truncated, state["info"] = env.step(action)
        if terminated or truncated:
            _, state["info"] = env.reset()
        return 1

    return rate(step)


def evaluate() -> float:
    command = [sys.executable, "-m", "ferry", "evaluate", "--map", "colon", "--controller", "attractor"]
    began = time.perf_counter()
    done = subprocess.run([*command, "--episodes", "40", "--json"], capture_output=True, text=True, check=True)
    row = json.loads(done.stdout)["rows"][0]
    return row["steps_mean"] * row["episodes"] / (time.perf_counter() - began)


if __name__ == "__main__":
    print(f"Lattice-v0, {LANES} lanes, vector only:     {lattice('vector'):10.0f} steps/s")
    print(f"Lattice-v0, {LANES} lanes, full observation: {lattice('dict'):10.0f} steps/s")
    print(f"Maze-v0, one lane:                   {maze():10.1f} control steps/s")
    print(f"ferry evaluate, attractor:           {evaluate():10.1f} control steps/s")
