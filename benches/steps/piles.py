# SPDX-License-Identifier: MIT OR Apache-2.0
"""Piles at rest in YADE: pyramids by this library, or YADE's own spheres.

A pile of a few thousand bodies is settled once and kept; a larger one is made of copies of it, in
compartments side by side, so that 100,000 bodies at rest take seconds to make. SI units, z up.
"""

import numpy as np
import yade
from yade import O, utils

import pile
from box import BODY_MASK, SLAB_MASK, SLAB_ONLY, Box
from loose_grid import loose_grid

SEED = 7
SETTLING_DAMPING = 0.3  # of YADE: it ends sooner than with the demo's
SETTLING_STEPS = 14_000
SPHERE_RADIUS = 0.045  # m, so that a sphere has about the volume of a pyramid


class Pyramids(pile.Pile):
    """best: by ConicInteractionLoop and with BoundWatch, else by YADE's own loop and boxes."""

    def __init__(self, count, best):
        super().__init__(count, seed=SEED, measure_time=False)
        self.best = best

    def engines(self):
        loop = self.contact.loop if self.best else yade.InteractionLoop
        made = pile.engines(self.contact.functor, loop)
        return pile.watched(made) if self.best else made


class Spheres(pile.Pile):
    """YADE's own, between its boxes."""

    def __init__(self, count, _best):
        super().__init__(count, seed=SEED)
        self.grid = loose_grid(count, SPHERE_RADIUS, pile.JITTER, SEED)
        self.box = Box(self.grid.half_width, self.grid.half_width, self.grid.height, thickness=pile.SIZE)
        self.material.young, self.material.poisson = pile.NORMAL_STIFFNESS / SPHERE_RADIUS, 0.5

    def walls(self):
        h, top, t = self.box.half_x, self.box.height, self.box.thickness
        sides = [((0, 0, -0.5 * t), (h + t, h + t, 0.5 * t))]
        sides += [((s * (h + 0.5 * t), 0, 0.5 * top), (0.5 * t, h + t, 0.5 * top + t)) for s in (-1, 1)]
        sides += [((0, s * (h + 0.5 * t), 0.5 * top), (h, 0.5 * t, 0.5 * top + t)) for s in (-1, 1)]
        boxes = [utils.box(centre, half, fixed=True, material=self.material) for centre, half in sides]
        for body in boxes:
            body.mask = SLAB_MASK
        return boxes

    def body(self, position, orientation):
        return utils.sphere(tuple(map(float, position)), SPHERE_RADIUS, material=self.material, mask=BODY_MASK)

    def engines(self):
        return [
            yade.ForceResetter(),
            yade.InsertionSortCollider(
                [yade.Bo1_Sphere_Aabb(), yade.Bo1_Box_Aabb()], verletDist=0.0, avoidSelfInteractionMask=SLAB_ONLY,
                label="collider"),
            yade.InteractionLoop(
                [yade.Ig2_Sphere_Sphere_ScGeom(), yade.Ig2_Box_Sphere_ScGeom()],
                [yade.Ip2_FrictMat_FrictMat_FrictPhys()], [yade.Law2_ScGeom_FrictPhys_CundallStrack()],
                label="contacts"),
            yade.NewtonIntegrator(damping=pile.LOCAL_DAMPING, gravity=(0, 0, -pile.GRAVITY), label="motion"),
        ]


KINDS = {"pyramids": Pyramids, "spheres": Spheres}


def settle(kind, count, path):
    """Lets a loose pile come to rest and keeps it."""
    heap = KINDS[kind](count, False)
    heap.build()
    O.engines[-1].damping = SETTLING_DAMPING
    O.run(SETTLING_STEPS, True)
    np.savez(path, **pile.states(heap.ids))


def start(kind, count, kept, copies, best):
    """As many compartments with the kept pile; the ids of its bodies."""
    heap = KINDS[kind](count, best)
    O.materials.append(heap.material)
    side = int(np.ceil(np.sqrt(copies)))
    pitch = 2.0 * heap.box.half_x + 6.0 * heap.box.thickness
    for copy in range(copies):
        shift = np.array([copy % side * pitch, copy // side * pitch, 0.0])
        walls = heap.walls()
        for body in walls:
            body.state.pos += yade.Vector3(*shift)
        O.bodies.append(walls)
        positions, *others = (kept[name] for name in pile.STATES)
        heap.lay(positions + shift, *others)
    heap.finish()
    return heap.ids
