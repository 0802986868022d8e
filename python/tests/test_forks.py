"""Processes that are forked. Each case is a program of its own: what was used before decides what works after."""

import subprocess
import sys
from pathlib import Path

import pytest

HEAD = """
import multiprocessing, sys
import gymnasium, numpy as np
import ferry

def lanes():
    return gymnasium.make_vec("ferry/Maze-v0", num_envs=2, vectorization_mode="vector_entry_point", map="posts")

def steps(envs):
    envs.reset(seed=1)
    envs.step(np.zeros(2, np.int64))
    return envs

def in_a_pool(_):
    steps(lanes())

if __name__ == "__main__":
    context, sweeps = sys.argv[1:]
"""
# Nothing is kept in the folder: the parent takes the images of one map, a child those of the other.
TWO_MAPS = """
    names = ("posts", "u-turn")
    makers = [lambda name=name: gymnasium.make("ferry/Lattice-v0", map=name, sweeps=sweeps) for name in names]
    steps(gymnasium.vector.AsyncVectorEnv(makers, context=context)).close()
"""
MAZES = """
    own = {"context": context}
    steps(gymnasium.make_vec("ferry/Maze-v0", 2, "async", vector_kwargs=own, map="posts")).close()
"""
THREADS = """
    before = steps(lanes())
"""
POOL = """
    with multiprocessing.get_context(context).Pool(2) as pool:
        pool.map(in_a_pool, range(2))
"""
# A child steps what its parent has begun.
INHERITED = """
    before = steps(lanes())
    child = multiprocessing.get_context(context).Process(target=steps, args=(before,))
    child.start()
    child.join()
    assert child.exitcode == 0
"""
EVALUATION = """
    before = steps(lanes())
    with multiprocessing.get_context(context).Pool(1) as pool:
        pool.apply(ferry.evaluate, args=("attractor",), kwds={"map": "open", "episodes": 1})
"""
# Without the remedy, a child hangs for ever. A busy machine needs ten seconds.
WITHIN_S = 20.0
REMEDY = 'Start processes by "spawn" or "forkserver"'


@pytest.mark.parametrize(
    ("context", "program", "works"),
    [
        ("fork", TWO_MAPS, False),
        ("fork", MAZES, True),
        ("fork", THREADS + MAZES, False),
        ("fork", POOL, True),
        ("fork", THREADS + POOL, False),
        ("fork", INHERITED, False),
        ("fork", EVALUATION, False),
        ("forkserver", TWO_MAPS, True),
        ("forkserver", THREADS + MAZES, True),
        ("forkserver", THREADS + POOL, True),
        ("spawn", TWO_MAPS, True),
        ("spawn", THREADS + MAZES, True),
        ("spawn", THREADS + POOL, True),
    ],
)
def test_a_process_works_or_names_the_remedy(context: str, program: str, works: bool, tmp_path: Path) -> None:
    path = tmp_path / "program.py"
    path.write_text(HEAD + program + '    print("ended")\n')
    arguments = [sys.executable, str(path), context, str(tmp_path / "sweeps")]
    done = subprocess.run(arguments, capture_output=True, text=True, timeout=WITHIN_S, check=False)
    told = done.stdout + done.stderr
    assert ("ended" in done.stdout.split()) == works, told
    assert works or REMEDY in told, told
