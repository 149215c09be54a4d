# SPDX-License-Identifier: MIT OR Apache-2.0
"""Angle of repose: a cylinder full of rocks is lifted from a rough floor. yade -x -n -j2 examples/repose.py

Environment: BODIES (600), FRICTION (30 degrees), SEED (0), OUTPUT (out/repose). Writes repose.png and summary.json. SI
    units; z up.
"""
import os

import numpy as np
import potential_particles
from matplotlib import pyplot
from potential_particles import boundaries, files, packing, shapes
from yade import *
from yade import utils

COUNT, FRICTION, OUT = int(os.environ.get("BODIES",
                                          600)), float(os.environ.get("FRICTION",
                                                                      30)), os.environ.get("OUTPUT", "out/repose")
DIAMETER, RADIUS, LIFT = 0.03, 0.03 * (0.12
                                       * COUNT)**(1 / 3), 0.15  # of a ball of a rock's volume, of the cylinder, m; m/s
for label, angle in ("rough", FRICTION), ("smooth", 0):
    O.materials.append(FrictMat(young=1e7, poisson=0.3, frictionAngle=np.radians(angle), density=2650, label=label))
kinds = [shapes.random_rock(seed, elongation=0.8, flatness=0.75) for seed in range(8)]
rocks = potential_particles.pack(packing.Cylinder((0, 0, 0), 0.95 * RADIUS, 10 * RADIUS), kinds, sizes=DIAMETER,
                                 number=COUNT, seed=int(os.environ.get("SEED", 0)))
ids = potential_particles.add_packing(rocks, material="rough", color=(0.75, 0.6, 0.42))
O.bodies.append(utils.wall(0, axis=2, material="rough"))
tube = O.bodies.append(boundaries.funnel(RADIUS, RADIUS, 10 * RADIUS, material="smooth", sides=24,
                                         mask=3))  # 2 is theirs alone: no pairs of two facets
O.engines = [
    ForceResetter(),
    InsertionSortCollider(
        [PotentialParticle2AABB(), Bo1_Wall_Aabb(), Bo1_Facet_Aabb()], verletDist=0, avoidSelfInteractionMask=2),
    ConicInteractionLoop(
        [Ig2_ConicPP_ConicPP_ScGeom(),
         Ig2_Wall_ConicPP_ScGeom(), Ig2_Facet_ConicPP_ScGeom()], [Ip2_FrictMat_FrictMat_FrictPhys()],
        [Law2_ScGeom_FrictPhys_CundallStrack(sphericalBodies=False)]),
    potential_particles.time_stepper(safety=0.8),
    NewtonIntegrator(damping=0.2, gravity=(0, 0, -9.81), exactAsphericalRot=True)
]

while O.time < 0.8 or utils.unbalancedForce() > 0.02 and O.time < 3:
    O.run(250, True)
for i in tube:
    O.bodies[i].state.vel = Vector3(0, 0, LIFT)
end = O.time + 1.2 * max(O.bodies[i].state.pos[2] for i in ids) / LIFT
while O.time < end or utils.unbalancedForce() > 0.02 and O.time < end + 3:
    O.run(250, True)

# The surface: the highest rock of each ring; the slope is that of its middle part, where the heap is a cone.
places = np.array([O.bodies[i].state.pos for i in ids])
distance = np.hypot(*(places[:, :2] - np.median(places[:, :2], axis=0)).T)
edge = np.quantile(distance, 0.9)
rings = np.linspace(0.1 * edge, 0.95 * edge, 9)
within = [(distance >= a) & (distance < b) for a, b in zip(rings, rings[1:])]
surface = np.array([(distance[one].mean(), np.quantile(places[one, 2], 0.95) + 0.5 * DIAMETER) for one in within
                    if one.any()])
# Few rocks are in the inner rings, and the highest of few lies deep: a ring counts by its rocks.
slope, base = np.polyfit(*surface.T, 1, w=[np.sqrt(one.sum()) for one in within if one.any()])
summary = {
    "bodies": len(ids), "steps": O.iter, "angle_of_repose": np.degrees(np.arctan(-slope)), "radius": edge,
    "below_floor": int((places[:, 2] < 0).sum())
}
os.makedirs(OUT, exist_ok=True)
potential_particles.plot(os.path.join(OUT, "heap.png"), size=(800, 500), bodies=ids, towards=(0.3, -0.9, 0.25))
picture, (left, right) = pyplot.subplots(1, 2, figsize=(10, 3.4), layout="constrained")
left.imshow(pyplot.imread(os.path.join(OUT, "heap.png")))
left.axis("off")
right.plot(distance, places[:, 2], ".", ms=2, color="0.6", label="centres of rocks")
right.plot(*surface.T, "o", label="surface")
right.plot(rings, base + slope * rings, label=f"{summary['angle_of_repose']:.1f} degrees")
right.set(xlabel="from the axis, m", ylabel="height, m", aspect="equal", ylim=0)
right.legend()
picture.savefig(os.path.join(OUT, "repose.png"), dpi=110)
files.write_summary(os.path.join(OUT, "summary.json"), summary)
print(summary)
