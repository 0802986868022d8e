"""Loads a folder of data sets with Minari and prints what the attempts hold, as a JSON object."""

import json
import os
import sys

os.environ["MINARI_DATASETS_PATH"] = sys.argv[1]

import minari  # noqa: E402  It reads the variable above.
import numpy as np  # noqa: E402


def column(values):
    return {"shape": list(values.shape), "dtype": str(values.dtype)}


data_set = minari.load_dataset("ferry/attempts-v0")
episodes = []
metadata = data_set.storage.get_episode_metadata(data_set.episode_indices)
for episode, about in zip(data_set.iterate_episodes(), metadata, strict=True):
    steps = len(episode)
    rows = [{name: values[row] for name, values in episode.observations.items()} for row in range(steps + 1)]
    episodes.append({
        "about": about,
        "columns": {
            **{f"observations.{name}": column(values) for name, values in episode.observations.items()},
            **{f"infos.{name}": column(values) for name, values in episode.infos.items()},
            "actions": column(episode.actions),
            "rewards": column(episode.rewards),
            "terminations": column(episode.terminations),
            "truncations": column(episode.truncations),
        },
        "in_spaces": all(row in data_set.observation_space for row in rows)
        and all(action in data_set.action_space for action in episode.actions),
        "rewards": episode.rewards.tolist(),
        "terminations": episode.terminations.tolist(),
        "truncated": bool(episode.truncations.any()),
        "actions": episode.actions.tolist(),
        "tool_m": episode.observations["tool_m"].tolist(),
        "goal_m": episode.observations["goal_m"].tolist(),
        # The image changes; the goal's part of the second channel does not.
        "images": len(np.unique(episode.observations["observation"][:, 0], axis=0)),
        "goals": len(np.unique(episode.observations["observation"][:, 1, :42], axis=0)),
        "tick": episode.infos["tick"].tolist(),
        "steers": episode.infos["steers"].tolist(),
        "sub_controller": episode.infos["sub_controller"].tolist(),
        "bead_m": episode.infos["bead_m"].tolist(),
    })
listed = list(minari.list_local_datasets())
sampled = data_set.sample_episodes(1)
steered = data_set.filter_episodes(lambda episode: bool(episode.infos["steers"].any()))
combined = minari.combine_datasets([data_set, data_set], "ferry/twice-v0")
print(json.dumps({
    "total_episodes": data_set.total_episodes,
    "total_steps": data_set.total_steps,
    "listed": listed,
    "algorithm": data_set.storage.metadata["algorithm_name"],
    "sampled_steps": len(sampled[0]),
    "steered": steered.total_episodes,
    "combined_steps": combined.total_steps,
    "episodes": episodes,
}))
