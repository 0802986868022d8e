"""Runs the evaluations of docs/evaluation.md and writes that page: `make results`.

The seed is the first eight hexadecimal digits of the evaluated commit, so it is not chosen. Each evaluation is kept as
JSON in tests/results/reports; a run that was interrupted goes on with the evaluations that are missing.
`FERRY_COMMIT` names the commit of such a run when HEAD has moved on.
"""

import json
import os
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
FERRY = os.environ.get("FERRY_BIN", ROOT / "target/release/ferry")
PAGE = ROOT / "docs/evaluation.md"
ALL = "rl,errt,attractor"

# Name, heading, what the rows show, and the options of `ferry evaluate`. The number of trials comes first.
EVALUATIONS = [
    ("claims", "RL where it was trained", "A claim of 99.5 % needs 1,130 trials with at most one failure.",
     1130, ["--map", "colon", "--controller", "rl", "--disturbances", "0,3"]),
    ("bare", "RL without help",
     "The network alone: a step into a wall in view is refused and the arm holds, and nothing ends going to and fro.",
     400, ["--map", "colon,posts", "--controller", "rl", "--set", "rl_shield=false", "--set", "rl_visit_penalty=0"]),
    ("shield", "RL with the shield alone", "The same trials. A step into a wall is replaced by the next best.",
     400, ["--map", "colon,posts", "--controller", "rl", "--set", "rl_visit_penalty=0"]),
    ("controllers", "All controllers", "Every controller runs the same starts, goals and disturbances.",
     200, ["--map", "colon,posts", "--controller", ALL, "--disturbances", "0,3"]),
    ("realistic", "The realistic camera mount", "Magnet and gripper are in the picture and hide a part of the table.",
     200, ["--map", "colon,posts", "--controller", ALL, "--set", "preset=realistic"]),
    ("hand", "A person's hand, and a first fetch",
     "A hand draws the bead away three times through free space, and the tool starts at least 15 cm from the bead.",
     200, ["--map", "colon,posts", "--controller", ALL, "--disturbances", "3", "--by-hand", "--tool-apart"]),
    ("general", "RL with the general policy", "One network for four maps.",
     400, ["--map", "posts,vessels", "--controller", "rl", "--disturbances", "0,3", "--set", "rl_policy=general"]),
    ("poor", "Poor sensors",
     "A tracker with noise, bias, drift, losses and latency, which the arm can hide the bead from, and a late camera with "
     "noise.",
     200, ["--map", "colon,posts", "--controller", ALL, "--set", "preset=poor"]),
]


def revision():
    return subprocess.run(["git", "rev-parse", "--short=8", "HEAD"], cwd=ROOT, capture_output=True, text=True,
                          check=True).stdout.strip()


def evaluated(name, trials, options, commit):
    """The report of an evaluation, run now if it is not kept."""
    kept = ROOT / "tests/results/reports" / commit / f"{name}.json"
    if not kept.exists():
        print(f"{name}: {trials} trials per row", file=sys.stderr, flush=True)
        command = [FERRY, "evaluate", *options, "--episodes", str(trials), "--seed", str(int(commit, 16)), "--json"]
        environment = {"XDG_RUNTIME_DIR": "/tmp", **os.environ}
        done = subprocess.run(command, stdout=subprocess.PIPE, check=True, env=environment)
        kept.parent.mkdir(parents=True, exist_ok=True)
        kept.write_bytes(done.stdout)
    return json.loads(kept.read_text())


def share(interval):
    return f"{100 * interval[0]:.1f}–{100 * interval[1]:.1f} %"


def settings(row):
    """What differs from the defaults: shield and penalty of RL, mount, and the rest."""
    changes = dict(change.split("=", 1) for change in row["changes"])
    words = []
    if row["controller"] == "rl":
        shield, penalty = changes.pop("rl_shield", "true"), changes.pop("rl_visit_penalty", "0.1")
        words.append(f"shield {'on' if shield == 'true' else 'off'}, penalty {float(penalty):g}")
    mount = [name for name in changes if name.startswith("camera_") and "noise" not in name and "latency" not in name]
    for name in mount:
        del changes[name]
    words.append("realistic mount" if mount else "ideal mount")
    if any(name.startswith("tracker_") for name in changes):
        words.append("poor sensors")
    return ", ".join(words)


def rows(report):
    yield ("| controller | map | trained there | disturbances | settings | delivered | 95 % Wilson | reached | mean error; x, y "
           "| largest error x, y (mean over trials) | path ratio | steps |")
    yield "|---|---|---|---|---|---|---|---|---|---|---|---|"
    for row in report["rows"]:
        trained = {None: "–", True: "yes", False: "no"}[row["trained_on_map"]]
        errors = [1e3 * row[f"tracking_error_{name}_m"] for name in ("mean", "mean_x", "mean_y", "max_x", "max_y")]
        ratio = f"{row['path_ratio_mean']:.2f}" if row["path_ratio_mean"] else "–"
        yield (f"| {row['controller']} | {row['map']} | {trained} | {row['disturbances']} | {settings(row)} "
               f"| {row['delivered']}/{row['episodes']} | {share(row['wilson95'])} | {row['successes']} "
               f"| {errors[0]:.0f} mm; {errors[1]:.0f}, {errors[2]:.0f} | {errors[3]:.0f}, {errors[4]:.0f} mm "
               f"| {ratio} | {row['steps_mean']:.0f} |")


def paired(mean, interval, digits):
    return f"{mean:+.{digits}f} ({interval[0]:+.{digits}f} to {interval[1]:+.{digits}f})"


def differences(report):
    if not report["comparisons"]:
        return
    yield ""
    yield (f"Paired differences over all trials, with intervals that hold together with 95 % ({len(report['comparisons'])} "
           "comparisons). A trial that was not delivered counts with all steps that its legs may take.")
    yield ""
    yield "| first − second | map | disturbances | both, first, second, neither | delivered, points | steps | path ratio |"
    yield "|---|---|---|---|---|---|---|"
    for one in report["comparisons"]:
        counts = ", ".join(str(one[name]) for name in ("both", "first_only", "second_only", "neither"))
        points = paired(100 * one["delivered_difference"],
                        [100 * end for end in one["delivered_difference_corrected"]], 1)
        of_all = [paired(one[name]["mean"], one[name]["interval_corrected"], digits) if one[name] else "–"
                  for name, digits in (("steps_of_all", 1), ("path_ratio_of_all", 2))]
        yield (f"| {one['controller']} − {one['against']} | {one['map']} | {one['disturbances']} | {counts} | {points} "
               f"| {of_all[0]} | {of_all[1]} |")


def failures(report):
    reasons = {}
    for failure in report["failures"]:
        words = "; ".join(word for word in (failure["outcome"], failure["trouble"], failure["refusal"]) if word)
        # Places differ from trial to trial.
        words = words.split(", at (")[0]
        row = (failure["controller"], failure["map"], failure["disturbances"])
        reasons.setdefault(row, {}).setdefault(words, 0)
        reasons[row][words] += 1
    if reasons:
        yield ""
        yield "Why beads were not delivered:"
        yield ""
    for (controller, name, disturbances), counts in reasons.items():
        listed = "; ".join(f"{count} × {words}" for words, count in sorted(counts.items(), key=lambda one: -one[1])[:3])
        yield f"- {controller}, {name}, {disturbances} disturbances: {listed}."


def main():
    wanted = set(sys.argv[1:])
    commit = os.environ.get("FERRY_COMMIT") or revision()
    lines = [
        "# Evaluation",
        "",
        "`make results` runs these evaluations and writes this page. [Results](results.md) says what they show. The words are",
        "those of the [glossary](glossary.md).",
        "",
        f"Evaluated commit {commit}. Its first eight hexadecimal digits are the seed, {int(commit, 16)}: it was not chosen, and",
        "nothing was tuned on it. Each evaluation ran once. RL's policies were trained on the maps marked with *yes*; the",
        "parameters of ERRT and of the attractor were tuned on `posts`, `colon` and `colon-folds`. Deliveries count: the bead",
        "is within 2 cm of the goal. *Reached* is the paper's test: the tool is.",
    ]
    for name, heading, about, trials, options in EVALUATIONS:
        if wanted and name not in wanted:
            continue
        report = evaluated(name, trials, options, commit)
        lines += ["", f"## {heading}", "", about, "",
                  f"`ferry evaluate {' '.join(options)} --episodes {trials} --seed {int(commit, 16)}`", ""]
        lines += [*rows(report), *differences(report), *failures(report)]
        # After each, so that an interrupted run leaves what it has.
        PAGE.write_text("\n".join(lines) + "\n")


main()
