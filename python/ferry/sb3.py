"""Ferry's vector environments for stable-baselines3, which must be installed.

On a machine without Vulkan, import this before you make an environment: OpenGL's software driver and torch's Triton
both have an LLVM, and Triton must come first.
"""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from typing import Any

import numpy as np
from gymnasium import spaces
from gymnasium.vector import AutoresetMode, VectorEnv
from stable_baselines3.common.vec_env.base_vec_env import VecEnv, VecEnvIndices, VecEnvObs, VecEnvStepReturn

with suppress(ImportError):
    import triton  # noqa: F401


class FerryVecEnv(VecEnv):
    """A native vector environment as a ``VecEnv``.

    ``env`` must have been made with ``autoreset_mode=AutoresetMode.SAME_STEP``: stable-baselines3 expects the first
    observation of the next episode in the step that ends one, and the last one as ``terminal_observation``.

    With ``observation="dict"`` the image gets a first axis for its channel, ``(1, 84, 84)``: only then
    ``MultiInputPolicy`` takes it for an image. A controller gives it as ``percept.observation()["image"][None]``.
    """

    def __init__(self, env: VectorEnv[Any, Any, Any]) -> None:
        mode = env.metadata["autoreset_mode"]
        if mode != AutoresetMode.SAME_STEP:
            raise ValueError(f"autoreset_mode is {mode.value!r}, it must be {AutoresetMode.SAME_STEP.value!r}")
        self.env = env
        self._actions: np.ndarray | None = None
        space = env.single_observation_space
        if isinstance(space, spaces.Dict):
            image = spaces.Box(0, 255, (1, *space["image"].shape), np.uint8)
            space = spaces.Dict({**space.spaces, "image": image})
        super().__init__(env.num_envs, space, env.single_action_space)
        self.metadata["render_fps"] = env.metadata["render_fps"]

    def reset(self) -> VecEnvObs:
        seeds = None if all(seed is None for seed in self._seeds) else list(self._seeds)
        names = {name for options in self._options for name in options}
        options = {name: [one.get(name) for one in self._options] for name in names}
        observed, _ = self.env.reset(seed=seeds, options=options)
        self._reset_seeds()
        self._reset_options()
        return _with_channel(observed)

    def step_async(self, actions: np.ndarray) -> None:
        self._actions = actions

    def step_wait(self) -> VecEnvStepReturn:
        observed, rewards, terminated, truncated, info = self.env.step(self._actions)
        infos: list[dict[str, Any]] = [{"TimeLimit.truncated": bool(out)} for out in truncated & ~terminated]
        if "final_obs" in info:
            for lane in np.flatnonzero(info["_final_obs"]):
                infos[lane]["terminal_observation"] = _with_channel(info["final_obs"][lane])
                infos[lane]["is_success"] = bool(info["final_info"]["is_success"][lane])
        return _with_channel(observed), rewards.astype(np.float32), terminated | truncated, infos

    def close(self) -> None:
        self.env.close()

    def get_attr(self, attr_name: str, indices: VecEnvIndices = None) -> list[Any]:
        return [getattr(self.env, attr_name) for _ in self._get_indices(indices)]

    def set_attr(self, attr_name: str, value: Any, indices: VecEnvIndices = None) -> None:
        setattr(self.env, attr_name, value)

    def env_method(
        self, method_name: str, *method_args: Any, indices: VecEnvIndices = None, **method_kwargs: Any
    ) -> list[Any]:
        called = getattr(self.env, method_name)
        return [called(*method_args, **method_kwargs) for _ in self._get_indices(indices)]

    def env_is_wrapped(self, wrapper_class: type, indices: VecEnvIndices = None) -> list[bool]:
        return [False for _ in self._get_indices(indices)]

    def get_images(self) -> Sequence[np.ndarray | None]:
        frames = self.env.render()
        return [None] * self.num_envs if frames is None else list(frames)


def _with_channel(observed: Any) -> Any:
    """An observation, or those of all lanes, with an axis for the channel of the image."""
    if not isinstance(observed, dict):
        return observed
    return {**observed, "image": np.expand_dims(observed["image"], -3)}
