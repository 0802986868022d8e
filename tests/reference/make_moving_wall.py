"""Writes moving_wall.json: a ball that a moving wall pushes and throws, in MuJoCo.

    pip install numpy mujoco==4.0.0
    python make_moving_wall.py

The ball has the bead's mass and radius and slides in the plane without gravity, drag or rotation. The wall is a face at
x = closing(t) = A/2 (1 - cos(2 pi t / T)), with the ball on the side of larger x; it is far heavier than the ball. A
second face stands at x = `far_m`. MuJoCo's contact is a spring and a damper that only push. Their damping ratio z gives
the restitution e by -ln e = z / sqrt(1 - z^2) (pi - 2 asin z) (Schwager & Poeschel 2007, "Coefficient of restitution and
linear-dashpot model revisited"): .3 in half a millisecond. The friction coefficient is .1, with an elliptic cone. The
time step is 5 microseconds, so that a contact takes about a hundred steps.

A case is the motion, the ball's start and velocity, and its centre and velocity at some times. SI units.
"""

import json
import math
from pathlib import Path

import mujoco
import numpy as np

RADIUS_M, MASS_KG = 0.0025, 0.491e-3
RESTITUTION, FRICTION = 0.3, 0.1
CONTACT_S, STEP_S = 5e-4, 5e-6
TIMES_S = [0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.8, 1.0]
random = np.random.default_rng(20261127)


def damping_ratio() -> float:
    low, high = 0.0, 0.7
    for _ in range(60):
        z = (low + high) / 2
        lost = z / math.sqrt(1 - z * z) * (math.pi - 2 * math.asin(z))
        low, high = (z, high) if lost < -math.log(RESTITUTION) else (low, z)
    return low


def model(far_m: float) -> mujoco.MjModel:
    damping = damping_ratio()
    rate = math.pi / CONTACT_S / math.sqrt(1 - damping**2)
    contact = f'solref="{-(rate**2)} {-2 * damping * rate}" solimp=".9999 .9999 .001" friction="{FRICTION} 0 0" condim="3"'
    thick = 0.01
    return mujoco.MjModel.from_xml_string(f"""<mujoco><option timestep="{STEP_S}" gravity="0 0 0" cone="elliptic"
      integrator="implicitfast" impratio="10"/><worldbody>
      <body name="wall"><joint name="wall" type="slide" axis="1 0 0"/>
        <geom type="box" size="{thick} 5 .1" pos="{-thick} 0 0" mass="1e4" {contact}/></body>
      <geom type="box" size="{thick} 5 .1" pos="{far_m + thick} 0 0" {contact}/>
      <body name="ball"><joint type="slide" axis="1 0 0"/><joint type="slide" axis="0 1 0"/>
        <geom type="sphere" size="{RADIUS_M}" mass="{MASS_KG}" {contact}/></body></worldbody></mujoco>""")


def run(amplitude_m, period_s, far_m, start_m, velocity_m_s):
    m = model(far_m)
    data = mujoco.MjData(m)
    data.qpos[1:], data.qvel[1:] = start_m, velocity_m_s
    seen = []
    for step in range(round(max(TIMES_S) / STEP_S)):
        phase = 2 * math.pi * step * STEP_S / period_s
        data.qpos[0] = amplitude_m / 2 * (1 - math.cos(phase))
        data.qvel[0] = amplitude_m / 2 * math.sin(phase) * 2 * math.pi / period_s
        mujoco.mj_step(m, data)
        if any(abs((step + 1) * STEP_S - time_s) < STEP_S / 2 for time_s in TIMES_S):
            seen.append([*data.qpos[1:], *data.qvel[1:]])
    return seen


cases = []
for number in range(12):
    amplitude_m, period_s = random.uniform(0.006, 0.02), random.uniform(1.0, 1.6)
    far_m = 0.2 if number < 6 else random.uniform(0.03, 0.06)
    start_m = [RADIUS_M + random.uniform(1e-4, 0.01), 0.0]
    velocity_m_s = [0.0, 0.0] if number % 3 == 0 else [random.uniform(-0.3, 0.1), random.uniform(-0.1, 0.1)]
    cases.append({
        "amplitude_m": amplitude_m, "period_s": period_s, "far_m": far_m, "start_m": start_m,
        "velocity_m_s": velocity_m_s, "seen": run(amplitude_m, period_s, far_m, start_m, velocity_m_s),
    })
Path(__file__).with_name("moving_wall.json").write_text(json.dumps({"times_s": TIMES_S, "cases": cases}, indent=1))
