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

import json
import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, Literal

import gymnasium
import numpy as np
from gymnasium import spaces
from gymnasium.vector import AutoresetMode, VectorEnv
from gymnasium.vector.utils import batch_space
from numpy.typing import NDArray

from ferry._ferry import Lattice, Mazes
from ferry.evaluation import changes

SIDE_PX = 84
STEP_M = 0.01
"""Distance between two cells, and length of a step."""
OFFSETS = np.array([[1, 0], [-1, 0], [0, 1], [0, -1]])
"""Columns and rows by which each action moves the tool."""

ObservationKind = Literal["dict", "paper", "vector"]


def observation_space(kind: ObservationKind) -> spaces.Space[Any]:
    vector = spaces.Box(0.0, 1.0, (4,), np.float32)
    match kind:
        case "dict":
            image = spaces.Box(0, 255, (SIDE_PX, SIDE_PX), np.uint8)
            return spaces.Dict({"image": image, "vector": vector})
        case "paper":
            return spaces.Box(0.0, 1.0, (2, SIDE_PX, SIDE_PX), np.float32)
        case "vector":
            return vector
    raise ValueError(f'observation is {kind!r}, it must be "dict", "paper" or "vector"')


def observations(native: Lattice | Mazes, kind: ObservationKind) -> Any:
    """The observations of all lanes."""
    vectors = native.vectors()
    if kind == "vector":
        return vectors
    images = native.images()
    if kind == "dict":
        return {"image": images, "vector": vectors}
    half = SIDE_PX // 2
    channels = np.empty((len(vectors), 2, SIDE_PX, SIDE_PX), np.float32)
    channels[:, 0] = images / np.float32(255)
    # Goal above, tool below; x left, y right.
    blocks = vectors.reshape(-1, 2, 2)
    channels[:, 1] = blocks.repeat(half, axis=1).repeat(half, axis=2)
    return channels


def _only(batch: Any) -> Any:
    """The observation of the only lane."""
    return {key: value[0] for key, value in batch.items()} if isinstance(batch, dict) else batch[0]


def default_sweeps() -> Path:
    """Where the camera's images of a map are kept."""
    cache = os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache"
    return Path(cache) / "ferry" / "sweeps"


def _new_lattice(
    map: str,
    lanes: int,
    sweeps: str | os.PathLike[str] | None,
    progress_reward: float,
    step_penalty: float,
    clearance_m: float,
) -> Lattice:
    settings = {
        "progress_reward": progress_reward,
        "step_penalty": step_penalty,
        "clearance_m": clearance_m,
    }
    return Lattice(map, lanes, json.dumps(settings), default_sweeps() if sweeps is None else sweeps, 0)


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
    """

    metadata = {"render_modes": ["rgb_array"], "render_fps": 4}

    def __init__(
        self,
        map: str = "colon",
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
        self.render_mode = render_mode
        self._kind = observation
        self._native = _new_lattice(map, 1, sweeps, progress_reward, step_penalty, clearance_m)
        self._all = np.ones(1, bool)
        self._is_seeded = False

    def reset(self, *, seed: int | None = None, options: dict[str, Any] | None = None) -> tuple[Any, dict[str, Any]]:
        super().reset(seed=seed)
        if seed is None and not self._is_seeded:
            seed = int(self.np_random.integers(2**63))
        self._is_seeded = True
        self._native.start(self._all, [seed])
        return self._observed(), self._info()

    def step(self, action: Any) -> tuple[Any, float, bool, bool, dict[str, Any]]:
        rewards, endings = self._native.step(np.array([action], np.int64), self._all)
        ending = endings[0]
        is_terminated, is_truncated = bool(ending in (1, 2)), bool(ending == 3)
        info = {**self._info(), "is_success": bool(ending == 1)}
        return self._observed(), float(rewards[0]), is_terminated, is_truncated, info

    def render(self) -> NDArray[np.uint8] | None:
        if self.render_mode != "rgb_array":
            return None
        enlarged: NDArray[np.uint8] = self._native.images()[0].repeat(4, axis=0).repeat(4, axis=1)
        return np.stack([enlarged] * 3, axis=2)

    def _observed(self) -> Any:
        return _only(observations(self._native, self._kind))

    def _info(self) -> dict[str, Any]:
        return {"distance_steps": int(self._native.distances()[0])}


class _LanesEnv(VectorEnv[Any, Any, Any]):
    """What the vector environments have in common: seeds, and how lanes begin again."""

    render_mode: str | None = None

    def _begin(self, num_envs: int, kind: ObservationKind, mode: AutoresetMode | str) -> None:
        self.num_envs = num_envs
        self.metadata = {"render_modes": [], "autoreset_mode": AutoresetMode(mode)}
        self.single_observation_space = observation_space(kind)
        self.observation_space = batch_space(self.single_observation_space, num_envs)
        self._kind = kind
        self._has_ended = np.zeros(num_envs, bool)
        self._is_seeded = False

    def _start(self, mask: NDArray[np.bool_], seeds: Sequence[int | None] | None) -> None:
        """Begins an episode in the lanes of ``mask``; without seeds, from the lanes' own random numbers."""
        raise NotImplementedError

    def _observed(self) -> Any:
        raise NotImplementedError

    def _info(self) -> dict[str, Any]:
        """What is known about each lane."""
        raise NotImplementedError

    def _advance(self, actions: Any, mask: NDArray[np.bool_]) -> tuple[NDArray[Any], NDArray[Any]]:
        """Steps the lanes of ``mask``: rewards, and endings (0 none, 1 success, 2 failure, 3 out of steps)."""
        raise NotImplementedError

    def reset(
        self,
        *,
        seed: int | Sequence[int | None] | None = None,
        options: dict[str, Any] | None = None,
    ) -> tuple[Any, dict[str, Any]]:
        mask = np.ones(self.num_envs, bool)
        if options is not None and "reset_mask" in options:
            mask = np.asarray(options["reset_mask"], bool)
        seeds: Sequence[int | None] | None
        if isinstance(seed, Sequence):
            seeds = seed
        elif seed is not None:
            super().reset(seed=seed)
            seeds = [seed + lane for lane in range(self.num_envs)]
        elif not self._is_seeded:
            seeds = [int(number) for number in self.np_random.integers(2**63, size=self.num_envs)]
        else:
            seeds = None
        self._is_seeded = True
        self._start(mask, seeds)
        self._has_ended &= ~mask
        return self._observed(), self._with_masks(self._info())

    def step(
        self, actions: Any
    ) -> tuple[Any, NDArray[np.float64], NDArray[np.bool_], NDArray[np.bool_], dict[str, Any]]:
        mode = self.metadata["autoreset_mode"]
        steps = ~self._has_ended
        if mode == AutoresetMode.DISABLED and not steps.all():
            raise ValueError(f"lane {self._has_ended.argmax()} has ended: reset it first")
        rewards, endings = self._advance(actions, steps)
        is_terminated, is_truncated = (endings == 1) | (endings == 2), endings == 3
        info = self._with_masks({**self._info(), "is_success": endings == 1})
        ended = is_terminated | is_truncated
        if mode == AutoresetMode.NEXT_STEP:
            if self._has_ended.any():
                self._start(self._has_ended, None)
                info = self._with_masks({**self._info(), "is_success": endings == 1})
            self._has_ended = ended
            return self._observed(), rewards, is_terminated, is_truncated, info
        observed = self._observed()
        if mode == AutoresetMode.DISABLED:
            self._has_ended = ended
        elif ended.any():
            info["final_obs"] = self._split(observed, ended)
            info["final_info"] = {key: value for key, value in info.items() if key != "final_obs"}
            info["_final_obs"] = info["_final_info"] = ended
            self._start(ended, None)
            observed = self._observed()
            info |= self._with_masks(self._info())
        return observed, rewards, is_terminated, is_truncated, info

    def _split(self, batch: Any, mask: NDArray[np.bool_]) -> NDArray[np.object_]:
        """The observations of the lanes of ``mask``, one object each."""
        split = np.full(self.num_envs, None, object)
        for lane in np.flatnonzero(mask):
            is_dict = isinstance(batch, Mapping)
            split[lane] = {key: value[lane] for key, value in batch.items()} if is_dict else batch[lane]
        return split

    def _with_masks(self, info: dict[str, Any]) -> dict[str, Any]:
        everywhere = np.ones(self.num_envs, bool)
        return info | {f"_{key}": everywhere for key in info}


class LatticeVectorEnv(_LanesEnv):
    """Many episodes of ``ferry/Lattice-v0`` at once; arguments as :class:`LatticeEnv`.

    ``autoreset_mode`` is one of Gymnasium's three modes.
    """

    def __init__(
        self,
        num_envs: int = 1,
        map: str = "colon",
        *,
        observation: ObservationKind = "dict",
        progress_reward: float = 0.1,
        step_penalty: float = 0.0,
        clearance_m: float = 0.008,
        sweeps: str | os.PathLike[str] | None = None,
        autoreset_mode: AutoresetMode | str = AutoresetMode.NEXT_STEP,
    ) -> None:
        self._begin(num_envs, observation, autoreset_mode)
        self.single_action_space = spaces.Discrete(4)
        self.action_space = batch_space(self.single_action_space, num_envs)
        self._native = _new_lattice(map, num_envs, sweeps, progress_reward, step_penalty, clearance_m)

    def _start(self, mask: NDArray[np.bool_], seeds: Sequence[int | None] | None) -> None:
        self._native.start(mask, seeds)

    def _observed(self) -> Any:
        return observations(self._native, self._kind)

    def _info(self) -> dict[str, Any]:
        return {"distance_steps": self._native.distances()}

    def _advance(self, actions: Any, mask: NDArray[np.bool_]) -> tuple[NDArray[Any], NDArray[Any]]:
        return self._native.step(np.asarray(actions, np.int64), mask)


class _Trials:
    """Trials of the full system: actions to places, and rewards."""

    def __init__(
        self,
        lanes: int,
        map: str,
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
        self.native = Mazes(map, lanes, changes(parameters), disturbances)
        self._action = action
        self._progress_reward = progress_reward
        self._corner_m: NDArray[np.float64] = np.array(self.native.corner_m())

    def targets_m(self, actions: Any) -> NDArray[np.float64]:
        """Where each action sends the tool, ``(lanes, 2)``."""
        tools_m = self.native.places_m()[:, :2]
        if self._action == "box":
            moved: NDArray[np.float64] = tools_m + STEP_M * np.asarray(actions, np.float64).clip(-1.0, 1.0)
            return moved
        indices = np.asarray(actions, np.int64)
        if wrong := [index for index in indices.tolist() if not 0 <= index < 4]:
            raise ValueError(f"action is {wrong[0]}, it must be 0 to 3")
        cells = np.floor((tools_m - self._corner_m) / STEP_M)
        middles: NDArray[np.float64] = self._corner_m + (cells + 0.5 + OFFSETS[indices]) * STEP_M
        return middles

    def step(self, actions: Any, mask: NDArray[np.bool_]) -> tuple[NDArray[np.float64], NDArray[np.uint8]]:
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


class MazeEnv(gymnasium.Env[Any, Any]):
    """``ferry/Maze-v0``: the full system; see :mod:`ferry.environments`.

    An action counts while sub-controller 2 carries the bead (``info["asks"]``); while sub-controller 1 fetches it, and
    within 2 cm of the goal, Ferry moves the arm itself. A step that the limits refuse (a wall in the image, the reach)
    holds the arm; ``info["refusal"]`` says why.

    An episode ends with +1 when the bead is delivered, and with −1 when it cannot be any more: it hangs on the magnet,
    the goal is walled off, or the bead did not follow. It is truncated when the parameter ``step_limit`` is used up.

    ``info`` has ``tool_m``, ``bead_tracked_m`` and ``goal_m``, each ``(2,)`` in metres, and ``phase``.

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
        map: str = "colon",
        *,
        observation: ObservationKind = "dict",
        action: Literal["discrete", "box"] = "discrete",
        render_mode: str | None = None,
        parameters: Mapping[str, Any] | None = None,
        disturbances: int = 0,
        progress_reward: float = 0.0,
    ) -> None:
        self.observation_space = observation_space(observation)
        self.render_mode = render_mode
        self._kind = observation
        self._trials = _Trials(1, map, action, parameters, disturbances, progress_reward)
        self.action_space = self._trials.action_space
        self._native = self._trials.native

    def reset(self, *, seed: int | None = None, options: dict[str, Any] | None = None) -> tuple[Any, dict[str, Any]]:
        super().reset(seed=seed)
        self._native.start([int(self.np_random.integers(2**63)) if seed is None else seed])
        return self._observed(), self._info()

    def step(self, action: Any) -> tuple[Any, float, bool, bool, dict[str, Any]]:
        rewards, endings = self._trials.step(np.asarray([action]), np.ones(1, bool))
        ending = endings[0]
        is_terminated, is_truncated = bool(ending in (1, 2)), bool(ending == 3)
        info = {**self._info(), "is_success": bool(ending == 1)}
        return self._observed(), float(rewards[0]), is_terminated, is_truncated, info

    def render(self) -> NDArray[np.uint8] | None:
        return self._native.picture(0, 512, 384) if self.render_mode == "rgb_array" else None

    def _observed(self) -> Any:
        return _only(observations(self._native, self._kind))

    def _info(self) -> dict[str, Any]:
        info = {key: value[0] for key, value in self._trials.info().items()}
        return info | {
            "asks": bool(info["asks"]),
            "phase": self._native.phases()[0],
            "refusal": self._native.refusals()[0],
        }


class MazeVectorEnv(_LanesEnv):
    """Many trials of ``ferry/Maze-v0`` at once, on all cores; arguments as :class:`MazeEnv`.

    ``autoreset_mode`` is one of Gymnasium's three modes.
    """

    def __init__(
        self,
        num_envs: int = 1,
        map: str = "colon",
        *,
        observation: ObservationKind = "dict",
        action: Literal["discrete", "box"] = "discrete",
        parameters: Mapping[str, Any] | None = None,
        disturbances: int = 0,
        progress_reward: float = 0.0,
        autoreset_mode: AutoresetMode | str = AutoresetMode.NEXT_STEP,
    ) -> None:
        self._begin(num_envs, observation, autoreset_mode)
        self._trials = _Trials(num_envs, map, action, parameters, disturbances, progress_reward)
        self.single_action_space = self._trials.action_space
        self.action_space = batch_space(self.single_action_space, num_envs)
        self._lanes_random: list[np.random.Generator] = []

    def _start(self, mask: NDArray[np.bool_], seeds: Sequence[int | None] | None) -> None:
        # Each lane draws the seeds of its later trials from its first one.
        if seeds is not None:
            if len(seeds) != self.num_envs:
                raise ValueError(f"seed has {len(seeds)} entries, it must have {self.num_envs}")
            self._lanes_random = self._lanes_random or [np.random.default_rng() for _ in seeds]
            for lane, seed in enumerate(seeds):
                if mask[lane] and seed is not None:
                    self._lanes_random[lane] = np.random.default_rng(seed)
        drawn = [
            None if not starts else int(random.integers(2**63)) if seeds is None or seeds[lane] is None else seeds[lane]
            for lane, (starts, random) in enumerate(zip(mask, self._lanes_random, strict=True))
        ]
        self._trials.native.start(drawn)

    def _observed(self) -> Any:
        return observations(self._trials.native, self._kind)

    def _info(self) -> dict[str, Any]:
        return self._trials.info()

    def _advance(self, actions: Any, mask: NDArray[np.bool_]) -> tuple[NDArray[Any], NDArray[Any]]:
        return self._trials.step(actions, mask)


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
