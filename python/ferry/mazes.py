"""Trials of the full system: actions to places, and rewards."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from typing import Any, Literal

import numpy as np
from gymnasium import spaces
from numpy.typing import NDArray

from ferry import checks
from ferry._ferry import Mazes

STEP_M = 0.01
"""Distance between two cells, and length of a step."""
OFFSETS = np.array([[1, 0], [-1, 0], [0, 1], [0, -1]])
"""Columns and rows by which each action moves the tool."""


class MazeTrials:
    def __init__(
        self,
        lanes: int,
        map: str | os.PathLike[str],
        action: Literal["discrete", "box"],
        parameters: Mapping[str, Any] | None,
        disturbances: int,
        progress_reward: float,
    ) -> None:
        match action:
            case "discrete":
                self.action_space: spaces.Space[Any] = spaces.Discrete(4)
            case "box":
                self.action_space = spaces.Box(-1.0, 1.0, (2,), np.float32)
            case _:
                raise ValueError(f'action is {action!r}, it must be "discrete" or "box"')
        if not 0.0 <= progress_reward <= 1.0:
            raise ValueError(f"progress_reward is {progress_reward}, it must be 0 to 1")
        count = checks.whole("num_envs", lanes, 1, Mazes.MOST)
        disturbed = checks.whole("disturbances", disturbances)
        self.native = Mazes(checks.map_name(map), count, checks.changes(parameters), disturbed)
        self._action = action
        self._progress_reward = progress_reward
        self._corner_m: NDArray[np.float64] = np.array(self.native.corner_m())

    def start(self, seeds: Sequence[int | None], options: Sequence[Mapping[str, Any]]) -> None:
        fields = [
            (one.get("start_m"), one.get("goal_m"), one.get("parameters", []), one.get("disturbances"))
            for one in options
        ]
        self.native.start(seeds, fields)

    def targets_m(self, actions: NDArray[Any]) -> NDArray[np.float64]:
        """Where each action sends the tool, ``(lanes, 2)``."""
        tools_m = self.native.places_m()[:, :2]
        if self._action == "box":
            moved: NDArray[np.float64] = tools_m + STEP_M * actions.astype(np.float64)
            return moved
        cells = np.floor((tools_m - self._corner_m) / STEP_M)
        middles: NDArray[np.float64] = self._corner_m + (cells + 0.5 + OFFSETS[actions]) * STEP_M
        return middles

    def step(self, actions: NDArray[Any], mask: NDArray[np.bool_]) -> tuple[NDArray[np.float64], NDArray[np.uint8]]:
        counts_progress = self._progress_reward > 0.0
        asked = self.native.asks()
        before_m = self.native.remaining_m() if counts_progress else np.zeros(len(mask))
        self.native.step(self.targets_m(actions), mask)
        endings = self.native.endings() * mask
        rewards = (endings == 1) * 1.0 - (endings == 2)
        if counts_progress:
            gained = (before_m - self.native.remaining_m()) / STEP_M
            # While the arm fetches the bead, the tool's way is not the action's.
            counts = mask & asked & self.native.asks() & np.isfinite(gained)
            rewards = rewards + self._progress_reward * np.where(counts, gained, 0.0)
        return rewards, endings

    def info(self) -> dict[str, Any]:
        places_m = self.native.places_m()
        return {
            "asks": self.native.asks(),
            "tool_m": places_m[:, 0:2],
            "bead_tracked_m": places_m[:, 2:4],
            "goal_m": places_m[:, 4:6],
        }
