"""Controllers of one's own for a running Ferry."""

from __future__ import annotations

import copy
import http.client
import json
import logging
import threading
import time
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any
from urllib.parse import urlencode, urlsplit

import numpy as np
from numpy.typing import NDArray
from websockets.exceptions import ConnectionClosed, InvalidHandshake, InvalidStatus
from websockets.sync.client import ClientConnection, connect

from ferry._ferry import observation

PROTOCOL = 1
REASON_BYTES = 160
RETRY_S = 1.0

log = logging.getLogger("ferry")


@dataclass(frozen=True)
class Leg:
    """The part of a trial between two fetches or goals."""

    trial: str
    """Name of the session, or of the trial of an evaluation."""
    map: str
    workspace_m: tuple[float, float, float, float]
    """x from and to, then y from and to."""
    parameters: Mapping[str, Any]
    """Ferry's parameters by name; ``transport_speed_m_s`` is the tool's speed."""


@dataclass(frozen=True)
class Percept:
    """What a controller knows at a control step, 0.25 s after the last one. Places are in metres on the table."""

    leg: Leg
    tick: int
    """Ticks of 8 ms since the trial began."""
    tool_m: NDArray[np.float64]
    """``(2,)``"""
    bead_tracked_m: NDArray[np.float64]
    """``(2,)``, as the tracker sees it: it may be late or wrong."""
    goal_m: NDArray[np.float64]
    """``(2,)``"""
    obstacles_m: NDArray[np.float64]
    """``(n, 4)``: rectangles that cover the dark parts of the image, x from and to, y from and to."""
    image: NDArray[np.uint8]
    """``(480, 480)``, gray; the top row is at the largest y."""
    image_center_m: NDArray[np.float64]
    """``(2,)``: the place at the middle of the image."""
    m_per_px: float
    deadline_s: float
    """The answer is waited for this long."""

    def observation(self) -> dict[str, NDArray[Any]]:
        """The same as the environments' ``observation="dict"``."""
        x_from, x_to, y_from, y_to = self.leg.workspace_m
        image, vector = observation(self.image, tuple(self.goal_m), tuple(self.tool_m), (x_from, x_to, y_from, y_to))
        return {"image": image, "vector": vector}

    def is_dark(self, place_m: NDArray[np.float64]) -> bool:
        """Whether the image shows a wall at a place; ``False`` outside the image."""
        column, row = (place_m - self.image_center_m) / self.m_per_px * (1, -1) + len(self.image) / 2
        if not (0 <= column < len(self.image) and 0 <= row < len(self.image)):
            return False
        return bool(self.image[int(row), int(column)] <= 100)

    def cell(self, action: int) -> Step:
        """The step of an action of the environments: the middle of the next cell along +x, −x, +y or −y."""
        corner = np.array([self.leg.workspace_m[0], self.leg.workspace_m[2]])
        offset = ((1, 0), (-1, 0), (0, 1), (0, -1))[action]
        place = corner + (np.floor((self.tool_m - corner) / 0.01) + 0.5 + offset) * 0.01
        return Step((float(place[0]), float(place[1])))


@dataclass(frozen=True)
class Step:
    """Straight toward a place, as far as a control step reaches (1 cm with the default speed)."""

    target_m: tuple[float, float]


class Controller:
    """A controller of one's own: override :meth:`act`."""

    def copy(self) -> Controller:
        """The controller of one trial, a deep copy. Override it to share what is large or cannot be copied."""
        return copy.deepcopy(self)

    def start(self, leg: Leg) -> None:
        """A leg begins: forget what belongs to the last one."""

    def act(self, percept: Percept) -> Step | None:
        """The next step, or ``None`` to hold."""
        raise NotImplementedError


class Refused(ValueError):
    """The server refuses the program."""


def serve(
    controller: Controller,
    address: str = "http://127.0.0.1:8080",
    *,
    name: str = "mine",
    token: str | None = None,
    stop: threading.Event | None = None,
) -> None:
    """Offers a controller to a running Ferry, until ``stop`` is set or the program is interrupted.

    In the page it appears beside RL, ERRT and Attractor. When the server is gone, it is tried again every second. Each
    session has a :meth:`Controller.copy`.

    An exception in :meth:`Controller.act`, or a step that is no pair of finite numbers, holds the arm; the page says
    why, and the exception is logged.

    Raises:
        Refused: the name is not allowed or in use, the token is wrong, or the server has another protocol.
    """
    parts = urlsplit(address)
    scheme = {"http": "ws", "https": "wss"}.get(parts.scheme)
    if scheme is None or not parts.netloc:
        raise Refused(f"address is {address!r}, it must be like http://127.0.0.1:8080")
    url = f"{scheme}://{parts.netloc}/api/controllers/{name}?{urlencode({'protocol': PROTOCOL})}"
    headers = {} if token is None else {"Authorization": f"Bearer {token}"}
    stop = stop or threading.Event()
    while not stop.is_set():
        try:
            with connect(url, additional_headers=headers, max_size=1 << 22, open_timeout=10) as socket:
                log.info("%s is connected to %s", name, address)
                _run(controller, socket, stop)
        except InvalidStatus as refused:
            status = refused.response.status_code
            if status not in (http.client.BAD_GATEWAY, http.client.SERVICE_UNAVAILABLE):
                raise Refused(_detail(refused.response.body, status)) from refused
        except (OSError, ConnectionClosed, InvalidHandshake) as gone:
            log.info("%s is not connected: %s", name, gone)
        stop.wait(RETRY_S)


def _detail(body: bytes | bytearray | None, status: int) -> str:
    try:
        return str(json.loads(body or b"")["detail"])
    except (ValueError, KeyError, TypeError):
        return f"the server answers with status {status}"


class Trials:
    """The trials in which a controller is asked, each with a copy of its own."""

    def __init__(self, controller: Controller) -> None:
        self._controller = controller
        self._trials: dict[str, tuple[Controller, Leg]] = {}

    def start(self, message: Mapping[str, Any]) -> None:
        area, name = message["workspace"], message["trial"]
        bounds = tuple(area[side] for side in ("x_min_m", "x_max_m", "y_min_m", "y_max_m"))
        leg = Leg(name, message["map"], bounds, message["parameters"])
        controller, _ = self._trials.get(name) or (self._controller.copy(), None)
        self._trials[name] = (controller, leg)
        controller.start(leg)

    def act(self, message: Mapping[str, Any], pixels: Any) -> dict[str, Any]:
        """The answer to ``observe``."""
        controller, leg = self._trials[message["trial"]]
        target_m = checked_target_m(controller.act(_percept(leg, message, pixels)))
        request = message["request"]
        if target_m is None:
            return {"type": "hold", "request": request, "reason": "it holds"}
        return {"type": "act", "request": request, "target_m": list(target_m)}

    def end(self, message: Mapping[str, Any]) -> None:
        self._trials.pop(message["trial"], None)


def _run(controller: Controller, socket: ClientConnection, stop: threading.Event) -> None:
    trials = Trials(controller)
    while not stop.is_set():
        try:
            text = socket.recv(timeout=0.2)
        except TimeoutError:
            continue
        message = json.loads(text)
        match message["type"]:
            case "start":
                try:
                    trials.start(message)
                except Exception:
                    log.exception("start")
            case "observe":
                socket.send(json.dumps(_answer(trials, message, socket.recv())))
            case "end":
                trials.end(message)
            case "error":
                log.warning("%s", message["message"])


def _answer(trials: Trials, message: dict[str, Any], pixels: Any) -> dict[str, Any]:
    began = time.monotonic()
    try:
        answer = trials.act(message, pixels)
    except Exception as fault:
        log.exception("act")
        reason = f"{type(fault).__name__}: {fault}".encode()[:REASON_BYTES].decode(errors="ignore")
        return {"type": "hold", "request": message["request"], "reason": reason}
    took_s = time.monotonic() - began
    if took_s > message["deadline_s"]:
        log.warning("act took %.0f ms, the arm waits %.0f ms", took_s * 1e3, message["deadline_s"] * 1e3)
    return answer


def _percept(leg: Leg, message: Mapping[str, Any], pixels: Any) -> Percept:
    image = message["image"]
    size = image["size_px"]
    rectangles = [[box[side] for side in ("x_min_m", "x_max_m", "y_min_m", "y_max_m")] for box in message["obstacles"]]
    return Percept(
        leg=leg,
        tick=message["tick"],
        tool_m=np.array(message["tool_m"]),
        bead_tracked_m=np.array(message["bead_tracked_m"]),
        goal_m=np.array(message["goal_m"]),
        obstacles_m=np.array(rectangles, np.float64).reshape(-1, 4),
        image=np.frombuffer(pixels, np.uint8).reshape(size, size),
        image_center_m=np.array(image["center_m"]),
        m_per_px=image["m_per_px"],
        deadline_s=message["deadline_s"],
    )


def checked_target_m(step: Step | None) -> tuple[float, float] | None:
    """The place of a step.

    Raises:
        TypeError, ValueError: the step cannot be used.
    """
    if step is None:
        return None
    if not isinstance(step, Step):
        raise TypeError(f"act returned {type(step).__name__}, it must return a ferry.Step or None")
    target = np.asarray(step.target_m, np.float64)
    if target.shape != (2,):
        raise ValueError(f"target_m has the shape {target.shape}, it must have (2,)")
    if not np.isfinite(target).all():
        raise ValueError(f"target_m is {target.tolist()}, it must be finite")
    return float(target[0]), float(target[1])
