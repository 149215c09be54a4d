# SPDX-License-Identifier: GPL-3.0-or-later
"""The functions of yade.potential_utils, with their names and arguments, for ConicPotentialParticle.

    from potential_particles import potential_utils

Theirs make PotentialBlocks, which Debian's YADE does not have. As there, faces are where the arguments say, k = 0, r is
a length, half of the least distance of a face from the centre if it is 0 (potentialblock, whose planes are those of the
core, needs r > 0); the frame of a body is at its centroid along principal axes. R has no effect for k = 0. Each returns
a Body, or a list of them, to be appended to O.bodies.
"""
import math
import random as _random

import numpy as np

from .arguments import MOST_PLANES, positive, rows, vector, whole
from .bodies import body
from .polyhedron import Polyhedron, rounded


def potentialblock(material, a=[], b=[], c=[], d=[], r=0.0, R=0.0, mask=1, isBoundary=False, fixed=False,
                   color=[-1, -1, -1]):
    """A body of the planes a x + b y + c z = d of its core: its faces lie at d + r."""
    if not len(a) == len(b) == len(c) == len(d):
        raise ValueError(
            f"a, b, c, d have {len(a)}, {len(b)}, {len(c)} and {len(d)} entries: all must be of one length")
    r = positive(r, "r")
    core = rows(zip(a, b, c, d), 4, "planes", "the four numbers a, b, c, d")
    lengths = np.linalg.norm(core[:, :3], axis=1)
    return _faced(np.column_stack([core[:, :3], core[:, 3] + r * lengths]), r, material, (0, 0, 0), mask, isBoundary,
                  fixed, color, "potential block")


def cuboid(material, edges=(1, 1, 1), r=0.0, R=0.0, center=[0, 0, 0], mask=1, isBoundary=False, fixed=False,
           color=[-1, -1, -1]):
    """A cuboid with these edge lengths about `center`."""
    half = 0.5 * vector(edges, "edges")
    return _faced([(*sign * axis, h) for axis, h in zip(np.eye(3), half) for sign in (1.0, -1.0)],
                  r, material, center, mask, isBoundary, fixed, color, "cuboid")


def aabbPlates(material, extrema=None, thickness=0.0, r=0.0, R=0.0, mask=1, isBoundary=False, fixed=True, color=None):
    """Six plates around the box between two corners (default: that of the bodies in the scene): -x, +x, -y, +y, -z, +z.

    thickness: 0 for a tenth of the least side.
    """
    if not extrema:
        from .measures import extrema as of_scene
        extrema = of_scene()
    low, high = vector(extrema[0], "extrema[0]"), vector(extrema[1], "extrema[1]")
    sides, middle = high - low, 0.5 * (low + high)
    thickness = positive(thickness or 0.1 * sides.min(), "thickness")
    plates = []
    for axis in range(3):
        # Each as wide as the box and the plates beside it.
        edges = sides + 2.0 * thickness
        edges[axis] = thickness
        for sign in (-1.0, 1.0):
            centre = middle.copy()
            centre[axis] += sign * 0.5 * (sides[axis] + thickness)
            plates.append(cuboid(material, edges, r, R, centre, mask, isBoundary, fixed, color or [-1, -1, -1]))
    return plates


def cylindricalPlates(material, radius=0.0, height=0.0, thickness=0.0, numFaces=3, r=0.0, R=0.0, mask=1,
                      isBoundary=False, fixed=True, lid=[True, True], color=None):
    """Plates that form a hollow prism of `numFaces` sides about z, `radius` that of the circle within, heights from
    -height/2 to height/2; and its lids, below and above, for which `lid` says whether to make them. thickness: 0 for a
    tenth of the radius.
    """
    radius, height, sides = positive(radius, "radius"), positive(height,
                                                                 "height"), whole(numFaces, 3, MOST_PLANES - 2,
                                                                                  "numFaces")
    thickness = positive(thickness or 0.1 * radius, "thickness")
    outer, half_angle = radius + thickness, math.pi / sides
    colour = color or [-1, -1, -1]
    # As long as the outer side, so that neighbours close the edges between them.
    edges = (thickness, 2.0 * outer * math.tan(half_angle), height)
    plates = []
    for i in range(sides):
        angle = 2.0 * i * half_angle
        plate = cuboid(material, edges, r, R, (0, 0, 0), mask, isBoundary, fixed, colour)
        _place(plate, (outer - 0.5 * thickness) * np.array([math.cos(angle), math.sin(angle), 0.0]), angle)
        plates.append(plate)
    for wanted, sign in zip(lid, (-1.0, 1.0)):
        if wanted:
            cover = prism(material, outer, outer, thickness, sides, r, R, None, colour, mask, isBoundary, fixed)
            _place(cover, np.array([0.0, 0.0, sign * 0.5 * (height + thickness)]), 0.0)
            plates.append(cover)
    return plates


def prism(material, radius1=0.0, radius2=-1, thickness=0.0, numFaces=3, r=0.0, R=0.0, center=None, color=[1, 0, 0],
          mask=1, isBoundary=False, fixed=False):
    """A regular prism about z: radius1 is that of the circle within the lower end, radius2 (-1: the same) within the
    upper one, 0 for a pyramid; thickness (0: radius1) is its height. `center` is that of its heights.
    """
    radius = positive(radius1, "radius1")
    upper = radius if radius2 == -1 else radius2
    height = positive(thickness or radius, "thickness")
    sharp = Polyhedron.prism(whole(numFaces, 3, MOST_PLANES - 2, "numFaces"), radius, upper, height)
    return _body(sharp, r, material, center or (0, 0, 0), mask, isBoundary, fixed, color, "prism")


def platonic_solid(material, numFaces, edge=0.0, ri=0.0, rm=0.0, rc=0.0, volume=0.0, r=0.0, R=None, center=[0, 0, 0],
                   mask=1, isBoundary=False, fixed=False, color=[-1, -1, -1]):
    """The regular solid of 4, 6, 8, 12 or 20 faces, by one of its edge, inradius, midradius, circumradius or volume."""
    if sum(one > 0.0 for one in (edge, ri, rm, rc, volume)) != 1:
        raise ValueError("give one of edge, ri, rm, rc and volume, and only one, above 0")
    unit = Polyhedron.regular_solid(whole(numFaces, 0, MOST_PLANES, "faces"), 1.0)
    inner, outer = 0.5 * unit.size, np.linalg.norm(unit.corners, axis=1).max()
    middle = math.sqrt(outer**2 - 0.25)
    sharp = Polyhedron.regular_solid(
        numFaces, edge or ri / inner or rm / middle or rc / outer or (volume / unit.volume)**(1.0 / 3.0))
    return _body(sharp, r, material, center, mask, isBoundary, fixed, color, "platonic solid")


def _faced(faces, r, material, center, mask, isBoundary, fixed, color, name):
    """A body whose faces are the planes (a, b, c, h)."""
    faces = np.array(faces, float)
    return _body(Polyhedron.of_planes(faces[:, :3], faces[:, 3]), r, material, center, mask, isBoundary, fixed, color,
                 name)


def _body(sharp, r, material, center, mask, isBoundary, fixed, color, name):
    """A polyhedron with the rounding radius r, a length; 0: half of the least distance of a face from the origin."""
    shape = rounded(sharp, positive(r or 0.5 * float(sharp.offsets.min()), "r"), 0.0, None, name)
    if color is None or color[0] == -1:
        color = [_random.random() for _ in range(3)]
    return body(shape, material, center, fixed=fixed, color=color, mask=mask, isBoundary=isBoundary)


def _place(made, shift, angle):
    """Turns a body about z and then moves it."""
    import yade
    turn = yade.Quaternion(yade.Vector3(0, 0, 1), angle)
    made.state.pos = made.state.refPos = turn * made.state.pos + yade.Vector3(*shift)
    made.state.ori = made.state.refOri = turn * made.state.ori
