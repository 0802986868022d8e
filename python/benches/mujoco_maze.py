"""Control steps per second of `ferry/Maze-v0`, and of a MuJoCo environment of like content; docs/results.md.

pip install mujoco; MUJOCO_GL=egl LP_NUM_THREADS=1 RAYON_NUM_THREADS=1 taskset -c 0 python mujoco_maze.py
"""

import re
import statistics
import time
from pathlib import Path
from typing import Any

import gymnasium
import mujoco
import numpy as np
from numpy.typing import NDArray

import ferry

PAIRS, SECONDS = 6, 5.0
TICK_S, TICKS_PER_STEP, STEP_M, SPEED_M_S = 0.008, 31.25, 0.01, 0.04
TOOL_M, RADIUS_M, MASS_KG, DRAG_N_S_M = 0.1, 0.0025, 0.491e-3, 0.01
PULL_N_M4 = 0.3 * MASS_KG * 9.81 * (TOOL_M + 0.005 - RADIUS_M) ** 4  # Directly above, it lifts .6 of the weight.
PIXELS = np.arange(84) * 480 // 84 + 2  # One of about six by six: the cheapest reduction.
Y, Z = "0 1 0", "0 0 1"
JOINTS = {"0 0 .089": Z, "0 .136 0": Y, "0 -.12 .425": Y, "0 0 .392": Y, "0 .093 0": Z, "0 0 .095": Y}


def pieces_m() -> NDArray[np.float64]:
    """The drawing's pieces of outline and its folds, each from a point to a point."""
    outline, folds = re.findall(r' d="(.*?)"', (Path(__file__).parents[2] / "assets/maps/colon.svg").read_text(), re.S)
    ring = np.array(re.findall(r"[M ]([-\d.]+) ([-\d.]+)(?=\n|Z)", outline.split("Z", 1)[1]), float)
    strokes = np.array(re.findall(r"[ML]([-\d.]+) ([-\d.]+)", folds), float).reshape(-1, 2, 2)
    return np.concatenate([np.stack([ring[:-1], ring[1:]], axis=1), strokes]) * [0.001, -0.001]


def model(pieces: NDArray[np.float64], substeps: int) -> mujoco.MjModel:
    walls, arm, servos = "", "", ""
    for (x0, y0), (x1, y1) in pieces:
        walls += f'<geom type="box" size="{np.hypot(x1 - x0, y1 - y0) / 2 + 0.001} .0025 .0025" rgba=".16 .16 .16 1" '
        walls += f'pos="{(x0 + x1) / 2} {(y0 + y1) / 2} .0025" euler="0 0 {np.arctan2(y1 - y0, x1 - x0)}"/>'
    for at, axis in JOINTS.items():
        arm += f'<body pos="{at}" gravcomp="1"><joint name="{at}" axis="{axis}" damping="20" armature="1"/>'
        arm += '<geom type="capsule" size=".04 .04" mass="2" group="3" contype="0" conaffinity="0"/>'
        servos += f'<position joint="{at}" kp="4000"/>'
    return mujoco.MjModel.from_xml_string(f"""<mujoco><compiler angle="radian"/>
    <option timestep="{TICK_S / substeps}" integrator="implicitfast" cone="elliptic"/>
    <visual><global offwidth="480" offheight="480"/><quality shadowsize="0" offsamples="0" numquads="1"/>
      <headlight ambient=".95 .95 .95" diffuse="0 0 0" specular="0 0 0"/></visual><!-- No shadows, no reflections. -->
    <worldbody><geom type="plane" size="1 1 1" rgba=".94 .94 .94 1" friction=".2 0 0"/>{walls}
      <body name="bead"><freejoint/><geom type="sphere" size="{RADIUS_M}" mass="{MASS_KG}" rgba="1 .9 .5 1"
        condim="6" friction=".2 .00001 .000025"/></body>
      <body mocap="true"><camera name="camera" pos="0 0 {0.3 - TOOL_M}" fovy="36.87"/></body>
      {arm}<body pos="0 .262 0"/>{"</body>" * 6}</worldbody><actuator>{servos}</actuator></mujoco>""")


class MujocoMaze(gymnasium.Env[Any, Any]):
    """A magnet, carried by an arm with position servos, pulls a rolling bead through the walls of `colon`."""

    def __init__(self, ferrys: ferry.MazeEnv, substeps: int, renders: bool) -> None:
        pieces = pieces_m()
        self.from_m, self.along_m = pieces[:, 0], pieces[:, 1] - pieces[:, 0]
        self.model, self.substeps = model(pieces, substeps), substeps
        self.data, self.ik = mujoco.MjData(self.model), mujoco.MjData(self.model)
        self.bead, self.tool = self.model.body("bead").id, self.model.nbody - 1
        self.tasks = [(info["tool_m"], info["goal_m"]) for info in (ferrys.reset(seed=i)[1] for i in range(50))]
        self.renderer = mujoco.Renderer(self.model, 480, 480) if renders else None
        self.image, self.option = np.zeros((480, 480, 3), np.uint8), mujoco.MjvOption()
        self.option.geomgroup[3] = 0  # As with Ferry's default camera, arm and magnet are not in the picture.

    def is_free(self, at_m: NDArray[np.float64]) -> bool:
        """12 mm from every wall. Ferry finds it out from the image."""
        share = ((at_m - self.from_m) * self.along_m).sum(axis=1) / (self.along_m**2).sum(axis=1)
        off_m = at_m - self.from_m - share.clip(0, 1)[:, None] * self.along_m
        return bool((off_m**2).sum(axis=1).min() > 0.012**2)

    def reach(self, at_m: NDArray[np.float64], rounds: int) -> NDArray[np.float64]:
        """Angles of the arm for a place of the tool, pointing down."""
        jacobian = np.zeros((6, self.model.nv))
        for _ in range(rounds):
            mujoco.mj_kinematics(self.model, self.ik)
            mujoco.mj_comPos(self.model, self.ik)
            mujoco.mj_jacBody(self.model, self.ik, jacobian[:3], jacobian[3:], self.tool)
            tilt = np.cross(self.ik.xmat[self.tool, 1::3], [0, 0, -1])
            errors, arms = np.concatenate([at_m - self.ik.xpos[self.tool], tilt]), jacobian[:, 6:]
            self.ik.qpos[7:] += np.linalg.solve(arms.T @ arms + 1e-4 * np.eye(6), arms.T @ errors)
        return self.ik.qpos[7:].copy()

    def reset(self, *, seed: int | None = None, options: dict[str, Any] | None = None) -> tuple[Any, dict[str, Any]]:
        super().reset(seed=seed)
        mujoco.mj_resetData(self.model, self.data)
        start, self.goal = self.tasks[self.np_random.integers(len(self.tasks))]
        self.steps, self.magnet = 0, np.array([*start, TOOL_M])
        self.data.qpos[:7], self.data.mocap_pos[0] = [*start, RADIUS_M, 1, 0, 0, 0], self.magnet
        self.ik.qpos[7:] = [np.arctan2(start[1], start[0]), -0.5, 1.8, 0.27, -1.57, 0]
        self.data.qpos[7:] = self.data.ctrl[:] = self.reach(self.magnet, 30)
        mujoco.mj_forward(self.model, self.data)
        return self.seen()

    def step(self, action: Any) -> tuple[Any, float, bool, bool, dict[str, Any]]:
        data, angles, pull = self.data, self.data.ctrl.copy(), self.data.xfrc_applied[self.bead, :3]
        target = self.magnet[:2] + STEP_M * np.clip(action, -1, 1)
        travel = target - self.magnet[:2] if self.is_free(target) else np.zeros(2)
        share = min(1.0, SPEED_M_S * TICK_S / max(float(np.hypot(*travel)), 1e-9))
        (x, y), (dx, dy) = self.magnet[:2].tolist(), (travel * share).tolist()
        turn = (self.reach(np.array([*target, TOOL_M]), 3) - angles) * share if travel.any() else np.zeros(6)
        for tick in range(int((self.steps + 1) * TICKS_PER_STEP) - int(self.steps * TICKS_PER_STEP)):
            if travel.any() and (tick + 1) * share <= 1.0 + 1e-9:
                x, y, angles = x + dx, y + dy, angles + turn
                data.mocap_pos[0], data.ctrl[:] = (x, y, TOOL_M), angles
            # Pull of an upright dipole on another one, and drag.
            (rx, ry, rz), (vx, vy) = (data.qpos[:3] - (x, y, TOOL_M + 0.005)).tolist(), data.qvel[:2].tolist()
            near = PULL_N_M4 / (square := rx * rx + ry * ry + rz * rz) ** 2.5
            side = near * (1 - 5 * rz * rz / square)
            pull[:] = side * rx - DRAG_N_S_M * vx, side * ry - DRAG_N_S_M * vy, (side + 2 * near) * rz
            mujoco.mj_step(self.model, data, nstep=self.substeps)
        self.steps, self.magnet = self.steps + 1, np.array([x, y, TOOL_M])
        (seen, info), is_there = self.seen(), bool(np.hypot(*(self.goal - data.qpos[:2])) < 0.02)
        return seen, float(is_there), is_there, self.steps >= 150, info

    def seen(self) -> tuple[dict[str, Any], dict[str, Any]]:
        seen = {"vector": np.concatenate([self.goal, self.magnet[:2]]).astype(np.float32)}
        if self.renderer is not None:
            self.renderer.update_scene(self.data, "camera", self.option)
            self.renderer.render(out=self.image)
            seen["image"] = (self.image[PIXELS[:, None], PIXELS] @ [0.299, 0.587, 0.114]).astype(np.uint8)
        return seen, {"tool_m": self.magnet[:2], "goal_m": self.goal}


def rate(env: gymnasium.Env[Any, Any]) -> float:
    """Control steps per second of processor time, of all threads; the steps are those of `maze` in speed.py."""
    random, steps, began, used = np.random.default_rng(1), 0, time.perf_counter(), time.process_time()
    _, info = env.reset(seed=1)
    while time.perf_counter() - began < SECONDS:
        way = info["goal_m"] - info["tool_m"]
        _, _, terminated, truncated, info = env.step(way / max(np.abs(way).max(), 1e-9) + random.normal(0, 0.5, 2))
        steps += 1
        if terminated or truncated:
            _, info = env.reset()
    return steps / (time.process_time() - used)


if __name__ == "__main__":
    maze = ferry.MazeEnv("colon", action="box", observation="dict")
    for renders, substeps in [(True, 1), (True, 8), (False, 1), (False, 8)]:
        other = MujocoMaze(maze, substeps, renders)
        pairs = [(rate(maze), rate(other)) for _ in range(PAIRS)]
        print(f"MuJoCo {mujoco.__version__}, {substeps} steps a tick, {renders=}")
        columns = [*zip(*pairs, strict=True), [ours / theirs for ours, theirs in pairs]]
        for name, rates in zip(["Ferry", "MuJoCo", "ratio"], columns, strict=True):
            print(f"  {name:6} {statistics.median(rates):7.2f} ({min(rates):.2f} to {max(rates):.2f})")
