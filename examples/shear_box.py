# SPDX-License-Identifier: MIT OR Apache-2.0
"""Direct shear of rocks in a box of two halves, at three normal stresses: yade -x -n -j2 examples/shear_box.py

Environment: BODIES (300), STRESSES (2.5e4 5e4 1e5, Pa), WAY (0.1, of the box's length), SEED (0), OUTPUT (out/shear_box).
The lower half stays, the upper one is driven along x with its lid, which moves up and down to keep the normal stress;
no gravity. Published for angular rock: 40 to 50 degrees at the peak, 33 to 40 at the end. Ctrl-C keeps what there is.
Writes shear_box.png and summary.json. SI units; z up.
"""
import os
import time

import numpy as np
import potential_particles
from matplotlib import pyplot
from potential_particles import boundaries, files, packing, progress, shapes
from yade import *
from yade import utils

COUNT, WAY, OUT, SEED, STRESSES = (kind(os.environ.get(name, value)) for kind, name, value in (
    (int, "BODIES", 300), (float, "WAY", 0.1), (str, "OUTPUT", "out/shear_box"), (int, "SEED", 0), (str.split, "STRESSES", "2.5e4 5e4 1e5")))
SIZE = 0.03  # of a ball of a rock's volume, m
LENGTH, WIDTH, SPLIT = SIZE * (COUNT / 300)**(1 / 3) * np.array((10, 4.5, 2.9))  # of the box; half its height, m
GRAINS = potential_particles.suggest("rock", size=SIZE, load=4 * max(map(float, STRESSES)) * SIZE**2, overlap=0.3)


def half(low, high, shelf):
    """Both ends of a half, and beside one of them a shelf that keeps rocks in."""
    ends = ([0, 0, low], [0, WIDTH, 0], [0, 0, high - low]), ([LENGTH, 0, low], [0, 0, high - low], [0, WIDTH, 0]), shelf
    # The mask's 2 is theirs alone: no pairs of two facets.
    return O.bodies.append([one for end in ends for one in boundaries.plate(*end, material="smooth", mask=3)])


def stresses():
    """Shear and normal stress on the lower half, kPa."""
    force = sum(np.array(O.forces.f(i)) for i in lower)
    return 1e-3 * force[0] / (LENGTH * WIDTH), -1e-3 * force[2] / (LENGTH * WIDTH)


results, start, most, bar = {}, time.perf_counter(), 0.0, progress.Bar(100 * len(STRESSES), True, "%", "shear")
with progress.Interrupts() as stopped:
    for number, stress in enumerate(map(float, STRESSES)):
        O.reset()
        for label, angle in ("smooth", 0), ("rough", GRAINS.friction_angle), ("rocks", 0):
            O.materials.append(FrictMat(**dict(GRAINS.frict_mat(), frictionAngle=angle), label=label))
        kinds = [shapes.random_rock(seed, elongation=0.75, flatness=0.7) for seed in range(12)]
        space = packing.Box((0, 0, 0), (LENGTH, WIDTH, 5 * SPLIT))
        rocks = potential_particles.pack(space, kinds, sizes=SIZE, number=COUNT, dense=True, seed=SEED + number)
        ids = potential_particles.add_packing(rocks, material="rocks", color=(0.72, 0.58, 0.42))
        O.bodies.append([utils.wall(place, axis=1, material="smooth") for place in (0, WIDTH)])
        lower = half(0, SPLIT, ([LENGTH, 0, SPLIT], [SPLIT, 0, 0], [0, WIDTH, 0]))
        lower.append(O.bodies.append(utils.wall(0, axis=2, material="rough")))
        upper = half(SPLIT, 4 * SPLIT, ([-SPLIT, 0, SPLIT], [0, WIDTH, 0], [SPLIT, 0, 0]))
        lid = O.bodies[O.bodies.append(utils.wall(potential_particles.extrema()[1][2], axis=2, material="rough"))]
        O.engines = [
            ForceResetter(),
            InsertionSortCollider(
                [PotentialParticle2AABB(), Bo1_Wall_Aabb(), Bo1_Facet_Aabb()], verletDist=0, avoidSelfInteractionMask=2),
            ConicInteractionLoop(
                [Ig2_ConicPP_ConicPP_ScGeom(), Ig2_Wall_ConicPP_ScGeom(), Ig2_Facet_ConicPP_ScGeom()],
                [Ip2_FrictMat_FrictMat_FrictPhys()], [Law2_ScGeom_FrictPhys_CundallStrack(sphericalBodies=False)]),
            potential_particles.time_stepper(safety=0.8),
            NewtonIntegrator(damping=0.3, exactAsphericalRot=True)
        ]
        # The lid comes down, and then bears a weight: a heavy body that the load presses down.
        lid.dynamic, lid.state.mass, lid.state.blockedDOFs, lid.state.vel = True, 0.02 * COUNT, "xyzXYZ", Vector3(0, 0, -0.3)
        while not stopped and 1e3 * stresses()[1] < 0.2 * stress and O.time < 1:
            O.run(20, True)
        lid.state.blockedDOFs, lid.state.vel, end = "xyXYZ", Vector3.Zero, O.time + 0.15
        O.forces.setPermF(lid.id, (0, 0, -stress * LENGTH * WIDTH))
        while not stopped and O.time < end:
            O.run(100, True)
        O.materials["rocks"].frictionAngle, rows, height = GRAINS.friction_angle, [], lid.state.pos[2]
        O.interactions.clear()  # contacts begin again, with friction
        for i in [*upper, lid.id]:
            O.bodies[i].state.vel = Vector3(0.12 * np.sqrt(stress / 1e5), 0, 0)
        while not stopped and lid.state.pos[0] < WAY * LENGTH:
            O.run(50, True)
            rows.append((1e3 * lid.state.pos[0], *stresses(), 1e3 * (lid.state.pos[2] - height)))
            bar.reached(int(100 * (number + lid.state.pos[0] / (WAY * LENGTH))))
        if len(rows) > 20:
            results[stress / 1e3] = np.array(rows).T
            most = max(most, potential_particles.overlap_ratio())
            print(f"{stress / 1e3:g} kPa: sheared by {rows[-1][0]:.1f} mm, growth {rows[-1][3]:.2f} mm", flush=True)
bar.close()
if not results:
    raise SystemExit("stopped before anything was sheared")
# Of each test: the normal stress, the largest shear stress (of means over 1 mm) and that of the last third; and of all
# together the angles of lines from the origin through these.
means = [[np.convolve(line, np.ones(10) / 10, "valid") for line in rows] for rows in results.values()]
points = np.array([(across.mean(), along.max(), along[-len(along) // 3:].mean()) for _, along, across, _ in means])
peak, end = (np.degrees(np.arctan(points[:, 0] @ points[:, i] / np.sum(points[:, 0]**2))) for i in (1, 2))
places = np.array([O.bodies[i].state.pos for i in ids])
summary = {
    "bodies": COUNT, "friction_angle_peak": peak, "friction_angle_end": end, "seconds": time.perf_counter() - start,
    "normal_stress_kPa": points[:, 0].tolist(), "peak_kPa": points[:, 1].tolist(), "end_kPa": points[:, 2].tolist(),
    "growth_mm": [rows[3][-1] for rows in means], "overlap_over_r": most,
    "out_of_box": int((np.any(places[:, 1:] < 0, axis=1) | (places[:, 1] > WIDTH) | (places[:, 2] > lid.state.pos[2])).sum())
}
os.makedirs(OUT, exist_ok=True)
potential_particles.plot(os.path.join(OUT, "rocks.png"), size=(700, 500), colour="velocity", scale_bar=True, towards=(0.3, -0.9, 0.3))
picture, ((rocks, shear), (line, growth)) = pyplot.subplots(2, 2, figsize=(8, 6), layout="constrained")
rocks.imshow(pyplot.imread(os.path.join(OUT, "rocks.png")))
rocks.axis("off")
for stress, (way, along, across, grown) in zip(results, means):
    shear.plot(way, along / across, label=f"{stress:g} kPa")
    growth.plot(way, grown)
normal = np.array([0, 1.1 * points[:, 0].max()])
for column, angle, published, label in (1, peak, (40, 50), "peak"), (2, end, (33, 40), "end"):
    shown = line.plot(points[:, 0], points[:, column], "o")[0].get_color()
    line.plot(normal, normal * np.tan(np.radians(angle)), color=shown, label=f"{label}: {angle:.1f} degrees")
    line.fill_between(normal, *(normal * np.tan(np.radians(one)) for one in published), color=shown, alpha=0.2,
                      label=f"published: {published[0]} to {published[1]}")
shear.set(xlabel="way of the upper half, mm", ylabel="shear stress / normal stress")
growth.set(xlabel="way of the upper half, mm", ylabel="growth of the height, mm")
line.set(xlabel="normal stress, kPa", ylabel="shear stress, kPa")
shear.legend()
line.legend()
picture.savefig(os.path.join(OUT, "shear_box.png"), dpi=110)
files.write_summary(os.path.join(OUT, "summary.json"), summary)
print(summary)
