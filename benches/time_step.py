# SPDX-License-Identifier: GPL-3.0-or-later
"""Where scenes break, and the steps that critical_time_step() and YADE's stepper give there.

    make time-step        # a few minutes; SCENES="rods;plates" for some, whose results join those that are there; results in out/time_step

A pile at rest, undamped, breaks with a step beyond its limit: its kinetic energy grows to four times what it is with a
fifth of our step, and beyond that of a fall by a tenth of the rounding. The largest step with which it does not is
found by bisection to 3 %. Before contacts, bodies fall on a wall, and the largest step is that with which the first
impact brings no energy.
"""
import json
import math
import os
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

import potential_particles
from potential_particles import packing, shapes
from yade import *
from yade import utils

sys.path[:0] = ["studies", "benches"]
from stepping import advance
from summary import made, print_targets, target, write_summary

OUT, GRAVITY, DENSITY, NUMBER, STEPS = Path(os.environ.get("OUTPUT", "out/time_step")), 9.81, 2650.0, 40, 1500
KEYS = ("breaks_s", "ours_s", "yades_s")
ROCKS = [shapes.random_rock(seed, size=0.1) for seed in range(10)]
KINDS = {"rocks": ROCKS, "rods": [shapes.cuboid((0.3, 0.05, 0.05))], "plates": [shapes.cuboid((0.2, 0.2, 0.03))],
         "rocks, 1 to 3.3": [ROCKS[0], ROCKS[1].scaled(0.3)], "clumps": [shapes.cuboid((0.2, 0.06, 0.06))],
         "rocks by area (KnKs)": ROCKS, "cubes with joints": [shapes.cuboid((0.1, 0.1, 0.1))]}
springs = [Ip2_FrictMat_FrictMat_FrictPhys()], [Law2_ScGeom_FrictPhys_CundallStrack(sphericalBodies=False)]


def scene(name):
    """Bodies above a floor between four walls."""
    O.reset()
    joints, area = "joints" in name, "KnKs" in name
    material = (ConicJointMat(young=1e7, poisson=0.3, frictionAngle=0.5, density=DENSITY, restitution=1.0) if joints
                else FrictMat(young=1e7, poisson=0.3, frictionAngle=0.5, density=DENSITY))
    O.materials.append(material)
    placed = potential_particles.pack(packing.Box((0, 0, 0), (0.5, 0.5, 2.0)), KINDS[name], number=NUMBER, seed=1,
                                      progress=False, margin=0.1 if name == "clumps" else 0.0)
    ids = potential_particles.add_packing(placed)
    if name == "clumps":
        # A cross-piece on each rod, which moves with it.
        for one in ids:
            rod, piece = O.bodies[one], potential_particles.body(shapes.cuboid((0.06, 0.14, 0.06)))
            piece.state.pos, piece.state.ori = rod.state.pos + rod.state.ori * Vector3(0, 0.04, 0.07), rod.state.ori
            potential_particles.clump([one, O.bodies.append(piece)])
    for axis, place in (2, 0.0), (0, 0.0), (0, 0.5), (1, 0.0), (1, 0.5):
        O.bodies.append(utils.wall(place, axis=axis))
    physics = springs
    if area:
        physics = ([
            Ip2_FrictMat_FrictMat_KnKsPhys(kn_i=1e8, ks_i=5e7, Knormal=1e8, Kshear=5e7, viscousDamping=0.0,
                                           useFaceProperties=False)
        ], [Law2_SCG_KnKsPhys_KnKsLaw(neverErase=False)])
    elif joints:
        physics = [Ip2_ConicJointMat_ConicJointMat_ConicJointPhys()], [Law2_ScGeomConicPP_ConicJointPhys()]
    O.engines = [
        ForceResetter(),
        InsertionSortCollider([PotentialParticle2AABB(), Bo1_Wall_Aabb()], verletDist=0),
        InteractionLoop([Ig2_ConicPP_ConicPP_ScGeom(patch=joints), Ig2_Wall_ConicPP_ScGeom(patch=joints)], *physics),
        potential_particles.time_stepper(),
        GlobalStiffnessTimeStepper(active=False, timestepSafetyCoefficient=1.0),
        NewtonIntegrator(damping=0.4, gravity=(0, 0, -GRAVITY), exactAsphericalRot=True),
    ]


def largest_energy(step, seconds, most=math.inf):
    """Largest kinetic energy, J, of the pile that was saved, undamped, with this step; it ends once that is above
    `most`.
    """
    O.loadTmp("rest")
    O.engines[3].dead = True
    O.engines[-1].damping, O.dt, end = 0.0, step, O.time + seconds
    largest = 0.0
    while O.time < end and largest <= most:
        advance(O.iter + max(10, int(0.05 * seconds / step)))
        energy = utils.kineticEnergy()
        largest = max(largest, energy if energy == energy else math.inf)
    return largest


def of_pile(name):
    """(limit, ours of safety 1, YADE's of safety 1) in s."""
    scene(name)
    # Weight times a tenth of the rounding radius.
    scale = sum(body.state.mass * GRAVITY * 0.1 * body.shape.r for body in O.bodies
                if isinstance(body.shape, PotentialParticle))
    while O.time < 2.0 or utils.kineticEnergy() > 1e-3 * scale and O.time < 6.0:
        advance(O.iter + 100)
    O.saveTmp("rest")
    ours = potential_particles.critical_time_step(safety=1.0)
    O.engines[3].dead, O.engines[4].active = True, True
    O.step()
    yades = O.dt
    # What still settles does so at any step.
    seconds = STEPS * ours
    most = max(scale, 4.0 * largest_energy(0.2 * ours, seconds))
    return largest(ours, 0.2, lambda step: largest_energy(step, seconds, most) <= most), ours, yades


def largest(unit, low, is_sound):
    """The largest step, from low units on, that is sound, to 3 %."""
    high = 1.5 * low
    while is_sound(high * unit) and high < 50:
        low, high = high, 1.4 * high
    while high / low > 1.03:
        middle = math.sqrt(low * high)
        low, high = (middle, high) if is_sound(middle * unit) else (low, middle)
    return low * unit


def of_impact():
    """The same of rocks that fall on a wall, each alone, without friction."""
    def fall(step=None):
        O.reset()
        O.materials.append(FrictMat(young=1e7, poisson=0.3, frictionAngle=0.0, density=DENSITY))
        for i, rock in enumerate(ROCKS):
            O.bodies.append(potential_particles.body(rock, position=(i, 0, 0.1), velocity=(0, 0, -0.05)))
        O.bodies.append(utils.wall(0, axis=2))
        O.engines = [ForceResetter(), InsertionSortCollider([PotentialParticle2AABB(), Bo1_Wall_Aabb()], verletDist=0),
                     InteractionLoop([Ig2_ConicPP_ConicPP_ScGeom(), Ig2_Wall_ConicPP_ScGeom()], *springs),
                     GlobalStiffnessTimeStepper(active=False, timestepSafetyCoefficient=1.0),
                     NewtonIntegrator(damping=0.0, exactAsphericalRot=True)]
        if step is None:
            return
        O.dt = step
        before = utils.kineticEnergy()
        advance(O.iter + int(2.0 / step))
        return utils.kineticEnergy() / before
    fall()
    ours = potential_particles.critical_time_step(safety=1.0)
    limit = largest(ours, 0.5, lambda step: fall(step) < 1.05)
    fall()
    O.engines[3].active = True
    O.step()
    return limit, ours, O.dt


def main():
    wanted = os.environ.get("SCENES")
    names = wanted.split(";") if wanted else [*KINDS, "rocks before an impact"]
    OUT.mkdir(parents=True, exist_ok=True)
    kept = json.loads(
        (OUT / "summary.json").read_text())["scenes"] if wanted and (OUT / "summary.json").exists() else {}
    found = {name: tuple(one[key] for key in KEYS) for name, one in kept.items()}
    for name in names:
        limit, ours, yades = found[name] = of_impact() if "impact" in name else of_pile(name)
        print(f"| {name} | {limit * 1e6:.0f} | {ours * 1e6:.0f} | {ours / limit:.2f} | {yades / limit:.2f} |",
              flush=True)
    worst, least = max(ours / limit for limit, ours, _ in found.values()), min(ours / limit
                                                                               for limit, ours, _ in found.values())
    targets = [
        target("largest critical_time_step(safety=1) over the step that breaks a scene", "at most", 1.0, worst),
        target("least of it, with the default safety", "at least", 0.1, 0.5 * least)
    ]
    write_summary(OUT / "summary.json",
                  {"scenes": {name: dict(zip(KEYS, one))
                              for name, one in found.items()}, "targets": targets, **made("make time-step")})
    picture, axes = plt.subplots(figsize=(7, 3.2), layout="constrained")
    places = range(len(found))
    axes.barh([place + 0.2 for place in places], [ours / limit for limit, ours, _ in found.values()], 0.38,
              label="critical_time_step(safety=1)")
    axes.barh([place - 0.2 for place in places], [min(yades / limit, 3.0) for limit, _, yades in found.values()], 0.38,
              label="GlobalStiffnessTimeStepper")
    axes.axvline(1.0, color="black", lw=1)
    axes.set_yticks(list(places), list(found))
    axes.set_xlabel("step over the one beyond which the scene breaks (cut at 3)")
    axes.legend(fontsize=8)
    picture.savefig(OUT / "time_step.png", dpi=150)
    print_targets(targets)


main()
