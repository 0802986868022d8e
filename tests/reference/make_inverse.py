"""Writes inverse.json: poses of the UR5's flange, and all joint angles that reach them.

    pip install numpy ur-analytic-ik==0.1.0.post3
    python make_inverse.py

Two references:
- `package`: ur-analytic-ik, module `ur5`, the CB3 arm; other code for the same published equations
  (Hawkins 2013). Its DH table, its frames (base to flange, no turn of the flange) and its signs are
  those of the laboratory; its angles lie in [-pi, pi]. It takes sines under 1e-12 for zero and
  1 - c3^2 under 1e-12 too, so it is exact to about 1e-6 rad only next to a singularity, and it leaves
  out, with a warning, what misses the pose by 1e-9 or more.
- `newton`: no closed form, only the DH table. Levenberg-Marquardt from 500 random starts, then Newton
  steps with the residual in extended precision (x86's 80 bits), for the poses near a singularity. It
  lists every solution, nearly coinciding ones (1e-6 rad) once. Next to a free wrist random starts end
  in a long curved valley, so the package's solutions are starts too. A pose with a free wrist has a
  continuum and no such list.

A pose is [x, y, z, qw, qx, qy, qz]: metres and a unit quaternion, base_from_flange. Angles in rad.
"""

import json
from pathlib import Path

import numpy as np
from ur_analytic_ik import ur5

DH = [  # d, a (m), cosine and sine of the twist
    (0.089159, 0.0, 0, 1),
    (0.0, -0.425, 1, 0),
    (0.0, -0.39225, 1, 0),
    (0.10915, 0.0, 0, 1),
    (0.09465, 0.0, 0, -1),
    (0.0823, 0.0, 1, 0),
]
STARTS = 500
SAME_RAD = 1e-6
random = np.random.default_rng(20240607)


def frames(joints):
    """The poses of frames 0 to 6, for joints of shape (n, 6), in the precision of the joints."""
    pose = np.broadcast_to(np.eye(4, dtype=joints.dtype), (len(joints), 4, 4))
    found = [pose]
    for i, (d, a, ca, sa) in enumerate(DH):
        link = np.zeros_like(pose)
        c, s = np.cos(joints[:, i]), np.sin(joints[:, i])
        link[:, 0] = np.stack([c, -s * ca, s * sa, a * c], -1)
        link[:, 1] = np.stack([s, c * ca, -c * sa, a * s], -1)
        link[:, 2] = [0, sa, ca, d]
        link[:, 3, 3] = 1
        pose = pose @ link
        found.append(pose)
    return found


def residual_and_jacobian(joints, target):
    """How the flange must move and turn to come to `target`, and the geometric Jacobian."""
    poses = frames(joints)
    flange = poses[6]
    turn = sum(np.cross(flange[:, :3, k], target[:3, k]) for k in range(3)) / 2
    residual = np.concatenate([target[:3, 3] - flange[:, :3, 3], turn], -1)
    columns = []
    for pose in poses[:6]:
        axis = pose[:, :3, 2]
        columns.append(np.concatenate([np.cross(axis, flange[:, :3, 3] - pose[:, :3, 3]), axis], -1))
    return residual, np.stack(columns, -1).astype(float)


def wrapped(joints):
    return joints - 2 * np.pi * np.round(joints / (2 * np.pi))


def newton(target, known):
    """Every solution of `target`, an extended-precision matrix, from random starts and the `known` solutions."""
    coarse = target.astype(float)
    joints = np.concatenate([random.uniform(-np.pi, np.pi, (STARTS, 6)), np.reshape(known, (-1, 6))])
    damping = np.full(len(joints), 1e-2)
    residual, jacobian = residual_and_jacobian(joints, coarse)
    error = np.abs(coarse - frames(joints)[6]).sum((1, 2))
    for _ in range(120):
        # By singular values: next to a singularity JᵀJ would lose the digits that tell solutions apart.
        left, sizes, right = np.linalg.svd(jacobian)
        along = np.einsum("nji,nj->ni", left, residual) * sizes / (sizes**2 + damping[:, None])
        step = np.einsum("nij,ni->nj", right, along)
        tried = joints + step
        error_tried = np.abs(coarse - frames(tried)[6]).sum((1, 2))
        better = error_tried < error
        joints[better], error[better] = tried[better], error_tried[better]
        damping = np.clip(np.where(better, damping / 5, damping * 4), 1e-30, 1e2)
        residual, jacobian = residual_and_jacobian(joints, coarse)
    joints = joints[error < 1e-12].astype(np.longdouble)
    for _ in range(40):
        residual, jacobian = residual_and_jacobian(joints, target)
        # Where the Jacobian has no inverse, the least step does no harm.
        step = np.linalg.pinv(jacobian, rcond=1e-13) @ residual.astype(float)[:, :, None]
        joints = joints + np.clip(step[:, :, 0], -1e-5, 1e-5)
    error = np.abs(target - frames(joints)[6]).max((1, 2))
    found = []
    for candidate in wrapped(joints[error < 1e-15]):
        if all(np.abs(wrapped(candidate - other)).max() > SAME_RAD for other in found):
            found.append(candidate)
    return np.array(found, dtype=float)


def quaternion(matrix):
    """Unit quaternion of a rotation matrix, from its largest component."""
    m = matrix
    squares = np.array([
        1 + m[0, 0] + m[1, 1] + m[2, 2],
        1 + m[0, 0] - m[1, 1] - m[2, 2],
        1 - m[0, 0] + m[1, 1] - m[2, 2],
        1 - m[0, 0] - m[1, 1] + m[2, 2],
    ])
    rows = [
        [squares[0], m[2, 1] - m[1, 2], m[0, 2] - m[2, 0], m[1, 0] - m[0, 1]],
        [m[2, 1] - m[1, 2], squares[1], m[0, 1] + m[1, 0], m[0, 2] + m[2, 0]],
        [m[0, 2] - m[2, 0], m[0, 1] + m[1, 0], squares[2], m[1, 2] + m[2, 1]],
        [m[1, 0] - m[0, 1], m[0, 2] + m[2, 0], m[1, 2] + m[2, 1], squares[3]],
    ]
    q = np.array(rows[int(np.argmax(squares))])
    return q / np.sqrt((q * q).sum())


def matrix(pose):
    """The extended-precision matrix of a stored pose."""
    x, y, z, *q = np.array(pose, dtype=np.longdouble)
    w, i, j, k = q / np.sqrt(sum(part * part for part in q))
    return np.array([
        [1 - 2 * (j * j + k * k), 2 * (i * j - w * k), 2 * (i * k + w * j), x],
        [2 * (i * j + w * k), 1 - 2 * (i * i + k * k), 2 * (j * k - w * i), y],
        [2 * (i * k - w * j), 2 * (j * k + w * i), 1 - 2 * (i * i + j * j), z],
        [0, 0, 0, 1],
    ], dtype=np.longdouble)


def reached(joints):
    """The stored pose that `joints` reach."""
    flange = frames(np.array([joints], dtype=np.longdouble))[6][0]
    return [float(v) for v in (*flange[:3, 3], *quaternion(flange))]


def tool_down(x, y):
    """The flange straight down at 0.28 m; half a turn about (1, -1, 0)/sqrt 2."""
    half = float(np.sqrt(0.5))
    return [float(x), float(y), 0.28, 0.0, half, -half, 0.0]


def angles():
    return random.uniform(-np.pi, np.pi, 6)


def near(fraction):
    """A random joint away from every singularity but the one that the caller sets."""
    sign = random.choice([-1.0, 1.0])
    return sign * random.uniform(fraction, np.pi - fraction)


def at_shoulder(distance_m):
    """Joints whose wrist axis passes `distance_m` beside the base axis."""
    while True:
        joints = angles()
        joints[4] = near(0.5)
        elbow_m = -0.425 * np.cos(joints[1]) - 0.39225 * np.cos(joints[1] + joints[2])
        sine = (distance_m - elbow_m) / 0.09465
        if abs(np.sin(joints[2])) > 0.5 and abs(sine) < 0.9:
            joints[3] = np.arcsin(sine) - joints[1] - joints[2]
            return joints


def poses():
    for _ in range(250):
        yield "random", reached(angles())
    for x, y in [(-.24, -.27), (.19, -.28), (.21, -.34), (.20, -.47), (-.19, -.48), (-.24, -.28), (.21, -.40)]:
        yield "paper", tool_down(x, y)
    distances = [10.0**-n for n in range(2, 10)]
    for distance in distances + distances + [0.0] * 2:
        joints = angles()
        joints[2], joints[4] = near(0.5), distance * random.choice([-1.0, 1.0])
        yield "wrist" if distance else "free wrist", reached(joints)
        joints = angles()
        joints[2], joints[4] = distance * random.choice([-1.0, 1.0]), near(0.5)
        yield "elbow", reached(joints)
        yield "shoulder", reached(at_shoulder(distance))
    for _ in range(6):
        joints = angles()
        joints[2], joints[4] = near(0.5), 0.0
        yield "free wrist", reached(joints)
    # The tool straight down and theta1 at or near 0 and pi: over y = -d4 and y = d4.
    for distance in distances + [0.0]:
        for x, y in [(-0.4, -0.10915), (0.35, 0.10915)]:
            c, s = np.cos(distance), np.sin(distance)
            yield "first joint", tool_down(c * x - s * y, s * x + c * y)


cases = []
for kind, pose in poses():
    target = matrix(pose)
    solutions = ur5.inverse_kinematics(target.astype(float))
    case = {"kind": kind, "pose": pose, "package": [row.tolist() for row in solutions]}
    if kind not in ("random", "paper", "free wrist"):
        case["newton"] = newton(target, solutions).tolist()
    cases.append(case)
lines = ",\n".join(json.dumps(case, separators=(",", ":")) for case in cases)
Path(__file__).with_name("inverse.json").write_text(f"[\n{lines}\n]\n")
