from collections.abc import Sequence
from os import PathLike

import numpy as np
from numpy.typing import NDArray

__version__: str

_Place = tuple[float, float] | None
"""Drawn at random where it is not given."""

def run(arguments: Sequence[str]) -> int:
    """Run the command ``ferry``; the first argument is the program's name. Return its exit status."""

def observation(
    gray: NDArray[np.uint8],
    goal_m: tuple[float, ...],
    tool_m: tuple[float, ...],
    workspace_m: tuple[float, float, float, float],
) -> tuple[NDArray[np.uint8], NDArray[np.float32]]:
    """The image ``(84, 84)`` and the vector ``(4,)`` of a camera's gray image."""

class Lattice:
    """Training's episodes side by side on one map. Each lane is one episode."""

    MOST: int
    """Largest number of lanes."""

    def __new__(
        cls,
        map: str,
        lanes: int,
        *,
        progress_reward: float,
        step_penalty: float,
        clearance_m: float,
        sweeps: str | PathLike[str],
    ) -> Lattice: ...
    @classmethod
    def from_pickle(cls, kept: bytes) -> Lattice: ...
    def cells(self) -> int: ...
    def start(
        self,
        mask: NDArray[np.bool_],
        seeds: Sequence[int | None] | None = None,
        wishes: Sequence[tuple[_Place, _Place]] | None = None,
    ) -> None: ...
    def step(
        self, actions: NDArray[np.int64], mask: NDArray[np.bool_]
    ) -> tuple[NDArray[np.float32], NDArray[np.uint8]]: ...
    def images(self) -> NDArray[np.uint8]: ...
    def vectors(self) -> NDArray[np.float32]: ...
    def distances(self) -> NDArray[np.int64]: ...
    def places_m(self) -> NDArray[np.float64]: ...

class Mazes:
    """Trials of the full system side by side on one map. Each lane is one trial."""

    MOST: int
    """Largest number of lanes."""

    def __new__(cls, map: str, lanes: int, changes: Sequence[str], disturbances: int) -> Mazes: ...
    @classmethod
    def from_pickle(cls, kept: bytes) -> Mazes: ...
    def start(
        self,
        seeds: Sequence[int | None],
        wishes: Sequence[tuple[_Place, _Place, Sequence[str], int | None]],
    ) -> None: ...
    def step(self, targets_m: NDArray[np.float64], mask: NDArray[np.bool_]) -> None: ...
    def images(self) -> NDArray[np.uint8]: ...
    def vectors(self) -> NDArray[np.float32]: ...
    def places_m(self) -> NDArray[np.float64]: ...
    def asks(self) -> NDArray[np.bool_]: ...
    def phases(self) -> list[str]: ...
    def endings(self) -> NDArray[np.uint8]: ...
    def corner_m(self) -> list[float]: ...
    def refusals(self) -> list[str | None]: ...
    def steps(self) -> NDArray[np.int64]: ...
    def remaining_m(self) -> NDArray[np.float64]: ...
    def picture(self, lane: int, width_px: int, height_px: int) -> NDArray[np.uint8]: ...

class Job:
    """An evaluation or a recovery map, ready to run."""

    @staticmethod
    def evaluation(
        *,
        controllers: Sequence[tuple[str, bool]],
        maps: Sequence[str],
        disturbances: Sequence[int],
        episodes: int,
        seed: int,
        changes: Sequence[str],
        vary: Sequence[str],
        by_hand: bool,
        tool_apart: bool,
        policy: str | None,
    ) -> Job: ...
    @staticmethod
    def recovery(
        *,
        controllers: Sequence[tuple[str, bool]],
        map: str,
        scenario: str | None,
        at_s: float,
        kind: str,
        grid: int,
        repeats: int,
        seed: int,
        within_s: float,
        full: bool,
        changes: Sequence[str],
    ) -> Job: ...
    def done(self) -> int: ...
    def planned(self) -> int: ...
    def stop(self) -> None: ...
    def run(self, number: int, count: int, threads: int) -> bytes: ...
    def receive(self, own: int) -> str | bytes | None: ...
    def give_up(self, own: int) -> None: ...
    def send(self, own: int, text: str) -> None: ...

def merge(parts: Sequence[bytes]) -> str:
    """The report of an evaluation or of a recovery map as JSON, from the files of all its shards."""
