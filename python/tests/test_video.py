"""Frames and videos, as Gymnasium records them."""

from pathlib import Path
from typing import Any

import gymnasium
import numpy as np
import pytest
from gymnasium.vector import AutoresetMode
from gymnasium.wrappers import RecordVideo
from gymnasium.wrappers.vector import RecordVideo as RecordVideos

import ferry

NAMES = {"ferry/Lattice-v0": (336, 336, 3), "ferry/Maze-v0": (384, 512, 3)}


@pytest.mark.parametrize("name", NAMES)
def test_a_vector_has_a_frame_of_each_environment(name: str) -> None:
    envs = gymnasium.make_vec(name, num_envs=2, map="posts", render_mode="rgb_array")
    assert envs.render_mode == "rgb_array" and envs.metadata["render_modes"] == ["rgb_array"]
    envs.reset(seed=1)
    envs.step(np.array([0, 2]))
    frames = envs.render()
    assert len(frames) == 2 and all(frame.shape == NAMES[name] and frame.dtype == np.uint8 for frame in frames)
    assert not np.array_equal(*frames)
    for lane in range(2):
        single = gymnasium.make(name, map="posts", render_mode="rgb_array")
        single.reset(seed=1 + lane)
        single.step((0, 2)[lane])
        assert np.array_equal(single.render(), frames[lane])


@pytest.mark.parametrize("name", NAMES)
def test_without_a_render_mode_there_are_no_frames(name: str) -> None:
    envs = gymnasium.make_vec(name, num_envs=2, map="posts")
    envs.reset(seed=1)
    assert envs.render_mode is None and envs.render() is None
    with pytest.raises(ValueError, match="Render mode is None"):
        RecordVideos(envs, "unused")


@pytest.mark.parametrize("kind", [ferry.LatticeEnv, ferry.MazeEnv, ferry.LatticeVectorEnv, ferry.MazeVectorEnv])
@pytest.mark.parametrize("mode", ["human", "rgb_array_list", ""])
def test_other_render_modes_are_named(kind: type, mode: str) -> None:
    with pytest.raises(ValueError, match=f"render_mode is '{mode}', it must be \"rgb_array\" or None"):
        kind(map="posts", render_mode=mode)


def frames_of(video: Path) -> list[Any]:
    moviepy = pytest.importorskip("moviepy")
    # The clip alone leaves the pipes open when ffmpeg ended first.
    with moviepy.VideoFileClip(str(video)) as clip, clip.reader.proc:
        assert clip.fps == 4
        return list(clip.iter_frames())


@pytest.mark.parametrize("name", NAMES)
def test_gymnasium_records_a_video(name: str, tmp_path: Path) -> None:
    pytest.importorskip("moviepy")
    folder = tmp_path / "video"
    env = RecordVideo(gymnasium.make(name, map="posts", render_mode="rgb_array"), str(folder), video_length=6)
    env.reset(seed=1)
    for step in range(8):
        env.step(step % 4)
    env.close()
    frames = frames_of(next(folder.glob("*.mp4")))
    assert len(frames) >= 6 and frames[0].shape == NAMES[name] and np.ptp(frames[0]) > 100


@pytest.mark.parametrize("name", NAMES)
def test_gymnasium_records_a_video_of_a_vector(name: str, tmp_path: Path) -> None:
    pytest.importorskip("moviepy")
    folder = tmp_path / "video"
    envs = gymnasium.make_vec(
        name, num_envs=2, map="posts", render_mode="rgb_array", autoreset_mode=AutoresetMode.NEXT_STEP
    )
    recorded = RecordVideos(envs, str(folder), step_trigger=lambda step: step == 0, video_length=6)
    recorded.reset(seed=1)
    for step in range(8):
        recorded.step(np.full(2, step % 4))
    recorded.close()
    (frame, *_) = frames_of(next(folder.glob("*.mp4")))
    height, width, colours = NAMES[name]
    assert frame.shape in [(height, 2 * width, colours), (2 * height, width, colours)]
