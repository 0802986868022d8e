"""Turns a robot's tool about the vertical with ur_rtde, and prints what it saw as JSON.

    turn_robot.py ADDRESS PAGE arc|quarter
"""

import io
import json
import sys
import time
import urllib.request

import numpy as np
import rtde_control
import rtde_receive
from PIL import Image

address, page, part = sys.argv[1:]
control = rtde_control.RTDEControlInterface(address, 125.0)
receive = rtde_receive.RTDEReceiveInterface(address, 125.0)
start = receive.getActualQ()


def ask(path):
    with urllib.request.urlopen(f"{page}/api/sessions/main{path}") as answer:
        return answer.read()


def picture():
    time.sleep(1.0)
    return np.asarray(Image.open(io.BytesIO(ask("/camera.png"))).convert("L"), dtype=int)


def bead_beside_tool_m():
    pose = receive.getActualTCPPose()
    bead = json.loads(ask("/tracker"))
    return float(np.hypot(pose[0] - bead["x_m"], pose[1] - bead["y_m"]))


def with_joint(joint, turn_rad):
    return [angle + (turn_rad if i == joint else 0.0) for i, angle in enumerate(start)]


def servo(joints, speed_rad_s):
    """Follows a straight way in joint space at a rate of 125 Hz."""
    now = receive.getTargetQ()
    steps = int(max(abs(a - b) for a, b in zip(joints, now)) / (0.008 * speed_rad_s))
    for k in range(1, steps + 1):
        begun = control.initPeriod()
        if not control.servoJ([a + k / steps * (b - a) for a, b in zip(now, joints)], 0, 0, 0.008, 0.1, 300):
            return False
        control.waitPeriod(begun)
    control.servoStop()
    return True


found = {}
if part == "arc":
    # The bead follows at the speed of transport.
    found["aside"] = control.moveJ(with_joint(0, -0.5), 0.1, 1.0)
    for motion, turn_rad in (("moveJ", 0.5), ("back", -0.5)):
        ok = control.moveJ(with_joint(0, turn_rad), 0.1, 1.0)
        found[motion] = [ok, receive.getActualQ()[0] - start[0], bead_beside_tool_m()]
    found["servoJ"] = [servo(with_joint(0, 0.5), 0.1), servo(with_joint(0, -0.5), 0.1), bead_beside_tool_m()]
else:
    straight = picture()
    found["quarter"] = control.moveJ(with_joint(5, np.pi / 2), 1.0, 2.0)
    turned = picture()
    found["same"] = {k: float(np.mean(np.abs(np.rot90(straight, k) - turned) < 40)) for k in range(4)}
found["safe"] = receive.getSafetyMode()
print(json.dumps(found))
