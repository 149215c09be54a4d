# SPDX-License-Identifier: GPL-3.0-or-later
"""In YADE: bodies on the seams of many small meshes, for LAMMPS by to_lammps, and what pushes them:
yade -x yade_seams_scene.py FOLDER SEED."""
import math
import sys

import numpy as np
import potential_particles
import yade
from potential_particles import shapes
from yade import O, Quaternion, Vector3

folder, seed = sys.argv[-2], int(sys.argv[-1])
KN, KS, MU, CELLS, PITCH, DEPTH = 1e5, 6e4, 0.4, 50, 0.5, 1e-3
random = np.random.default_rng(seed)
kinds = ("flat", "cone", "ridge", "bowl", "any")
bodies = (shapes.cuboid((0.12, 0.1, 0.06), r=0.004, k=0.0), shapes.cuboid((0.1, 0.1, 0.1), r=0.01, k=0.02),
          shapes.platonic_solid(8, 0.1, r=0.006, k=0.01))
directions = random.normal(size=(4000, 3))
directions /= np.linalg.norm(directions, axis=1)[:, None]
ways = [Vector3(*d) for d in directions]
surfaces = [np.array(potential_particles.conic_particle(shape).surfaceDistance(ways))[:, None] * directions for shape in bodies]
O.materials.append(yade.FrictMat(young=1e7, poisson=0.6, frictionAngle=math.atan(MU), density=2600))


def fan(kind, at):
    """Corners of triangles around a corner; coordinates that STL files hold."""
    count = 4 if kind == "ridge" else random.integers(4, 10)
    shifts = random.uniform(-0.3, 0.3, count) * (kind != "ridge")
    angles = 2 * np.pi * (np.arange(count) + shifts + random.uniform()) / count
    slope = random.uniform(0.02, 0.08)
    heights = {"flat": 0, "cone": -slope, "ridge": np.tile([0, -slope], 2)[:count], "bowl": slope,
               "any": random.uniform(-0.03, 0.03, count)}[kind]
    rim = np.column_stack([0.22 * np.cos(angles), 0.22 * np.sin(angles), np.broadcast_to(heights, count)])
    corners = np.vstack([(0, 0, 0), rim]) + at
    corners = corners.astype(np.float32).astype(float)
    three = [(0, i + 1, (i + 1) % count + 1) for i in range(count)]
    return [corners[np.roll(t[::random.choice((1, -1))], random.integers(3))] for t in three], corners


meshes, placed, told = [], [], []
for n in range(CELLS**2):
    kind = kinds[n % len(kinds)]
    triangles, corners = fan(kind, PITCH * np.array([n % CELLS - CELLS / 2, n // CELLS - CELLS / 2, 0]))
    # Over the corner in the middle, over an edge, or off both by something.
    edge = corners[1 + random.integers(len(corners) - 1)] - corners[0]
    place = corners[0] + edge * random.choice((0, 0, random.uniform(0, 0.5)))
    place[:2] += random.choice((0, 1e-12, 1e-7, 1e-2)) * random.normal(size=2)
    which = random.integers(len(bodies))
    lies = random.uniform() < 0.3  # on a face
    turn = Quaternion(Vector3(0, 0, 1), random.uniform(0, 6)) if lies else Quaternion(*random.normal(size=4))
    turn.normalize()
    below = (surfaces[which] @ np.array(turn.conjugate() * Vector3(0, 0, -1))).max()
    meshes += triangles
    placed.append((bodies[which], Vector3(*place) + Vector3(0, 0, below - DEPTH), turn))
    told.append((kind, len(triangles)))
O.bodies.append([yade.utils.facet([Vector3(*corner) for corner in triangle], fixed=True) for triangle in meshes])
first = len(O.bodies)
for shape, position, turn in placed:
    O.bodies.append(potential_particles.body(shape, position=position, orientation=turn))
O.engines = [
    yade.ForceResetter(),
    yade.InsertionSortCollider([yade.PotentialParticle2AABB(), yade.Bo1_Facet_Aabb()]),
    yade.InteractionLoop([yade.Ig2_ConicPP_ConicPP_ScGeom(),
                          yade.Ig2_Facet_ConicPP_ScGeom(flatRegularisation=1e-4)], [
                              yade.Ip2_FrictMat_FrictMat_FrictPhys(
                                  **{
                                      name: yade.MatchMaker(algo="val", val=value)
                                      for name, value in (("kn", KN), ("ks", KS), ("frictAngle", math.atan(MU)))
                                  })
                          ], [yade.Law2_ScGeom_FrictPhys_CundallStrack(sphericalBodies=False)]),
]
O.dt = 1e-6
potential_particles.to_lammps(folder + "/scene", KN, KS, MU)
O.step()
contacts = np.zeros(len(O.bodies), int)
for pair in O.interactions:
    contacts[[pair.id1, pair.id2]] += 1
np.savez(folder + "/yade.npz", triangles=np.array(meshes), kinds=np.array([kind for kind, _ in told]),
         counts=np.array([count for _, count in told]), contacts=contacts[first:],
         pushes=np.array([[*O.forces.f(i), *O.forces.t(i)] for i in range(first, len(O.bodies))]))
