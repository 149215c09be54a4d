# SPDX-License-Identifier: MIT OR Apache-2.0
"""A dry-stone wall and a dome without mortar. Run it inside YADE: yade -x -n -j1 examples/dry_stone.py

The wall of random stones is tilted slowly: thickness over height is the tangent at which it turns over as a whole; at
half that angle it comes to rest, leaning by what its joints, which do not pull, give way. The dome is a hemisphere of 7
rings of 12 stones with an eye, 0.12 R thick: 0.042 R is the least at which a hemisphere stands (Heyman 1995, The Stone
Skeleton). Environment: OUTPUT (out/dry_stone). Writes pictures and summary.json. SI units.
"""
import os

import numpy as np
import potential_particles
from potential_particles import files, shapes
from yade import *

OUT = os.environ.get("OUTPUT", "out/dry_stone")
os.makedirs(OUT, exist_ok=True)
NORMAL, SHEAR, DENSITY, GRAVITY = 3e8, 1.5e8, 2400.0, 9.81
LENGTH, HEIGHT, THICK, COURSES, ROUNDING = 2.4, 1.2, 0.4, 8, 0.005
STONE, GROUND = (0.78, 0.74, 0.66), (0.55, 0.55, 0.5)


def start():
    """A scene with the law of joints."""
    O.reset()
    O.materials.append(
        ConicJointMat(normalStiffness=NORMAL, shearStiffness=SHEAR, frictionAngle=0.7, restitution=0.2,
                      density=DENSITY))
    O.engines = [
        ForceResetter(),
        InsertionSortCollider([PotentialParticle2AABB()], verletDist=0, avoidSelfInteractionMask=2),
        ConicInteractionLoop([Ig2_ConicPP_ConicPP_ScGeom(patch=True)],
                             [Ip2_ConicJointMat_ConicJointMat_ConicJointPhys()],
                             [Law2_ScGeomConicPP_ConicJointPhys()]),
        NewtonIntegrator(damping=0.3, gravity=(0, 0, -GRAVITY), exactAsphericalRot=True),
    ]


def run(seconds, tilt=0.0, tilting=0.4):
    """The largest way of a stone, mm, and its largest speed, mm/s, after gravity was inclined towards y by `tilt`
    degrees, in `tilting` seconds: more than a period of the wall, so that it does not swing.
    """
    O.dt = potential_particles.critical_time_step()
    stages = 40 if tilt else 0
    for stage in range(stages):
        angle = np.radians(tilt) * 0.5 * (1.0 - np.cos(np.pi * (stage + 1) / stages))
        O.engines[-1].gravity = GRAVITY * Vector3(0, np.sin(angle), -np.cos(angle))
        O.run(int(tilting / stages / O.dt), True)
    O.run(int(seconds / O.dt), True)
    return {"largest_way_mm": 1e3 * max((body.state.pos - body.state.refPos).norm() for body in O.bodies),
            "fastest_mm_s": 1e3 * max(body.state.vel.norm() for body in O.bodies), "steps": O.iter}


def wall(tilt):
    """Courses of stones of random length, laid in bond, on a slab."""
    start()
    rng, rise = np.random.default_rng(4), HEIGHT / COURSES
    O.bodies.append(
        potential_particles.body(shapes.cuboid((LENGTH + 1, 2, 0.2), rounding=ROUNDING, k=0),
                                 position=(LENGTH / 2, 0, -0.1), fixed=True, mask=3, color=GROUND))
    for course in range(COURSES):
        ends = np.concatenate([[0.0], (np.arange(1, 6) + 0.5 * (course % 2) + rng.uniform(-0.15, 0.15, 5)) * LENGTH / 6,
                               [LENGTH]])
        for x in zip(ends, ends[1:]):
            corners = [(a, y, z) for a in x for y in (-THICK / 2, THICK / 2)
                       for z in (course * rise, (course + 1) * rise)]
            O.bodies.append(
                potential_particles.body(shapes.from_vertices(corners, rounding=ROUNDING, k=0),
                                         color=np.array(STONE) * rng.uniform(0.85, 1.1)))
    return run(0.5, tilt)


def lean(tilt):
    """By how much the top course of a wall of rigid courses goes, mm: each joint turns and slides as a strip on springs
    that do not pull, over its width without the roundings.
    """
    width, rise, way = THICK - 2 * ROUNDING, HEIGHT / COURSES, 0.0
    for z in np.arange(COURSES) * rise:
        weight = THICK * (HEIGHT - z) * DENSITY * GRAVITY * np.cos(np.radians(tilt))
        off = 0.5 * (HEIGHT - z) * np.tan(np.radians(tilt))
        pressed = 3 * (0.5 * width - off)                  # of the width, where the weight leaves its middle third
        turn = 2 * weight / (NORMAL * pressed**2) if off > width / 6 else 12 * weight * off / (NORMAL * width**3)
        way += turn * (HEIGHT - 0.5 * rise - z) + weight * np.tan(np.radians(tilt)) / (SHEAR * width)
    return 1e3 * way


def dome(thickness, seconds):
    """Stones of a hemisphere of radius 2, by meridians and parallels; the lowest ring is fixed."""
    start()
    radius, rings, sectors = 2.0, 7, 12
    heights, rng = np.radians(np.linspace(90, 12, rings + 1)), np.random.default_rng(1)
    O.bodies.append(
        potential_particles.body(shapes.cuboid((6, 6, 0.2), rounding=0.01, k=0), position=(0, 0, -0.11), fixed=True,
                                 mask=3, color=GROUND))
    for ring, angles in enumerate(zip(heights, heights[1:])):
        for sector in range(sectors):
            turns = 2 * np.pi / sectors * np.array([sector, sector + 1])
            corners = [(r * np.sin(t) * np.cos(u), r * np.sin(t) * np.sin(u), r * np.cos(t))
                       for r in radius * np.array([1 - thickness / 2, 1 + thickness / 2]) for t in angles
                       for u in turns]
            O.bodies.append(
                potential_particles.body(shapes.from_vertices(corners, rounding=0.05 * radius * thickness,
                                                              k=0), fixed=ring == 0, mask=3 if ring == 0 else 1,
                                         color=np.array(STONE) * rng.uniform(0.85, 1.1)))
    return run(seconds)


found = {}
turns_over = np.degrees(np.arctan2(0.4, 1.2))
for name, tilt in (("level", 0.0), ("below", 0.5 * turns_over), ("beyond", 1.1 * turns_over)):
    found[f"wall_{name}"] = {"tilt_degrees": tilt, "turns_over_at_degrees": turns_over, **wall(tilt)}
    if tilt < turns_over:
        found[f"wall_{name}"]["lean_of_rigid_courses_mm"] = lean(tilt)
    print(name, found[f"wall_{name}"])
    potential_particles.plot(os.path.join(OUT, f"wall_{name}.png"), towards=(0.45, -0.85, 0.28), size=(900, 560))
found["dome"] = {"thickness_over_radius": 0.12, **dome(0.12, 0.25)}
print("dome", found["dome"])
potential_particles.plot(os.path.join(OUT, "dome.png"), towards=(0.5, -0.8, 0.45), size=(900, 640))
files.write_summary(os.path.join(OUT, "summary.json"), found)
