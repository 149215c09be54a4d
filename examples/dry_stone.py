# SPDX-License-Identifier: MIT OR Apache-2.0
"""A dry-stone wall and a dome without mortar. Run it inside YADE: yade -x -n -j1 examples/dry_stone.py

The wall of random stones is tilted: thickness over height is the tangent at which it turns over as a whole. The dome is a hemisphere of 7 rings of 12 stones with an eye, 0.12 R thick:
0.042 R is the least at which a hemisphere stands (Heyman 1995, The Stone Skeleton). Environment: OUTPUT (out/dry_stone). Writes pictures and summary.json. SI units.
"""
import json
import os

import numpy as np
import potential_particles
from potential_particles import shapes
from yade import *

OUT = os.environ.get("OUTPUT", "out/dry_stone")
os.makedirs(OUT, exist_ok=True)
STONE, GROUND = (0.78, 0.74, 0.66), (0.55, 0.55, 0.5)


def start(tilt=0.0):
    """A scene with the law of joints; gravity inclined by `tilt` degrees towards y."""
    O.reset()
    O.materials.append(ConicJointMat(normalStiffness=3e8, shearStiffness=1.5e8, frictionAngle=0.7, restitution=0.2, density=2400))
    O.engines = [
        ForceResetter(),
        InsertionSortCollider([PotentialParticle2AABB()], verletDist=0, avoidSelfInteractionMask=2),
        ConicInteractionLoop([Ig2_ConicPP_ConicPP_ScGeom(patch=True)],
                             [Ip2_ConicJointMat_ConicJointMat_ConicJointPhys()],
                             [Law2_ScGeomConicPP_ConicJointPhys()]),
        NewtonIntegrator(damping=0.3, gravity=9.81 * Vector3(0, np.sin(np.radians(tilt)), -np.cos(np.radians(tilt))), exactAsphericalRot=True),
    ]


def run(seconds):
    """The largest way of a stone, mm, and its largest speed, mm/s."""
    O.dt = potential_particles.critical_time_step()
    O.run(int(seconds / O.dt), True)
    return {"largest_way_mm": 1e3 * max((body.state.pos - body.state.refPos).norm() for body in O.bodies),
            "fastest_mm_s": 1e3 * max(body.state.vel.norm() for body in O.bodies), "steps": O.iter}


def wall(tilt):
    """Courses of stones of random length, laid in bond, on a slab."""
    start(tilt)
    length, height, thick, courses = 2.4, 1.2, 0.4, 8
    rng, rise = np.random.default_rng(4), height / courses
    O.bodies.append(potential_particles.body(shapes.cuboid((length + 1, 2, 0.2), r=0.005, k=0), position=(length / 2, 0, -0.1), fixed=True, mask=3, color=GROUND))
    for course in range(courses):
        ends = np.concatenate([[0.0], (np.arange(1, 6) + 0.5 * (course % 2) + rng.uniform(-0.15, 0.15, 5)) * length / 6, [length]])
        for x in zip(ends, ends[1:]):
            corners = [(a, y, z) for a in x for y in (-thick / 2, thick / 2) for z in (course * rise, (course + 1) * rise)]
            O.bodies.append(potential_particles.body(shapes.from_vertices(corners, r=0.005, k=0), color=np.array(STONE) * rng.uniform(0.85, 1.1)))
    return run(0.5)


def dome(thickness, seconds):
    """Stones of a hemisphere of radius 2, by meridians and parallels; the lowest ring is fixed."""
    start()
    radius, rings, sectors = 2.0, 7, 12
    heights, rng = np.radians(np.linspace(90, 12, rings + 1)), np.random.default_rng(1)
    O.bodies.append(potential_particles.body(shapes.cuboid((6, 6, 0.2), r=0.01, k=0), position=(0, 0, -0.11), fixed=True, mask=3, color=GROUND))
    for ring, angles in enumerate(zip(heights, heights[1:])):
        for sector in range(sectors):
            turns = 2 * np.pi / sectors * np.array([sector, sector + 1])
            corners = [(r * np.sin(t) * np.cos(u), r * np.sin(t) * np.sin(u), r * np.cos(t))
                       for r in radius * np.array([1 - thickness / 2, 1 + thickness / 2]) for t in angles for u in turns]
            O.bodies.append(potential_particles.body(shapes.from_vertices(corners, r=0.05 * radius * thickness, k=0), fixed=ring == 0, mask=3 if ring == 0 else 1,
                                                     color=np.array(STONE) * rng.uniform(0.85, 1.1)))
    return run(seconds)


found = {}
turns_over = np.degrees(np.arctan2(0.4, 1.2))
for name, tilt in (("level", 0.0), ("below", 0.5 * turns_over), ("beyond", 1.1 * turns_over)):
    found[f"wall_{name}"] = {"tilt_degrees": tilt, "turns_over_at_degrees": turns_over, **wall(tilt)}
    print(name, found[f"wall_{name}"])
    potential_particles.plot(os.path.join(OUT, f"wall_{name}.png"), towards=(0.45, -0.85, 0.28), size=(900, 560))
found["dome"] = {"thickness_over_radius": 0.12, **dome(0.12, 0.25)}
print("dome", found["dome"])
potential_particles.plot(os.path.join(OUT, "dome.png"), towards=(0.5, -0.8, 0.45), size=(900, 640))
json.dump(found, open(os.path.join(OUT, "summary.json"), "w"), indent=2)
