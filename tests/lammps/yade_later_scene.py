# SPDX-License-Identifier: GPL-3.0-or-later
"""In YADE: bonded blocks that have made steps, carried over by to_lammps, and where they are later: yade -x
yade_later_scene.py FOLDER.
"""
import sys

import numpy as np
import potential_particles
import yade
from potential_particles import shapes
from yade import O

folder = sys.argv[-1]
DT, STEPS = 1e-5, 400
O.materials.append(
    yade.ConicJointMat(normalStiffness=1e9, shearStiffness=5e8, frictionAngle=0.4, density=2600, cohesion=1e5,
                       tensileStrength=1e5))
cube = shapes.cuboid((0.1, 0.1, 0.1), rounding=0.004, k=0)
# A held block with two bonded to it, whose end a lasting force pulls; a block on one that is held and moves; a block
# before a wall that moves.
for position, held, velocity in (((0, 0, 0), True, (0, 0, 0)), ((0.1 - 1e-6, 0, 0), False, (0, 0, 0)),
                                 ((0.2 - 2e-6, 0, 0), False, (0, 0, 0)), ((0, 0.5, 0), True, (0, 0, 0.1)),
                                 ((0, 0.5, 0.1 - 1e-6), False, (0, 0, 0)), ((0, 1, 0), False, (0, 0, 0))):
    O.bodies.append(potential_particles.body(cube, position=position, velocity=velocity, fixed=held))
O.bodies.append(yade.utils.wall(1.05 + 1e-5, axis=1))
O.bodies[-1].state.vel = (0, -0.2, 0)
O.engines = [
    yade.ForceResetter(),
    yade.InsertionSortCollider([yade.PotentialParticle2AABB(), yade.Bo1_Wall_Aabb()]),
    yade.InteractionLoop([
        yade.Ig2_ConicPP_ConicPP_ScGeom(patch=True, patchTolerance=1e-7),
        yade.Ig2_Wall_ConicPP_ScGeom(patch=True, patchTolerance=1e-7)
    ], [yade.Ip2_ConicJointMat_ConicJointMat_ConicJointPhys(bonds=True)], [yade.Law2_ScGeomConicPP_ConicJointPhys()]),
    yade.NewtonIntegrator(damping=0, exactAsphericalRot=True),
]
O.dt = DT
for _ in range(5):
    O.step()
O.forces.setPermF(2, (40, 0, 0))
O.bodies[-1].state.vel = (0, -0.3, 0)
potential_particles.to_lammps(folder + "/scene")
rows = []
for step in range(STEPS + 1):
    rows.append([O.bodies[i].state.pos for i in range(6)])
    O.step()
np.savez(folder + "/yade.npz", rows=np.array(rows, float), bonds=sum(i.phys.bonded for i in O.interactions if i.isReal))
