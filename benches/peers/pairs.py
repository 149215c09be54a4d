# SPDX-License-Identifier: MIT OR Apache-2.0
"""The pairs that all contestants get: one text file of numbers, and the exact answers of those who measure distance or
depth.

Of each group: planes, corners and triangles of its body, and for each pair some poses of a smooth motion, as from step
to step of a simulation. Bodies have size about 1.
"""

from dataclasses import dataclass, field, replace

import numpy as np
from scipy.optimize import linprog
from scipy.spatial.transform import Rotation

from polyhedron import Polyhedron, distance, named, penetration

OVERLAP = 5e-4  # of the size, as in a calm pile
NEAR = 0.02  # distance of pairs that boxes do not separate
STEP = 5e-5  # move and turn from one pose to the next
POSES = 6
TILT = 1e-4  # radians, of faces that lie on each other
SHARP, ROUNDED, POTENTIAL = "sharp", "rounded", "potential"
# How the same body is written down: r of our potential particle, its k, and the radius of the ball that is swept by the
# others.
ROUNDING = {SHARP: (1e-3, 0.0, 0.0), ROUNDED: (0.05, 0.0, 0.05), POTENTIAL: (0.05, 0.02, 0.05)}
TOUCHING, LYING, NEAR_BY, FAR = "touching", "lying", "near", "far"


@dataclass
class Group:
    planes: int
    edges: str  # SHARP, ROUNDED, POTENTIAL
    place: str
    core: Polyhedron  # what the others sweep with a ball of `swept`
    normals: np.ndarray
    offsets: np.ndarray  # of our potential particle, before r is added
    r: float
    k: float
    shadow: float
    swept: float
    poses_a: list = field(default_factory=list)  # position, quaternion w x y z
    poses_b: list = field(default_factory=list)  # of each pair, of each time

    @property
    def name(self):
        return f"{self.planes}-{self.edges}-{self.place}"


def group(planes, edges, place, pairs, seed):
    r, k, swept = ROUNDING[edges]
    finished = named(planes)
    core = finished if swept == 0 else Polyhedron(finished.normals, finished.offsets - swept)
    shadow = 1.1 * finished.radius()
    made = Group(planes, edges, place, core, finished.normals, finished.offsets - r, r, k, shadow, swept)
    random = np.random.default_rng([seed, planes, len(edges), len(place)])
    while len(made.poses_a) < pairs:
        pose_a, first = _first_poses(finished, core, swept, place, random)
        made.poses_a.append(pose_a)
        made.poses_b.append(_motion(first, random))
    return made


def _first_poses(finished, core, swept, place, random):
    turn_a = Rotation.random(random_state=random.integers(2**31))
    if place == LYING:
        return _lying(finished, turn_a, random)
    turn_b = Rotation.random(random_state=random.integers(2**31))
    start = random.uniform(-2, 2, 3)
    way = _direction(random)
    if place == FAR:
        return (start, turn_a), (start + 3.0 * finished.radius() * way, turn_b)
    a = core.placed(np.zeros(3), turn_a.as_matrix())
    b = core.placed(np.zeros(3), turn_b.as_matrix())
    reach, normal = _touch(a, b, way)
    apart = 2 * swept + (NEAR if place == NEAR_BY else -OVERLAP)
    return (start, turn_a), (start + reach * way + apart * normal, turn_b)


def _touch(a, b, way):
    """How far b goes along `way` before it only touches a, and the normal there: a linear program in x and the
    distance.
    """
    rows = np.block([[a.normals, np.zeros((len(a.normals), 1))], [b.normals, -(b.normals @ way)[:, None]]])
    found = linprog([0, 0, 0, -1], A_ub=rows, b_ub=np.concatenate([a.offsets, b.offsets]), bounds=[(None, None)] * 4,
                    method="highs")
    pull = -found.ineqlin.marginals[: len(a.normals)] @ a.normals
    return found.x[3], pull / np.linalg.norm(pull)


def _lying(finished, turn_a, random):
    """B on A, face to face but for a slight tilt, shifted at random: at rest most contacts are like that."""
    normal = finished.normals[random.integers(len(finished.normals))]
    below = finished.normals[random.integers(len(finished.normals))]
    tilt = Rotation.from_rotvec(TILT * _direction(random))
    turn_b = tilt * Rotation.from_rotvec(random.uniform(0, 2 * np.pi) * normal) * _turn(below, -normal)
    a, b = finished, finished.placed(np.zeros(3), turn_b.as_matrix())
    across = _direction(random)
    across -= (across @ normal) * normal
    height = a.offsets[np.argmax(a.normals @ normal)] - (b.corners @ normal).min()
    shift = (height - OVERLAP) * normal + random.uniform(0, 0.2) * across / np.linalg.norm(across)
    start = random.uniform(-2, 2, 3)
    return (start, turn_a), (start + turn_a.apply(shift), turn_a * turn_b)


def _motion(first, random):
    """Poses STEP apart, all in one direction and about one axis."""
    position, turn = first
    way, axis = _direction(random), _direction(random)
    return [(position + STEP * i * way, Rotation.from_rotvec(STEP * i * axis) * turn) for i in range(POSES)]


def _direction(random):
    vector = random.normal(size=3)
    return vector / np.linalg.norm(vector)


def moved(one, shifts):
    """The same group with B elsewhere: for bodies that are rounded otherwise, and so touch at other poses. shifts:
    (pairs, 3).
    """
    poses_b = [[(position + shift, turn) for position, turn in motion] for motion, shift in zip(one.poses_b, shifts)]
    return replace(one, poses_b=poses_b)


def shifts_of(one, placed):
    """From what rust/src/bin/placed.rs found: to overlap by OVERLAP, or to be NEAR apart; those far away stay."""
    placed = np.array(placed)
    if one.place == FAR:
        return np.zeros((len(placed), 3))
    return placed[:, :3] + (OVERLAP + NEAR if one.place == NEAR_BY else 0.0) * placed[:, 3:]


def write(groups, path):
    """The file that the drivers read: white space between, every number to the last digit."""
    with open(path, "w") as file:
        line = lambda *values: print(*(value if isinstance(value, str) else repr(value) for value in values), file=file)
        line(len(groups))
        for one in groups:
            line(one.name, one.r, one.k, one.shadow, one.swept)
            line(len(one.normals), len(one.core.corners), len(one.core.triangles), len(one.poses_a), POSES)
            for normal, offset in zip(one.normals.tolist(), one.offsets.tolist()):
                line(*normal, offset)
            for corner in one.core.corners.tolist():
                line(*corner)
            for triangle in one.core.triangles.tolist():
                line(*triangle)
            for pose_a, poses_b in zip(one.poses_a, one.poses_b):
                for pose in (pose_a, *poses_b):
                    line(*_numbers(pose))


def _numbers(pose):
    x, y, z, w = pose[1].as_quat().tolist()
    return [*pose[0].tolist(), w, x, y, z]


def cores(one, pair):
    """Those of A and B at the last pose, from the centre of A."""
    (position_a, turn_a), (position_b, turn_b) = one.poses_a[pair], one.poses_b[pair][-1]
    return one.core.placed(np.zeros(3), turn_a.as_matrix()), one.core.placed(position_b - position_a,
                                                                             turn_b.as_matrix())


def exact(one, pair):
    """At the last pose: what is to be found by those who measure distance and depth of the swept cores; > 0: overlap.
    """
    a, b = cores(one, pair)
    if one.place != FAR and one.swept == 0 and one.place in (TOUCHING, LYING):
        return penetration(a, b)[0]
    return 2 * one.swept - distance(a, b)[0]


def _turn(start, end):
    """A rotation that takes one unit vector to another."""
    axis = np.cross(start, end)
    sine, cosine = np.linalg.norm(axis), start @ end
    if sine < 1e-12:
        axis = np.cross(start, np.eye(3)[np.argmin(np.abs(start))])
    return Rotation.from_rotvec(np.arctan2(sine, cosine) * axis / np.linalg.norm(axis))
