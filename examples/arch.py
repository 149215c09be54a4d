# SPDX-License-Identifier: MIT OR Apache-2.0
"""A round arch of fifteen stones comes to rest, and a picture of the pressure in its joints. Run it inside YADE: yade
-x -n -j1 examples/arch.py
"""
import numpy as np
import potential_particles
from potential_particles import shapes

STONES, RADIUS, THICKNESS, DEPTH = 15, 1.0, 0.18, 0.45  # m

O.materials.append(ConicJointMat(young=2e9, poisson=0.3, frictionAngle=0.7, restitution=0.3, density=2400))
angles = np.pi / STONES * np.arange(-1, STONES + 2)
for number, ends in enumerate(zip(angles, angles[1:])):
    corners = [(r * np.cos(angle), y, r * np.sin(angle)) for angle in ends
               for r in (RADIUS - THICKNESS / 2, RADIUS + THICKNESS / 2) for y in (-DEPTH / 2, DEPTH / 2)]
    O.bodies.append(
        potential_particles.body(shapes.from_vertices(corners, rounding=0.005, k=0), fixed=number in (0, STONES + 1),
                                 color=(0.85, 0.78, 0.66)))
O.engines = [
    ForceResetter(),
    InsertionSortCollider([PotentialParticle2AABB()], verletDist=0),
    ConicInteractionLoop([Ig2_ConicPP_ConicPP_ScGeom(patch=True)],
                         [Ip2_ConicJointMat_ConicJointMat_ConicJointPhys()],
                         [Law2_ScGeomConicPP_ConicJointPhys()]),
    NewtonIntegrator(damping=0.3, gravity=(0, 0, -9.81), exactAsphericalRot=True),
]
O.dt = potential_particles.critical_time_step()
O.run(int(0.5 / O.dt), wait=True)
print(f"{O.iter} steps, fastest stone {max(body.state.vel.norm() for body in O.bodies):.1e} m/s")
found = potential_particles.limit_analysis("load", push=(1, 0, 0))
print(f"it would bear {found.factor:.3f} g sideways")
potential_particles.plot("arch.png", patches=True, towards=(0.5, -0.8, 0.3), size=(1000, 640))
