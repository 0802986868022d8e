"""Trains with one change each, over several seeds, and writes docs/ablations.md: `make ablations`.

Finished runs are kept in tests/results/ablations.json, so an interrupted run goes on. Interquartile means and bootstrap
intervals follow Agarwal et al. 2021, "Deep Reinforcement Learning at the Edge of the Statistical Precipice".
"""

import json
import os
import random
import re
import statistics
import subprocess
import sys
import textwrap
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).resolve().parents[2]
FERRY = os.environ.get("FERRY_BIN", ROOT / "target/release/ferry")
KEPT = ROOT / "tests/results/ablations.json"
PAGE = ROOT / "docs/ablations.md"
OUT = ROOT / "target/results/ablations"
RESAMPLES = 20_000
AS_SHIPPED = "as shipped"


class Study(NamedTuple):
    """Trainings that differ from the shipped one in one setting."""

    title: str
    # How long it is trained, and what it is examined on.
    about: str
    map: str
    # The lines of `ferry train` that count, as a regular expression.
    examined: str
    settings: list
    # Starts and goals on each map, or on each family's mazes together.
    episodes: int
    seeds: range
    # What is changed, and the settings of `ferry train`.
    variants: dict


STUDIES = {
    "colon": Study(
        title="The paper's network on one map",
        about="a third of the default number of updates, where differences still show; examined on 2000 starts and goals",
        map="colon",
        examined=r"trained on +colon",
        settings=["updates=4000"],
        episodes=2000,
        seeds=range(1, 6),
        variants={
            AS_SHIPPED: [],
            "no progress reward": ["progress_reward=0"],
            "discount .99 with the progress reward": ["discount=0.99"],
            "no drawn goals: each image 16 times for the episode's own": ["uniform_goals=0", "future_goals=0"],
            "one goal an image": ["goals=1"],
            "uniform replay": ["priority_exponent=0"],
            "no skip connections": ["architecture.residual=false"],
            "no quantiles: one value an action": ["architecture.quantiles=false"],
            "no noisy layers (5 % of the actions drawn anywhere remain)": ["architecture.noisy=false"],
            "three-step returns": ["n_step=3"],
            "no double Q-learning": ["double=false"],
            "no dueling heads": ["architecture.dueling=false"],
            "no averaging of the weights": ["averaging=0"],
            "noisy layers alone explore": ["exploration=0"],
            "an episode out of steps is a failure for the learner too": ["timeout_fails=true"],
            "no clearance: an episode ends over the wall": ["clearance_m=0"],
            "early fusion: 128 images, one goal each": ["architecture.fusion=early", "images=128", "goals=1"],
        },
    ),
    "explorer": Study(
        title="The explorer on mazes that it has not seen",
        about="a quarter of the default number of updates; examined on rooms, spirals and serpentines with seeds 1 to 20, 10 "
        "starts and goals on each",
        map="generated",
        examined="unseen +(?:rooms|spirals|serpentines)",
        settings=["updates=2000", "imitation_updates=625"],
        episodes=200,
        seeds=range(1, 4),
        variants={
            AS_SHIPPED: [],
            "no memory: it sees only what the camera shows now": ["memory=false"],
            "visits not seen": ["architecture.survey.visits=false"],
            "one scale": ["architecture.survey.coarse=false"],
            "no imitation": ["imitation_updates=0"],
            "imitation only": ["updates=625"],
        },
    ),
}


def train(study, changes, seed):
    """Counts of the last examination: episodes, reached, collided, out of steps."""
    OUT.mkdir(parents=True, exist_ok=True)
    command = [FERRY, "train", "--map", study.map, "--seed", str(seed), "--episodes", str(study.episodes),
               "--force", "--out", str(OUT / "one.safetensors"), "--sweeps", str(OUT / "sweeps"),
               *(word for setting in [*study.settings, *changes] for word in ("--set", setting))]
    environment = {"XDG_RUNTIME_DIR": "/tmp", **os.environ}
    done = subprocess.run(command, stdout=subprocess.PIPE, check=True, text=True, env=environment)
    counts = rf"^{study.examined}: (\d+)/(\d+) reached .*?, (\d+) collided, (\d+) out of steps"
    found = [[int(count) for count in line] for line in re.findall(counts, done.stdout, re.M)]
    reached, episodes, collided, out = map(sum, zip(*found, strict=True))
    return [episodes, reached, collided, out]


def middle(values):
    """Interquartile mean: without the lowest and the highest quarter, rounded down."""
    cut = len(values) // 4
    return statistics.mean(sorted(values)[cut:len(values) - cut])


def resampled(shares, rng):
    return middle(rng.choices(shares, k=len(shares)))


def interval(draws):
    ordered = sorted(draws)
    return ordered[int(0.025 * len(ordered))], ordered[int(0.975 * len(ordered))]


def table(study, kept):
    """Rows of a study, from each variant's counts by seed."""
    shares = {name: [100 * runs[seed][1] / runs[seed][0] for seed in sorted(runs)] for name, runs in kept.items()}
    base = shares[AS_SHIPPED]
    yield f"## {study.title}"
    yield ""
    settings = " ".join(f"--set {setting}" for setting in study.settings)
    yield textwrap.fill(
        f"`ferry train --map {study.map} {settings}` with one change each, seeds {study.seeds[0]} to {study.seeds[-1]}: "
        f"{study.about}.", 120, break_on_hyphens=False)
    yield ""
    yield "| changed | seeds | reached, % | 95 % | difference, points | 95 % | each seed, % | collided | out of steps |"
    yield "|---|---|---|---|---|---|---|---|---|"
    for name in study.variants:
        if name not in kept:
            continue
        rng = random.Random(1)
        own = shares[name]
        low, high = interval([resampled(own, rng) for _ in range(RESAMPLES)])
        difference = interval([resampled(own, rng) - resampled(base, rng) for _ in range(RESAMPLES)])
        # One seed says nothing about others.
        spread = f"{low:.1f}–{high:.1f}" if len(own) > 1 else "–"
        collided, out = (sum(counts[i] for counts in kept[name].values()) for i in (2, 3))
        compared = "–" if name == AS_SHIPPED else f"{middle(own) - middle(base):+.1f}"
        between = "–" if name == AS_SHIPPED or len(own) < 2 else f"{difference[0]:+.1f} to {difference[1]:+.1f}"
        yield (f"| {name} | {len(own)} | {middle(own):.1f} | {spread} | {compared} | {between} "
               f"| {', '.join(f'{share:.1f}' for share in own)} | {collided} | {out} |")
    yield ""


def page(kept):
    yield "# Ablations"
    yield ""
    yield "`make ablations` trains these policies and writes this page."
    yield ""
    yield textwrap.fill(
        "A table has the interquartile mean of the share that reached its goal, and the difference to the recipe as shipped, "
        "both with 95 % bootstrap intervals over the training seeds (Agarwal et al. 2021). An interval of the difference "
        "that contains 0 shows no effect. Few seeds give rough intervals, and they are not corrected for the number of "
        "comparisons.", 120)
    yield ""
    for name, study in STUDIES.items():
        runs = {variant: runs for variant, runs in kept.get(name, {}).items() if runs}
        if runs:
            yield from table(study, runs)


def main():
    kept = json.loads(KEPT.read_text()) if KEPT.exists() else {}
    for title, study in STUDIES.items():
        for seed in study.seeds:
            for name, changes in study.variants.items():
                runs = kept.setdefault(title, {}).setdefault(name, {})
                if str(seed) in runs:
                    continue
                print(f"{title}, {name}: seed {seed}", file=sys.stderr, flush=True)
                runs[str(seed)] = train(study, changes, seed)
                # After each, so that an interrupted run leaves what it has.
                KEPT.write_text(json.dumps(kept, indent=1, ensure_ascii=False) + "\n")
                PAGE.write_text("\n".join(page(kept)))


main()
