"""A rule written by hand: toward the goal, and along walls.

    python rule.py http://127.0.0.1:8080

It looks 2 cm ahead in 32 directions, and takes the free one that turns least from the way to the goal. Once it
follows a wall, it keeps to the side on which it began, until the way to the goal is free and shorter than where it
began.
"""

import sys

import numpy as np

import ferry

DIRECTIONS = 32
AHEAD_M = np.linspace(0.004, 0.022, 8)
ASIDE_M = (-0.006, 0.0, 0.006)


class Rule(ferry.Controller):
    def __init__(self) -> None:
        self.side = 0
        self.begun_m = 0.0

    def start(self, leg: ferry.Leg) -> None:
        self.side = 0

    def act(self, percept: ferry.Percept) -> ferry.Step | None:
        to_goal = percept.goal_m - percept.tool_m
        left_m = float(np.linalg.norm(to_goal))
        heading = float(np.arctan2(to_goal[1], to_goal[0]))
        if is_free(percept, heading) and (self.side == 0 or left_m < self.begun_m - 0.01):
            self.side = 0
            return step(percept, heading)
        if self.side == 0:
            self.begun_m = left_m
        for turn in np.arange(1, DIRECTIONS) * 2 * np.pi / DIRECTIONS:
            for side in (self.side,) if self.side else (1, -1):
                if is_free(percept, heading + side * turn):
                    self.side = side
                    return step(percept, heading + side * turn)
        return None


def is_free(percept: ferry.Percept, angle: float) -> bool:
    along = np.array([np.cos(angle), np.sin(angle)])
    across = np.array([-along[1], along[0]])
    places = (percept.tool_m + ahead * along + aside * across for ahead in AHEAD_M for aside in ASIDE_M)
    return not any(percept.is_dark(place) for place in places)


def step(percept: ferry.Percept, angle: float) -> ferry.Step:
    x, y = percept.tool_m + 0.01 * np.array([np.cos(angle), np.sin(angle)])
    return ferry.Step((float(x), float(y)))


if __name__ == "__main__":
    ferry.serve(Rule(), *sys.argv[1:], name="rule")
