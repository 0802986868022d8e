"""Several trainings with one setting and several seeds, one after the other or with Ray."""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
from collections.abc import Mapping, Sequence
from os import PathLike, fspath
from pathlib import Path
from typing import Any, Literal

from tqdm import tqdm

from ferry.checks import changes, seed_of, whole
from ferry.environments import default_sweeps
from ferry.evaluation import check_engine, in_parallel

OUT = "seed-{}.safetensors"


def train(
    map: str | PathLike[str],
    folder: str | PathLike[str],
    *,
    seeds: Sequence[int] = (1,),
    recipe: Literal["quick", "full", "paper", "toy"] = "full",
    settings: Mapping[str, Any] | None = None,
    episodes: int = 2000,
    engine: Literal["ray"] | None = None,
) -> list[Path]:
    """Trains one policy per seed, each as ``ferry train`` does, and returns their files: ``FOLDER/seed-N.safetensors``.

    Beside each are its curve (``.curve.csv``) and what the command printed, with the examination (``.log``).

    Args:
        map: name of a map, or path of an SVG.
        folder: is created if it does not exist.
        seeds: seeds of the trainings.
        recipe: where the settings start.
        settings: settings of the recipe by name, as in ``ferry train --set``.
        episodes: random starts and goals of the final examination.
        engine: ``"ray"`` trains the seeds at the same time on its cluster, one core each; otherwise they are trained
            one after the other on all cores of this machine. What a lost worker has trained is trained again.

    Raises:
        ValueError: ``ferry train`` refuses something. The message names it.
    """
    check_engine(engine)
    out = Path(folder)
    out.mkdir(parents=True, exist_ok=True)
    where = (fspath(map), recipe, whole("episodes", episodes), changes(settings, "settings"))
    seeds = [seed_of(seed) for seed in seeds]
    files = [out / OUT.format(seed) for seed in seeds]
    with tqdm(total=len(files), unit=" trainings", disable=None) as bar:
        if engine:
            trained = in_parallel(_train, [(*where, seed, 1) for seed in seeds], lambda _: bar.update())
            for file, written in zip(files, trained, strict=True):
                _write(file, written)
        else:
            for file, seed in zip(files, seeds, strict=True):
                _write(file, _train(*where, seed, None))
                bar.update()
    return files


def _write(file: Path, written: Mapping[str, bytes]) -> None:
    for ending, content in written.items():
        file.with_suffix(ending).write_bytes(content)


def _train(
    map: str, recipe: str, episodes: int, changed: Sequence[str], seed: int, threads: int | None
) -> dict[str, bytes]:
    """Files by their ending."""
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder) / OUT.format(seed)
        command = [sys.executable, "-m", "ferry", "train", "--map", map, "--seed", str(seed), "--recipe", recipe]
        command += ["--episodes", str(episodes), "--out", str(out), "--sweeps", str(default_sweeps())]
        command += [part for change in changed for part in ("--set", change)]
        environment = None if threads is None else {**os.environ, "RAYON_NUM_THREADS": str(threads)}
        done = subprocess.run(command, capture_output=True, env=environment)
        if done.returncode != 0:
            raise ValueError(done.stderr.decode(errors="replace").strip().splitlines()[-1])
        endings = (".safetensors", ".curve.csv")
        return {ending: out.with_suffix(ending).read_bytes() for ending in endings} | {".log": done.stdout}
