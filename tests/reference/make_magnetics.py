"""Writes magnetics.json: fields of magnetised cuboids, and forces on a dipole aligned with them.

    pip install numpy magpylib==6.1.0
    python make_magnetics.py

The reference is magpylib: `Cuboid.getB` for the field, in closed form, and `getFT` for the force, by
central differences of that field over 1e-5 of the cuboid's longest side. SI units: metres, tesla,
A m^2, newtons. The cuboid's centre is the origin and its sides lie along the axes; `size` is the whole
side, `polarization` J = mu0 M in tesla, `point` where the field is taken and the dipole stands.

The dipole's moment has the direction of the field at its point, as that of a bead that is free to turn,
and the bead's size. `getFT` holds it fixed: the force m (grad B)^T b is then m grad |B|.
"""

import json
from pathlib import Path

import magpylib
import numpy as np

FIELD_CASES = 300
FORCE_CASES = 60
TURNED_CASES = 40
MOMENT_A_M2 = 0.0677
random = np.random.default_rng(20240608)


def beyond(half):
    """A coordinate outside the side's extent, a micrometre to some sides away."""
    return random.choice([-1.0, 1.0]) * half * (1 + 10 ** random.uniform(-4, 1))


def within(half):
    return random.uniform(-0.999, 0.999) * half


def place(kind, half):
    """A point of a kind about a cuboid of half sides `half`."""
    along, aside, other = random.permutation(3)
    corner = half * random.choice([-1.0, 1.0], 3)
    point = np.array([within(h) for h in half])
    if kind == "near":
        point[along] = corner[along] * (1 + 10 ** random.uniform(-4, 0))
    elif kind == "far":
        direction = random.normal(size=3)
        distance = np.linalg.norm(half) * 10 ** random.uniform(0.2, 1.5)
        point = direction / np.linalg.norm(direction) * distance
    elif kind == "face":
        point[along] = corner[along]
    elif kind == "face plane":
        point[along] = corner[along]
        point[aside] = beyond(half[aside])
    elif kind in ("edge line", "beside edge line"):
        point = corner.copy()
        point[along] = beyond(half[along])
        if kind == "beside edge line":
            point[[aside, other]] += random.normal(size=2) * half.min() * 10 ** random.uniform(-9, -2)
    elif kind == "corner line":
        point = corner * (1 + 10 ** random.uniform(-4, 1))
    return point


def case(kind):
    size = random.uniform(1e-3, 50e-3, 3)
    polarization = random.normal(size=3)
    polarization *= random.uniform(0.1, 1.5) / np.linalg.norm(polarization)
    point = place(kind, size / 2)
    if kind == "face":
        # The field along a face jumps there, unless the polarisation is normal to it.
        polarization = np.where(np.abs(point) == size / 2, polarization, 0.0)
    magnet = magpylib.magnet.Cuboid(dimension=size, polarization=polarization)
    field = magnet.getB(point)
    found = {
        "kind": kind,
        "size": size.tolist(),
        "polarization": polarization.tolist(),
        "point": point.tolist(),
        "field": field.tolist(),
    }
    return magnet, found


def force_case():
    magnet, found = case(random.choice(["near", "far"]))
    size, field = np.array(found["size"]), np.array(found["field"])
    point = np.array(found["point"])
    # So near to the magnet that differences feel its edges: take another.
    if (np.abs(point) - size / 2).max() < 2e-3:
        return force_case()
    moment = MOMENT_A_M2 * field / np.linalg.norm(field)
    dipole = magpylib.misc.Dipole(position=point, moment=moment)
    force, _ = magpylib.getFT(magnet, dipole, eps=1e-5 * size.max())
    del found["kind"]
    return found | {"moment": MOMENT_A_M2, "force": force.tolist()}


def turned_case():
    """A cuboid with its centre at `position`, turned about z."""
    kind = random.choice(["near", "far", "inside", "corner line"])
    magnet, found = case(kind)
    turn = random.uniform(-np.pi, np.pi)
    position = random.uniform(-0.4, 0.4, 3)
    magnet.rotate_from_rotvec([0.0, 0.0, turn], degrees=False)
    point = magnet.orientation.apply(found["point"]) + position
    magnet.position = position
    found |= {"position": position.tolist(), "turn": turn, "point": point.tolist()}
    return found | {"field": magnet.getB(point).tolist()}


kinds = ["near", "far", "face", "face plane", "edge line", "beside edge line", "corner line", "inside"]
fields = [case(kinds[i % len(kinds)])[1] for i in range(FIELD_CASES)]
forces = [force_case() for _ in range(FORCE_CASES)]
turned = [turned_case() for _ in range(TURNED_CASES)]


def lines(cases):
    return ",\n".join(json.dumps(case, separators=(",", ":")) for case in cases)


text = f'{{"fields":[\n{lines(fields)}\n],"forces":[\n{lines(forces)}\n],"turned":[\n{lines(turned)}\n]}}\n'
Path(__file__).with_name("magnetics.json").write_text(text)
