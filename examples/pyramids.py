# SPDX-License-Identifier: MIT OR Apache-2.0
"""Two hundred pyramids fall into a box and come to rest, as in simulation A of Boon, Houlsby & Utili. Run it inside
YADE:

    yade -x -n -j1 examples/pyramids.py

Environment: BODIES (200), STEPS (14000), OUTPUT (out/pyramids_short), LAW (point, or joint: contact patches). Writes
three pictures and, for ParaView, pyramids.*.pvd. SI units; z up. studies/pyramids.py is the same with dashpots,
energies and a summary.
"""
import os

import potential_particles
from potential_particles import boundaries, packing, shapes
from yade import *

COUNT, STEPS = int(os.environ.get("BODIES", 200)), int(os.environ.get("STEPS", 14_000))
OUT = os.environ.get("OUTPUT", "out/pyramids_short")
EDGE = 0.1  # of the base, and height, m

os.makedirs(OUT, exist_ok=True)
O.materials.append(FrictMat(young=3e7, poisson=0.3, frictionAngle=0.52, density=2600))
half = 0.5 * EDGE
pyramid = shapes.from_vertices([(x, y, 0) for x in (-half, half) for y in (-half, half)] + [(0, 0, EDGE)],
                               rounding=0.05)

# A tower of which they fill an eighth, in a box three times as wide.
side = 0.5 * EDGE + 1.1 * EDGE * COUNT ** (1 / 3)
tower = packing.Box((-side / 2, -side / 2, 0), (side / 2, side / 2, 2 * side))
ids = potential_particles.add_packing(potential_particles.pack(tower, pyramid, number=COUNT), color=(0.25, 0.5, 0.7))
O.bodies.append(boundaries.box_walls((-1.5 * side, -1.5 * side, 0), (1.5 * side, 1.5 * side, 2 * side)))

contacts = [Ig2_ConicPP_ConicPP_ScGeom(), Ig2_Facet_ConicPP_ScGeom()]
O.engines = [
    ForceResetter(),
    InsertionSortCollider([PotentialParticle2AABB(), Bo1_Facet_Aabb()], verletDist=0),
    ConicInteractionLoop(contacts, [Ip2_FrictMat_FrictMat_FrictPhys()],
                         [Law2_ScGeom_FrictPhys_CundallStrack(sphericalBodies=False)]),
    NewtonIntegrator(damping=0.2, gravity=(0, 0, -9.81), exactAsphericalRot=True),
]
if potential_particles.joints.chosen():
    potential_particles.use_joints(restitution=0.5)
O.dt = potential_particles.critical_time_step()

record = potential_particles.Recorder(os.path.join(OUT, "pyramids"), ids=ids)
for part, end in enumerate((0, round(STEPS * 2 / 7), STEPS)):  # the steps of the paper's Fig. 3
    if end > O.iter:
        O.run(end - O.iter, wait=True)
    record()
    potential_particles.plot(os.path.join(OUT, f"pyramids_{part}.png"))

touching = sum(1 for contact in O.interactions if contact.isReal)
lost = sum(1 for i in ids if not -half < O.bodies[i].state.pos[2] < 2 * side)
failures = sum(functor.failures for functor in contacts)
print(
    f"{len(ids)} pyramids, {O.time:.2f} s: {touching} contacts, {lost} lost, {failures} failures, kinetic energy {kineticEnergy():.1e} J"
)
