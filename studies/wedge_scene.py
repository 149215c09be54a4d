# SPDX-License-Identifier: MIT OR Apache-2.0
"""A wedge on its three fixed blocks, as a YADE scene: shapes, engines, and what the joints carry.

Joints are elastic, perfectly plastic, Mohr-Coulomb without cohesion. Each face of the wedge meets its
block in one contact point, which carries a moment only by moving to where the balance wants it.
Between exactly flat faces (k = 0) that point is chosen as if they were very slightly curved
(flat_regularisation), so that it moves smoothly with the tilt of the wedge. The more curved, the
softer is the wedge against tilting, and the longer may a time step be; but the overlap counts at that point,
which in a tilted wedge is not where it is largest, so that the curvature should stay below the overlap.
"""

from dataclasses import dataclass

import numpy as np
import yade
from yade import O, Vector3

from potential_particles import body, shapes, use_joints

import settings
from stepping import advance

# With LAW=joint in the environment contacts are patches with the law of joints, which gives way to tilting: with
# OVERLAP_OF_JOINTS of the overlap of points, on a square of the size. Without dashpots a wedge that slides swings on
# its springs, and YADE's damping, which takes half of all that speeds it up and gives half to what slows it, makes a
# drag of that: near the limit it crept.
JOINTS = settings.choice("LAW", "point", ("point", "joint"), "law") == "joint"
OVERLAP_OF_JOINTS = 0.1
RESTITUTION_OF_JOINTS = 0.3

GRAVITY = 9.81  # m/s^2
WEDGE, BLOCK_A, BLOCK_B, BASE = range(4)  # ids
FREE_MASK, FIXED_MASK, FIXED_ONLY = 0b01, 0b11, 0b10

DAMPING = 0.5  # YADE's local damping: on what is out of balance, so that rest and limit stay as they are
# Of the faces between which k = 0 particles choose their contact point, over the overlap: depth lost
# within a length of the order of the size.
REGULARISED_BULGE = 0.05
# Of the time in which the stiffest motion, springs or tilting, turns one radian.
SPRING_STEP, TILT_STEP = 0.15, 0.8


@dataclass
class Joint:
    """What one joint carries: forces on the wedge, N, world frame; `normal` into the wedge."""

    normal: np.ndarray
    normal_force: float
    shear_force: np.ndarray
    point: np.ndarray
    overlap: float


class WedgeScene:
    """Empties YADE's scene and fills it with the blocks of a case (see wedge_cases.py)."""

    def __init__(self, case, blocks, contact, regularise=True):
        O.reset()
        self.case, self.blocks, self.contact = case, blocks, contact
        self.failures = 0  # of functors that loading a saved state replaced
        self.rounding = case.rounding * case.size
        material = yade.FrictMat(young=1.0, poisson=1.0, frictionAngle=0.0, density=case.density)
        O.materials.append(material)
        radii = []
        for polyhedron in (blocks.wedge, blocks.block_a, blocks.block_b, blocks.base):
            block = self._body(polyhedron, material, free=not radii)
            O.bodies.append(block)
            radii.append(block.shape.boundingRadius)
        state = O.bodies[WEDGE].state
        self.weight = state.mass * GRAVITY
        self.overlap = case.overlap * case.size * (OVERLAP_OF_JOINTS if JOINTS else 1.0)
        self.stiffness = self.weight / self.overlap
        regularisation = REGULARISED_BULGE * self.overlap / self.rounding if regularise else 0.0
        if regularise and case.sphericity == 0.0 and not JOINTS:
            contact.functor.flatRegularisation = regularisation
        O.engines = self._engines()
        if JOINTS:
            per_area = self.stiffness / case.size**2
            use_joints(normalStiffness=per_area, shearStiffness=case.shear_ratio * per_area,
                       restitution=RESTITUTION_OF_JOINTS)
        contact.prepare()
        O.dt = self._time_step(state, radii, regularisation)

    def _engines(self):
        def value(number):
            return yade.MatchMaker(algo="val", val=float(number))

        physics = yade.Ip2_FrictMat_FrictMat_FrictPhys(
            kn=value(self.stiffness), ks=value(self.case.shear_ratio * self.stiffness)
        )
        return [
            yade.ForceResetter(),
            yade.InsertionSortCollider(
                [yade.PotentialParticle2AABB()],
                verletDist=0.02 * self.case.size,
                avoidSelfInteractionMask=FIXED_ONLY,
            ),
            yade.InteractionLoop(
                [self.contact.functor],
                [physics],
                # Levers of forces run to the contact point, not along the normal as for spheres.
                [yade.Law2_ScGeom_FrictPhys_CundallStrack(sphericalBodies=False)],
            ),
            yade.NewtonIntegrator(damping=DAMPING, gravity=(0.0, 0.0, -GRAVITY), exactAsphericalRot=True),
        ]

    def _body(self, polyhedron, material, free):
        """A block where it stands in the slope."""
        shape = shapes.from_planes(polyhedron.planes, rounding=self.rounding / polyhedron.size, k=self.case.sphericity)
        return body(shape, material, fixed=not free, mask=FREE_MASK if free else FIXED_MASK)

    def _time_step(self, state, radii, regularisation):
        """s; from the springs, and from the tilting of the wedge on its slightly curved faces.

        Where two faces of rounding r touch, a tilt moves the point by tilt / (r (k_A/R_A^2 + k_B/R_B^2)).
        """
        least_inertia = min(state.inertia)
        if JOINTS:
            # Of a patch as large as a section of the ball about the wedge.
            stiffness = self.stiffness * np.pi * (radii[WEDGE] / self.case.size) ** 2
            return SPRING_STEP / np.sqrt(stiffness * max(1.0 / state.mass, 0.5 * radii[WEDGE] ** 2 / least_inertia))
        springs = np.sqrt(self.stiffness / state.mass)
        curvature = min(
            self.rounding * self._curving(radius, regularisation)
            + self.rounding * self._curving(radii[WEDGE], regularisation)
            for radius in (radii[BLOCK_A], radii[BLOCK_B])
        )
        tilting = np.sqrt(self.weight / (max(curvature, 1e-300) * least_inertia))
        return min(SPRING_STEP / springs, TILT_STEP / tilting)

    def _curving(self, radius, regularisation):
        return max(self.case.sphericity, regularisation) / radius**2

    # --- what it does ---------------------------------------------------------------------------

    @property
    def motion(self):
        """The integrator; loading a saved state makes a new one."""
        return O.engines[-1]

    @property
    def functor(self):
        """The contact functor, likewise."""
        return O.engines[2].geomDispatcher.functors[0]

    @property
    def state(self):
        """Of the wedge."""
        return O.bodies[WEDGE].state

    def position(self):
        """Of the wedge's centroid, m."""
        return np.array(self.state.pos)

    def set_friction(self, angle):
        """Friction angle of both joints from now on, degrees."""
        radians = np.radians(angle)
        for material in O.materials:
            material.frictionAngle = radians
        for interaction in O.interactions:
            if interaction.isReal:
                interaction.phys.tangensOfFrictionAngle = np.tan(radians)
                if JOINTS:
                    interaction.phys.tangensOfResidualFrictionAngle = np.tan(radians)

    def joints(self):
        """(Joint A, Joint B); SystemExit if the wedge lost one or met the base."""
        found = {}
        for interaction in O.interactions:
            if interaction.isReal:
                found[interaction.id2] = interaction
        if set(found) != {BLOCK_A, BLOCK_B}:
            names = {BLOCK_A: "block A", BLOCK_B: "block B", BASE: "the base"}
            touched = " and ".join(names[i] for i in sorted(found)) or "nothing"
            raise SystemExit(
                f"{self.case.name}: the wedge touches {touched} instead of blocks A and B at step {O.iter:,}: the "
                "bulge of its faces is too near its overlap, or the time step too long"
            )
        return tuple(_joint(found[block]) for block in (BLOCK_A, BLOCK_B))

    def out_of_balance(self):
        """Net force on the wedge in the last step, over its weight."""
        pull = np.array([0.0, 0.0, -self.weight])
        return float(np.linalg.norm(np.array(O.forces.f(WEDGE)) + pull) / self.weight)

    def push(self, force):
        """A lasting force on the centroid of the wedge, N, in the place of the last one."""
        O.forces.setPermF(WEDGE, Vector3(*map(float, force)))

    def lay_down(self):
        """Moves the wedge, which does not move otherwise, until both joints overlap by half of W/k_n."""
        want = 0.5 * self.overlap
        across = np.array([self.blocks.plane_a.normal, self.blocks.plane_b.normal])
        self._shift(across, [-0.1 * self.rounding] * 2)
        self.motion.dead = True
        for _ in range(3):
            advance(O.iter + 1)
            self._shift(across, [joint.overlap - want for joint in self.joints()])
        self.motion.dead = False

    def _shift(self, across, distances):
        """By these distances along both normals, and not along the line."""
        self.state.pos += Vector3(*np.linalg.lstsq(across, np.array(distances), rcond=None)[0])

    def save(self, name):
        """Keeps the whole scene in memory."""
        O.saveTmp(name)

    def restore(self, name):
        """Back to a saved scene: positions, velocities, forces in the springs."""
        self.failures += self.functor.failures
        O.loadTmp(name)
        self.failures -= self.functor.failures

    def failed_contacts(self):
        """Contacts that could not be computed so far."""
        return self.failures + self.functor.failures


def _joint(interaction):
    # Body 1 is the wedge: forces of the law are those on body 2.
    geom, phys = interaction.geom, interaction.phys
    return Joint(
        normal=-np.array(geom.normal),
        normal_force=phys.normalForce.norm(),
        shear_force=-np.array(phys.shearForce),
        point=np.array(geom.contactPoint),
        overlap=geom.penetrationDepth,
    )
