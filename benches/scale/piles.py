# SPDX-License-Identifier: MIT OR Apache-2.0
"""Piles at rest in YADE: pyramids by this library, or YADE's own spheres.

A pile of a few thousand bodies is settled once and kept; a larger one is made of copies of it, in
compartments side by side, so that 100,000 bodies at rest take seconds to make. SI units, z up.
"""

import os
import sys

# The scenes of the commit whose plugin is measured.
sys.path.insert(0, os.environ["STUDIES"])

import numpy as np
import yade
from yade import O, utils

import loose_grid
import pyramids
from bodies import potential_body, reach
from box import BODY_MASK, SLAB_ONLY, Box
from contact_functor import LIBRARY, ContactFunctor
from pyramid import pyramid

PYRAMIDS, SPHERES = "pyramids", "spheres"
SEED = 7
SETTLING_DAMPING = 0.3  # of YADE: it ends sooner than with the demo's
SETTLING_STEPS = 14_000
SPHERE_RADIUS = 0.045  # m, so that a sphere has about the volume of a pyramid
VERLET_DISTANCE = 0.03 * pyramids.SIZE
STATE_FIELDS = ("pos", "ori", "vel", "angVel")


class Pile:
    """Scene of one kind; `copies` compartments of the kept pile, or a loose one to be settled."""

    def __init__(self, kind, count, loop=None, watched=False):
        """loop: another contact loop than the demo's; watched: whether the collider runs only when BoundWatch asks."""
        self.kind, self.count, self.loop, self.watched = kind, count, loop, watched
        self.contact = ContactFunctor(LIBRARY, measure_time=False) if kind == PYRAMIDS else None
        self.shape = pyramid(pyramids.SIZE)
        self.ball = reach(self.shape) if kind == PYRAMIDS else SPHERE_RADIUS
        self.grid = loose_grid.loose_grid(count, self.ball, pyramids.JITTER, SEED)
        self.box = Box(self.grid.half_width, self.grid.half_width, self.grid.height, thickness=pyramids.SIZE)
        self.material = yade.FrictMat(
            young=pyramids.NORMAL_STIFFNESS / SPHERE_RADIUS,
            poisson=0.5,
            frictionAngle=np.radians(pyramids.FRICTION_ANGLE),
            density=pyramids.DENSITY,
        )

    # --- scenes -----------------------------------------------------------------------------

    def loose(self):
        """The pile before it falls."""
        self._start()
        self._compartment((0.0, 0.0))
        for position, orientation in zip(self.grid.positions, self.grid.orientations):
            self._append(position, orientation)
        self._finish()

    def kept(self, states, copies=1):
        """As many compartments with the kept pile."""
        self._start()
        side = int(np.ceil(np.sqrt(copies)))
        pitch = 2.0 * self.box.half_x + 6.0 * self.box.thickness
        for copy in range(copies):
            shift = np.array([copy % side * pitch, copy // side * pitch, 0.0])
            self._compartment(shift[:2])
            for pos, ori, vel, spin in zip(*(states[name] for name in STATE_FIELDS)):
                body = self._append(pos + shift, ori)
                body.state.vel, body.state.angVel = yade.Vector3(*vel), yade.Vector3(*spin)
        self._finish()

    def states(self):
        """Of all bodies but the boxes, as arrays; orientations w, x, y, z."""
        bodies = [O.bodies[i] for i in self.ids]
        return {
            "pos": np.array([tuple(b.state.pos) for b in bodies]),
            "ori": np.array([[b.state.ori[i] for i in (3, 0, 1, 2)] for b in bodies]),
            "vel": np.array([tuple(b.state.vel) for b in bodies]),
            "angVel": np.array([tuple(b.state.angVel) for b in bodies]),
        }

    # --- their parts ------------------------------------------------------------------------

    def _start(self):
        O.reset()
        O.materials.append(self.material)
        self.ids = []

    def _other_loop(self, loop):
        if self.loop is None:
            return loop
        return self.loop(loop.geomDispatcher.functors, loop.physDispatcher.functors, loop.lawDispatcher.functors,
                         label="contacts")

    def _watch_boxes(self):
        reset, collider, *others = O.engines
        collider.boundDispatcher.functors = [yade.Bo1_ConicPP_Aabb()]
        collider.verletDist = VERLET_DISTANCE
        O.engines = [reset, yade.BoundWatch(label="watch"), collider, *others]

    def _compartment(self, shift):
        if self.kind == PYRAMIDS:
            for slab in self.box.slabs(self.contact.shape_class, self.material):
                slab.state.pos += yade.Vector3(*shift, 0.0)
                O.bodies.append(slab)
            return
        h, top, t = self.box.half_x, self.box.height, self.box.thickness
        x, y = shift
        sides = [((x, y, -0.5 * t), (h + t, h + t, 0.5 * t))]
        sides += [((x + s * (h + 0.5 * t), y, 0.5 * top), (0.5 * t, h + t, 0.5 * top + t)) for s in (-1, 1)]
        sides += [((x, y + s * (h + 0.5 * t), 0.5 * top), (h, 0.5 * t, 0.5 * top + t)) for s in (-1, 1)]
        for centre, half in sides:
            body = utils.box(centre, half, fixed=True, material=self.material)
            body.mask = 0b11
            O.bodies.append(body)

    def _append(self, position, orientation):
        if self.kind == PYRAMIDS:
            body = potential_body(self.contact.shape_class, self.shape, self.material, position, orientation,
                                  mask=BODY_MASK)
        else:
            body = utils.sphere(tuple(map(float, position)), SPHERE_RADIUS, material=self.material, mask=BODY_MASK)
        number = O.bodies.append(body)
        self.ids.append(number)
        return O.bodies[number]

    def _finish(self):
        if self.kind == PYRAMIDS:
            O.engines = [
                self._other_loop(one) if one.label == "contacts" else one for one in pyramids.engines(self.contact)
            ]
            if self.watched:
                self._watch_boxes()
            self.contact.prepare()
        else:
            O.engines = [
                yade.ForceResetter(),
                yade.InsertionSortCollider(
                    [yade.Bo1_Sphere_Aabb(), yade.Bo1_Box_Aabb()],
                    verletDist=0.0,
                    avoidSelfInteractionMask=SLAB_ONLY,
                    label="collider",
                ),
                yade.InteractionLoop(
                    [yade.Ig2_Sphere_Sphere_ScGeom(), yade.Ig2_Box_Sphere_ScGeom()],
                    [yade.Ip2_FrictMat_FrictMat_FrictPhys()],
                    [yade.Law2_ScGeom_FrictPhys_CundallStrack()],
                    label="contacts",
                ),
                yade.NewtonIntegrator(
                    damping=pyramids.LOCAL_DAMPING, gravity=(0, 0, -pyramids.GRAVITY), label="motion"
                ),
            ]
        O.dt = pyramids.TIME_STEP
        O.timingEnabled = True
