# SPDX-License-Identifier: MIT OR Apache-2.0
"""Shapes of particles from what a script has: planes, points, a file, or the name of a solid.

    from potential_particles import shapes
    brick = shapes.cuboid((1, 1, 0.5))
    brick.particle                                                            # for detect() and its like
    O.bodies.append(body(brick, material, position=(0, 0, 2)))                # in YADE

Every function returns a Shape. What `rounding`, `k`, `r` and `R` do: docs/shapes.md. In short:

    rounding  0 to 0.5. How far edges and corners are rounded: r as a share of the *size* of the sharp shape, the
              diameter of the largest ball that fits in it; by default 0.05.
    r         the same as a length, in its place. Faces stay where they are, however many share a rounding.
    k         0 <= k < 1. 0: flat faces; towards 1: a sphere of radius R; between, faces bulge by about r k/2.
    R         radius of the shadow sphere, a length; by default the distance from the centroid to the farthest corner.

Bad input is a ValueError of one sentence, and nothing is made.
"""
import math

import numpy as np

from . import fitting
from .arguments import LARGE, MOST_PLANES, bearable, positive, rows, vector, whole, within
from .mesh_file import from_mesh
from .polyhedron import Polyhedron, round_shape, rounded
from .random_rock import random_rock
from .rounding import SPHERICITY, Rounding
from .shape import Fit, Shape
from .voxels import from_voxels, voxel_image

__all__ = [
    "Fit", "Shape", "capsule", "cone", "cuboid", "cylinder", "ellipsoid", "from_mesh", "from_planes",
    "from_surface", "from_vertices", "from_voxels", "platonic_solid", "prism", "random_rock", "sphere", "superquadric",
    "voxel_image"
]


def from_planes(planes, rounding=None, k=SPHERICITY, R=None, name="planes", *, r=None):
    """Of half-spaces: rows (a, b, c, h), a x + b y + c z <= h inside, (a, b, c) of any length. Faces are where these
    planes are.

    That is, the offsets of the particle are reduced so that its surface, not its core, reaches h. Planes that make no
    face are left out. Planes that enclose no volume are refused for every k: with k > 0 the sphere of radius R/sqrt(k)
    alone would end the shape.
    """
    given = rows(planes, 4, "planes", "the four numbers a, b, c, h")
    if len(given) == 0:
        raise ValueError("planes is empty: give at least four, or use sphere(radius)")
    return _rounded(Polyhedron.of_planes(given[:, :3], given[:, 3]), Rounding(rounding, k, r, R), name)


def from_surface(points, triangles, rounding=None, k=SPHERICITY, R=None, name="surface", known=0.0, *, r=None):
    """Of a closed convex surface, points (n, 3) and triangles (m, 3), numbers of points, whose faces are those of the
    shape. known: as of from_vertices. A surface that is open, not convex or crosses itself is a ValueError that says
    where.
    """
    points = bearable(rows(points, 3, "points", "the three numbers x, y, z"), "points")
    return _rounded(Polyhedron.of_surface(points, triangles, _known(known)), Rounding(rounding, k, r, R), name)


def from_vertices(points, rounding=None, k=SPHERICITY, R=None, name="vertices", planes=None, error=None, known=0.0, *,
                  r=None):
    """Of the convex hull of points (x, y, z), rounded inwards: no part lies outside the hull.

    known: the length to which the points are known, where that is less than all their digits: triangles of the hull
    within it of the plane of a larger one are one face with it.

    planes=N, error=e: few planes that keep the volume of the hull, as from_mesh has them; r is chosen then, if neither
    it nor rounding is given.
    """
    points = bearable(rows(points, 3, "points", "the three numbers x, y, z"), "points")
    if planes is None and error is None:
        return _rounded(Polyhedron.of_points(points, _known(known)), Rounding(rounding, k, r, R), name)
    hull = Polyhedron.of_points(points, _known(known))
    samples = np.concatenate([hull.corners, hull.corners[hull.triangles].mean(1)])
    return fitting.warn_of_volume(
        fitting.of_surface(hull, samples, hull.volume, Rounding(rounding, k, r, R), name, planes, error), name)


def sphere(radius, name="sphere"):
    """A sphere about the origin: k = 1."""
    R = positive(radius, "radius")
    volume = 4.0 / 3.0 * math.pi * R**3
    return Shape(planes=(), r=0.0, k=1.0, R=R, volume=volume, inertia=(0.4 * volume * R**2, ) * 3, error=0.0, sharp_volume=volume,
                 centroid=(0.0, 0.0, 0.0), orientation=(1.0, 0.0, 0.0, 0.0), bounding_radius=R, name=name)


def cuboid(edges=(1.0, 1.0, 1.0), rounding=None, k=SPHERICITY, R=None, name="cuboid", *, r=None):
    """A cuboid about the origin with these edge lengths along x, y, z."""
    half = [0.5 * positive(edge, "edges") for edge in vector(edges, "edges")]
    return from_planes([(*sign * axis, h) for axis, h in zip(np.eye(3), half) for sign in (1.0, -1.0)], rounding, k, R,
                       name, r=r)


def prism(sides=6, radius=0.5, height=1.0, top_radius=None, rounding=None, k=SPHERICITY, R=None, name="prism", *,
          r=None):
    """A regular prism along z, its heights from -height/2 to height/2; `radius` is that of the circle within its
    section.

    With `top_radius`, that at the upper end, a frustum; 0 makes a pyramid. The first side faces x.
    """
    sides, radius, height = whole(sides, 3, MOST_PLANES - 2, "sides"), positive(radius,
                                                                                "radius"), positive(height, "height")
    top = radius if top_radius is None else within(top_radius, 0.0, math.inf, "top_radius")
    return _rounded(Polyhedron.prism(sides, radius, top, height), Rounding(rounding, k, r, R), name)


def cylinder(radius=0.5, height=1.0, sides=48, rounding=None, k=SPHERICITY, R=None, name="cylinder", *, r=None):
    """A cylinder along z as a prism of as many sides, whose section, rounded as it is, has the area pi radius^2."""
    radius, height = _lengths(radius, height)
    return _round("cylinder", (radius, height), sides, min(2.0 * radius, height), Rounding(rounding, k, r, R), name)


def cone(radius=0.5, height=1.0, sides=48, rounding=None, k=SPHERICITY, R=None, name="cone", *, r=None):
    """A cone along z from -height/2 to its tip at height/2, as a pyramid of as many sides whose base has the area pi
    radius^2.

    Without rounding and r, r is so small that base and height lose no more than 0.1 % of them.
    """
    radius, height = _lengths(radius, height)
    size = 2.0 * radius * height / (radius + math.hypot(radius, height))
    return _round("cone", (radius, height), sides, size, Rounding(rounding, k, r, R), name)


def ellipsoid(axes=(1.0, 0.8, 0.6), name="ellipsoid"):
    """An ellipsoid about the origin with these semi-axes along x, y, z: exact, of 6 planes through its centre."""
    return round_shape("ellipsoid", [positive(axis, "axes") for axis in vector(axes, "axes")], name)


def capsule(radius=0.5, length=1.0, name="capsule"):
    """All points within `radius` of a segment of this length along z, about the origin: exact, of 6 planes."""
    return round_shape("capsule", (positive(radius, "radius"), positive(length, "length")), name)


def superquadric(axes, exponents, planes=48, rounding=None, k=SPHERICITY, R=None, name="superquadric", *, r=None):
    """A superquadric about the origin, (|x/a|^(2/e) + |y/b|^(2/e))^(e/n) + |z/c|^(2/n) <= 1, with its volume.

    axes: a, b, c; exponents: n, e from 0.1, nearly a box, over 1, an ellipsoid, to 2, an octahedron; planes: at most so
    many. Without rounding and r, r is what comes nearest.
    """
    axes = [positive(axis, "axes") for axis in vector(axes, "axes")]
    n, e = (within(one, 0.1, 2.0, "exponents") for one in exponents)
    return _round("superquadric", (*axes, n, e), planes, 2.0 * min(axes), Rounding(rounding, k, r, R), name)


def platonic_solid(faces, edge=1.0, rounding=None, k=SPHERICITY, R=None, name=None, *, r=None):
    """The regular solid of 4, 6, 8, 12 or 20 faces with this edge length, about the origin."""
    solid = Polyhedron.regular_solid(whole(faces, 0, LARGE, "faces"), positive(edge, "edge"))
    return _rounded(solid, Rounding(rounding, k, r, R), name or f"platonic solid of {faces} faces")


def _rounded(polyhedron, rounding, name):
    return rounding.told_of(rounded(polyhedron, *rounding.lengths(polyhedron.size), name))


def _round(form, sizes, planes, size, rounding, name):
    """`size`: that of the sharp shape, of which rounding is a share."""
    planes = whole(planes, 3, MOST_PLANES - 2, "planes" if form == "superquadric" else "sides")
    r, k, R = rounding.lengths(size)
    return rounding.told_of(round_shape(form, sizes, name, planes, (r if rounding.is_chosen else None, k, R)))


def _known(length):
    return within(length, 0.0, math.inf, "known")


def _lengths(radius, height):
    return positive(radius, "radius"), positive(height, "height")


def __getattr__(name):
    # Its error is measured by the clumps of YADE.
    if name == "clump_from_mesh":
        try:
            from .convex_parts import clump_from_mesh
        except ImportError:
            raise AttributeError("shapes.clump_from_mesh makes clumps of YADE: it needs YADE and its plugin") from None
        return clump_from_mesh
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
