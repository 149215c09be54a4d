# SPDX-License-Identifier: GPL-3.0-or-later
"""Shapes of particles from what a script has: planes, points, a file, or the name of a solid.

    from potential_particles import body, shapes
    O.bodies.append(body(shapes.cuboid((1, 1, 0.5)), material, position=(0, 0, 2)))

Every function returns a Shape. `r` and `R` are fractions of the *size* of the sharp shape, the diameter of the largest ball
that fits in it; `k` is the sphericity itself. What they do: docs/shapes.md. In short:

    r    0 < r < 0.5. How far edges and corners are rounded. Faces stay where they are (rounding.py says where exactly).
    k    0 <= k <= 1. 0: flat faces; 1: a sphere of radius R; between, faces bulge by about r k/2.
    R    radius of the shadow sphere, by default the distance from the centroid to the farthest corner.

Bad input is a ValueError of one sentence, and nothing is made.
"""
import math

import numpy as np
from scipy.spatial import ConvexHull

from . import fitting, rounding
from .arguments import positive, rows, vector, whole, within
from .convex_parts import clump_from_mesh
from .mesh_file import from_mesh
from .polyhedron import Polyhedron, refuse_flat
from .random_rock import random_rock
from .rounding import ROUNDING, SPHERICITY
from .solids import rounded_hull, sizes
from .shape import Fit, Shape
from .voxels import from_voxels, voxel_image

__all__ = ["Fit", "Shape", "clump_from_mesh", "cuboid", "cylinder", "from_mesh", "from_planes", "from_vertices", "from_voxels", "platonic_solid",
           "prism", "random_rock", "sphere", "voxel_image"]


def from_planes(planes, r=ROUNDING, k=SPHERICITY, R=None, name="planes"):
    """Of half-spaces: rows (a, b, c, h), a x + b y + c z <= h inside, (a, b, c) of any length. Faces are where these planes are.

    That is, the offsets of the particle are reduced so that its surface, not its core, reaches h. Planes that make no face are left
    out. Planes that enclose no volume are refused for every k: with k > 0 the sphere of radius R/sqrt(k) alone would end the shape.
    """
    given = rows(planes, 4, "planes", "the four numbers a, b, c, h")
    if len(given) == 0:
        raise ValueError("planes is empty: give at least four, or use sphere(radius)")
    polyhedron = Polyhedron.of_planes(given[:, :3], given[:, 3])
    return rounding.rounded(polyhedron, *sizes(polyhedron.ball_radius, r, k, R), name)


def from_vertices(points, r=None, k=SPHERICITY, R=None, name="vertices", planes=None, error=None):
    """Of the convex hull of points (x, y, z), rounded inwards: no part lies outside the hull.

    planes=N, error=e: few planes that keep the volume of the hull, as from_mesh has them; r=None is chosen then, and the default without them.
    """
    points = rows(points, 3, "points", "the three numbers x, y, z")
    if planes is None and error is None:
        return rounded_hull(points, ROUNDING if r is None else r, k, R, name)
    refuse_flat(points)
    hull = ConvexHull(points - points.mean(0))
    samples = np.concatenate([points[hull.vertices], points[hull.simplices].mean(1)])
    return fitting.warn_of_volume(fitting.of_surface(points, samples, hull.volume, r, k, R, name, planes, error), name)


def sphere(radius, name="sphere"):
    """A sphere about the origin: k = 1."""
    return rounding.ball(positive(radius, "radius"), name)


def cuboid(edges=(1.0, 1.0, 1.0), r=ROUNDING, k=SPHERICITY, R=None, name="cuboid"):
    """A cuboid about the origin with these edge lengths along x, y, z."""
    half = 0.5 * vector(edges, "edges")
    if not np.all(half > 0.0):
        raise ValueError(f"edges={tuple(2.0 * half)} must all be above 0")
    return from_planes([(*sign * axis, h) for axis, h in zip(np.eye(3), half) for sign in (1.0, -1.0)], r, k, R, name)


def prism(sides=6, radius=0.5, height=1.0, top_radius=None, r=ROUNDING, k=SPHERICITY, R=None, name="prism"):
    """A regular prism along z, its heights from -height/2 to height/2; `radius` is that of the circle within its section.

    With `top_radius`, that at the upper end, a frustum; 0 makes a pyramid. The first side faces x.
    """
    sides, radius, height = whole(sides, 3, "sides"), positive(radius, "radius"), positive(height, "height")
    top = radius if top_radius is None else within(top_radius, 0.0, math.inf, "top_radius")
    angles = 2.0 * np.pi * np.arange(sides) / sides
    planes = [(math.cos(angle), math.sin(angle), (radius - top) / height, 0.5 * (radius + top)) for angle in angles]
    return from_planes(planes + [(0, 0, 1, 0.5 * height), (0, 0, -1, 0.5 * height)], r, k, R, name)


def cylinder(radius=0.5, height=1.0, sides=32, r=ROUNDING, k=SPHERICITY, R=None, name="cylinder"):
    """A cylinder along z as a prism of as many sides, whose section has the area pi radius^2."""
    sides, radius = whole(sides, 3, "sides"), positive(radius, "radius")
    inner = radius * math.sqrt(math.pi / (sides * math.tan(math.pi / sides)))
    return prism(sides, inner, height, None, r, k, R, name)


_GOLDEN = 0.5 * (1.0 + math.sqrt(5.0))


def _cyclic(triples):
    """Each triple in its three cyclic orders."""
    return [(t[i], t[(i + 1) % 3], t[(i + 2) % 3]) for t in triples for i in range(3)]


_CUBE = [(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]
# Corners by the number of faces, and the edge length that they have.
_PLATONIC = {
    4: ([p for p in _CUBE if p[0] * p[1] * p[2] == 1], 2.0 * math.sqrt(2.0)),
    6: (_CUBE, 2.0),
    8: (_cyclic([(s, 0, 0) for s in (-1, 1)]), math.sqrt(2.0)),
    12: (_CUBE + _cyclic([(0, x / _GOLDEN, y * _GOLDEN) for x in (-1, 1) for y in (-1, 1)]), 2.0 / _GOLDEN),
    20: (_cyclic([(0, x, y * _GOLDEN) for x in (-1, 1) for y in (-1, 1)]), 2.0),
}


def platonic_solid(faces, edge=1.0, r=ROUNDING, k=SPHERICITY, R=None, name=None):
    """The regular solid of 4, 6, 8, 12 or 20 faces with this edge length, about the origin."""
    points, length = regular_solid(faces)
    return from_vertices(positive(edge, "edge") / length * points, r, k, R, name or f"platonic solid of {faces} faces")


def regular_solid(faces):
    """Corners (n, 3) of the regular solid of so many faces, about the origin, and the length of its edges."""
    if faces not in _PLATONIC:
        raise ValueError(f"faces={faces!r}: regular solids have 4, 6, 8, 12 or 20")
    points, length = _PLATONIC[faces]
    return np.array(points, float), length

