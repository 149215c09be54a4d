# SPDX-License-Identifier: GPL-3.0-or-later
"""The picture of an answer of limit_analysis() for the bodies of YADE's scene."""
import numpy as np
import yade

from .. import equilibrium_picture
from ..bodies import is_free, owner
from ..equilibrium_picture import Block
from ..limit_state import clipped
from .drawn import ShapeMeshes
from .mesh import rotation_matrix

# Meshes of bodies that have no flat faces, over their size.
TOLERANCE = 0.05
# A scene is seen from its side if the centres of its bodies lie in one plane, to this part of its extent.
PLANE = 1e-3
OBLIQUE = (0.46, -0.84, 0.42)


def plot_equilibrium(found, file, towards=None):
    """Draws an answer of limit_analysis() to a PNG, PDF or SVG: above the forces at the corners, in the colour of the
    share of friction used, below the mechanism, as blocks that have moved and as velocities of their centres.

    towards: direction from the scene to the eye, world axes; by default from the side of a wall whose centres lie in
    one vertical plane, and otherwise oblique. Forces are those on body id2 of a contact. Bodies that touch nothing are
    left out. ValueError for an answer whose bodies are not in the scene.
    """
    bodies = {body.id: body for body in yade.O.bodies if body.shape is not None and not body.isClump}
    if unknown := [one for pair in found.contacts for one in pair if one not in bodies]:
        raise ValueError(f"body {unknown[0]} of the answer is not in the scene")
    shown = sorted({one for pair in found.contacts for one in pair})
    meshes = ShapeMeshes(TOLERANCE)
    blocks = [_block(bodies[one], found.velocities, meshes) for one in shown]
    blocks = [block for block in blocks if block.faces]
    if not any(not block.held for block in blocks):
        raise ValueError("no free body of the answer can be drawn")
    equilibrium_picture.plot(found, blocks, file, _side(blocks) if towards is None else towards)


def _block(body, velocities, meshes):
    own = owner(body)
    linear, angular = map(np.array, velocities.get(own.id, (np.zeros(3), np.zeros(3))))
    turn, place = rotation_matrix(body.state.ori), np.array(body.state.pos)
    faces = [place + face @ turn.T for face in _faces(body.shape, meshes)]
    return Block(faces, np.array(own.state.pos), linear, angular, not is_free(own))


def _faces(shape, meshes):
    """Polygons (m, 3) that bound a shape, local frame; [] for one that is not drawn."""
    if not (hasattr(shape, "planes") and shape.k < 1):
        local = meshes.of(shape)
        return [] if local is None else list(local[0])
    planes = np.array(shape.planes, float)
    bounds = [(plane[:3], plane[3] + shape.r) for plane in planes]
    reach = 2.0 * shape.boundingRadius
    polygons = [clipped(n, offset * n, bounds[:i] + bounds[i + 1:], reach) for i, (n, offset) in enumerate(bounds)]
    return [one for one in polygons if len(one) > 2]


def _side(blocks):
    centres = np.array([block.centre for block in blocks if not block.held])
    spread = np.ptp(centres, axis=0)
    for axis, towards in ((1, (0, -1, 0)), (0, (1, 0, 0))):
        if len(centres) > 2 and spread[axis] <= PLANE * spread.max():
            return towards
    return OBLIQUE
