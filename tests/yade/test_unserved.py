# SPDX-License-Identifier: GPL-3.0-or-later
# Where bodies pass through each other for want of a functor, the first step says so in one line.
import warnings

import potential_particles
import yade
from mixed import *

check = Checks()


def said(action):
    """The lines that an action warns with of shapes without a functor (test_laboratory.py has the other ones)."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        action()
    return [
        str(one.message) for one in caught
        if one.category is potential_particles.SceneWarning and "no functor" in str(one.message)
    ]


def scene(functors, *shapes, **keywords):
    mixed_scene(functors, **keywords)
    for i, shape in enumerate(shapes):
        place(shape, Vector3(10 * i, 0, 0), fixed=False)


plain_only = lambda: [yade.Ig2_PP_PP_ScGeom_Conic()]
for name, shape in ("Sphere", yade.Sphere(radius=1)), ("Box", yade.Box(extents=(1, 1, 1))), ("Wall", yade.Wall(axis=2)), \
        ("Facet", yade.Facet(vertices=[(0, 0, 0), (1, 0, 0), (0, 1, 0)])):
    for particle in cube(), plain(cube_planes(), r=0.05, k=0.05, R=0.9):
        scene(plain_only(), particle, shape, shape)
        lines = said(lambda: run(1))
        check.equal(len(lines), 1, f"one line for {name}: {lines}")
        kind = type(particle).__name__
        check.true(f"{kind} (1) and {name} (2): add Ig2_{name}_ConicPP_ScGeom()" in lines[0] and "\n" not in lines[0],
                   f"it says what: {lines[0]}")
        check.equal(said(lambda: run(5)), [], "and once")
        scene(None, particle, shape, shape)
        check.equal(said(lambda: run(1)), [], f"nothing is said where {name} is served")
scene(None, cube(), yade.Tetra(v=[(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]))
lines = said(lambda: O.step())
check.true(
    len(lines) == 1 and "ConicPotentialParticle (1) and Tetra (1): there is no functor for them" in lines[0],
    f"no remedy: {lines}")
scene([yade.Ig2_ConicPP_ConicPP_ScGeom()], cube(), plain(cube_planes(), r=0.05, k=0.05, R=0.9))
check.true("Ig2_PP_PP_ScGeom_Conic" in said(lambda: O.step())[0], "plain shapes beside ours")

# Nothing is said of bodies that could not touch in any case, and of scenes without potential particles.
scene(plain_only(), cube(), yade.Sphere(radius=1))
O.bodies[0].mask, O.bodies[1].mask = 1, 2
check.equal(said(lambda: O.step()), [], "bodies of masks that never meet")
scene(plain_only(), cube(), yade.Sphere(radius=1))
for body in O.bodies:
    body.dynamic = False
check.equal(said(lambda: O.step()), [], "bodies that never move")
scene(plain_only(), yade.Sphere(radius=1), yade.Wall(axis=0))
check.equal(said(lambda: O.step()), [], "no potential particles")
# A part of the scene on another rank.
scene(plain_only(), cube(), yade.Subdomain())
check.equal(said(lambda: O.step()), [], "subdomains of several ranks")
# A body that comes later is seen as well.
scene(plain_only(), cube(), cube())
check.equal(said(lambda: run(3)), [], "all is served")
place(yade.Sphere(radius=1), Vector3(0, 50, 0), fixed=False)
check.equal(len(said(lambda: run(3))), 1, "until a sphere comes")
check.equal(said(lambda: run(3)), [], "which is said once")

check.finish()
