# SPDX-License-Identifier: MIT OR Apache-2.0
"""Shapes of the scenes, and bodies of them. Local frame, m."""

import numpy as np
import potential_particles
import yade
from yade import O, Vector3

from bodies import potential_body, shape_of_planes
from box import BODY_MASK, SLAB_NORMALS

OCTAHEDRON_NORMALS = np.array([(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]) / np.sqrt(3.0)


def half_height(shape):
    """Distance from the centre to the surface along the local z axis."""
    return potential_particles.conic_particle(shape).surfaceDistance([Vector3(0, 0, 1)])[0]


def plain_body(shape, material, position, orientation=(1, 0, 0, 0), fixed=False):
    """A body with YADE's own shape, not yet in the scene."""
    return potential_body(yade.PotentialParticle, shape, material, position, orientation, fixed=fixed, mask=BODY_MASK)


def ball(radius):
    """k = 1: a sphere of radius R, whose planes mean nothing."""
    return shape_of_planes(SLAB_NORMALS, np.full(6, radius), 0.1 * radius, 1.0, radius, "ball")


def block(half, r, k):
    """A rounded block; half: one half size for a cube, or three."""
    half = np.broadcast_to(np.asarray(half, float), 3)
    offsets = np.repeat(half, 2) - r
    return shape_of_planes(SLAB_NORMALS, offsets, r, k, np.linalg.norm(half), "block")


def octahedron(half, r, k):
    """Faces at distance `half` from the centre."""
    return shape_of_planes(OCTAHEDRON_NORMALS, np.full(8, half - r), r, k, np.sqrt(3.0) * half, "octahedron")


def material(friction_degrees, density):
    """Enters the scene's list; stiffness is that of the springs and not of the material."""
    it = yade.FrictMat(young=-1, poisson=-1, frictionAngle=np.radians(friction_degrees), density=density)
    O.materials.append(it)
    return it
