# SPDX-License-Identifier: MIT OR Apache-2.0
"""Fifty particles fall into a box, and a picture of it. Run it inside YADE: yade -x -n -j1 examples/first_pile.py
(LAW=joint: with contact patches)
"""
import os

import potential_particles
from potential_particles import boundaries, packing, shapes

O.materials.append(FrictMat(young=1e8, poisson=0.3, frictionAngle=0.5, density=2600))
kinds = [shapes.cuboid((0.2, 0.15, 0.1)), shapes.platonic_solid(8, edge=0.2), shapes.random_rock(seed=1, size=0.2)]
for place in potential_particles.pack(packing.Box((-0.4, -0.4, 0), (0.4, 0.4, 1.8)), kinds, number=50):
    potential_particles.add_packing([place], color=[(0.8, 0.4, 0.2), (0.2, 0.5, 0.7),
                                                    (0.6, 0.6, 0.5)][kinds.index(place.shape)])
O.bodies.append(boundaries.box_walls((-0.4, -0.4, 0), (0.4, 0.4, 1.8)))
O.engines = [
    ForceResetter(),
    InsertionSortCollider([PotentialParticle2AABB(), Bo1_Facet_Aabb()], verletDist=0),
    InteractionLoop([Ig2_ConicPP_ConicPP_ScGeom(), Ig2_Facet_ConicPP_ScGeom()],
                    [Ip2_FrictMat_FrictMat_FrictPhys()],
                    [Law2_ScGeom_FrictPhys_CundallStrack(sphericalBodies=False)]),
    NewtonIntegrator(damping=0.3, gravity=(0, 0, -9.81), exactAsphericalRot=True),
]
if potential_particles.joints.chosen():
    potential_particles.use_joints(restitution=0.5)
O.dt = potential_particles.critical_time_step()
O.run(int(1.0 / O.dt), wait=True)
potential_particles.plot("first_pile.png")
