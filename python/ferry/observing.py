"""Observations of the environments: their spaces, and arrays from the native lanes."""

from __future__ import annotations

from typing import Any, Literal

import numpy as np
from gymnasium import spaces

from ferry._ferry import Lattice, Mazes

SIDE_PX = 84

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


def only(batch: Any) -> Any:
    """The observation of the only lane."""
    return {key: value[0] for key, value in batch.items()} if isinstance(batch, dict) else batch[0]
