# SPDX-License-Identifier: GPL-3.0-or-later
"""Force chains: of each contact the line between the centres of its bodies, with the forces that it bears."""
import numpy as np
import yade

from ..bodies import image_shift, into_cell, is_free
from . import vtk_files

# The widest tube's radius, over the median length of lines; sides of a tube.
WIDEST, SIDES = 0.12, 8


def branch(contact):
    """Begin and end of the line of a contact: the centres of its bodies, and of one that is not moved by forces (walls)
    the contact point.
    """
    ends = []
    for number in (contact.id1, contact.id2):
        body = yade.O.bodies[number]
        place = contact.geom.contactPoint
        if body is not None and (body.isClumpMember or is_free(body)):
            place = yade.Vector3(body.state.pos)
            if number == contact.id2:
                place += image_shift(contact)
        ends.append(place + into_cell(yade.O.bodies[contact.id1]))
    return ends


def tubes(contacts):
    """(corners (n, 3, 3), normal force (n,)) of triangles: a tube along the line of each contact that bears a force, as
    wide as the root of its share of the largest.

    Above 0 where bodies push, below where they pull.
    """
    rows = [(*branch(one), one.phys.normalForce.dot(one.geom.normal)) for one in contacts
            if hasattr(one.phys, "normalForce")]
    rows = [row for row in rows if row[2] != 0.0]
    if not rows:
        return np.zeros((0, 3, 3)), np.zeros(0)
    begin, end = (np.array([list(row[i]) for row in rows]) for i in (0, 1))
    force = np.array([row[2] for row in rows])
    lengths = np.linalg.norm(end - begin, axis=1)
    along = (end - begin) / np.maximum(lengths, 1e-300)[:, None]
    across = np.cross(along, np.eye(3)[np.abs(along).argmin(1)])
    across /= np.maximum(np.linalg.norm(across, axis=1), 1e-300)[:, None]
    radius = WIDEST * np.median(lengths) * np.sqrt(np.abs(force) / np.abs(force).max())
    angles = 2.0 * np.pi * np.arange(SIDES + 1) / SIDES
    ring = radius[:, None, None] * (np.cos(angles)[:, None] * across[:, None]
                                    + np.sin(angles)[:, None] * np.cross(along, across)[:, None])
    lower, upper = begin[:, None] + ring, end[:, None] + ring
    quads = [lower[:, :-1], lower[:, 1:], upper[:, 1:], upper[:, :-1]]
    triangles = np.stack([np.stack([quads[i] for i in corners], axis=2) for corners in ((0, 1, 2), (0, 2, 3))], axis=2)
    return triangles.reshape(-1, 3, 3), np.repeat(force, 2 * SIDES)


def lines(columns):
    """VTK's lines of contacts by the columns of the recorder: begin, end, normal_force, shear_force, id1 and id2."""
    data = {name: columns[name] for name in ("normal_force", "shear_force", "id1", "id2")}
    # On body 2 along the normal from body 1 to it: a push is above 0.
    data["push"] = (columns["normal_force"] * columns["normal"]).sum(1)
    return vtk_files.lines(np.stack([columns["begin"], columns["end"]], axis=1), data)
