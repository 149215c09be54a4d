# SPDX-License-Identifier: GPL-3.0-or-later
"""Force chains: of each contact the line between the centres of its bodies, with the forces that it bears."""
import numpy as np
import yade

from ..bodies import image_shift, is_free
from . import vtk_files


def branch(contact):
    """Begin and end of the line of a contact: the centres of its bodies, and of one that is not moved by forces (walls) the contact point."""
    ends = []
    for number in (contact.id1, contact.id2):
        body = yade.O.bodies[number]
        place = contact.geom.contactPoint
        if body is not None and (body.isClumpMember or is_free(body)):
            place = yade.Vector3(body.state.pos)
            if number == contact.id2:
                place += image_shift(contact)
        ends.append(place)
    return ends


def lines(columns):
    """VTK's lines of contacts by the columns of the recorder: begin, end, normal_force, shear_force, id1 and id2."""
    data = {name: columns[name] for name in ("normal_force", "shear_force", "id1", "id2")}
    # On body 2 along the normal from body 1 to it: a push is above 0.
    data["push"] = (columns["normal_force"] * columns["normal"]).sum(1)
    return vtk_files.lines(np.stack([columns["begin"], columns["end"]], axis=1), data)
