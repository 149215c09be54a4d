# SPDX-License-Identifier: GPL-3.0-or-later
"""In YADE: blocks with joints, carried over by to_lammps, and where they are after some steps: yade -x
yade_patch_scene.py FOLDER HALVINGS.
"""
import math
import sys

import numpy as np
import potential_particles
import yade
from potential_particles import shapes
from yade import O

folder, halvings = sys.argv[-2], int(sys.argv[-1])
DT, STEPS = 2e-5 / 2**halvings, 250 * 2**halvings
O.materials.append(
    yade.ConicJointMat(normalStiffness=1e9, shearStiffness=5e8, frictionAngle=math.atan(0.4), restitution=0.4,
                       density=2600, cohesion=2e4, tensileStrength=3e4, residualFrictionAngle=math.atan(0.3),
                       residualCohesion=1e3))
brick = shapes.cuboid((0.12, 0.1, 0.06), rounding=0.004, k=0.02)
O.bodies.append(yade.utils.wall(0, axis=2))
# Two that are bonded, one that slides on them, and one that hits their end with an edge.
for position, velocity, turn in (((0, 0, 0.03), (0.3, 0, 0), 0), ((0.12 - 1e-6, 0, 0.03), (0.3, 0, 0), 0),
                                 ((0.05, 0.01, 0.0905), (-0.4, 0.2, -0.3), 0.2), ((0.2605, 0.02, 0.035), (-0.6, 0.1,
                                                                                                          -0.2), 0.6)):
    body = potential_particles.body(brick, position=position, velocity=velocity)
    body.state.ori = yade.Quaternion((0, 0, 1), turn)
    O.bodies.append(body)
O.engines = [
    yade.ForceResetter(),
    yade.InsertionSortCollider([yade.PotentialParticle2AABB(), yade.Bo1_Wall_Aabb()]),
    yade.InteractionLoop([
        yade.Ig2_ConicPP_ConicPP_ScGeom(patch=True, patchTolerance=1e-7),
        yade.Ig2_Wall_ConicPP_ScGeom(patch=True, patchTolerance=1e-7)
    ], [yade.Ip2_ConicJointMat_ConicJointMat_ConicJointPhys(bonds=True)], [yade.Law2_ScGeomConicPP_ConicJointPhys()]),
    yade.NewtonIntegrator(damping=0, gravity=(0, 0, -9.81), exactAsphericalRot=True),
]
O.dt = DT
potential_particles.to_lammps(folder + "/scene")
for body in O.bodies:
    if body.id:  # a leap-frog begins half a step earlier
        body.state.vel += yade.Vector3(0, 0, 9.81 * DT / 2)
rows, bonds = [], []
for step in range(STEPS + 1):
    rows.append([[*O.bodies[i].state.pos, *O.bodies[i].state.ori] for i in (1, 2, 3, 4)])
    O.step()
    bonds.append(sum(i.phys.bonded for i in O.interactions if i.isReal))
np.savez(folder + "/yade.npz", rows=np.array(rows), bonds=np.array(bonds))
