# SPDX-License-Identifier: MIT OR Apache-2.0
"""Pictures of a rock mass: its key blocks, and an answer of limit analysis."""
import os

import numpy as np

from ..equilibrium_picture import Block, STONE, picture
from ..files import written
from .mass import marked


def plot(mass, file, keys=(), found=None, held=(), removed=(), towards=(0.8, -0.6, 0.4)):
    """Draws a RockMass to a PNG, PDF or SVG, by matplotlib.

    keys: of key_blocks(), whose colours (COLOURS) the blocks take. found: an answer of limit_analysis() for this mass:
    then forces on the joints, in the colour of the friction used, and the mechanism. held: blocks that are grey and
    stay, removed: those that are not there, as of limit_analysis(). towards: from the rock to the eye.
    """
    colours = {block: one.color for one in keys for block in one.blocks}
    held, gone = marked(held, len(mass), "held"), marked(removed, len(mass), "removed")
    still = np.zeros(3), np.zeros(3)
    velocities = {} if found is None else found.velocities
    blocks = []
    for piece in (piece[~gone[piece]] for piece in mass.blocks_of_pieces):
        if not len(piece):
            continue
        linear, angular = map(np.array, velocities.get(int(piece[0]), still))
        volumes, centroids = mass.blocks["volume"][piece], mass.blocks["centroid"][piece]
        centre = volumes @ centroids / volumes.sum()
        for block in piece:
            faces = [mass.outline(face) for face in mass[block].faces]
            blocks.append(Block(faces, centre, linear, angular, bool(held[piece].any()), colours.get(int(block), STONE)))
    if (held | gone).all():
        raise ValueError("all blocks are held or removed: none is left to be drawn")
    if found is None:
        title, at, forces, used = f"{len(mass):,} blocks", np.zeros((0, 3)), np.zeros((0, 3)), np.zeros(0)
    else:
        stands = "it stands" if found.question == "stands" else f"factor {found.factor:.4g}"
        title = stands if found.stands else "it falls"
        at, forces, used = found.corners, found.forces, found.used[found.contact_of_corner]
    drawn = picture([(title, blocks, at, forces, used)], towards, width=8)
    with written(file) as out:
        drawn.savefig(out, dpi=110, format=os.path.splitext(file)[1][1:] or None)
