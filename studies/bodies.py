# SPDX-License-Identifier: MIT OR Apache-2.0
"""YADE bodies made of potential particles: shape, box, mass."""

import numpy as np
from yade import Body, Quaternion, Vector3

from surface_mesh import polyhedron_faces


def potential_body(shape_class, surface, material, position, orientation=(1, 0, 0, 0), **shape):
    """A body without mass yet, at `position` (m); orientation w, x, y, z, local to world."""
    body = Body()
    body.shape = potential_shape(shape_class, surface, **shape)
    body.mat = material
    body.state.pos = body.state.refPos = Vector3(*map(float, position))
    turn = Quaternion(*map(float, orientation))
    turn.normalize()
    body.state.ori = body.state.refOri = turn
    return body


def potential_shape(shape_class, surface, **more):
    """A PotentialParticle, or a class derived from it, with the planes of a PotentialSurface."""
    a, b, c = ([float(value) for value in column] for column in surface.normals.T)
    if not hasattr(shape_class, "automaticBox"):
        # YADE's own class knows no corners: without them its box would be a cube about a ball.
        more = {"AabbMinMax": True, "vertices": _corners(surface), **more}
    offsets = [float(d) for d in surface.offsets]
    return shape_class(a=a, b=b, c=c, d=offsets, r=surface.r, k=surface.k, R=surface.R, **more)


def give_mass(body, volume, principal_inertia):
    """volume in m^3; inertia for density 1 about the centroid, along the local axes, m^5."""
    density = body.mat.density
    body.state.mass = volume * density
    body.state.inertia = Vector3(*(float(value) * density for value in principal_inertia))
    body.aspherical = True


def fix(body):
    """Holds a body where it is, whatever pushes it."""
    body.state.blockedDOFs = "xyzXYZ"


def _corners(surface):
    """Corners of a polyhedron that holds the particle: each face at d + r/sqrt(1-k)."""
    faces = polyhedron_faces(surface.normals, surface.offsets + surface.r / np.sqrt(1.0 - surface.k))
    corners = np.unique(np.round(np.vstack(faces), 12), axis=0)
    return [Vector3(*corner) for corner in corners]
