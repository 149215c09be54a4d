# SPDX-License-Identifier: GPL-3.0-or-later
# YADE's own check and example for potential particles, as its packages install them, run as they are but
# for the class that goes by the name Ig2_PP_PP_ScGeom: once the built-in one, once ours.
import math
import os
import random
import sys
import types

import potential_particles
import yade
import yade.config
from harness import *
from yade import pack

check = Checks()
FOLDER = "/usr/share/doc/yade"
CHECK = FOLDER + "/scripts/checks-and-tests/checks/checkPotentialParticles.py"
CUBES = FOLDER + "/examples/PotentialParticles/cubePPscaled.py"


class YadeCheckError(Exception):
    """What YADE's checks raise when something is wrong."""


def execute(path, functor_class, **names):
    """Runs a script of YADE's in a fresh scene; returns its names."""
    O.reset()
    with open(path, encoding="utf-8") as file:
        program = compile(file.read(), path, "exec")
    names = {**globals(), "features": yade.config.features, "Ig2_PP_PP_ScGeom": functor_class, **names}
    exec(program, names)
    return names


def installed(path):
    # Slim containers leave documentation out, and with it YADE's examples.
    if os.path.exists(path):
        return True
    print(f"skipped: {path} is not installed (does dpkg exclude /usr/share/doc?)")
    return False


# --- two cubes, half in each other ----------------------------------------------------------------

def section_area(edge, k, r, R, height, samples=20000):
    """Area of the particle's section at a height above the centre, in polar coordinates.

    The particle is the cube of YADE's check: six faces of distance edge/2 - r. Each radius is found by
    bisection; the mean of the squares over evenly spaced angles is all but exact for a closed curve
    without corners.
    """
    def inside(radius, cosine, sine):
        flat = sum(max(abs(x) - (edge / 2 - r), 0)**2 for x in (height, radius * cosine, radius * sine))
        return (1 - k) / r**2 * flat + k / R**2 * (height**2 + radius**2) < 1

    total, eighth = 0, math.pi / 4
    for i in range(samples):
        angle = (i + 0.5) / samples * eighth  # the curve repeats itself eight times
        low, high = 0.0, edge
        for _ in range(50):
            middle = 0.5 * (low + high)
            low, high = (middle, high) if inside(middle, math.cos(angle), math.sin(angle)) else (low, middle)
        total += low**2
    return math.pi * total / samples


if installed(CHECK):
    execute(CHECK, yade.Ig2_PP_PP_ScGeom, YadeCheckError=YadeCheckError)  # raises if it is not content
    contact = O.interactions[0, 1]
    theirs = contact.geom.penetrationDepth, contact.geom.normal, contact.phys.ptOnP1, contact.phys.ptOnP2
    polygon = contact.phys.contactArea

    # The check asks for the area of a polygon. All else it must accept.
    complaints = []
    try:
        execute(CHECK, yade.Ig2_PP_PP_ScGeom_Conic, YadeCheckError=YadeCheckError)
    except YadeCheckError as error:
        complaints = [line for line in str(error).splitlines() if line]
    check.true(all("area" in line for line in complaints), f"its check of ours: {complaints}")
    contact = O.interactions[0, 1]
    for mine, other, name in zip((contact.geom.penetrationDepth, contact.geom.normal, contact.phys.ptOnP1,
                                  contact.phys.ptOnP2), theirs, ("overlap", "normal", "ptOnP1", "ptOnP2")):
        check.close(mine, other, 1e-12, f"its check: {name}")
    exact = section_area(edge=0.1, k=0.8, r=0.01, R=0.05, height=0.025)
    check.close(contact.phys.contactArea / exact, 1, 1e-6, "its check: area against quadrature")
    print(f"YADE's area of it, of a polygon: {polygon / exact - 1:.2g} off")
    check.equal(functor().failures, 0, "its check: failures")

# --- a hundred cubes, falling into a box -----------------------------------------------------------

STEPS = 1750


class SeededPack(pack.SpherePack):
    """The cloud of the example comes from the clock; here it is the same one every time."""

    def makeCloud(self, *arguments):
        return super().makeCloud(*arguments, seed=7)


def cubes(functor_class):
    """The example's scene, ready to run."""
    random.seed(1)
    names = execute(CUBES, functor_class)
    globals()["myAddPlotData"] = names["myAddPlotData"]  # the example's runner looks for it here


def states():
    return [(tuple(b.state.pos), tuple(b.state.ori), tuple(b.state.vel), tuple(b.state.angVel)) for b in O.bodies]


if installed(CUBES):
    # It opens a window at its end; there is none here.
    yade.qt = sys.modules["yade.qt"] = types.ModuleType("yade.qt")
    yade.qt.Controller = yade.qt.View = lambda: None
    pack.SpherePack = SeededPack

    def fallen(functor_class):
        cubes(functor_class)
        run(STEPS)
        return states(), utils.kineticEnergy()

    (one, energy), (other, energy_of_theirs) = map(fallen, (yade.Ig2_PP_PP_ScGeom_Conic, yade.Ig2_PP_PP_ScGeom))
    drop = 0.5 * 9.81 * O.time**2
    cubes(yade.Ig2_PP_PP_ScGeom_Conic)
    met = sum(1 for (start, *_), (end, *_) in zip(states(), one) if abs(start[1] - end[1]) > 1e-9
              and abs(start[1] - end[1] - drop) > 0.01)
    check.true(met >= 3, f"cubes that did not fall freely: {met}")
    # Cubes of size 1 that hit the floor at up to 8 m/s. The built-in's area is that of a polygon, and its
    # solver stops at 1e-7: a bounce ends a little otherwise.
    worst = max(math.dist(a[0], b[0]) for a, b in zip(one, other))
    check.true(0 < worst < 0.02, f"positions after {STEPS} steps are apart by up to {worst:g}")
    check.close(energy / energy_of_theirs, 1, 1e-3, f"kinetic energy after {STEPS} steps")

    # Deeper in the fall, one and the same state by both: every contact.
    cubes(yade.Ig2_PP_PP_ScGeom_Conic)
    run(2750)
    there = states()
    check.equal(functor().failures, 0, "example: failures")

    def contacts(functor_class):
        cubes(functor_class)
        for body, (position, orientation, _, _) in zip(O.bodies, there):
            body.state.pos, body.state.ori = Vector3(position), Quaternion(*orientation[3:], *orientation[:3])
            body.state.vel = body.state.angVel = Vector3.Zero
        O.dt = 1e-12
        run(2)
        return {(c.id1, c.id2): (c.geom.penetrationDepth, c.geom.normal, c.geom.contactPoint, c.phys.contactArea)
                for c in O.interactions if c.isReal}

    mine, theirs = map(contacts, (yade.Ig2_PP_PP_ScGeom_Conic, yade.Ig2_PP_PP_ScGeom))
    check.true(len(mine) >= 5, f"contacts to compare: {len(mine)}")
    check.equal(sorted(mine), sorted(theirs), "who touches whom")
    for ids in sorted(set(mine) & set(theirs)):
        (depth, normal, point, area), (their_depth, their_normal, their_point, their_area) = mine[ids], theirs[ids]
        check.close(depth, their_depth, 1e-5, f"overlap of {ids}")
        check.close(normal, their_normal, 1e-3, f"normal of {ids}")
        check.close(point, their_point, 1e-4, f"contact point of {ids}")
        check.close(area / their_area, 1, 0.02, f"area of {ids}")

if not check.passed + check.failed:
    check.true("POTENTIAL_PARTICLES" in yade.config.features, "this YADE knows potential particles")
check.finish()
