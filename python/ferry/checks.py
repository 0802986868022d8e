"""What users give, checked. Errors name the field and its value."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping, Sequence
from operator import index
from typing import Any

import numpy as np
from gymnasium import spaces
from numpy.typing import NDArray

SEED_MOST = 2**64 - 1
COUNT_MOST = 2**32 - 1
"""Where the allowed range is smaller, Ferry says so."""

PLACES = ("start_m", "goal_m")
TRIAL = (*PLACES, "parameters", "disturbances")


def whole(name: str, value: Any, least: int = 0, most: int = COUNT_MOST) -> int:
    """A whole number of a range."""
    try:
        number = index(value)
    except TypeError:
        raise TypeError(f"{name} is {value!r}, it must be a whole number") from None
    if not least <= number <= most:
        raise ValueError(f"{name} is {number}, it must be {least} to {most}")
    return number


def seed_of(value: Any, name: str = "seed") -> int:
    return whole(name, value, 0, SEED_MOST)


def map_name(value: str | os.PathLike[str]) -> str:
    """Name of a map, or path of an SVG."""
    try:
        return os.fsdecode(value)
    except TypeError:
        raise TypeError(f"map is {value!r}, it must be the name of a map or the path of an SVG") from None


def render_mode(value: str | None) -> str | None:
    if value not in (None, "rgb_array"):
        raise ValueError(f'render_mode is {value!r}, it must be "rgb_array" or None')
    return value


def changes(parameters: Mapping[str, Any] | None, name: str = "parameters") -> list[str]:
    """Parameters as ``NAME=VALUE``."""
    if not isinstance(parameters, Mapping | None):
        raise TypeError(f"{name} is {parameters!r}, it must be a dictionary")
    return [
        f"{field}={json.dumps(bool(value)) if isinstance(value, bool | np.bool_) else value}"
        for field, value in (parameters or {}).items()
    ]


def place_m(value: Any, name: str) -> tuple[float, float]:
    """x and y on the table."""
    try:
        place = np.asarray(value, np.float64)
    except (TypeError, ValueError):
        place = np.empty(0)
    if place.shape != (2,) or not np.isfinite(place).all():
        raise ValueError(f"{name} is {value!r}, it must be x and y in metres, two finite numbers")
    return float(place[0]), float(place[1])


def actions(space: spaces.Space[Any], given: Any, steps: NDArray[np.bool_] | None = None) -> NDArray[Any]:
    """The actions of the lanes that step, and zeros for the others; ``steps`` is ``None`` for a single environment."""
    shape = (space.shape or ()) if steps is None else (len(steps), *(space.shape or ()))
    try:
        found = np.asarray(given)
    except ValueError:
        raise ValueError(f"action is {given!r}, it must have the shape {shape}") from None
    if found.shape != shape:
        raise ValueError(f"action has the shape {found.shape}, it must be {shape}")
    lanes = found if steps is not None else found[None]
    good = np.zeros(len(lanes), bool)
    if isinstance(space, spaces.Discrete):
        allowed = "0, 1, 2 or 3"
        if lanes.dtype.kind in "iu":
            good = (lanes >= 0) & (lanes < space.n)
    else:
        allowed = "two numbers from -1 to 1; gymnasium.wrappers.ClipAction clips them"
        if lanes.dtype.kind in "iuf":
            good = (np.abs(lanes) <= 1).all(axis=1)
    if good.all():
        return lanes
    wrong = ~good if steps is None else ~good & steps
    if wrong.any():
        lane = int(wrong.argmax())
        name = "action" if steps is None else f"action[{lane}]"
        raise ValueError(f"{name} is {lanes.tolist()[lane]!r}, it must be {allowed}")
    return np.where(good.reshape(-1, *[1] * (lanes.ndim - 1)), lanes, 0)


def trial(options: Any, fields: Sequence[str]) -> dict[str, Any]:
    """The options of an episode by name, without those that are ``None``."""
    options = {} if options is None else options
    _check_names(options, fields)
    return {name: _option(name, value, name) for name, value in options.items() if value is not None}


def trials(options: Any, fields: Sequence[str], count: int) -> tuple[NDArray[np.bool_], list[dict[str, Any]] | None]:
    """Which lanes begin, and the options of each, if there are any. A list has a value for each lane."""
    options = {} if options is None else options
    _check_names(options, (*fields, "reset_mask"))
    fields = [name for name in options if name != "reset_mask"]
    mask = _reset_mask(options["reset_mask"], count) if "reset_mask" in options else np.ones(count, bool)
    each: list[dict[str, Any]] = [{} for _ in range(count)]
    for name in fields:
        value = options[name]
        is_list = isinstance(value, list | tuple) or (isinstance(value, np.ndarray) and value.ndim > 0)
        # A place is a list, too: of two numbers.
        if not is_list or (name in PLACES and all(np.isscalar(one) for one in value)):
            values, names = [value] * count, [name] * count
        else:
            values, names = list(value), [f"{name}[{lane}]" for lane in range(count)]
        if len(values) != count:
            raise ValueError(f"{name} has {len(values)} entries, it must have {count}")
        for lane, one in enumerate(values):
            if one is not None:
                each[lane][name] = _option(name, one, names[lane])
    return mask, each if fields else None


def _reset_mask(value: Any, count: int) -> NDArray[np.bool_]:
    mask = np.asarray(value)
    if mask.shape != (count,) or mask.dtype != np.bool_:
        raise ValueError(f"reset_mask is {value!r}, it must be {count} times True or False")
    if not mask.any():
        raise ValueError(f"reset_mask is {value!r}, it must be True for one environment or more")
    return mask


def _check_names(options: Any, fields: Sequence[str]) -> None:
    if not isinstance(options, Mapping):
        raise TypeError(f"options is {options!r}, it must be a dictionary")
    for name in options:
        if name not in fields:
            only = ", which only vector environments take" if name == "reset_mask" else ""
            raise ValueError(f"options has {name!r}{only}; there are {', '.join(fields)}")


def _option(field: str, value: Any, name: str) -> Any:
    match field:
        case "parameters":
            return changes(value, name)
        case "disturbances":
            return whole(name, value)
        case _:
            return place_m(value, name)
