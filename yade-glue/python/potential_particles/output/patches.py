# SPDX-License-Identifier: GPL-3.0-or-later
"""Contact patches and bonds as triangles with the pressure at their corners."""
from dataclasses import dataclass

import numpy as np
import yade

from .. import _glue
from ..bodies import image_shift, into_cell
from .drawn import Rows
from .mesh import rotation_matrix


@dataclass
class Patches(Rows):
    """Triangles on contact patches, world frame.

    corners (n, 3, 3), m; pressure at them (n, 3), Pa, below 0 where a bond is pulled; contacts (n,), rows of the
    contacts they belong to.
    """

    corners: np.ndarray
    pressure: np.ndarray
    contacts: np.ndarray

    @classmethod
    def none(cls):
        return cls(np.zeros((0, 3, 3)), np.zeros((0, 3)), np.zeros(0, int))


def patches(contacts):
    """The Patches of interactions: those of a functor with patch=True, each in its mean plane, and bonds; none of other
    contacts.

    Between flat faces the corners of a patch are exact, and the pressure is linear but for the rounding of the edges.
    """
    parts = [_bond(number, contact) if getattr(contact.phys, "bonded", False) else _patch(number, contact)
             for number, contact in enumerate(contacts)]
    # As body 1 is drawn.
    return Patches.together([Patches(part.corners + np.array(into_cell(yade.O.bodies[contact.id1])), part.pressure,
                                     part.contacts) for part, contact in zip(parts, contacts)])


def _patch(number, contact):
    one, other = (yade.O.bodies[i] for i in (contact.id1, contact.id2))
    corners, depth = _glue.patch_surface(contact.geom, one.shape, one.state, other.shape, other.state,
                                         image_shift(contact))
    depth = np.frombuffer(depth).reshape(-1, 3)
    return Patches(np.frombuffer(corners).reshape(-1, 3, 3), _stiffness(contact) * depth, np.full(len(depth), number))


def _stiffness(contact):
    """Of the contact, per area, N/m^3: that of a joint, or the one by which another law made its force."""
    stiffness = getattr(contact.phys, "normalStiffness", None)
    if stiffness is None:
        size = contact.geom.penetrationDepth * getattr(contact.geom, "contactArea", 0.0)
        stiffness = contact.phys.normalForce.norm() / size if size > 0 and hasattr(contact.phys, "normalForce") else 0.0
    return stiffness


def _bond(number, contact):
    """The bonded area under the stress of its force and bending moment."""
    phys, one = contact.phys, yade.O.bodies[contact.id1].state
    axes = rotation_matrix(one.ori * phys.bondTurn1)
    centroid = np.array(one.pos + one.ori * phys.bondPoint1)
    rim = np.array(phys.bondRim).reshape(-1, 2)
    moment = axes.T @ np.array(phys.bendingMoment)
    slope = np.array([-moment[2] / phys.bondMoments[2], moment[1] / phys.bondMoments[1]])
    middle = axes[:, 0] @ np.array(phys.normalForce) / phys.bondArea
    fan = np.stack([np.zeros_like(rim), rim, np.roll(rim, -1, axis=0)], axis=1)
    return Patches(centroid + fan @ axes[:, 1:].T, middle + fan @ slope, np.full(len(rim), number))
