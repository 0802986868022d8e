"""Evaluates controllers on generated mazes that no training used, and writes docs/mazes.md: `make mazes`.

`MAZE_TRIALS` is the number of trials on each maze, of those with disturbances a quarter. The seed is the first eight
hexadecimal digits of the evaluated commit, so it is not chosen; `FERRY_COMMIT` names that commit when HEAD has moved on.
Finished rows are kept in tests/results/mazes/COMMIT, so an interrupted run goes on. `POLICIES` lists further policies,
trained with other seeds.
"""

import json
import math
import os
import subprocess
import sys
import textwrap
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
FERRY = os.environ.get("FERRY_BIN", ROOT / "target/release/ferry")
PAGE = ROOT / "docs/mazes.md"
DRAWN = ROOT / "target/results/mazes"
FAMILIES = ["rooms", "spirals", "serpentines"]
MAZES = 20
TRIALS = int(os.environ.get("MAZE_TRIALS", "200"))
STEPS = 400
POLICIES = [Path(path) for path in os.environ.get("POLICIES", "").split(":") if path]


def revision():
    return subprocess.run(["git", "rev-parse", "--short=8", "HEAD"], cwd=ROOT, capture_output=True, text=True,
                          check=True).stdout.strip()


def contenders():
    """Name, controller, disturbances, trials on each maze, and further options."""
    yield "RL, explorer", "rl", 0, TRIALS, []
    yield "RL, explorer, three disturbances", "rl", 3, TRIALS // 4, []
    for path in POLICIES:
        yield f"RL, {path.stem}", "rl", 0, TRIALS, ["--policy", str(path)]
    yield "ERRT", "errt", 0, TRIALS, []
    yield "replanner", "replanner", 0, TRIALS, []


def report(family, name, controller, disturbances, trials, options, commit):
    """The rows of an evaluation on all mazes of a family, run now if they are not kept."""
    kept = ROOT / "tests/results/mazes" / commit / f"{family}, {name}, {trials}.json"
    if not kept.exists():
        print(f"{family}, {name}", file=sys.stderr, flush=True)
        maps = ",".join(str(DRAWN / f"{family}-{seed}.svg") for seed in range(1, MAZES + 1))
        command = [FERRY, "evaluate", "--map", maps, "--controller", controller, "--disturbances", str(disturbances),
                   "--episodes", str(trials), "--seed", str(int(commit, 16)), "--set", f"step_limit={STEPS}", "--json",
                   *options]
        environment = {"XDG_RUNTIME_DIR": "/tmp", **os.environ}
        done = subprocess.run(command, stdout=subprocess.PIPE, check=True, env=environment)
        fields = ("map", "episodes", "successes", "delivered", "path_ratio_mean", "steps_mean")
        rows = [{field: row[field] for field in fields} for row in json.loads(done.stdout)["rows"]]
        kept.parent.mkdir(parents=True, exist_ok=True)
        kept.write_text(json.dumps(rows, indent=1) + "\n")
    return json.loads(kept.read_text())


def wilson95(count, total):
    z = 1.959_963_984_540_054
    share = count / total
    middle = share + z * z / (2 * total)
    spread = z * math.sqrt(share * (1 - share) / total + z * z / (4 * total * total))
    return [(middle + sign * spread) / (1 + z * z / total) for sign in (-1, 1)]


def line(family, name, rows):
    episodes, delivered, reached = (sum(row[field] for row in rows) for field in ("episodes", "delivered", "successes"))
    low, high = wilson95(delivered, episodes)
    # Means over the mazes' own means, weighted by the trials that count in them.
    ratio = sum((row["path_ratio_mean"] or 0) * row["successes"] for row in rows) / max(reached, 1)
    steps = sum(row["steps_mean"] * row["episodes"] for row in rows) / episodes
    least = min(rows, key=lambda row: row["delivered"] / row["episodes"])
    return (f"| {family} | {name} | {delivered}/{episodes} | {100 * low:.1f}–{100 * high:.1f} % | {reached} "
            f"| {least['map']}: {least['delivered']}/{least['episodes']} | {ratio:.2f} | {steps:.0f} |")


def deficit(name, reference, reports):
    """On which maze a controller falls farthest behind another, once all are evaluated."""
    if not all((family, other) in reports for family in FAMILIES for other in (name, reference)):
        return
    pairs = [pair for family in FAMILIES for pair in zip(reports[family, name], reports[family, reference], strict=True)]
    points, maze = max((100 * (second["delivered"] - first["delivered"]) / first["episodes"], first["map"])
                       for first, second in pairs)
    yield ""
    yield f"{name} delivers at most {points:.1f} points less than the {reference} on a maze ({maze})."


def page(reports, commit):
    yield "# Mazes that no training used"
    yield ""
    yield "`make mazes` runs this and writes the page."
    yield ""
    yield textwrap.fill(
        f"Mazes of the families rooms, spirals and serpentines with seeds 1 to {MAZES}, all widths, none left out: "
        f"`ferry maps generate --family F --count {MAZES} --out DIR`. {TRIALS} trials on each, "
        f"{TRIALS // 4} with disturbances, `step_limit` {STEPS}, commit {commit}, seed {int(commit, 16)}. The explorer was "
        "trained on tubes, trees and stones only: the shipped one with seed 1, explorer-N with seed N. Path ratio: length of "
        "the tool's path over the shortest path of the bead, in trials that reached the goal; a controller that sees 20 cm "
        "must explore.", 120)
    yield ""
    yield "| mazes | controller | delivered | 95 % Wilson | reached | lowest | path ratio | steps |"
    yield "|---|---|---|---|---|---|---|---|"
    for name in dict.fromkeys(name for _, name in reports):
        for family in FAMILIES:
            if (family, name) in reports:
                yield line(family, name, reports[family, name])
        pooled = [row for (_, other), rows in reports.items() if other == name for row in rows]
        yield line("**all**", name, pooled)
    yield from deficit("ERRT", "replanner", reports)


def main():
    commit = os.environ.get("FERRY_COMMIT", revision())
    for family in FAMILIES:
        subprocess.run([FERRY, "maps", "generate", "--family", family, "--count", str(MAZES), "--out", DRAWN], check=True,
                       stdout=subprocess.DEVNULL)
    reports = {}
    for name, *setup in contenders():
        for family in FAMILIES:
            reports[family, name] = report(family, name, *setup, commit)
            # After each, so that an interrupted run leaves what it has.
            PAGE.write_text("\n".join(page(reports, commit)) + "\n")


main()
