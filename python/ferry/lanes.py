"""What Ferry's vector environments have in common: seeds, options, and how lanes begin again."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, ClassVar

import numpy as np
from gymnasium.vector import AutoresetMode, VectorEnv
from gymnasium.vector.utils import batch_space
from numpy.typing import NDArray

from ferry import checks
from ferry.observing import ObservationKind, observation_space


class LanesEnv(VectorEnv[Any, Any, Any]):
    OPTIONS: ClassVar[Sequence[str]]
    """What ``reset`` takes beside ``reset_mask``."""

    def _begin(self, num_envs: int, kind: ObservationKind, mode: AutoresetMode | str, render_mode: str | None) -> None:
        self.num_envs = num_envs
        self.render_mode = checks.render_mode(render_mode)
        self.metadata = {"render_modes": ["rgb_array"], "render_fps": 4, "autoreset_mode": AutoresetMode(mode)}
        self.single_observation_space = observation_space(kind)
        self.observation_space = batch_space(self.single_observation_space, num_envs)
        self._kind = kind
        self._has_ended = np.zeros(num_envs, bool)
        self._is_seeded = False

    def _start(
        self,
        mask: NDArray[np.bool_],
        seeds: Sequence[int | None] | None = None,
        options: Sequence[Mapping[str, Any]] | None = None,
    ) -> None:
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

    def _frames(self) -> Sequence[NDArray[np.uint8]]:
        raise NotImplementedError

    def render(self) -> tuple[NDArray[np.uint8], ...] | None:
        """A frame of each lane."""
        return None if self.render_mode is None else tuple(self._frames())

    def reset(
        self,
        *,
        seed: int | Sequence[int | None] | NDArray[Any] | None = None,
        options: dict[str, Any] | None = None,
    ) -> tuple[Any, dict[str, Any]]:
        mask, each = checks.trials(options, self.OPTIONS, self.num_envs)
        self._start(mask, self._seeds(seed), each)
        self._is_seeded = True
        self._has_ended &= ~mask
        return self._observed(), self._with_masks(self._info())

    def _seeds(self, seed: Any) -> Sequence[int | None] | None:
        count = self.num_envs
        if seed is None:
            if self._is_seeded:
                return None
            return [int(number) for number in self.np_random.integers(2**63, size=count)]
        if isinstance(seed, Sequence) or np.ndim(seed) > 0:
            given = list(seed)
            if len(given) != count:
                raise ValueError(f"seed has {len(given)} entries, it must have {count}")
            names = [f"seed[{lane}]" for lane in range(count)]
            return [None if one is None else checks.seed_of(one, name) for one, name in zip(given, names, strict=True)]
        first = checks.whole("seed", seed, 0, checks.SEED_MOST + 1 - count)
        super().reset(seed=first)
        return [first + lane for lane in range(count)]

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
                self._start(self._has_ended)
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
            self._start(ended)
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
