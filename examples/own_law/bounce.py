# SPDX-License-Identifier: MIT OR Apache-2.0
"""A ball and a rock bounce on a wall by a law of one's own:

    cmake -S examples/own_law -B out/own_law && cmake --build out/own_law
    PYTHONPATH=out/own_law yade -x -n examples/own_law/bounce.py

Prints the speed of the ball after the impact over that before, which is the restitution of the law.
"""
import potential_particles
from own_law import Law2_ScGeom_FrictPhys_Restitution
from potential_particles import shapes
from yade import *

RESTITUTION, SPEED = 0.6, 2.0
O.materials.append(FrictMat(**potential_particles.suggest("rock", size=0.1, fall=0.3).frict_mat()))
O.bodies.append(utils.wall(0.0, axis=2, sense=1))
ball = O.bodies.append(potential_particles.body(shapes.sphere(0.05), position=(0, 0, 0.051)))
rock = O.bodies.append(potential_particles.body(shapes.random_rock(seed=1, size=0.1), position=(1, 0, 0.08)))
for one in (ball, rock):
    O.bodies[one].state.vel = (0, 0, -SPEED)
law = Law2_ScGeom_FrictPhys_Restitution(restitution=RESTITUTION)
O.engines = [
    ForceResetter(),
    InsertionSortCollider([PotentialParticle2AABB(), Bo1_Wall_Aabb()], verletDist=0),
    ConicInteractionLoop([Ig2_ConicPP_ConicPP_ScGeom(), Ig2_Wall_ConicPP_ScGeom()],
                         [Ip2_FrictMat_FrictMat_FrictPhys()], [law]),
    NewtonIntegrator(damping=0, exactAsphericalRot=True),
]
O.dt = 0.05 * potential_particles.critical_time_step()
O.run(round(0.02 / O.dt), wait=True)
found = O.bodies[ball].state.vel[2] / SPEED
print(f"restitution of the ball {found:.4f}, of the law {law.restitution}; "
      f"the rock moves on at {O.bodies[rock].state.vel[2]:.2f} m/s")
O.saveTmp()
O.loadTmp()
assert O.engines[2].lawDispatcher.functors[0].restitution == RESTITUTION
