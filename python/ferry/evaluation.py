"""Evaluations: many random trials, with controllers of one's own beside Ferry's, on all cores or with Ray."""

from __future__ import annotations

import json
import math
import re
import threading
from collections.abc import Callable, Iterable, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from os import PathLike, fspath
from typing import Any, Literal

import numpy as np
from tqdm import tqdm

from ferry import _ferry
from ferry.checks import changes, seed_of, whole
from ferry.controllers import Controller, Trials

TRIALS_A_TASK = 16
"""A task of Ray lasts some seconds."""
RETRIES = 5
"""How often a task of Ray is run again when its worker is lost."""
SHARDS_MOST = 10_000
LOOK_S = 0.2
ROWS_SHOWN = 20

Kind = Literal["evaluation", "recovery"]
Controllers = Controller | str | Sequence[Controller | str] | Mapping[str, Controller | str]


@dataclass(frozen=True, repr=False)
class Evaluation:
    """The results, as ``ferry evaluate --json`` prints them."""

    report: Mapping[str, Any]

    def __repr__(self) -> str:
        lines = [_summary(row) for row in self.rows[:ROWS_SHOWN]]
        if more := len(self.rows) - len(lines):
            lines.append(f"… and {more} more rows")
        return "\n".join([f"Evaluation with seed {self.report['seed']} (rates with 95% intervals)", *lines])

    @property
    def rows(self) -> list[dict[str, Any]]:
        """One for each controller, map and number of disturbances."""
        return list(self.report["rows"])

    @property
    def comparisons(self) -> list[dict[str, Any]]:
        """One for each pair of controllers at the same trials."""
        return list(self.report["comparisons"])

    @property
    def failures(self) -> list[dict[str, Any]]:
        """The trials that did not deliver, each with its seed, start and goal."""
        return list(self.report["failures"])


def _summary(row: Mapping[str, Any]) -> str:
    varied = "".join(f", {one['name']} {one['value']:g}" for one in row["varied"])
    disturbed = f"{row['disturbances']} disturbance{'' if row['disturbances'] == 1 else 's'}"
    counts = f"{row['delivered']} of {row['episodes']} delivered"
    rate = with_interval(row["delivered"] / row["episodes"], row["wilson95"])
    return f"{row['controller']} on {row['map']}, {disturbed}{varied}: {counts}, {rate}"


def with_interval(share: float, interval: Sequence[float]) -> str:
    least, most = interval
    return f"{share:.1%} ({least:.1%} to {most:.1%})"


def evaluate(
    controllers: Controllers,
    *,
    map: str | PathLike[str] | Sequence[str | PathLike[str]] = "posts",
    disturbances: int | Sequence[int] = 0,
    episodes: int = 30,
    seed: int = 1,
    parameters: Mapping[str, Any] | None = None,
    vary: Mapping[str, tuple[float, float, int]] | None = None,
    by_hand: bool = False,
    tool_apart: bool = False,
    policy: str | PathLike[str] | None = None,
    engine: Literal["ray"] | None = None,
) -> Evaluation:
    """Runs random trials. All controllers get the same starts, goals, seeds and disturbances.

    A trial waits 10 s for each answer of a controller of one's own, so the results do not depend on the machine's
    speed. Each trial has a :meth:`Controller.copy`, so they do not depend on the order of the trials either.

    Args:
        controllers: a controller, or several: names of Ferry's (``"rl"``, ``"errt"``, ``"attractor"``,
            ``"replanner"``), or controllers of one's own. In rows, these have the name of their class, or the one given
            by a mapping.
        map: names of maps, or paths of SVGs.
        disturbances: how often the bead is disturbed in a trial; several numbers give several rows.
        episodes: trials for each row, 1 to 100,000.
        seed: seed of the trials.
        parameters: Ferry's parameters by name, as in ``ferry evaluate --set``.
        vary: parameters that take several values, at most two, each with the first value, the last one and how many;
            every combination has its rows, and ``row["varied"]`` says which.
        by_hand: a hand draws the bead through free space; otherwise it is lifted.
        tool_apart: the tool starts at least 15 cm from the bead; otherwise above it.
        policy: a policy's file for ``"rl"``, instead of the shipped ones.
        engine: ``"ray"`` spreads the trials over the cluster of Ray, which must be installed. What a lost worker was
            doing is done again. The results are the same on machines with the same wheel, graphics adapter and
            processor instructions; others are refused.

    Raises:
        ValueError: a setting is not allowed. The message names it.
        Exception: whatever :meth:`Controller.act` raises.
    """
    check_engine(engine)
    named = with_names(controllers)
    maps = [fspath(one) for one in ([map] if isinstance(map, str | PathLike) else map)]
    counts = [whole("disturbances", count) for count in np.atleast_1d(np.asarray(disturbances)).tolist()]
    varied = vary or {}
    settings = {
        "controllers": [(name, isinstance(one, Controller)) for name, one in named],
        "maps": maps,
        "disturbances": counts,
        "episodes": whole("episodes", episodes),
        "seed": seed_of(seed),
        "changes": changes(parameters),
        "vary": [f"{name}={first}:{last}:{count}" for name, (first, last, count) in varied.items()],
        "by_hand": by_hand,
        "tool_apart": tool_apart,
        "policy": None if policy is None else fspath(policy),
    }
    own = [one for _, one in named if isinstance(one, Controller)]
    values = math.prod(max(1, count) for _, _, count in varied.values())
    trials = len(named) * len(maps) * len(counts) * values * episodes
    with tqdm(total=trials, unit=" trials", disable=None) as bar:
        if engine:
            parts = in_shards("evaluation", settings, own, trials, bar)
        else:
            parts = [part("evaluation", settings, own, bar=bar)]
    return Evaluation(json.loads(_ferry.merge(parts)))


def check_engine(engine: str | None) -> None:
    if engine not in (None, "ray"):
        raise ValueError(f'engine is {engine!r}, it must be "ray" or None')


def with_names(controllers: Controllers) -> list[tuple[str, Controller | str]]:
    """Each controller with its name; Ferry's with their own."""
    if isinstance(controllers, Controller | str):
        controllers = [controllers]
    pairs: Iterable[tuple[str | None, Controller | str]]
    pairs = controllers.items() if isinstance(controllers, Mapping) else ((None, one) for one in controllers)
    named: list[tuple[str, Controller | str]] = []
    for given, one in pairs:
        if not isinstance(one, Controller | str):
            raise TypeError(f"a controller is {one!r}, it must be a ferry.Controller or a name")
        name = one if isinstance(one, str) else given or type(one).__name__.lower()
        if isinstance(one, Controller) and not re.fullmatch("[a-z0-9-]{1,32}", name):
            raise ValueError(f"{name!r} cannot be the name of a controller: use 1 to 32 of a to z, 0 to 9 and -")
        if name in (other for other, _ in named):
            raise ValueError(f"two controllers have the name {name!r}; give names with a mapping")
        named.append((name, one))
    if not named:
        raise ValueError("controllers is empty, it must have at least one")
    return named


def part(
    kind: Kind,
    settings: Mapping[str, Any],
    own: Sequence[Controller],
    number: int = 1,
    count: int = 1,
    threads: int = 0,
    bar: tqdm[Any] | None = None,
) -> bytes:
    """Runs a shard of a job on some threads, 0 for one per core, and returns its file."""
    native: _ferry.Job = getattr(_ferry.Job, kind)(**settings)
    with ThreadPoolExecutor(1 + len(own)) as pool:
        answering = [pool.submit(_answer, native, index, one) for index, one in enumerate(own)]
        running = pool.submit(native.run, number, count, threads)
        ended = threading.Event()
        running.add_done_callback(lambda _: ended.set())
        try:
            while not ended.wait(LOOK_S):
                if bar is not None:
                    bar.total = native.planned()
                    bar.update(native.done() - bar.n)
        finally:
            native.stop()
        for one in answering:
            one.result()
        if bar is not None:
            bar.update(native.done() - bar.n)
        return running.result()


def _answer(native: _ferry.Job, index: int, controller: Controller) -> None:
    """Answers all questions to one controller. What it raises ends the evaluation."""
    trials = Trials(controller)
    try:
        while (text := native.receive(index)) is not None:
            message = json.loads(text)
            match message["type"]:
                case "start":
                    trials.start(message)
                case "observe":
                    native.send(index, json.dumps(trials.act(message, native.receive(index))))
                case "end":
                    trials.end(message)
    except BaseException:
        native.stop()
        native.give_up(index)
        raise


def in_shards(
    kind: Kind,
    settings: Mapping[str, Any],
    own: Sequence[Controller],
    trials: int,
    bar: tqdm[Any],
) -> list[bytes]:
    """The files of all shards, each a task of Ray."""
    count = max(1, min(math.ceil(trials / TRIALS_A_TASK), SHARDS_MOST))
    shards = [(kind, settings, list(own), number, count, 1) for number in range(1, count + 1)]
    return in_parallel(part, shards, lambda _: bar.update(min(trials / count, trials - bar.n)))


def in_parallel(
    function: Callable[..., Any], calls: Sequence[Sequence[Any]], on_end: Callable[[Any], Any]
) -> list[Any]:
    """The results of all calls, each a task of Ray on one core. What a lost worker was doing is done again."""
    import ray

    if not ray.is_initialized():
        ray.init()
    task = ray.remote(num_cpus=1, max_retries=RETRIES)(function)
    tasks = [task.remote(*call) for call in calls]
    waiting = tasks
    try:
        while waiting:
            (ended,), waiting = ray.wait(waiting)
            on_end(ray.get(ended))
        return ray.get(tasks)  # type: ignore[no-any-return]
    except ray.exceptions.RayTaskError as fault:
        raise fault.cause from None
    finally:
        for one in waiting:
            ray.cancel(one, force=True)
