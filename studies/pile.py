# SPDX-License-Identifier: MIT OR Apache-2.0
"""The pile of pyramids of simulation A of Boon, Houlsby & Utili, as a YADE scene. SI units; z up, floor at z = 0."""

import numpy as np
import yade
from yade import O

from bodies import potential_body, reach
from box import BODY_MASK, SLAB_ONLY, Box
from contact_functor import LIBRARY, ContactFunctor
from loose_grid import loose_grid
from pyramid import pyramid

SIZE = 0.1  # base edge, m
DENSITY = 2600.0  # kg/m^3
FRICTION_ANGLE = 30.0  # degrees, everywhere
GRAVITY = 9.81  # m/s^2
SEED = 2012
JITTER = 0.03 * SIZE

# So stiff that the fastest impacts (some 4 m/s) overlap by about 1 % of the size.
NORMAL_STIFFNESS = 1.5e6  # N/m
SHEAR_STIFFNESS = 0.5 * NORMAL_STIFFNESS
# A fifth of sqrt(m/k_n), the critical step of a contact at a corner, where the effective mass is
# about m/4.
TIME_STEP = 1.5e-4  # s
# Impacts lose energy in dashpots along the normal. The law has none along the shear direction, so
# a little of YADE's local damping stills sliding and rocking. It acts on the acceleration, gravity
# included (bodies fall with 0.9 g), and so vanishes at rest; left off gravity, it would shift the
# balance of forces of resting bodies. What neither can still is the slow spin of a pyramid that
# lies flat: it meets what is below in one point, about which nothing resists turning.
VISCOUS_DAMPING = 0.3  # of critical
LOCAL_DAMPING = 0.1

STATES = ("pos", "ori", "vel", "angVel")


class Pile:
    """Pyramids on a loose grid, or at states that were kept, in a box; `ids` are those of the pyramids."""

    def __init__(self, count, functor=LIBRARY, room=0.0, seed=SEED, measure_time=True):
        """room: between the grid and the walls, over the height of the grid."""
        self.contact = ContactFunctor(functor, measure_time=measure_time)
        self.shape = pyramid(SIZE)
        self.grid = loose_grid(count, reach(self.shape), JITTER, seed)
        half_width = self.grid.half_width + room * self.grid.height
        self.box = Box(half_width, half_width, self.grid.height + SIZE, thickness=SIZE)
        self.ids = []
        self.material = yade.FrictMat(young=-1, poisson=-1, frictionAngle=np.radians(FRICTION_ANGLE), density=DENSITY)

    def build(self):
        """Fills YADE's scene with the loose pile."""
        self.start()
        self.lay(self.grid.positions, self.grid.orientations)
        self.finish()

    def start(self):
        """The material and the box."""
        O.materials.append(self.material)
        O.bodies.append(self.walls())

    def walls(self):
        """Floor and walls, not yet in the scene."""
        return self.box.slabs(self.contact.shape_class, self.material)

    def body(self, position, orientation):
        """A pyramid, not yet in the scene."""
        return potential_body(self.contact.shape_class, self.shape, self.material, position, orientation,
                              mask=BODY_MASK)

    def lay(self, positions, orientations, velocities=None, spins=None):
        """Pyramids at positions, m, with orientations w, x, y, z."""
        for number, place in enumerate(zip(positions, orientations)):
            body = self.body(*place)
            if velocities is not None:
                body.state.vel, body.state.angVel = yade.Vector3(*velocities[number]), yade.Vector3(*spins[number])
            self.ids.append(O.bodies.append(body))

    def finish(self):
        """Engines and time step."""
        O.engines = self.engines()
        self.contact.prepare()
        O.dt = TIME_STEP
        O.timingEnabled = True

    def engines(self):
        """Those of the demo."""
        return engines(self.contact.functor, self.contact.loop)


def engines(functor, loop=yade.InteractionLoop, normal=NORMAL_STIFFNESS, shear=SHEAR_STIFFNESS,
            viscous=VISCOUS_DAMPING, local=LOCAL_DAMPING, gravity=GRAVITY, never_erase=False):
    """YADE's loop around a contact functor: boxes, contacts, springs, motion."""
    return [
        yade.ForceResetter(),
        # The boxes must be exact at every step: with a margin, YADE runs the collider when a centre has moved by it,
        # but a body that tips moves its corners much further than its centre, and would meet the floor unseen.
        # (BoundWatch would see it; for so few bodies it takes as long as the collider.)
        yade.InsertionSortCollider([yade.PotentialParticle2AABB()], verletDist=0.0, avoidSelfInteractionMask=SLAB_ONLY,
                                   label="collider"),
        loop(
            [functor],
            # Without a contact area (the functor's switch) the stiffnesses are those of springs, in N/m.
            [yade.Ip2_FrictMat_FrictMat_KnKsPhys(Knormal=normal, Kshear=shear, kn_i=normal, ks_i=shear,
                                                 viscousDamping=viscous, useFaceProperties=False, brittleLength=5.0)],
            [yade.Law2_SCG_KnKsPhys_KnKsLaw(allowViscousAttraction=False, neverErase=never_erase)],
            label="contacts"),
        yade.NewtonIntegrator(damping=local, exactAsphericalRot=True, gravity=(0.0, 0.0, -gravity), label="motion"),
    ]  # fmt: skip


def watched(engines, verlet_distance=0.03 * SIZE):
    """These engines with boxes that are wider by a margin and a collider that runs when a body leaves its box."""
    reset, collider, *others = engines
    collider.boundDispatcher.functors = [yade.Bo1_ConicPP_Aabb()]
    collider.verletDist = verlet_distance
    return [reset, yade.BoundWatch(label="watch"), collider, *others]


def states(ids):
    """Of bodies, as arrays by the names of STATES; orientations w, x, y, z."""
    found = [O.bodies[i].state for i in ids]
    return {
        "pos": np.array([tuple(state.pos) for state in found]),
        "ori": np.array([[state.ori[i] for i in (3, 0, 1, 2)] for state in found]),
        "vel": np.array([tuple(state.vel) for state in found]),
        "angVel": np.array([tuple(state.angVel) for state in found]),
    }
