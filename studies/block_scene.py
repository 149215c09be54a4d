# SPDX-License-Identifier: MIT OR Apache-2.0
"""The scene of classics and of the sliding wedge: blocks with flat faces, springs and friction, and all numerical
choices, which no case of the classics changes.

Every length below is relative to the size of the scene, the diameter of the largest ball in its smallest block.

- Edges are rounded with the radius r = ROUNDING: the flat part of a face, over which its contact point may move, ends
  r inside the edge.
- Springs are so stiff that the largest force at rest, which the case names (`load`), makes an overlap of OVERLAP.
- Faces are flat (k = 0). Their contact point is chosen as if they bulged by BULGE of that overlap, so that it moves
  smoothly with the tilt: it crosses a face while the block tilts by some 1e-6 rad (docs/classics.md).
- The time step follows from the stiffest motion, springs or tilting.
- With LAW=joint in the environment, contacts are patches with the law of joints: the load on a square of the size makes
  an overlap of OVERLAP_OF_JOINTS, less than of points, since a face that tilts on its edge gives way
  (docs/classics.md). Their dashpots have RESTITUTION_AT_REST, so that blocks that slide do not swing on their springs,
  of which YADE's damping would make a drag; in motion RESTITUTION.
- What is looked for at rest has YADE's local damping, which vanishes at rest and delays all motion of a block alike.
  What is looked for in motion (`moving`) has none, but dashpots beside the normal springs, so that what lands does not
  bounce. (Dashpots in shear would add to the friction of YADE's law, which limits the spring alone.)
"""

import numpy as np
import yade
from potential_particles import body, shapes, use_joints
from potential_particles.polyhedron import Polyhedron
from yade import O, Vector3

import settings
from stepping import advance

JOINTS = settings.choice("LAW", "point", ("point", "joint"), "law") == "joint"

GRAVITY = 9.81  # m/s^2
DENSITY = 2600.0  # kg/m^3; no result depends on it
ROUNDING = 1e-3
OVERLAP = 1e-5
BULGE = 0.1
SHEAR = 0.5  # of the normal stiffness
DAMPING = 0.5  # YADE's local one
DASHPOT = 2.0  # over sqrt(k m), m the mass of the load
OVERLAP_OF_JOINTS = 1e-8
RESTITUTION_AT_REST, RESTITUTION = 0.3, 0.01  # of joints
# Of the time in which the springs, and tilting, turn one radian.
SPRING_STEP, TILT_STEP = 0.2, 0.4
QUIET = 1e-5  # of the speed that belongs to the overlap
FREE_MASK, FIXED_MASK, FIXED_ONLY = 0b01, 0b11, 0b10


def soft_overlap(least, sphericity, rounding):
    """Overlap over the size: soft enough for faces that bulge (k > 0), 20 times k r, up to a part of r.

    The faces of a particle bulge by about k r / 2. If tilting is not much stiffer than the springs, the two swing
    together when a block slides, and drag it along or hold it.
    """
    return max(least, min(20.0 * sphericity, 0.1) * rounding)


class Scene:
    """Empties YADE's scene. Add blocks, then `start`.

    size: m; load: the largest force of a contact at rest, as the weight of so much volume (m^3) of rock; overlap: under
    that force, over the size, in place of what follows from OVERLAP; shear: of the normal stiffness.
    """

    bulge, spring_step, tilt_step = BULGE, SPRING_STEP, TILT_STEP

    def __init__(self, size, load, moving=False, rounding=ROUNDING, sphericity=0.0, overlap=None, shear=SHEAR,
                 density=DENSITY):
        O.reset()
        self.moving = moving
        self.size, self.rounding, self.sphericity = size, rounding * size, sphericity
        self.density, self.shear = density, shear
        self.load = load * density * GRAVITY
        if overlap is None:
            overlap = soft_overlap(OVERLAP_OF_JOINTS if JOINTS else OVERLAP, sphericity, rounding)
        self.overlap = size * overlap
        self.stiffness = self.load / self.overlap
        # The unit of motions: joints give way by more than their overlap.
        self.motion_unit = max(self.overlap, size * OVERLAP)
        self.material = O.materials[O.materials.append(self._material())]

    def _material(self):
        if not self.moving:
            return yade.FrictMat(young=1.0, poisson=1.0, frictionAngle=0.0, density=self.density)
        dashpot = DASHPOT * np.sqrt(self.stiffness * self.load / GRAVITY)
        # YADE puts the values of both bodies in series: twice each gives what is wanted.
        return yade.ViscElMat(
            kn=2.0 * self.stiffness, ks=2.0 * self.shear * self.stiffness, cn=2.0 * dashpot, cs=0.0,
            frictionAngle=0.0, density=self.density,
        )  # fmt: skip

    # --- blocks ---------------------------------------------------------------------------------

    def block(self, corners, fixed=False, position=(0.0, 0.0, 0.0), mask=None):
        """The convex hull of corners (m) as a body."""
        corners = np.asarray(corners, float)
        relative = self.rounding / Polyhedron.of_points(corners).size
        shape = shapes.from_vertices(corners, rounding=relative, k=self.sphericity)
        return self.add(shape, fixed, position, mask=mask)

    def add(self, shape, fixed=False, position=(0.0, 0.0, 0.0), orientation=(1.0, 0.0, 0.0, 0.0), mask=None):
        """A Shape as a body; orientation w, x, y, z. Returns the body."""
        mask = mask if mask is not None else (FIXED_MASK if fixed else FREE_MASK)
        made = body(shape, self.material, position, orientation, fixed=fixed, mask=mask)
        O.bodies.append(made)
        return made

    # --- engines --------------------------------------------------------------------------------

    def start(self, friction, gravity=(0.0, 0.0, -GRAVITY), before=()):
        """Engines and time step; friction angle in degrees. `before`: engines that run before the contacts."""
        bulge = self.bulge * self.overlap / self.rounding
        regularisation = {"flatRegularisation": bulge} if self.sphericity == 0.0 else {}
        functor = yade.Ig2_ConicPP_ConicPP_ScGeom(calContactArea=False, **regularisation)
        physics, law = self._laws()
        O.engines = [
            yade.ForceResetter(),
            yade.BoundWatch(),
            yade.InsertionSortCollider(
                [yade.Bo1_ConicPP_Aabb()], verletDist=0.02 * self.size, avoidSelfInteractionMask=FIXED_ONLY
            ),
            *before,
            yade.ConicInteractionLoop([functor], [physics], [law], label="contacts"),
            yade.NewtonIntegrator(damping=0.0 if self.moving else DAMPING, gravity=gravity, exactAsphericalRot=True),
        ]
        if JOINTS:
            use_joints(normalStiffness=self.stiffness / self.size**2,
                       shearStiffness=self.shear * self.stiffness / self.size**2,
                       restitution=RESTITUTION if self.moving else RESTITUTION_AT_REST)
        O.dt = self._time_step_of_joints() if JOINTS else self._time_step(max(bulge, self.sphericity))
        self.set_friction(friction)

    def _laws(self):
        if self.moving:
            return yade.Ip2_ViscElMat_ViscElMat_ViscElPhys(), yade.Law2_ScGeom_ViscElPhys_Basic()

        def value(number):
            return yade.MatchMaker(algo="val", val=float(number))

        physics = yade.Ip2_FrictMat_FrictMat_FrictPhys(kn=value(self.stiffness), ks=value(self.shear * self.stiffness))
        # Levers of forces run to the contact point, not along the normal as for spheres.
        return physics, yade.Law2_ScGeom_FrictPhys_CundallStrack(sphericalBodies=False)

    def _time_step(self, curving):
        """s. A tilt moves the point by tilt R^2 / (r curving), and with it the load."""
        least = np.inf
        for one in self.free():
            springs = np.sqrt(self.stiffness / one.state.mass)
            lever = one.shape.boundingRadius**2 / (curving * self.rounding)
            tilting = np.sqrt(self.load * lever / min(one.state.inertia))
            least = min(least, self.spring_step / springs, self.tilt_step / tilting)
        return least

    def _time_step_of_joints(self):
        """s, from the springs of a patch as large as any section of the ball about a block: at least twice its own, so
        that dashpots have room.
        """
        least = np.inf
        for one in self.free():
            radius = one.shape.boundingRadius
            area = np.pi * radius**2
            springs = self.stiffness * area / self.size**2 * max(1.0 / one.state.mass,
                                                                 0.5 * radius**2 / min(one.state.inertia))
            least = min(least, self.spring_step / np.sqrt(springs))
        return least

    @property
    def functor(self):
        """The contact functor; loading a saved state makes a new one, as of all engines."""
        return next(one for one in O.engines if one.label == "contacts").geomDispatcher.functors[0]

    @property
    def motion(self):
        """The integrator."""
        return O.engines[-1]

    def free(self):
        """Blocks that may move."""
        return [one for one in O.bodies if one.state.blockedDOFs == "" and not one.isClump]

    def set_friction(self, angle):
        """Friction angle of all contacts from now on, degrees."""
        self.friction = angle
        for material in O.materials:
            material.frictionAngle = np.radians(angle)
        for interaction in O.interactions:
            if interaction.isReal:
                interaction.phys.tangensOfFrictionAngle = np.tan(np.radians(angle))
                if JOINTS:
                    interaction.phys.tangensOfResidualFrictionAngle = np.tan(np.radians(angle))

    def set_gravity(self, vector):
        """m/s^2; a tilted gravity stands for a tilted plane."""
        self.motion.gravity = Vector3(*map(float, vector))

    # --- what it does ---------------------------------------------------------------------------

    @property
    def beat(self):
        """sqrt(overlap / g), s: the pace of the springs."""
        return np.sqrt(self.overlap / GRAVITY)

    def run(self, seconds):
        """So long, in whole steps."""
        advance(O.iter + max(1, round(seconds / O.dt)))

    def at_rest(self):
        """Whether no block is faster than QUIET sqrt(g overlap), and none is turned faster than that at its farthest
        corner.
        """
        limit = QUIET * np.sqrt(GRAVITY * self.overlap)
        return all(one.state.vel.norm() < limit and one.state.angVel.norm() * one.shape.boundingRadius < limit
                   for one in self.free())

    def comes_to_rest(self, within, every, fails=lambda: False):
        """Whether the blocks rest within so many seconds from now, before `fails` is true; looked at every so many
        beats.
        """
        until, rests = O.time + within, False
        while O.time < until and not rests and not fails():
            self.run(every * self.beat)
            rests = self.at_rest()
        self.check()
        return rests

    def settle(self, most=4000):
        """Runs until the blocks rest, at most `most` beats; whether they rest."""
        return self.comes_to_rest(most * self.beat, every=20.0)

    def check(self):
        """SystemExit if a contact could not be computed."""
        if self.functor.failures:
            raise SystemExit(f"{self.functor.failures} contacts could not be computed: {self.functor.failureReport}")


def box_corners(length, width, height):
    """Of a box about the origin along x, y, z."""
    return [(0.5 * x * length, 0.5 * y * width, 0.5 * z * height) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]


def tilted_gravity(angle):
    """Gravity seen from a plane that dips by `angle` (degrees) towards x."""
    radians = np.radians(angle)
    return GRAVITY * np.array([np.sin(radians), 0.0, -np.cos(radians)])


def turn_about_y(one):
    """By how much a body has turned about y since it was made, radians, -pi to pi; positive falls towards +x."""
    turned = one.state.ori * one.state.refOri.conjugate()
    w, y = turned[3], turned[1]
    return 2.0 * np.arctan2(y, w) if w >= 0.0 else 2.0 * np.arctan2(-y, -w)


def place_of(one, point):
    """Where a material point is now that was at `point` (m, world) when the body was made."""
    local = one.state.refOri.conjugate() * (Vector3(*map(float, point)) - one.state.refPos)
    return np.array(one.state.pos + one.state.ori * local)
