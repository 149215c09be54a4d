# SPDX-License-Identifier: MIT OR Apache-2.0
"""Shapes whose planes are given, and bodies of them for either contact functor."""

import numpy as np
import yade
from potential_particles import ConicPotentialParticle, body, mesh
from potential_particles.polyhedron import Polyhedron
from potential_particles.shape import Shape

MASS_TOLERANCE = 1e-8  # of volume and inertia, relative
REACH_TOLERANCE = 1e-4  # of the bounding radius


def shape_of_planes(normals, offsets, r, k, R, name):
    """The Shape with these planes n_i.x <= d_i, whose centroid and principal axes must be those of its frame.

    The builders of potential_particles.shapes are given faces, and find planes and frame; comparisons with closed forms
    and with YADE's own functor give the planes themselves.
    """
    planes = tuple((*map(float, normal), float(offset)) for normal, offset in zip(normals, offsets))
    particle = ConicPotentialParticle(planes=list(planes), r=r, k=k, R=R)
    volume, _, inertia, error = particle.massProperties(MASS_TOLERANCE)
    return Shape(planes, r, k, R, volume, tuple(inertia[i, i] for i in range(3)), error, (0.0, 0.0, 0.0),
                 (1.0, 0.0, 0.0, 0.0), particle.boundingRadius, name)  # fmt: skip


def reach(shape):
    """Radius of the least ball about the centroid that holds a shape, m; `bounding_radius` may be a tenth larger."""
    surface = mesh(shape, REACH_TOLERANCE)
    return float(np.linalg.norm(surface.points, axis=1).max() + surface.error)


def potential_body(shape_class, shape, *place, **more):
    """As potential_particles.body, with the shape as a ConicPotentialParticle or as YADE's own PotentialParticle."""
    made = body(shape, *place, **more)
    if shape_class is not ConicPotentialParticle:
        made.shape = _plain(shape, made.shape.isBoundary)
    return made


def _plain(shape, is_boundary):
    a, b, c, d = (list(column) for column in zip(*shape.planes))
    # YADE's own class knows no corners: without them its box is a cube about a ball, which is right for k = 1 alone.
    corners = [] if shape.k == 1.0 else _corners(shape)
    return yade.PotentialParticle(a=a, b=b, c=c, d=d, r=shape.r, k=shape.k, R=shape.R, isBoundary=is_boundary,
                                  AabbMinMax=bool(corners), vertices=corners)  # fmt: skip


def _corners(shape):
    """Corners of a polyhedron that holds the particle: each face at d + r/sqrt(1-k)."""
    planes = np.array(shape.planes)
    sharp = Polyhedron.of_planes(planes[:, :3], planes[:, 3] + shape.r / np.sqrt(1.0 - shape.k))
    return [yade.Vector3(*corner) for corner in np.unique(np.round(sharp.corners, 12), axis=0)]
