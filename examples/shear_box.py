# SPDX-License-Identifier: MIT OR Apache-2.0
"""Direct shear of rocks in a box of two halves, at two normal stresses: yade -x -n -j2 examples/shear_box.py

Environment: BODIES (300), STRESSES (2.5e4 5e4, Pa), WAY (0.1, of the box's length), SEED (0), OUTPUT
(out/shear_box). The lower half stays, the upper one is driven along x, and its lid bears a weight; no other gravity.
Ctrl-C keeps what there is. Writes shear_box.png and summary.json. SI units; z up.
"""
import os

import numpy as np
import potential_particles
from matplotlib import pyplot
from potential_particles import boundaries, files, packing, progress, shapes
from yade import *
from yade import utils

COUNT, WAY, SEED = int(os.environ.get("BODIES", 300)), float(os.environ.get("WAY", 0.1)), int(os.environ.get("SEED", 0))
OUT, STRESSES = os.environ.get("OUTPUT", "out/shear_box"), os.environ.get("STRESSES", "2.5e4 5e4")
STRESSES = [float(one) for one in STRESSES.split()]
SIZE = 0.03  # of a ball of a rock's volume, m
LENGTH, WIDTH, SPLIT = SIZE * (COUNT / 300)**(1 / 3) * np.array((10, 4.5, 2.9))  # of the box; half its height, m
PRESSED = 10  # friction between rocks while they are pressed together, degrees: the less, the denser they become
GAP = 0.6 * SIZE  # between the halves, so that no rock is caught between their edges
GRAINS = potential_particles.suggest("rock", size=SIZE, load=8 * max(STRESSES) * SIZE**2, overlap=0.3)
kinds = [shapes.random_rock(seed, elongation=0.75, flatness=0.7) for seed in range(12)]


def half(low, high, shelf):
    """Both ends of a half of the box, and the shelf beside one of them that keeps rocks in."""
    across, up = [0, WIDTH, 0], [0, 0, high - low]
    plates = ([0, 0, low], across, up), ([LENGTH, 0, low], up, across), shelf
    # The mask's 2 is theirs alone: no pairs of two facets.
    return O.bodies.append([one for plate in plates for one in boundaries.plate(*plate, material="smooth", mask=3)])


def stresses():
    """Shear and normal stress on the lower half, Pa."""
    return (sum(np.array(O.forces.f(i)) for i in lower) / (LENGTH * WIDTH))[[0, 2]] * (1, -1)


results, bar = {}, progress.Bar(100 * len(STRESSES), True, "%", "shear")
with progress.Interrupts() as stopped:
    for number, stress in enumerate(STRESSES):
        O.reset()
        for label, angle in ("smooth", 0), ("rough", GRAINS.friction_angle), ("rocks", np.radians(PRESSED)):
            O.materials.append(FrictMat(**dict(GRAINS.frict_mat(), frictionAngle=angle), label=label))
        rocks = potential_particles.pack(packing.Box((0, 0, 0), (LENGTH, WIDTH, 5 * SPLIT)), kinds, sizes=SIZE,
                                         number=COUNT, dense=True, seed=SEED + number)
        ids = potential_particles.add_packing(rocks, material="rocks", color=(0.72, 0.58, 0.42))
        O.bodies.append([utils.wall(place, axis=1, material="smooth") for place in (0, WIDTH)])
        below, above = SPLIT - 0.5 * GAP, SPLIT + 0.5 * GAP
        lower = half(0, below, ([LENGTH, 0, below], [SPLIT, 0, 0], [0, WIDTH, 0]))
        lower.append(O.bodies.append(utils.wall(0, axis=2, material="rough")))
        upper = half(above, 4 * SPLIT, ([-SPLIT, 0, above], [0, WIDTH, 0], [SPLIT, 0, 0]))
        lid = O.bodies[O.bodies.append(utils.wall(potential_particles.extrema()[1][2], axis=2, material="rough"))]
        O.engines = [
            ForceResetter(),
            InsertionSortCollider([PotentialParticle2AABB(), Bo1_Wall_Aabb(), Bo1_Facet_Aabb()], verletDist=0,
                                  avoidSelfInteractionMask=2),
            ConicInteractionLoop([Ig2_ConicPP_ConicPP_ScGeom(), Ig2_Wall_ConicPP_ScGeom(), Ig2_Facet_ConicPP_ScGeom()],
                                 [Ip2_FrictMat_FrictMat_FrictPhys()],
                                 [Law2_ScGeom_FrictPhys_CundallStrack(sphericalBodies=False)]),
            potential_particles.time_stepper(safety=0.8),
            NewtonIntegrator(damping=0.3, exactAsphericalRot=True)
        ]
        # The lid comes down, and once it presses on rocks, bears a weight.
        lid.dynamic, lid.state.mass, lid.state.blockedDOFs = True, 0.02 * COUNT, "xyzXYZ"
        lid.state.vel, rows = Vector3(0, 0, -0.3), []
        while not stopped and stresses()[1] < 0.2 * stress:
            O.run(20, True)
        lid.state.blockedDOFs, lid.state.vel, end = "xyXYZ", Vector3.Zero, O.time + 0.15
        O.forces.setPermF(lid.id, (0, 0, -stress * LENGTH * WIDTH))
        while not stopped and O.time < end:
            O.run(100, True)
        O.materials["rocks"].frictionAngle, height = GRAINS.friction_angle, lid.state.pos[2]
        O.interactions.clear()  # contacts begin again, with the friction of rocks
        for i in [*upper, lid.id]:
            O.bodies[i].state.vel = Vector3(0.12 * np.sqrt(stress / 1e5), 0, 0)
        while not stopped and lid.state.pos[0] < WAY * LENGTH:
            O.run(50, True)
            rows.append((1e3 * lid.state.pos[0], *stresses() / 1e3, 1e3 * (lid.state.pos[2] - height)))
            bar.reached(int(100 * (number + lid.state.pos[0] / (WAY * LENGTH))))
        if len(rows) > 20:  # means over ten: rocks are uneasy
            results[stress / 1e3] = [np.convolve(column, np.full(10, 0.1), "valid") for column in np.transpose(rows)]
            print(f"{stress / 1e3:g} kPa: {rows[-1][0]:.1f} mm along, {rows[-1][3]:.2f} mm up", flush=True)
bar.close()
if not results:
    raise SystemExit("stopped before rocks were sheared")
# Normal and shear stress of each test, kPa: where their ratio is largest, and means of the last third; and the angles
# of lines from the origin through all tests.
at_peak, at_end = [], []
for _, along, across, _ in results.values():
    i, third = (along / across).argmax(), len(along) // 3
    at_peak.append((across[i], along[i]))
    at_end.append((across[-third:].mean(), along[-third:].mean()))
at_peak, at_end = np.array(at_peak), np.array(at_end)
peak, end = (np.degrees(np.arctan(np.prod(one, axis=1).sum() / np.sum(one[:, 0]**2))) for one in (at_peak, at_end))
places = np.array([O.bodies[i].state.pos for i in ids])
summary = {
    "bodies": COUNT, "friction_angle_peak": peak, "friction_angle_end": end, "at_peak_kPa": at_peak.tolist(),
    "at_end_kPa": at_end.tolist(), "growth_mm": [grown[-1] for *_, grown in results.values()],
    "overlap_over_r": potential_particles.overlap_ratio(),
    "out_of_box": int(((places < 0).any(1) | (places > (1.2 * LENGTH, WIDTH, lid.state.pos[2])).any(1)).sum())
}
os.makedirs(OUT, exist_ok=True)
potential_particles.plot(os.path.join(OUT, "rocks.png"), size=(700, 500), colour="velocity", scale_bar=True,
                         towards=(0.1, -1, 0.2))
picture, ((rocks, shear), (line, growth)) = pyplot.subplots(2, 2, figsize=(8, 6), layout="constrained")
rocks.imshow(pyplot.imread(os.path.join(OUT, "rocks.png")))
rocks.axis("off")
for stress, (way, along, across, grown) in results.items():
    shear.plot(way, along / across, label=f"{stress:g} kPa")
    growth.plot(way, grown)
normal = np.array([0, 1.1 * at_peak[:, 0].max()])
for points, angle, published, label in (at_peak, peak, (40, 50), "peak"), (at_end, end, (33, 40), "end"):
    colour = line.plot(*points.T, "o")[0].get_color()
    line.plot(normal, normal * np.tan(np.radians(angle)), color=colour, label=f"{label}: {angle:.1f} degrees")
    line.fill_between(normal, *(normal * np.tan(np.radians(one)) for one in published), color=colour, alpha=0.2,
                      label="published: {} to {}".format(*published))
shear.set(xlabel="way of the upper half, mm", ylabel="shear stress / normal stress")
growth.set(xlabel="way of the upper half, mm", ylabel="growth of the height, mm")
line.set(xlabel="normal stress, kPa", ylabel="shear stress, kPa")
shear.legend()
line.legend()
picture.savefig(os.path.join(OUT, "shear_box.png"), dpi=110)
files.write_summary(os.path.join(OUT, "summary.json"), summary)
print(summary)
