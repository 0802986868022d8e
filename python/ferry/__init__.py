"""Ferry for Python: the ``ferry`` command, and its environments for Gymnasium.

``import ferry`` registers ``ferry/Lattice-v0`` and ``ferry/Maze-v0``.
"""

from ferry._ferry import __version__
from ferry.environments import LatticeEnv, LatticeVectorEnv, MazeEnv, MazeVectorEnv, register

__all__ = ["LatticeEnv", "LatticeVectorEnv", "MazeEnv", "MazeVectorEnv", "__version__"]

register()
