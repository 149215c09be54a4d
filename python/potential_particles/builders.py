# SPDX-License-Identifier: MIT OR Apache-2.0
"""Builders of shapes: half-spaces, points, surfaces, files and solids, rounded, about their centroid along principal
axes.

rounding is the rounding radius as a share of the *size* of the sharp shape, the diameter of the largest ball that fits
in it; r, in its place, and R are lengths; k is the sphericity itself. Faces stay where they are: the planes of the
particle lie deeper. A Shape says with centroid and orientation where its frame lies in that of the builder: x_builder =
centroid + orientation x.
"""
from ._core import _builders

Shape = _builders.Shape
half_spaces = _builders.half_spaces
hull = _builders.hull
surface = _builders.surface
mesh = _builders.mesh
sphere = _builders.sphere
cuboid = _builders.cuboid
prism = _builders.prism
cylinder = _builders.cylinder
regular_solid = _builders.regular_solid

__all__ = ["Shape", "cuboid", "cylinder", "half_spaces", "hull", "mesh", "prism", "regular_solid", "sphere", "surface"]
