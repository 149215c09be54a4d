# SPDX-License-Identifier: MIT OR Apache-2.0
"""Rocks flow out of a silo with a flat floor through slots of three widths, beside the law of Beverloo.

    yade -x -n -j2 examples/silo.py

Environment: BODIES (500), SLOTS (5 6 7, over the size of a rock), SHARE (0.35, of the rocks that flow out of each),
SEED (0), OUTPUT (out/silo). The silo is a slice between two smooth walls. Ctrl-C keeps what there is. Writes silo.png
and summary.json. SI units; z up.
"""
import os

import numpy as np
import potential_particles
from matplotlib import pyplot
from potential_particles import boundaries, files, packing, progress, shapes
from yade import *
from yade import utils

COUNT, SHARE = int(os.environ.get("BODIES", 500)), float(os.environ.get("SHARE", 0.35))
OUT, SEED = os.environ.get("OUTPUT", "out/silo"), int(os.environ.get("SEED", 0))
SIZE, G = 0.03, 9.81  # of a ball of a rock's volume, m; m/s2
SLOTS, WIDTH, DEPTH = np.array(os.environ.get("SLOTS", "5 6 7").split(), float) * SIZE, 16 * SIZE, 3 * SIZE  # m
GRAINS = potential_particles.suggest("rock", size=SIZE, fall=SIZE, overlap=0.5)
for label, angle in ("rough", GRAINS.friction_angle), ("smooth", 0):
    O.materials.append(FrictMat(**dict(GRAINS.frict_mat(), frictionAngle=angle), label=label))
kinds = [shapes.random_rock(seed, elongation=0.8, flatness=0.75) for seed in range(12)]
box = packing.Box((-WIDTH / 2, 0, 0), (WIDTH / 2, DEPTH, 0.06 * COUNT * SIZE))
rocks = potential_particles.pack(box, kinds, sizes=SIZE, number=COUNT, dense=True, seed=SEED)
ids = potential_particles.add_packing(rocks, material="rough", color=(0.72, 0.58, 0.42))
O.bodies.append([utils.wall(place, axis=1, material="smooth") for place in (0, DEPTH)] +
                [utils.wall(place, axis=0, material="rough") for place in (-WIDTH / 2, WIDTH / 2)])
# The floor in strips between the edges of all slots: those within a slot are taken out to open it.
edges = np.sort([-WIDTH / 2, *-SLOTS / 2, *SLOTS / 2, WIDTH / 2])
floor = {i: abs(a + b) / 2 for a, b in zip(edges, edges[1:])
         for i in O.bodies.append(boundaries.plate((a, 0, 0), (b - a, 0, 0), (0, DEPTH, 0), material="rough", mask=3))}
O.engines = [
    ForceResetter(),
    InsertionSortCollider([PotentialParticle2AABB(), Bo1_Wall_Aabb(), Bo1_Facet_Aabb()], verletDist=0,
                          avoidSelfInteractionMask=2),  # no pairs of two facets, whose mask has the 2
    ConicInteractionLoop([Ig2_ConicPP_ConicPP_ScGeom(), Ig2_Wall_ConicPP_ScGeom(), Ig2_Facet_ConicPP_ScGeom()],
                         [Ip2_FrictMat_FrictMat_FrictPhys()],
                         [Law2_ScGeom_FrictPhys_CundallStrack(sphericalBodies=False)]),
    potential_particles.time_stepper(safety=0.8),
    NewtonIntegrator(damping=0.1, dampGravity=False, gravity=(0, 0, -G), exactAsphericalRot=True)
]
while O.time < 0.3 or utils.unbalancedForce() > 0.06 and O.time < 0.6:
    O.run(500, True)
low, high = (-WIDTH / 2, 0, SIZE), (WIDTH / 2, DEPTH, 0.8 * potential_particles.extrema(ids)[1][2])
density = GRAINS.density * (1 - potential_particles.sampled_porosity(low, high)[0])
mass = O.bodies[ids[0]].state.mass  # rocks have one volume
O.saveTmp("full")
flows, bar = {}, progress.Bar(100 * len(SLOTS), True, "%", "flow")
with progress.Interrupts() as stopped:
    for number, slot in enumerate(SLOTS):
        O.loadTmp("full")
        for i in [i for i, place in floor.items() if place < slot / 2]:
            O.bodies.erase(i)
        begin, rows, last = O.time, [(0.0, 0)], O.time
        while not stopped and rows[-1][1] < SHARE * len(ids) and O.time - last < 0.5:
            O.run(20, True)
            rows.append((O.time - begin, sum(O.bodies[i].state.pos[2] < 0 for i in ids)))
            last = O.time if rows[-1][1] > rows[-2][1] else last
            bar.reached(int(100 * (number + rows[-1][1] / (SHARE * len(ids)))))
        rows = np.array([row for row in rows if row[0] > 1.5 * np.sqrt(slot / G)])  # it is steady
        if O.time - last < 0.5 and len(rows) > 8:
            parts = [mass * np.polyfit(*part.T, 1)[0] for part in np.array_split(rows, 4)]
            flows[slot / SIZE] = mass * np.polyfit(*rows.T, 1)[0], np.std(parts) / 2
        said = f"{flows[slot / SIZE][0]:.3g} kg/s" if slot / SIZE in flows else "jammed, or stopped"
        print(f"slot of {slot / SIZE:g} rocks: {said}", flush=True)
bar.close()
if not flows:
    raise SystemExit("no slot had a steady flow")
# W = C rho b sqrt(g) (D - k d)^(3/2): with C = 1.03, that of slots (Nedderman 1992), k of each slot; and C and k from
# all of them, by a line through W^(2/3).
widths, (rates, scatter) = np.array(list(flows)), np.array(list(flows.values())).T
unit = density * DEPTH * np.sqrt(G) * SIZE**1.5  # of a slot as wide as a rock, kg/s
k = widths - (rates / (1.03 * unit))**(2 / 3)
slope, start = np.polyfit(widths, (rates / unit)**(2 / 3), 1) if len(widths) > 1 else (np.nan, np.nan)
summary = {
    "bodies": len(ids), "density": density, "slots_over_size": widths.tolist(), "rates_kg_per_s": rates.tolist(),
    "scatter_kg_per_s": scatter.tolist(), "k_with_C_of_1.03": k.tolist(), "C": slope**1.5, "k": -start / slope,
    "overlap_over_r": potential_particles.overlap_ratio()
}
os.makedirs(OUT, exist_ok=True)
shown = [i for i in ids if O.bodies[i].state.pos[2] > -5 * SIZE]
potential_particles.plot(os.path.join(OUT, "rocks.png"), size=(700, 600), bodies=shown, colour="velocity",
                         scale_bar=True, towards=(0.1, -1, 0.1))
picture, (left, right) = pyplot.subplots(1, 2, figsize=(9, 4), layout="constrained")
left.imshow(pyplot.imread(os.path.join(OUT, "rocks.png")))
left.axis("off")
along = np.linspace(max(3, k.mean()), widths.max() + 1)
right.fill_between(along, *(1.03 * unit * (along - one)**1.5 for one in (1.4, 3)), alpha=0.2,
                   label="Beverloo: C = 1.03, k from 1.4 to 3")
right.plot(along, 1.03 * unit * (along - k.mean())**1.5, label=f"C = 1.03, k = {k.mean():.2f}")
right.errorbar(widths, rates, scatter, fmt="o", capsize=4, label="measured")
right.set(xlabel="width of the slot / size of a rock", ylabel="rate of flow, kg/s", ylim=0)
right.legend()
picture.savefig(os.path.join(OUT, "silo.png"), dpi=110)
files.write_summary(os.path.join(OUT, "summary.json"), summary)
print(summary)
