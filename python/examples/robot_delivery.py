"""Ferries the bead to the goal through the robot alone, as a program for a real UR5 would: it moves with ur_rtde, and
sees the camera's picture and the tracker's estimate.

    pip install ur-rtde numpy pillow
    ferry serve --robot-server
    python robot_delivery.py [ROBOT [FERRY]]
"""

import heapq
import io
import json
import sys
import time
import urllib.request

import numpy as np
from PIL import Image
from rtde_control import RTDEControlInterface
from rtde_receive import RTDEReceiveInterface

ROBOT, FERRY = (sys.argv[1:] + ["127.0.0.1", "http://127.0.0.1:8080"][len(sys.argv) - 1 :])[:2]
CELL_M, SIDE, CORNER_M = 0.004, 220, np.array([-0.44, -0.88])  # a map of 88 x 88 cm
VIEW_M, VIEW_PX, DARK = 0.2, 480, 100  # the picture shows 20 cm of the table; walls are darker
STEP_CELLS, LOST_M = 5, 0.04
cells = CORNER_M + CELL_M * np.stack(np.meshgrid(np.arange(SIDE), np.arange(SIDE), indexing="ij"), -1)
is_wall, seen_from_m = np.zeros((SIDE, SIDE), bool), np.full((SIDE, SIDE), np.inf)


def ask(path: str) -> bytes:
    with urllib.request.urlopen(f"{FERRY}/api/sessions/main/{path}") as answer:
        return answer.read()


def look(tool: np.ndarray) -> None:
    """Notes the walls in the picture. What is nearer to its middle is seen with less parallax, and counts."""
    picture = np.array(Image.open(io.BytesIO(ask("camera.png"))).convert("L"))
    offset = cells - tool
    near = np.abs(offset).max(-1)
    update = (near < VIEW_M / 2 - CELL_M) & (near < seen_from_m)
    pixel = np.rint(offset[update] * [1, -1] / VIEW_M * VIEW_PX + VIEW_PX / 2).astype(int)
    around = [(i, j) for i in (-4, 0, 4) for j in (-4, 0, 4)]
    is_wall[update] = np.min([picture[pixel[:, 1] + i, pixel[:, 0] + j] for i, j in around], axis=0) < DARK
    seen_from_m[update] = near[update]


def plan(start: np.ndarray, goal: np.ndarray) -> list[tuple[int, int]]:
    """The cheapest path over cells that are not known to be walls, with room to them (Dijkstra 1959)."""
    cost, reach = np.ones((SIDE, SIDE)), range(-3, 4)
    for shift in [(i, j) for i in reach for j in reach]:
        cost += np.roll(is_wall, shift, (0, 1)) * (1 if max(map(abs, shift)) > 1 else 100)
    begin, end = (tuple(np.rint((place - CORNER_M) / CELL_M).astype(int)) for place in (start, goal))
    best, came, queue = {begin: 0.0}, {}, [(0.0, begin)]
    while (here := heapq.heappop(queue)[1]) != end:
        for i, j in [(1, 0), (-1, 0), (0, 1), (0, -1), (1, 1), (1, -1), (-1, 1), (-1, -1)]:
            there = (min(max(here[0] + i, 0), SIDE - 1), min(max(here[1] + j, 0), SIDE - 1))
            further = best[here] + cost[there] * np.hypot(i, j)
            if further < best.get(there, np.inf):
                best[there], came[there] = further, here
                heapq.heappush(queue, (further, there))
    path = [end]
    while path[-1] != begin:
        path.append(came[path[-1]])
    return path[::-1]


control, receive = RTDEControlInterface(ROBOT, 125.0), RTDEReceiveInterface(ROBOT, 125.0)
height_and_rotation = receive.getActualTCPPose()[2:]
goal = np.array(list(json.loads(ask("tracker"))["goal"].values()))
for _ in range(300):
    time.sleep(0.3)  # until there is a picture from here
    tool, tracker = np.array(receive.getActualTCPPose()[:2]), json.loads(ask("tracker"))
    bead = np.array([tracker["x_m"], tracker["y_m"]])
    look(tool)
    if np.linalg.norm(bead - goal) < 0.01 and np.linalg.norm(tool - goal) < 0.002:
        print(f"delivered: the bead is {1000 * np.linalg.norm(bead - goal):.0f} mm from the goal")
        break
    if np.linalg.norm(bead - tool) > LOST_M:  # fetch it
        place, speed = bead, 0.15
    else:
        path = plan(tool, goal)
        place = goal if len(path) <= STEP_CELLS else CORNER_M + CELL_M * np.array(path[STEP_CELLS])
        speed = 0.04
    if not control.moveL([*place, *height_and_rotation], speed, 0.5):
        raise SystemExit("the robot has refused a motion")
else:
    raise SystemExit("not delivered")
control.stopScript()
