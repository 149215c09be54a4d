# SPDX-License-Identifier: MIT OR Apache-2.0
"""Kinds of particles for the scenes: surface, mass, and a ball that holds them. Local frame, m."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import yade
from yade import O

from bodies import fix, give_mass, potential_body
from box import BODY_MASK, SLAB_NORMALS
from potential_surface import PotentialSurface
from pyramid import Pyramid
from surface_mesh import surface_mesh

OCTAHEDRON_NORMALS = np.array([(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]) / np.sqrt(3.0)


@dataclass
class Kind:
    """A particle whose centroid and principal axes are those of its local frame."""

    surface: PotentialSurface
    volume: float = None  # m^3; found by quadrature if not given
    principal_inertia: np.ndarray = None  # for density 1, m^5

    def __post_init__(self):
        if self.volume is None:
            self.volume, _, inertia = self.surface.mass_properties()
            self.principal_inertia = np.diag(inertia)

    @cached_property
    def ball_radius(self):
        """Of a ball about the centre that holds the particle."""
        return float(np.linalg.norm(surface_mesh(self.surface)[0], axis=1).max())

    def half_height(self):
        """Distance from the centre to the surface along the local z axis."""
        return float(self.surface.distance(np.array([0.0, 0.0, 1.0])))

    def body(self, material, position, orientation=(1, 0, 0, 0), fixed=False):
        """A body with YADE's own shape, not yet in the scene."""
        body = self._bare(material, position, orientation)
        give_mass(body, self.volume, self.principal_inertia)
        body.mask = BODY_MASK
        if fixed:
            fix(body)
        return body

    def _bare(self, *place):
        return potential_body(yade.PotentialParticle, self.surface, *place)


class Ball(Kind):
    """k = 1: a sphere of radius R, whose planes mean nothing."""

    def __init__(self, radius):
        surface = PotentialSurface(SLAB_NORMALS, np.full(6, radius), 0.1 * radius, 1.0, radius)
        super().__init__(surface, 4.0 / 3.0 * np.pi * radius**3, np.full(3, 8.0 / 15.0 * np.pi * radius**5))

    @property
    def ball_radius(self):
        return self.surface.R

    def _bare(self, *place):
        # The polyhedron that YADE's box is made from elsewhere has no meaning here; a cube about the ball does.
        cube = PotentialSurface(self.surface.normals, self.surface.offsets, self.surface.r, 0.5, self.surface.R)
        body = potential_body(yade.PotentialParticle, cube, *place, AabbMinMax=False)
        body.shape.k = self.surface.k
        return body


def block(half, r, k):
    """A rounded block; half: one half size for a cube, or three."""
    half = np.broadcast_to(np.asarray(half, float), 3)
    offsets = np.repeat(half, 2) - r
    return Kind(PotentialSurface(SLAB_NORMALS, offsets, r, k, np.linalg.norm(half)))


def octahedron(half, r, k):
    """Faces at distance `half` from the centre."""
    return Kind(PotentialSurface(OCTAHEDRON_NORMALS, np.full(8, half - r), r, k, np.sqrt(3.0) * half))


def pyramid(size, r, k):
    """The pyramid of the falling pyramids; r relative to `size`."""
    it = Pyramid(size, rounding=r, sphericity=k)
    return Kind(it.surface, it.volume, it.principal_inertia)


def material(friction_degrees, density):
    """Enters the scene's list; stiffness is that of the springs and not of the material."""
    it = yade.FrictMat(young=-1, poisson=-1, frictionAngle=np.radians(friction_degrees), density=density)
    O.materials.append(it)
    return it
