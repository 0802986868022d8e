"""Reads a model of the arm with yourdfpy (URDF) or MuJoCo (MJCF), and prints what the test compares as JSON.

    read_arm.py urdf|mjcf FILE < JOINTS

JOINTS is a JSON list of joint angles in rad, six per pose. For each pose: the pose of `tool0` and of `magnet` in `base`,
as a row-major matrix of 4 by 4. With MuJoCo also: contacts in the pose `home`, and how far its servos let the arm sink
in a second of simulated time.
"""

import json
import sys

import numpy as np


def urdf(path: str, poses: list[list[float]]) -> dict:
    import mujoco
    import yourdfpy

    model = yourdfpy.URDF.load(path, load_meshes=False, build_collision_scene_graph=True)
    frames = []
    for joints in poses:
        model.update_cfg(joints)
        frames.append([model.get_transform(frame, "base").ravel().tolist() for frame in ("tool0", "magnet")])
    return {
        "joints": model.actuated_joint_names,
        "valid": model.validate(),
        "frames": frames,
        "mass_kg": float(mujoco.MjModel.from_xml_path(path).body_mass.sum()),
    }


def mjcf(path: str, poses: list[list[float]]) -> dict:
    import mujoco

    model = mujoco.MjModel.from_xml_path(path)
    data = mujoco.MjData(model)

    def frame(name: str) -> list[float]:
        body = data.body(name)
        matrix = np.eye(4)
        matrix[:3, :3] = body.xmat.reshape(3, 3)
        matrix[:3, 3] = body.xpos
        return matrix.ravel().tolist()

    frames = []
    for joints in poses:
        data.qpos[:] = joints
        mujoco.mj_kinematics(model, data)
        frames.append([frame(name) for name in ("tool0", "magnet")])
    names = [model.joint(joint).name for joint in range(model.njnt)]

    mujoco.mj_resetDataKeyframe(model, data, model.key("home").id)
    home = data.qpos.copy()
    mujoco.mj_forward(model, data)
    contacts = data.ncon
    while data.time < 1.0:
        mujoco.mj_step(model, data)
    sunk_rad = float(np.abs(data.qpos - home).max())
    # A servo that moves: half a radian further, a second later.
    data.ctrl[:] = home + 0.5
    while data.time < 3.0:
        mujoco.mj_step(model, data)
    missed_rad = float(np.abs(data.qpos - data.ctrl).max())
    return {
        "joints": names,
        "frames": frames,
        "contacts": contacts,
        "sunk_rad": sunk_rad,
        "missed_rad": missed_rad,
        "mass_kg": float(model.body_mass.sum()),
    }


if __name__ == "__main__":
    _, kind, path = sys.argv
    print(json.dumps({"urdf": urdf, "mjcf": mjcf}[kind](path, json.load(sys.stdin))))
