# SPDX-License-Identifier: MIT OR Apache-2.0
"""A wedge on its three fixed blocks, as a YADE scene, and what the joints carry.

Joints are elastic, perfectly plastic, Mohr-Coulomb without cohesion. Each face of the wedge meets its
block in one contact point, which carries a moment only by moving to where the balance wants it.
Between exactly flat faces (k = 0) that point is chosen as if they were very slightly curved
(flat_regularisation), so that it moves smoothly with the tilt of the wedge. The more curved, the
softer is the wedge against tilting, and the longer may a time step be; but the overlap counts at that point,
which in a tilted wedge is not where it is largest, so that the curvature should stay below the overlap.
"""

from dataclasses import dataclass

import numpy as np
from potential_particles import shapes
from yade import O, Vector3

from block_scene import GRAVITY, JOINTS, Scene
from stepping import advance

# With LAW=joint in the environment contacts are patches with the law of joints, which gives way to tilting: with
# this part of the overlap of points, on a square of the size.
OVERLAP_OF_JOINTS = 0.1
WEDGE, BLOCK_A, BLOCK_B, BASE = range(4)  # ids


@dataclass
class Joint:
    """What one joint carries: forces on the wedge, N, world frame; `normal` into the wedge."""

    normal: np.ndarray
    normal_force: float
    shear_force: np.ndarray
    point: np.ndarray
    overlap: float


class WedgeScene(Scene):
    """Empties YADE's scene and fills it with the blocks of a case (see wedge_cases.py)."""

    # Of the faces between which k = 0 particles choose their contact point: depth lost within a length of the order of
    # the size, over the overlap.
    bulge, spring_step, tilt_step = 0.05, 0.15, 1.0

    def __init__(self, case, blocks):
        self.case, self.blocks = case, blocks
        self.failures = 0  # of functors that loading a saved state replaced
        made = [
            shapes.from_planes(one.planes, rounding=case.rounding * case.size / one.size, k=case.sphericity)
            for one in (blocks.wedge, blocks.block_a, blocks.block_b, blocks.base)
        ]
        super().__init__(case.size, made[0].volume, rounding=case.rounding, sphericity=case.sphericity,
                         overlap=case.overlap * (OVERLAP_OF_JOINTS if JOINTS else 1.0), shear=case.shear_ratio,
                         density=case.density)
        for shape in made:
            self.add(shape, fixed=shape is not made[0])
        self.weight = self.state.mass * GRAVITY
        self.start(friction=0.0)

    @property
    def state(self):
        """Of the wedge."""
        return O.bodies[WEDGE].state

    def position(self):
        """Of the wedge's centroid, m."""
        return np.array(self.state.pos)

    def joints(self):
        """(Joint A, Joint B); SystemExit if the wedge lost one or met the base."""
        found = {one.id2: one for one in O.interactions if one.isReal}
        if set(found) != {BLOCK_A, BLOCK_B}:
            names = {BLOCK_A: "block A", BLOCK_B: "block B", BASE: "the base"}
            touched = " and ".join(names[i] for i in sorted(found)) or "nothing"
            raise SystemExit(
                f"{self.case.name}: the wedge touches {touched} instead of blocks A and B at step {O.iter:,}: the "
                "bulge of its faces is too near its overlap, or the time step too long")
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
