"""Recovery maps: from one moment, many disturbances under each controller, on all cores or with Ray."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass
from os import PathLike, fspath
from typing import Any, Literal

from tqdm import tqdm

from ferry import _ferry
from ferry.checks import changes, seed_of, whole
from ferry.controllers import Controller
from ferry.evaluation import Controllers, check_engine, in_shards, part, with_interval, with_names


@dataclass(frozen=True, repr=False)
class RecoveryMap:
    """The results, as ``ferry recovery --json`` prints them."""

    report: Mapping[str, Any]

    def __repr__(self) -> str:
        head = f"RecoveryMap of {self.report['map']}, kind {self.report['kind']}, seed {self.report['seed']}"
        lines = [
            f"{one['controller']}: {one['delivered']} of {one['trials']} delivered, "
            f"share {with_interval(one['share'], one['share95'])}"
            for one in self.basins
        ]
        return "\n".join([f"{head} (shares with 95% intervals)", *lines])

    @property
    def cells(self) -> list[dict[str, Any]]:
        """One for each cell and controller."""
        return list(self.report["cells"])

    @property
    def basins(self) -> list[dict[str, Any]]:
        """For each controller the share of the map from which it delivers in time, with its interval."""
        return list(self.report["basins"])

    @property
    def differences(self) -> list[dict[str, Any]]:
        """One for each pair of controllers, at the same cells with the same noise."""
        return list(self.report["differences"])


def recovery(
    controllers: Controllers = ("rl", "errt", "attractor"),
    *,
    map: str | PathLike[str] = "posts",
    scenario: str | PathLike[str] | None = None,
    at_s: float = 0.0,
    kind: Literal["place", "push", "drag", "blind"] = "place",
    grid: int = 24,
    repeats: int = 3,
    seed: int = 1,
    within_s: float = 60.0,
    full: bool = False,
    parameters: Mapping[str, Any] | None = None,
    engine: Literal["ray"] | None = None,
) -> RecoveryMap:
    """From one moment, tries many disturbances under each controller, with the same noise for all.

    Args:
        controllers: as in :func:`ferry.evaluate`, with one of one's own at most.
        map: name of a map, or path of an SVG; start and goal are drawn from the seed.
        scenario: instead of the map, the name of a shipped scenario, or the path of a JSON file.
        at_s: moment of the scenario, in simulated seconds.
        kind: the bead is put elsewhere, pushed, pulled by a hand, or not seen for a time.
        grid: columns of the finest grid, directions or times, 4 to 96.
        repeats: trials for each cell and controller, each with its own noise.
        seed: seed of the noise, and of start and goal.
        within_s: a later delivery is late.
        full: try each cell of the finest grid, also where all neighbours agree.
        parameters: Ferry's parameters by name.
        engine: ``"ray"`` spreads the trials over the cluster of Ray, always over the finest grid (``full``).

    Raises:
        ValueError: a setting is not allowed. The message names it.
        Exception: whatever :meth:`Controller.act` raises.
    """
    check_engine(engine)
    named = with_names(controllers)
    settings: dict[str, Any] = {
        "controllers": [(name, isinstance(one, Controller)) for name, one in named],
        "map": fspath(map),
        "scenario": None if scenario is None else fspath(scenario),
        "at_s": at_s,
        "kind": kind,
        "grid": whole("grid", grid),
        "repeats": whole("repeats", repeats),
        "seed": seed_of(seed),
        "within_s": within_s,
        "full": full or engine is not None,
        "changes": changes(parameters),
    }
    own = [one for _, one in named if isinstance(one, Controller)]
    with tqdm(unit=" trials", disable=None) as bar:
        if engine:
            bar.total = _ferry.Job.recovery(**settings).planned()
            parts = in_shards("recovery", settings, own, bar.total, bar)
        else:
            parts = [part("recovery", settings, own, bar=bar)]
    return RecoveryMap(json.loads(_ferry.merge(parts)))
