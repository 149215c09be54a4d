# SPDX-License-Identifier: GPL-3.0-or-later
# What YADE's tools do with potential particles (docs/laboratory.md), check(), and the measures that take the place of YADE's.
import contextlib
import io
from pathlib import Path

import harness
import potential_particles
import yade
import yade.wrapper as w
from mixed import *

check = Checks()
TOP = Path(harness.__file__).resolve().parents[2]


def findings():
    """Those of check(), each as one text, and that it prints a line for each."""
    printed = io.StringIO()
    with contextlib.redirect_stdout(printed):
        found = potential_particles.check()
    check.equal(printed.getvalue().splitlines(), [f"potential_particles: {one.what}: {one.remedy}" for one in found], "a line for each finding")
    return [str(one) for one in found]


def finds(number, *parts):
    """That check() finds so many things, one of which holds all parts."""
    found = findings()
    check.true(len(found) == number and any(all(part in one for part in parts) for one in found), f"{parts} in {found}")


def right_scene(**keywords):
    """Two cubes, one on the other, over a facet, with all that they need."""
    mixed_scene(gravity=(0, 0, -9.81), **keywords)
    add(cube(k=1e-4), Vector3(0, 0, 0.4999))
    add(pyramid(), Vector3(0, 0, 2))
    facets([((-2, -2, 0), (2, -2, 0), (0, 3, 0))])
    O.dt = potential_particles.critical_time_step()


# A scene without potential particles, and right ones, before and after contacts.
O.reset()
check.equal(findings(), [], "an empty scene")
right_scene()
check.equal(findings(), [], "a right scene")
run(5)
check.true(any(c.isReal for c in O.interactions), "it has a contact")
check.equal(findings(), [], "a right scene with contacts")
script = (TOP / "examples/first_pile.py").read_text()
O.reset()
exec(compile(script.split("O.run(")[0], "first_pile.py", "exec"), vars(yade) | vars(w) | {"O": O})
check.equal((len(O.bodies) > 50, findings()), (True, []), "the first pile at its start")
run(int(0.5 / O.dt))
check.true(sum(c.isReal for c in O.interactions) > 20, "the pile has contacts")
check.equal(findings(), [], "the first pile after a fall")

# Boxes and contact functors.
right_scene()
O.engines[1].boundDispatcher.functors = [yade.PotentialParticle2AABB()]
finds(1, "no boxes for Facet (1)", "Bo1_Facet_Aabb()")
O.engines[1].boundDispatcher.functors = [yade.Bo1_Facet_Aabb()]
finds(1, "no boxes for ConicPotentialParticle (2)", "PotentialParticle2AABB()")
right_scene(functors=[yade.Ig2_ConicPP_ConicPP_ScGeom()])
finds(1, "no functor for ConicPotentialParticle (2) and Facet (1)", "Ig2_Facet_ConicPP_ScGeom()")
right_scene(functors=[yade.Ig2_Facet_ConicPP_ScGeom()])
finds(1, "no functor for ConicPotentialParticle (2) and ConicPotentialParticle (2)")

# Overlaps, time step, mass, weight, rotation: each alone.
right_scene()
O.bodies[0].state.pos = Vector3(0, 0, 0.43)
O.step()
check.true(potential_particles.overlap_ratio() > 1, "an overlap beyond r")
finds(1, "overlap by 1.4 of the rounding radius")
right_scene()
O.dt = 2.1 * potential_particles.critical_time_step()
finds(1, "O.dt=", "critical_time_step")
O.dt = 1.9 * potential_particles.critical_time_step()
check.equal(findings(), [], "a step within the proved limit")
right_scene()
O.bodies[0].state.mass *= 1.02
finds(1, "body 0: the mass is not volume times density")
O.bodies[0].state.mass /= 1.015
check.equal(findings(), [], "a mass within 1 %")
right_scene(young=1e4)
finds(1, "the weight alone makes overlaps beyond the rounding radius")
right_scene()
O.engines[-1].exactAsphericalRot = False
finds(1, "exactAsphericalRot=True")
right_scene()
O.bodies[0].aspherical = False
check.equal(findings(), [], "the moments of inertia of a cube are equal")
O.bodies[1].aspherical = False
finds(1, "body 1", "aspherical=True")

check.finish()
