# SPDX-License-Identifier: MIT OR Apache-2.0
"""Builders of shapes: half-spaces, points, surfaces, files and solids, rounded, about their centroid along principal
axes.

rounding is the rounding radius as a share of the *size* of the sharp shape, the diameter of the largest ball that fits
in it; r, in its place, and R are lengths; k is the sphericity itself. Faces stay where they are: the planes of the
particle lie deeper. A Shape says with centroid and orientation where its frame lies in that of the builder: x_builder =
centroid + orientation x.
"""
import math

import numpy as np

from . import mesh_text
from ._core import _builders

Shape = _builders.Shape
half_spaces = _builders.half_spaces
hull = _builders.hull
surface = _builders.surface
sphere = _builders.sphere
cuboid = _builders.cuboid
prism = _builders.prism
cylinder = _builders.cylinder
cone = _builders.cone
ellipsoid = _builders.ellipsoid
capsule = _builders.capsule
superquadric = _builders.superquadric
fitted = _builders.fitted
regular_solid = _builders.regular_solid


def mesh(file, *, hull=False, scale=1.0, rounding=None, k=0.02, r=None, R=None):
    """Of a closed convex surface in a file, .stl (binary or text) or .obj, all lengths multiplied by scale.

    hull=True takes the convex hull of its points. rounding, k, r, R: as of surface. ValueError: as of surface, and
    files that cannot be read.
    """
    if not (0.0 < scale < math.inf):
        raise ValueError(f"scale={scale!r} must be finite and above 0")
    points, polygons = mesh_text.read(file)
    known = mesh_text.known_to(points) * scale
    # Equal points are one; adding 0 makes one zero of both. A polygon is a fan of triangles.
    points, places = np.unique(points * scale + 0.0, axis=0, return_inverse=True)
    if not np.isfinite(points).all():
        raise ValueError(f"{file}: times scale={scale!r} its points are not finite")
    corners = ((polygon[0], *two) for polygon in polygons for two in zip(polygon[1:-1], polygon[2:]))
    triangles = places.ravel()[np.fromiter(corners, np.dtype((np.int64, 3)))]
    triangles = triangles[(triangles != np.roll(triangles, 1, axis=1)).all(axis=1)]
    try:
        return (_builders.hull(points, known=known, rounding=rounding, k=k, r=r, R=R) if hull else
                _builders.surface(points, triangles, known=known, rounding=rounding, k=k, r=r, R=R))
    except ValueError as error:
        raise ValueError(f"{file}: {error}") from None


__all__ = [
    "Shape", "capsule", "cone", "cuboid", "cylinder", "ellipsoid", "fitted", "half_spaces", "hull", "mesh", "prism",
    "regular_solid", "sphere", "superquadric", "surface"
]
