"""Ferry for Python: the ``ferry`` command, its environments for Gymnasium, and controllers of one's own.

``import ferry`` registers ``ferry/Lattice-v0`` and ``ferry/Maze-v0``.
"""

from ferry._ferry import __version__
from ferry.controllers import Controller, Leg, Percept, Refused, Step, serve
from ferry.environments import LatticeEnv, LatticeVectorEnv, MazeEnv, MazeVectorEnv, register

__all__ = [
    "Controller",
    "LatticeEnv",
    "LatticeVectorEnv",
    "Leg",
    "MazeEnv",
    "MazeVectorEnv",
    "Percept",
    "Refused",
    "Step",
    "__version__",
    "serve",
]

register()
