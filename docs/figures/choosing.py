# SPDX-License-Identifier: MIT OR Apache-2.0
"""The picture of docs/choosing.md: what stiffness, damping and time step do to a small pile.

    scripts/yade.sh -j1 docs/figures/choosing.py        # writes docs/pictures/choosing.png; a minute
"""
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

import potential_particles
from potential_particles import boundaries, packing, shapes
from yade import *
from yade import utils

sys.path.insert(0, "studies")
from stepping import advance

SIZE, GRAVITY, DENSITY = 0.1, 9.81, 2600.0
HEIGHT = 6 * SIZE
YOUNG, DAMPINGS, SHARES = np.logspace(6, 8.5, 6), (0.0, 0.1, 0.3, 0.6), (0.1, 0.25, 0.5, 1.0)


def scene(young, damping, kinds, number, friction=0.5):
    """Bodies above a floor between walls; returns the contact functor of two particles."""
    O.reset()
    O.materials.append(FrictMat(young=young, poisson=0.3, frictionAngle=friction, density=DENSITY))
    inside = packing.Box((0, 0, 0), (4 * SIZE, 4 * SIZE, HEIGHT))
    potential_particles.add_packing(potential_particles.pack(inside, kinds, number=number, seed=3, progress=False))
    if number > 1:
        O.bodies.append(boundaries.box_walls(inside.lower, inside.upper))
    else:
        O.bodies.append(utils.wall(0, axis=2))
    O.engines = [
        ForceResetter(),
        InsertionSortCollider(
            [PotentialParticle2AABB(), Bo1_Facet_Aabb(), Bo1_Wall_Aabb()], verletDist=0),
        ConicInteractionLoop([Ig2_ConicPP_ConicPP_ScGeom(),
                              Ig2_Facet_ConicPP_ScGeom(),
                              Ig2_Wall_ConicPP_ScGeom()], [Ip2_FrictMat_FrictMat_FrictPhys()],
                             [Law2_ScGeom_FrictPhys_CundallStrack(sphericalBodies=False)]),
        NewtonIntegrator(damping=damping, gravity=(0, 0, -GRAVITY), exactAsphericalRot=True),
    ]
    O.dt = potential_particles.critical_time_step()


def largest_overlap(young, rocks):
    """Of a pile while it falls and when it lies, over the size of the bodies."""
    scene(young, 0.3, rocks, 30)
    largest, end = 0.0, 1.2
    while O.time < end:
        advance(O.iter + 20)
        largest = max([largest] + [i.geom.penetrationDepth for i in O.interactions if i.isReal])
    lying = max(i.geom.penetrationDepth for i in O.interactions if i.isReal)
    return largest / SIZE, lying / SIZE


def kinetic(damping, rocks):
    """Times, and kinetic energy over the energy of the fall of half the height."""
    scene(1e7, damping, rocks, 30)
    weight = sum(body.state.mass for body in O.bodies if body.state.mass > 0) * GRAVITY * HEIGHT / 2
    times, energies = [], []
    while O.time < 2.0:
        advance(O.iter + max(1, int(0.01 / O.dt)))
        times.append(O.time)
        energies.append(utils.kineticEnergy() / weight)
    return times, energies


def energy_error(share, kinds, young):
    """Drift of the energy of frictionless bodies that bounce on a floor for 1 s, over that of their fall; `share` of
    the limit.
    """
    drifts = []
    for kind in kinds:
        scene(young, 0.0, kind, 1, friction=0.0)
        O.dt = share * potential_particles.critical_time_step(safety=1.0)
        body = next(one for one in O.bodies if one.state.mass > 0)
        body.state.pos = (0, 0, HEIGHT / 2)
        energies = []
        while O.time < 1.0:
            advance(O.iter + max(1, int(0.004 / O.dt)))
            if not any(i.isReal for i in O.interactions):
                # Velocities are those of half a step before: the height is taken there.
                height = body.state.pos[2] - 0.5 * O.dt * body.state.vel[2]
                energies.append(utils.kineticEnergy() + body.state.mass * GRAVITY * height)
        drifts.append(max(abs(one - energies[0]) for one in energies) / energies[0])
    return np.sqrt(np.mean(np.square(drifts)))


def main():
    rocks = [shapes.random_rock(seed, size=SIZE, elongation=0.8, flatness=0.8) for seed in range(6)]
    figure, (overlaps, energies, steps) = plt.subplots(1, 3, figsize=(11.5, 3.4), dpi=110)

    found = np.array([largest_overlap(young, rocks) for young in YOUNG])
    overlaps.loglog(YOUNG, found[:, 0], "o-", label="while falling")
    overlaps.loglog(YOUNG, found[:, 1], "s-", label="at rest")
    speed, mass = np.sqrt(2 * GRAVITY * HEIGHT), DENSITY * np.pi / 6 * SIZE**3
    overlaps.loglog(YOUNG,
                    speed * np.sqrt(mass / (YOUNG * SIZE / 2)) / SIZE, "k:", label=r"$v\sqrt{m/k_n}$ of one body")
    overlaps.axhline(rocks[0].r / SIZE, color="0.6")
    overlaps.text(YOUNG[-1], rocks[0].r / SIZE * 1.1, "r", ha="right", color="0.4")
    overlaps.set(xlabel="young, Pa", ylabel="largest overlap / size", title="stiffness")
    overlaps.legend(frameon=False, fontsize=8)

    for damping in DAMPINGS:
        times, values = kinetic(damping, rocks)
        energies.semilogy(times, np.maximum(values, 1e-10), label=f"{damping:g}")
    energies.set(xlabel="time, s", ylabel="kinetic energy / energy of the fall", title="damping")
    energies.legend(title="NewtonIntegrator", frameon=False, fontsize=8, title_fontsize=8)

    for label, kinds, young, marks in (("sphere, 1e8 Pa", [shapes.sphere(
            SIZE / 2)], 1e8, "k.:"), ("rocks, 1e7 Pa", rocks[:4], 1e7, "s-"), ("rocks, 1e9 Pa", rocks[:4], 1e9, "o-")):
        errors = [energy_error(share, kinds, young) for share in SHARES]
        print(label, *zip(SHARES, errors), sep="\n", flush=True)
        steps.loglog(SHARES, errors, marks, label=label)
    steps.axvline(0.5, color="0.6")
    steps.text(0.48, 0.95, "default", ha="right", color="0.4", transform=steps.get_xaxis_transform())
    steps.legend(frameon=False, fontsize=8, loc="lower right")
    steps.set(xlabel="time step / proved limit", ylabel="drift of the energy / fall", title="time step")

    for axis in (overlaps, energies, steps):
        axis.grid(alpha=0.3)
    figure.tight_layout()
    figure.savefig("docs/pictures/choosing.png")


main()
