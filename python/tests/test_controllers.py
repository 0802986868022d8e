"""Controllers of one's own in a running Ferry."""

import json
import re
import subprocess
import sys
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from websockets.sync.client import ClientConnection, connect

import ferry
from ferry.controllers import checked_target_m


@pytest.fixture(scope="module")
def address(tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    data = tmp_path_factory.mktemp("data")
    command = [sys.executable, "-m", "ferry", "serve", "--bind", "127.0.0.1:0", "--data", str(data)]
    serving = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    try:
        for line in serving.stdout:
            if found := re.search(r"http://127\.0\.0\.1:\d+", line):
                # Nothing else is read: the rest fits into the pipe.
                yield found[0]
                break
    finally:
        serving.kill()
        serving.communicate()


@contextmanager
def served(controller: ferry.Controller, address: str, name: str) -> Iterator[None]:
    stop = threading.Event()
    thread = threading.Thread(target=ferry.serve, args=(controller, address), kwargs={"name": name, "stop": stop})
    thread.start()
    try:
        yield
    finally:
        stop.set()
        thread.join(10)
        assert not thread.is_alive()


class Page:
    """A session's WebSocket, as the page has it."""

    def __init__(self, socket: ClientConnection) -> None:
        self.socket = socket

    def send(self, **message: Any) -> None:
        self.socket.send(json.dumps(message))

    def state(self, fits: Any, within_s: float = 60.0) -> dict[str, Any]:
        until = time.monotonic() + within_s
        while time.monotonic() < until:
            text = self.socket.recv(timeout=within_s)
            if isinstance(text, str):
                message = json.loads(text)
                assert message["type"] != "error", message
                if message["type"] == "state" and fits(message):
                    return message
        raise AssertionError("waited in vain")

    def carry(self, name: str, map: str = "open", start_m: Any = (-0.1, -0.35), goal_m: Any = (0.1, -0.35)) -> None:
        deadline = time.monotonic() + 10
        # The program may still be connecting.
        while True:
            self.send(type="load_scenario", map=map, start_m=list(start_m), goal_m=list(goal_m))
            self.send(type="select_controller", controller="program", program=name)
            try:
                self.state(lambda state: (state["program"] or {}).get("name") == name, 5)
                break
            except AssertionError:
                assert time.monotonic() < deadline
        self.send(type="run")


@contextmanager
def opened(address: str) -> Iterator[Page]:
    with connect(f"ws{address[4:]}/api/sessions/main/live", max_size=None) as socket:
        yield Page(socket)


class Straight(ferry.Controller):
    """All its trials write into the same lists."""

    def __init__(self) -> None:
        self.legs: list[ferry.Leg] = []
        self.percepts: list[ferry.Percept] = []

    def copy(self) -> ferry.Controller:
        return self

    def start(self, leg: ferry.Leg) -> None:
        self.legs.append(leg)

    def act(self, percept: ferry.Percept) -> ferry.Step:
        self.percepts.append(percept)
        return ferry.Step(tuple(percept.goal_m))


def test_a_controller_delivers(address: str) -> None:
    controller = Straight()
    with opened(address) as page, served(controller, address, "straight"):
        page.carry("straight")
        state = page.state(lambda state: state["phase"]["code"] == "delivered")
    # A busy machine may be late now and then.
    assert state["program"]["answers"] >= 17 and state["program"]["missed"] <= 5
    assert controller.legs[0].map == "open" and controller.legs[0].parameters["transport_speed_m_s"] == 0.04
    percept = controller.percepts[0]
    assert percept.image.shape == (480, 480) and percept.tool_m == pytest.approx([-0.1, -0.35], abs=1e-3)
    seen = percept.observation()
    assert seen["image"].shape == (84, 84) and seen["vector"].shape == (4,)
    assert not percept.is_dark(percept.tool_m) and percept.obstacles_m.shape[1] == 4
    assert percept.cell(0).target_m[0] > percept.tool_m[0]


class Odd(ferry.Controller):
    """Answers something that cannot be used, and another thing each time."""

    ANSWERS: tuple[Any, ...] = (
        None,
        "left",
        ferry.Step((1.0,)),
        ferry.Step((float("nan"), 0.0)),
        ZeroDivisionError("of zero"),
        ferry.Step((1e9, -1e9)),
    )

    def __init__(self) -> None:
        self.asked = 0

    def act(self, percept: ferry.Percept) -> Any:
        answer = self.ANSWERS[self.asked % len(self.ANSWERS)]
        self.asked += 1
        if isinstance(answer, Exception):
            raise answer
        return answer


def test_unusable_answers_hold_the_arm_and_say_why(address: str) -> None:
    with opened(address) as page:
        with served(Odd(), address, "odd"):
            page.carry("odd")
            for text in [
                "the program: odd: it holds",
                "TypeError: act returned str",
                "target_m has the shape (1,)",
                "target_m is [nan, 0.0], it must be finite",
                "ZeroDivisionError: of zero",
            ]:
                page.state(lambda state, text=text: text in (state["refusal"] or {"text": ""})["text"])
            assert page.state(lambda state: True)["running"]
        page.state(
            lambda state: (
                state["refusal"] is not None and state["refusal"]["text"] == "the program: odd is not connected"
            )
        )


def test_refusals_are_raised(address: str) -> None:
    with served(Straight(), address, "taken"):
        time.sleep(1)
        with pytest.raises(ferry.Refused, match="is connected already"):
            ferry.serve(Straight(), address, name="taken")
    for name, wrong in [("rl", address), ("Mine!", address), ("mine", "localhost:8080")]:
        with pytest.raises(ferry.Refused, match=f"{name}|address"):
            ferry.serve(Straight(), wrong, name=name)


def test_steps_are_checked() -> None:
    assert checked_target_m(None) is None
    assert checked_target_m(ferry.Step(np.array([0.1, -0.3]))) == (0.1, -0.3)


def test_the_image_is_that_of_the_environment() -> None:
    environment = ferry.MazeEnv("posts")
    seen, _ = environment.reset(seed=3)
    gray = np.full((480, 480), 240, np.uint8)
    image, vector = ferry._ferry.observation(gray, (0.1, -0.3), (0.0, -0.3), (-0.3, 0.3, -0.6, -0.2))
    assert (image == 240).all() and image.shape == seen["image"].shape and vector.dtype == np.float32
    with pytest.raises(ValueError, match=r"shape \(10, 10\)"):
        ferry._ferry.observation(np.zeros((10, 10), np.uint8), (0, 0), (0, 0), (0, 1, 0, 1))


def test_the_rule_of_the_example_carries_through_posts(address: str, tmp_path: Path) -> None:
    example = Path(__file__).parents[1] / "examples" / "rule.py"
    _, info = ferry.MazeEnv("posts").reset(seed=3)
    running = subprocess.Popen([sys.executable, example, address], cwd=tmp_path)
    try:
        with opened(address) as page:
            page.carry("rule", "posts", info["tool_m"], info["goal_m"])
            page.state(lambda state: state["phase"]["code"] == "delivered")
    finally:
        running.kill()
        running.wait()
