# SPDX-License-Identifier: MIT OR Apache-2.0
"""Looking closer at one wedge: its path, its contact points, and what locked-in shear does."""

from dataclasses import dataclass

import numpy as np
from yade import O

from friction_reduction import REST, STEP, FrictionReduction
from stepping import advance

SLIDE_BELOW = 3.0  # degrees below the bracket: the friction on which the wedge slides out
SLIDE_OUT = 0.35  # of the size
LOOKS = 140  # on the way
REST_STEPS = 600  # over which contact points are watched at rest
ROUGH = 60.0  # degrees, at which a wedge is set down that is not run in
UNREGULARISED = 1e-13  # the library's default


@dataclass
class Path:
    """A wedge that slides out; one row a look."""

    moved: np.ndarray  # along the line, m
    angle: np.ndarray  # between the way so far and the line, degrees
    points: tuple  # of contact on A and on B, world frame, (n, 3) each
    forces: np.ndarray  # normal forces on A and B over the weight, (n, 2)
    friction_angle: float


def slide_out(scene, result, on_look=None):
    """Lets the wedge slide by SLIDE_OUT, from the rest at which the bracket ended."""
    line, size = scene.blocks.limit.line, scene.case.size
    angle = result.slides_at - SLIDE_BELOW
    scene.set_friction(angle)
    start, rows = scene.position(), []
    spacing = SLIDE_OUT * size / LOOKS
    while not rows or rows[-1][0] < SLIDE_OUT * size:
        advance(O.iter + 20)
        way = scene.position() - start
        if way @ line < spacing * (len(rows) + 1):
            continue
        joints = scene.joints()
        off = np.degrees(np.arctan2(np.linalg.norm(np.cross(way, line)), way @ line))
        rows.append((way @ line, off, *(j.point for j in joints), [j.normal_force for j in joints]))
        if on_look:
            on_look(rows[-1][0] / (SLIDE_OUT * size))
    moved, off, on_a, on_b, forces = (np.array(column) for column in zip(*rows))
    return Path(moved, off, (on_a, on_b), forces / scene.weight, angle)


def points_at_rest(scene, regularisation):
    """Contact points on A and B, (REST_STEPS, 3) each, and mean net force over the weight, of a rest.

    `regularisation` is used from here on; the scene begins at the saved rest.
    """
    scene.restore(REST)
    scene.functor.flatRegularisation = regularisation
    points, unbalanced = [], []
    for _ in range(REST_STEPS):
        advance(O.iter + 1)
        points.append([joint.point for joint in scene.joints()])
        unbalanced.append(scene.out_of_balance())
    on_a, on_b = np.array(points).transpose(1, 0, 2)
    return on_a, on_b, float(np.mean(unbalanced))


def not_run_in(scene, look=None):
    """The bracket of a wedge that was set down with friction and never moved before it slid for good.

    The springs then hold shear across the line from setting down and from every tilt since.
    """
    reduction = FrictionReduction(scene, look=look, highest=ROUGH)
    reduction.drop()
    reduction.begin()
    slid = reduction.lower()
    scene.restore(REST)
    return reduction.halve(slid.friction_angle + STEP, slid)
