# SPDX-License-Identifier: MIT OR Apache-2.0
"""Pictures of a rock mass: its key blocks, and an answer of limit analysis."""
import numpy as np

from .. import equilibrium_picture
from ..equilibrium_picture import Block, STONE
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
        nothing = np.zeros((0, 3))
        equilibrium_picture.save([(f"{len(mass):,} blocks", blocks, nothing, nothing, np.zeros(0))], file, towards)
    else:
        equilibrium_picture.plot(found, blocks, file, towards)
