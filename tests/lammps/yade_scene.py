# SPDX-License-Identifier: GPL-3.0-or-later
"""In YADE: a scene for LAMMPS by to_lammps, and where its bodies are after some steps: yade -x yade_scene.py FOLDER
HALVINGS.
"""
import math
import sys

import numpy as np
import potential_particles
import yade
from potential_particles import shapes
from yade import O

folder, halvings = sys.argv[-2], int(sys.argv[-1])
KN, KS, MU, DT, STEPS = 1e5, 6e4, 0.4, 1e-4 / 2**halvings, 400 * 2**halvings
O.materials.append(yade.FrictMat(young=1e7, poisson=0.6, frictionAngle=math.atan(MU), density=2600))
brick = shapes.cuboid((0.12, 0.1, 0.06), rounding=0.004, k=0.02)
O.bodies.append(yade.utils.wall(0, axis=2))
O.bodies.append(potential_particles.body(brick, position=(0, 0, 0.0301), velocity=(0.6, 0.1, -0.05)))
O.bodies.append(potential_particles.body(brick, position=(0.01, 0.005, 0.0905), velocity=(-0.5, 0.2, -0.1)))
physics = yade.Ip2_FrictMat_FrictMat_FrictPhys(kn=yade.MatchMaker(algo="val",
                                                                  val=KN), ks=yade.MatchMaker(algo="val", val=KS),
                                               frictAngle=yade.MatchMaker(algo="val", val=math.atan(MU)))
O.engines = [
    yade.ForceResetter(), yade.InsertionSortCollider([yade.PotentialParticle2AABB(), yade.Bo1_Wall_Aabb()]),
    yade.InteractionLoop([yade.Ig2_ConicPP_ConicPP_ScGeom(), yade.Ig2_Wall_ConicPP_ScGeom()], [physics],
                         [yade.Law2_ScGeom_FrictPhys_CundallStrack(sphericalBodies=False)]),
    yade.NewtonIntegrator(damping=0, gravity=(0, 0, -9.81), exactAsphericalRot=True),
]
O.dt = DT
potential_particles.to_lammps(folder + "/scene", KN, KS, MU)
for body in O.bodies:
    if body.id:  # a leap-frog begins half a step earlier
        body.state.vel += yade.Vector3(0, 0, 9.81 * DT / 2)
rows = []
for step in range(STEPS + 1):
    rows.append([[*O.bodies[i].state.pos, *O.bodies[i].state.ori] for i in (1, 2)])
    O.step()
np.save(folder + "/yade.npy", np.array(rows))
