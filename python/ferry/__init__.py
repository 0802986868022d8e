"""Ferry for Python: the ``ferry`` command, its environments for Gymnasium, controllers of one's own, evaluations
and recovery maps.

``import ferry`` registers ``ferry/Lattice-v0`` and ``ferry/Maze-v0``.
"""

from ferry._ferry import __version__
from ferry.controllers import Controller, Leg, Percept, Refused, Step, serve
from ferry.environments import LatticeEnv, LatticeVectorEnv, MazeEnv, MazeVectorEnv, register
from ferry.evaluation import Evaluation, evaluate
from ferry.recovery import RecoveryMap, recovery
from ferry.training import train

__all__ = [
    "Controller",
    "Evaluation",
    "LatticeEnv",
    "LatticeVectorEnv",
    "Leg",
    "MazeEnv",
    "MazeVectorEnv",
    "Percept",
    "RecoveryMap",
    "Refused",
    "Step",
    "__version__",
    "evaluate",
    "recovery",
    "serve",
    "train",
]

register()
