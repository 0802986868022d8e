"""Trains with one change each, over five seeds, and writes docs/ablations.md: `make ablations`.

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

ROOT = Path(__file__).resolve().parents[2]
FERRY = os.environ.get("FERRY_BIN", ROOT / "target/release/ferry")
KEPT = ROOT / "tests/results/ablations.json"
PAGE = ROOT / "docs/ablations.md"
OUT = ROOT / "target/results/ablations"
SEEDS = range(1, 6)
UPDATES = 4000
EXAMINED = 2000
RESAMPLES = 20_000
AS_SHIPPED = "as shipped"

# What is changed, and the settings of `ferry train`.
VARIANTS = {
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
}


def train(changes, seed):
    """Counts of the last examination: reached, collided, out of steps."""
    OUT.mkdir(parents=True, exist_ok=True)
    settings = [f"updates={UPDATES}", *changes]
    command = [FERRY, "train", "--map", "colon", "--seed", str(seed), "--episodes", str(EXAMINED),
               "--out", str(OUT / "one.safetensors"), "--sweeps", str(OUT / "sweeps"),
               *(word for setting in settings for word in ("--set", setting))]
    environment = {"XDG_RUNTIME_DIR": "/tmp", **os.environ}
    done = subprocess.run(command, stdout=subprocess.PIPE, check=True, text=True, env=environment)
    found = re.search(r"^trained on +colon: (\d+)/\d+ reached .*?, (\d+) collided, (\d+) out of steps", done.stdout, re.M)
    return [int(count) for count in found.groups()]


def middle(values):
    """Interquartile mean: without the lowest and the highest quarter, rounded down."""
    cut = len(values) // 4
    return statistics.mean(sorted(values)[cut:len(values) - cut])


def resampled(shares, rng):
    return middle(rng.choices(shares, k=len(shares)))


def interval(draws):
    ordered = sorted(draws)
    return ordered[int(0.025 * len(ordered))], ordered[int(0.975 * len(ordered))]


def page(kept):
    shares = {name: [100 * counts[0] / EXAMINED for counts in runs.values()] for name, runs in kept.items()}
    base = shares[AS_SHIPPED]
    yield "# Ablations"
    yield ""
    yield "`make ablations` trains these policies and writes this page."
    yield ""
    yield textwrap.fill(
        f"`ferry train --map colon --set updates={UPDATES}` with one change each: a third of the default number of updates, "
        f"where differences still show. Each is trained with the seeds {SEEDS[0]} to {SEEDS[-1]} and examined on {EXAMINED} "
        "starts and goals. The table has the interquartile mean of the share that reached its goal, and the difference to the "
        "recipe as shipped, both with 95 % bootstrap intervals over the seeds (Agarwal et al. 2021). An interval of the "
        "difference that contains 0 shows no effect. Five seeds give rough intervals, and they are not corrected for the "
        "number of comparisons.", 120)
    yield ""
    yield "| changed | seeds | reached, % | 95 % | difference, points | 95 % | each seed, % | collided | out of steps |"
    yield "|---|---|---|---|---|---|---|---|---|"
    for name in VARIANTS:
        if name not in kept:
            continue
        rng = random.Random(1)
        own = shares[name]
        low, high = interval([resampled(own, rng) for _ in range(RESAMPLES)])
        difference = interval([resampled(own, rng) - resampled(base, rng) for _ in range(RESAMPLES)])
        collided, out = (sum(counts[i] for counts in kept[name].values()) for i in (1, 2))
        compared = "–" if name == AS_SHIPPED else f"{middle(own) - middle(base):+.1f}"
        between = "–" if name == AS_SHIPPED else f"{difference[0]:+.1f} to {difference[1]:+.1f}"
        yield (f"| {name} | {len(own)} | {middle(own):.1f} | {low:.1f}–{high:.1f} | {compared} | {between} "
               f"| {', '.join(f'{share:.1f}' for share in own)} | {collided} | {out} |")


def main():
    kept = json.loads(KEPT.read_text()) if KEPT.exists() else {}
    for seed in SEEDS:
        for name, changes in VARIANTS.items():
            runs = kept.setdefault(name, {})
            if str(seed) in runs:
                continue
            print(f"{name}: seed {seed}", file=sys.stderr, flush=True)
            runs[str(seed)] = train(changes, seed)
            # After each, so that an interrupted run leaves what it has.
            KEPT.write_text(json.dumps(kept, indent=1, ensure_ascii=False) + "\n")
            PAGE.write_text("\n".join(page({name: runs for name, runs in kept.items() if runs})) + "\n")


main()
