# SPDX-License-Identifier: MIT OR Apache-2.0
"""Rocks flow out of a hopper: both come from STL files, and the mass that has left is recorded. With INLET they first
fall in, while the outlet is closed.

    yade -x -n -j2 examples/hopper.py

Environment: BODIES (500), STEPS (25000), OUTPUT (out/hopper), LAW (point, or joint: contact patches), ROCK and HOPPER
(.stl files: a closed convex rock of any size; a hopper in m whose axis is z and whose outlet lies at z = 0), INLET (0;
rocks a second). Writes hopper.png (rocks half way, mass and rate of flow against time), with INLET inlet.png (the hopper
as it fills), flow.csv and summary.json. SI units; z up.
"""
import os
import sys
import time

import matplotlib
import numpy as np
import potential_particles
from potential_particles import boundaries, files, packing, shapes
from yade import *
from yade import ymport

matplotlib.use("Agg")
import matplotlib.pyplot as plt

HERE = os.path.dirname(os.path.abspath(sys.argv[0]))
RATE = float(os.environ.get("INLET", 0))
COUNT, STEPS = int(os.environ.get("BODIES", 500)), int(os.environ.get("STEPS", 25_000))
OUT = os.environ.get("OUTPUT", "out/hopper")
ROCK, HOPPER = (os.environ.get(name) or os.path.join(HERE, "data", f"{name.lower()}.stl")
                for name in ("ROCK", "HOPPER"))
DIAMETER = 0.06  # of a ball of a rock's volume, m
GONE = -0.6  # height below which a rock has left the scene, m

os.makedirs(OUT, exist_ok=True)
O.materials.append(FrictMat(young=2e7, poisson=0.3, frictionAngle=np.radians(25), density=2650))
walls = O.bodies.append(ymport.stl(HOPPER, wire=False))
for i in walls:
    O.bodies[i].mask = 3  # 2 is theirs alone: no pairs of two facets (the collider's avoidSelfInteractionMask)
# Vertices of a facet are given from its centre.
corners = np.array([O.bodies[i].state.pos + vertex for i in walls for vertex in O.bodies[i].shape.vertices])
top, radius = corners[:, 2].max(), np.hypot(corners[:, 0], corners[:, 1]).max()
rock, color = shapes.from_mesh(ROCK), (0.75, 0.55, 0.35)

contacts = [Ig2_ConicPP_ConicPP_ScGeom(), Ig2_Facet_ConicPP_ScGeom()]
O.engines = [
    ForceResetter(),
    BoundWatch(),  # sees bodies that turn out of their boxes, so that the collider may rest
    InsertionSortCollider([Bo1_ConicPP_Aabb(), Bo1_Facet_Aabb()], verletDist=0.05 * DIAMETER,
                          avoidSelfInteractionMask=2),
    ConicInteractionLoop(contacts, [Ip2_FrictMat_FrictMat_FrictPhys()],
                         [Law2_ScGeom_FrictPhys_CundallStrack(sphericalBodies=False)]),
    NewtonIntegrator(damping=0.1, gravity=(0, 0, -9.81), exactAsphericalRot=True),
]
if RATE:
    gate = O.bodies.append(boundaries.plate((-radius, -radius, 0), (2 * radius, 0, 0), (0, 2 * radius, 0), mask=3))
    inlet = potential_particles.Inlet(packing.Cylinder((0, 0, top), 0.8 * radius, 4 * DIAMETER), rock, sizes=DIAMETER,
                                      rate=RATE, number=COUNT, velocity=(0, 0, -2), color=color)
    O.engines = [inlet.engine] + O.engines
    ids = set(inlet.look())  # the first one, from which the time step follows
else:
    above = packing.Cylinder((0, 0, 0.4 * top), 0.95 * radius, max(0.6 * top, 0.0014 * COUNT))
    rocks = potential_particles.pack(above, rock, sizes=DIAMETER, number=COUNT, obstacles=O.bodies)
    ids = set(potential_particles.add_packing(rocks, color=color))
mass = O.bodies[next(iter(ids))].state.mass
if potential_particles.joints.chosen():
    potential_particles.use_joints(restitution=0.5)
O.dt = potential_particles.critical_time_step()

if RATE:
    filling, views = [], []
    while not inlet.finished:
        O.run(200, wait=True)
        filling.append((O.time, inlet.born_mass))
        if inlet.born * 3 >= COUNT * (len(views) + 1):
            views.append(os.path.join(OUT, f"filling_{len(views)}.png"))
            potential_particles.plot(views[-1], size=(500, 640), bodies=[b.id for b in O.bodies if b.id not in gate])
    figure, axes = plt.subplots(1, len(views) + 1, figsize=(12, 4), dpi=110)
    for axis, view in zip(axes, views):
        axis.imshow(plt.imread(view))
        axis.set_axis_off()
    axes[-1].plot(*np.array(filling).T)
    axes[-1].set(xlabel="time, s", ylabel="mass that has come, kg")
    figure.tight_layout()
    figure.savefig(os.path.join(OUT, "inlet.png"))
    for i in gate:
        O.bodies.erase(i)
    ids = {b.id for b in O.bodies if isinstance(b.shape, ConicPotentialParticle)}
flow, through, beside, stepping = [], 0, 0, 0.0
looks = 50
for look in range(looks):
    begin = time.perf_counter()
    O.run(max(STEPS // looks, 1), wait=True)
    stepping += time.perf_counter() - begin
    for i in [i for i in ids if O.bodies[i].state.pos[2] < GONE]:
        ids.discard(i)
        O.bodies.erase(i)
        through += 1
    positions = np.array([O.bodies[i].state.pos for i in ids]).reshape(-1, 3)
    out = positions[:, 2] < 0
    flow.append((O.time, mass * (through + out.sum())))
    # Below the outlet they may be anywhere; above it only inside.
    beside = max(beside, int((np.hypot(*positions[~out, :2].T) > radius).sum()))
    if look == looks // 2:
        potential_particles.plot(os.path.join(OUT, "rocks.png"), size=(700, 900))

times, masses = np.array(flow).T
rate = np.gradient(masses, times)
np.savetxt(os.path.join(OUT, "flow.csv"), np.column_stack([times, masses, rate]), delimiter=",",
           header="time_s,mass_kg,rate_kg_per_s", comments="")
figure, (left, right) = plt.subplots(1, 2, figsize=(11, 6.2), gridspec_kw={"width_ratios": (0.8, 1)}, dpi=110)
left.imshow(plt.imread(os.path.join(OUT, "rocks.png")))
left.set_axis_off()
right.plot(times, masses, label="mass that has left, kg")
right.plot(times, rate, label="rate of flow, kg/s")
right.set_xlabel("time, s")
right.legend()
figure.tight_layout()
figure.savefig(os.path.join(OUT, "hopper.png"))

summary = {
    "bodies": COUNT if RATE else len(rocks),
    "facets": len(walls),
    "steps": O.iter,
    "time_step_s": O.dt,
    "seconds_a_step": stepping / STEPS,
    "failures": sum(functor.failures for functor in contacts),
    "rocks_beside_the_hopper": beside,
    "mass_kg": mass * (COUNT if RATE else len(rocks)),
    "mass_out_kg": masses[-1],
    "largest_rate_kg_per_s": rate.max(),
}
files.write_summary(os.path.join(OUT, "summary.json"), summary)
print(f"{summary}\nResults in {OUT}")
