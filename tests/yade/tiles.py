# SPDX-License-Identifier: GPL-3.0-or-later
"""Scenes of a block with joints on a boundary that is cut into tiles, for the scripts in this folder."""
import math

import potential_particles
import yade
from harness import *
from potential_particles import shapes
from yade import utils

STIFFNESS, HALF, RADIUS = 1e9, 0.5, 0.01


def scene(loop=yade.ConicInteractionLoop, periodic=False, **material):
    O.reset()
    O.periodic = periodic
    given = dict(normalStiffness=STIFFNESS, shearStiffness=STIFFNESS / 2, frictionAngle=math.atan(0.5), density=2000.0)
    O.materials.append(yade.ConicJointMat(**{**given, **material}))
    kinds = ("ConicPP_ConicPP", "Wall_ConicPP", "Facet_ConicPP", "Box_ConicPP")
    O.engines = [
        yade.ForceResetter(),
        yade.InsertionSortCollider(
            [yade.PotentialParticle2AABB(), yade.Bo1_Wall_Aabb(), yade.Bo1_Facet_Aabb(), yade.Bo1_Box_Aabb()],
            verletDist=0.01),
        loop([getattr(yade, f"Ig2_{kind}_ScGeom")(patch=True) for kind in kinds],
             [yade.Ip2_ConicJointMat_ConicJointMat_ConicJointPhys()], [yade.Law2_ScGeomConicPP_ConicJointPhys()]),
        yade.NewtonIntegrator(damping=0.0, exactAsphericalRot=True),
    ]


def grid(count, width=1.3):
    """Triangles of a square with so many squares along each side."""
    at = [(i / count - 0.5) * width for i in range(count + 1)]
    return [triangle for i in range(count) for j in range(count)
            for a, b, c, d in [[(at[i], at[j]), (at[i + 1], at[j]), (at[i + 1], at[j + 1]), (at[i], at[j + 1])]]
            for triangle in ((a, b, c), (a, c, d))]


def fan(count, width=1.4):
    """4 or 8 triangles about the middle of a square."""
    corners = [(1, 0), (1, 1), (0, 1), (-1, 1), (-1, 0), (-1, -1), (0, -1), (1, -1)]
    rim = [(0.5 * width * x, 0.5 * width * y) for x, y in (corners if count == 8 else corners[1::2])]
    return [((0, 0), rim[i], rim[(i + 1) % count]) for i in range(count)]


def floor(kind, turn=Quaternion.Identity):
    if kind == "wall":
        O.bodies.append(utils.wall((0, 0, 0), axis=2, sense=1))
    elif kind == "box":
        O.bodies.append(utils.box(turn * Vector3(0, 0, -0.5), (2, 2, 0.5), fixed=True, orientation=turn))
    elif isinstance(kind, int):
        # So many blocks along each side, face beside face.
        width = 1.2 / kind
        block = shapes.from_vertices([(x * width / 2, y * width / 2, 0.2 * z) for x in (-1, 1) for y in (-1, 1)
                                      for z in (-1, 1)], rounding=1e-4, k=0.0)
        for i in range(kind):
            for j in range(kind):
                place = Vector3((i + 0.5) * width - 0.6, (j + 0.5) * width - 0.6, -0.2)
                O.bodies.append(potential_particles.body(block, position=turn * place, orientation=turn, fixed=True))
    else:
        for triangle in kind:
            O.bodies.append(utils.facet([turn * Vector3(*corner, 0) for corner in triangle], fixed=True))


def block(height=0.0, turn=Quaternion.Identity, place=(0, 0), shape=None, radius=RADIUS):
    shape = shape or cube(r=radius, k=0.0, half=HALF)
    return O.bodies[add(shape, turn * Vector3(*place, HALF + height), turn)]
