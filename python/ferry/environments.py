"""Ferry's environments for Gymnasium.

``ferry/Lattice-v0``
    Training's fast environment: the tool steps from cell to cell, 1 cm apart, and each cell has the camera's image.
    Bead, arm and physics are not simulated.
``ferry/Maze-v0``
    The full system: arm, magnet, bead, camera and switching law; one control step (0.25 s) a step.

Both have the same observations and actions, so a policy can be trained in one and tried in the other.

Observations
    ``observation="dict"`` (default): ``image``, uint8 ``(84, 84)``, the camera's gray image around the tool;
    ``vector``, float32 ``(4,)``, goal x and y, then tool x and y, each 0 to 1 over the workspace.
    ``observation="paper"``: float32 ``(2, 84, 84)``, 0 to 1, the same as the paper's two channels.
    ``observation="vector"``: only the vector.

Actions
    0 to 3: one cell along +x, −x, +y, −y.
    ``ferry/Maze-v0`` with ``action="box"``: float32 ``(2,)``, −1 to 1, a step of up to 1 cm along x and y.
"""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, Literal

import gymnasium
import numpy as np
from gymnasium import spaces
from gymnasium.vector import AutoresetMode
from gymnasium.vector.utils import batch_space
from numpy.typing import NDArray

from ferry import checks
from ferry._ferry import Lattice
from ferry.lanes import LanesEnv
from ferry.mazes import MazeTrials
from ferry.observing import ObservationKind, observation_space, observations, only

ENLARGED = 4
"""Pixels of a frame for each of the camera's image."""
PLAN_PX = (512, 384)


def default_sweeps() -> Path:
    """Where the camera's images of a map are kept."""
    cache = os.environ.get("XDG_CACHE_HOME")
    try:
        return Path(cache or Path.home() / ".cache") / "ferry" / "sweeps"
    except RuntimeError:
        raise RuntimeError(
            "there is no home folder to keep the camera's images in: set HOME or XDG_CACHE_HOME, or give sweeps=FOLDER"
        ) from None


def _new_lattice(
    map: str | os.PathLike[str],
    lanes: int,
    sweeps: str | os.PathLike[str] | None,
    progress_reward: float,
    step_penalty: float,
    clearance_m: float,
) -> Lattice:
    return Lattice(
        checks.map_name(map),
        checks.whole("num_envs", lanes, 1, Lattice.MOST),
        progress_reward=progress_reward,
        step_penalty=step_penalty,
        clearance_m=clearance_m,
        sweeps=default_sweeps() if sweeps is None else sweeps,
    )


def _start_lattice(
    native: Lattice,
    mask: NDArray[np.bool_],
    seeds: Sequence[int | None] | None,
    options: Sequence[Mapping[str, Any]] | None,
) -> None:
    places = None if options is None else [(one.get("start_m"), one.get("goal_m")) for one in options]
    native.start(mask, seeds, places)


def _enlarged(image: NDArray[np.uint8]) -> NDArray[np.uint8]:
    return np.stack([image.repeat(ENLARGED, axis=0).repeat(ENLARGED, axis=1)] * 3, axis=2)


class LatticeEnv(gymnasium.Env[Any, np.int64]):
    """``ferry/Lattice-v0``: training's fast environment; see :mod:`ferry.environments`.

    An episode ends with +1 within 2 cm of the goal, and with −1 when the image shows a wall nearer than
    ``clearance_m``. After 150 steps it is truncated. Each step adds ``progress_reward`` for each cell nearer to the
    goal along the shortest path, or subtracts it, and subtracts ``step_penalty``.

    ``info["distance_steps"]`` is the true number of steps to the goal; a policy must not use it.

    Args:
        map: name of a map, or path of an SVG.
        observation: ``"dict"``, ``"paper"`` or ``"vector"``.
        render_mode: ``"rgb_array"`` gives the camera's image, four times enlarged.
        progress_reward, step_penalty: 0 to 1.
        clearance_m: 0 to 0.02; 0 as in the paper.
        sweeps: folder that keeps the camera's images; the first use of a map takes them, for a few seconds.

    ``reset`` takes the options ``start_m`` and ``goal_m``: where the next episode begins, in the middle of a cell, and
    its goal.
    """

    metadata = {"render_modes": ["rgb_array"], "render_fps": 4}

    def __init__(
        self,
        map: str | os.PathLike[str] = "colon",
        *,
        observation: ObservationKind = "dict",
        render_mode: str | None = None,
        progress_reward: float = 0.1,
        step_penalty: float = 0.0,
        clearance_m: float = 0.008,
        sweeps: str | os.PathLike[str] | None = None,
    ) -> None:
        self.observation_space = observation_space(observation)
        self.action_space = spaces.Discrete(4)
        self.render_mode = checks.render_mode(render_mode)
        self._kind = observation
        self._native = _new_lattice(map, 1, sweeps, progress_reward, step_penalty, clearance_m)
        self._all = np.ones(1, bool)
        self._is_seeded = False

    def reset(self, *, seed: int | None = None, options: dict[str, Any] | None = None) -> tuple[Any, dict[str, Any]]:
        wished = checks.trial(options, checks.PLACES)
        seed = None if seed is None else checks.seed_of(seed)
        super().reset(seed=seed)
        if seed is None and not self._is_seeded:
            seed = int(self.np_random.integers(2**63))
        _start_lattice(self._native, self._all, [seed], [wished])
        self._is_seeded = True
        return self._observed(), self._info()

    def step(self, action: Any) -> tuple[Any, float, bool, bool, dict[str, Any]]:
        rewards, endings = self._native.step(
            checks.actions(self.action_space, action).astype(np.int64, copy=False), self._all
        )
        ending = endings[0]
        is_terminated, is_truncated = bool(ending in (1, 2)), bool(ending == 3)
        info = {**self._info(), "is_success": bool(ending == 1)}
        return self._observed(), float(rewards[0]), is_terminated, is_truncated, info

    def render(self) -> NDArray[np.uint8] | None:
        return None if self.render_mode is None else _enlarged(self._native.images()[0])

    def _observed(self) -> Any:
        return only(observations(self._native, self._kind))

    def _info(self) -> dict[str, Any]:
        return {"distance_steps": int(self._native.distances()[0])}


class LatticeVectorEnv(LanesEnv):
    """Many episodes of ``ferry/Lattice-v0`` at once; arguments as :class:`LatticeEnv`.

    ``autoreset_mode`` is one of Gymnasium's three modes. An option of ``reset`` is for all episodes, or a list with one
    for each; ``reset_mask`` says which begin.
    """

    OPTIONS = checks.PLACES

    def __init__(
        self,
        num_envs: int = 1,
        map: str | os.PathLike[str] = "colon",
        *,
        observation: ObservationKind = "dict",
        render_mode: str | None = None,
        progress_reward: float = 0.1,
        step_penalty: float = 0.0,
        clearance_m: float = 0.008,
        sweeps: str | os.PathLike[str] | None = None,
        autoreset_mode: AutoresetMode | str = AutoresetMode.NEXT_STEP,
    ) -> None:
        self._native = _new_lattice(map, num_envs, sweeps, progress_reward, step_penalty, clearance_m)
        self._begin(num_envs, observation, autoreset_mode, render_mode)
        self.single_action_space = spaces.Discrete(4)
        self.action_space = batch_space(self.single_action_space, num_envs)

    def _start(
        self,
        mask: NDArray[np.bool_],
        seeds: Sequence[int | None] | None = None,
        options: Sequence[Mapping[str, Any]] | None = None,
    ) -> None:
        _start_lattice(self._native, mask, seeds, options)

    def _observed(self) -> Any:
        return observations(self._native, self._kind)

    def _info(self) -> dict[str, Any]:
        return {"distance_steps": self._native.distances()}

    def _advance(self, actions: Any, mask: NDArray[np.bool_]) -> tuple[NDArray[Any], NDArray[Any]]:
        return self._native.step(
            checks.actions(self.single_action_space, actions, mask).astype(np.int64, copy=False), mask
        )

    def _frames(self) -> Sequence[NDArray[np.uint8]]:
        return [_enlarged(image) for image in self._native.images()]


class MazeEnv(gymnasium.Env[Any, Any]):
    """``ferry/Maze-v0``: the full system; see :mod:`ferry.environments`.

    An action counts while sub-controller 2 carries the bead (``info["asks"]``); while sub-controller 1 fetches it, and
    within 2 cm of the goal, Ferry moves the arm itself. A step that the limits refuse (a wall in the image, the reach)
    holds the arm; ``info["refusal"]`` says why.

    An episode ends with +1 when the bead is delivered, and with −1 when it cannot be any more: it hangs on the magnet,
    the goal is walled off, or the bead did not follow. It is truncated when the parameter ``step_limit`` is used up.

    ``info`` has ``tool_m``, ``bead_tracked_m`` and ``goal_m``, each ``(2,)`` in metres, and ``phase``.

    ``reset`` takes the options ``start_m``, ``goal_m``, ``parameters`` and ``disturbances``, for the next episode only.

    Args:
        map: name of a map, or path of an SVG.
        observation: ``"dict"``, ``"paper"`` or ``"vector"``.
        action: ``"discrete"`` or ``"box"``.
        render_mode: ``"rgb_array"`` gives the table from above.
        parameters: Ferry's parameters by name, as in ``ferry evaluate --set``.
        disturbances: how often the bead is lifted and put down elsewhere.
        progress_reward: for each centimetre nearer to the goal along the shortest path, 0 to 1. It costs time to
        compute.
    """

    metadata = {"render_modes": ["rgb_array"], "render_fps": 4}

    def __init__(
        self,
        map: str | os.PathLike[str] = "colon",
        *,
        observation: ObservationKind = "dict",
        action: Literal["discrete", "box"] = "discrete",
        render_mode: str | None = None,
        parameters: Mapping[str, Any] | None = None,
        disturbances: int = 0,
        progress_reward: float = 0.0,
    ) -> None:
        self.observation_space = observation_space(observation)
        self.render_mode = checks.render_mode(render_mode)
        self._kind = observation
        self._trials = MazeTrials(1, map, action, parameters, disturbances, progress_reward)
        self.action_space = self._trials.action_space
        self._native = self._trials.native

    def reset(self, *, seed: int | None = None, options: dict[str, Any] | None = None) -> tuple[Any, dict[str, Any]]:
        wished = checks.trial(options, checks.TRIAL)
        seed = None if seed is None else checks.seed_of(seed)
        super().reset(seed=seed)
        self._trials.start([int(self.np_random.integers(2**63)) if seed is None else seed], [wished])
        return self._observed(), self._info()

    def step(self, action: Any) -> tuple[Any, float, bool, bool, dict[str, Any]]:
        rewards, endings = self._trials.step(checks.actions(self.action_space, action), np.ones(1, bool))
        ending = endings[0]
        is_terminated, is_truncated = bool(ending in (1, 2)), bool(ending == 3)
        info = {**self._info(), "is_success": bool(ending == 1)}
        return self._observed(), float(rewards[0]), is_terminated, is_truncated, info

    def render(self) -> NDArray[np.uint8] | None:
        return None if self.render_mode is None else self._native.picture(0, *PLAN_PX)

    def _observed(self) -> Any:
        return only(observations(self._native, self._kind))

    def _info(self) -> dict[str, Any]:
        info = {key: value[0] for key, value in self._trials.info().items()}
        return info | {
            "asks": bool(info["asks"]),
            "phase": self._native.phases()[0],
            "refusal": self._native.refusals()[0],
        }


class MazeVectorEnv(LanesEnv):
    """Many trials of ``ferry/Maze-v0`` at once, on all cores; arguments as :class:`MazeEnv`.

    ``autoreset_mode`` is one of Gymnasium's three modes. An option of ``reset`` is for all trials, or a list with one
    for each; ``reset_mask`` says which begin.
    """

    OPTIONS = checks.TRIAL

    def __init__(
        self,
        num_envs: int = 1,
        map: str | os.PathLike[str] = "colon",
        *,
        observation: ObservationKind = "dict",
        action: Literal["discrete", "box"] = "discrete",
        render_mode: str | None = None,
        parameters: Mapping[str, Any] | None = None,
        disturbances: int = 0,
        progress_reward: float = 0.0,
        autoreset_mode: AutoresetMode | str = AutoresetMode.NEXT_STEP,
    ) -> None:
        self._trials = MazeTrials(num_envs, map, action, parameters, disturbances, progress_reward)
        self._begin(num_envs, observation, autoreset_mode, render_mode)
        self.single_action_space = self._trials.action_space
        self.action_space = batch_space(self.single_action_space, num_envs)
        self._lanes_random: list[np.random.Generator] = []

    def _start(
        self,
        mask: NDArray[np.bool_],
        seeds: Sequence[int | None] | None = None,
        options: Sequence[Mapping[str, Any]] | None = None,
    ) -> None:
        # Each lane draws the seeds of its later trials from its first one.
        seeds = seeds or [None] * self.num_envs
        self._lanes_random = self._lanes_random or [np.random.default_rng() for _ in seeds]
        for lane, seed in enumerate(seeds):
            if mask[lane] and seed is not None:
                self._lanes_random[lane] = np.random.default_rng(seed)
        drawn = [
            None if not starts else int(random.integers(2**63)) if seed is None else seed
            for starts, seed, random in zip(mask, seeds, self._lanes_random, strict=True)
        ]
        self._trials.start(drawn, options or [{}] * self.num_envs)

    def _observed(self) -> Any:
        return observations(self._trials.native, self._kind)

    def _info(self) -> dict[str, Any]:
        return self._trials.info()

    def _advance(self, actions: Any, mask: NDArray[np.bool_]) -> tuple[NDArray[Any], NDArray[Any]]:
        return self._trials.step(checks.actions(self.single_action_space, actions, mask), mask)

    def _frames(self) -> Sequence[NDArray[np.uint8]]:
        return [self._trials.native.picture(lane, *PLAN_PX) for lane in range(self.num_envs)]


def register() -> None:
    """Registers the environments with Gymnasium. Doing it twice does no harm."""
    for name, env, vector in [
        ("ferry/Lattice-v0", "LatticeEnv", "LatticeVectorEnv"),
        ("ferry/Maze-v0", "MazeEnv", "MazeVectorEnv"),
    ]:
        if name not in gymnasium.registry:
            gymnasium.register(
                name,
                entry_point=f"ferry.environments:{env}",
                vector_entry_point=f"ferry.environments:{vector}",
            )
