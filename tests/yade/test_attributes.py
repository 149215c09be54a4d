# SPDX-License-Identifier: GPL-3.0-or-later
# What existing scripts set on YADE's functor, its shapes, bodies and engines means the same with ours.
import math

import potential_particles
import yade
from harness import *

check = Checks()
BOTH = yade.Ig2_PP_PP_ScGeom, yade.Ig2_PP_PP_ScGeom_Conic
OURS = yade.Ig2_ConicPP_ConicPP_ScGeom, yade.Ig2_PP_PP_ScGeom_Conic


def block(r=0.1, half=0.5, **more):
    return plain(cube_planes(half, r), r=r, k=0.2, R=1.8 * half, **more)


def place(shape, position, orientation=Quaternion.Identity, **more):
    return add(shape, position, orientation, volume=1.0, inertia=Vector3(1, 1, 1) / 6, **more)


def both(scene, found):
    """What found() says of the same scene with the functor of YADE and with ours."""
    answers = []
    for kind in BOTH:
        scene(kind)
        answers.append(found())
    check.equal(functor().failures, 0, "failures")
    return answers


# Every keyword of the built-in functor is one of ours, with the same default, on both of ours.
theirs = yade.Ig2_PP_PP_ScGeom().dict()
for kind in OURS:
    mine = kind().dict()
    check.equal({key: mine.get(key) for key in theirs}, theirs, f"{kind.__name__}: keywords and defaults")
    check.true("not used" in getattr(kind, "areaStep").__doc__ and "areaTolerance" in getattr(kind, "areaStep").__doc__,
               f"{kind.__name__}: areaStep says what it does")


# areaStep is an angle between samples for the built-in. Our area does not depend on it.
def tilted(kind, **keywords):
    fresh_scene(kind(**keywords), dt=1e-12)
    place(block(), Vector3.Zero, fixed=True)
    place(block(), Vector3(0.12, 0.05, 0.93), turned((1, 2, 3), 0.4), fixed=True)
    run(2)
    return O.interactions[0, 1].phys


fine, coarse = (tilted(BOTH[1], areaStep=step).contactArea for step in (1, 45))
check.equal(fine, coarse, "area with another areaStep")
check.close(tilted(BOTH[0], areaStep=1).contactArea / fine, 1, 2e-3, "the built-in's, at its finest")

# Two dimensions: jointLength, the width of the overlap in the plane across the normal; the area, that times
# unitWidth2D. In any plane.
for direction in ((0, 1, 0), (1, 0, 0), (1, -1, 0.2)):
    flat = dict(twoDimension=True, twoDdir=Vector3(direction), unitWidth2D=0.7)
    area = tilted(BOTH[0], **flat).contactArea
    phys = tilted(BOTH[1], **flat)
    check.close(phys.contactArea / area, 1, 2e-5, f"two dimensions, normal {direction}: area")
    check.close(phys.contactArea, 0.7 * phys.jointLength, 1e-15, f"two dimensions, normal {direction}: length")
# Two blocks aside of each other: halfway through the overlap their edges are quarters of circles.
r = 0.05
fresh_scene(BOTH[1](twoDimension=True, unitWidth2D=3.0), dt=1e-12)
for x, z in ((0, 0), (0.3, 0.99)):
    place(plain(cube_planes(0.5, r), r=r, k=1e-9, R=1), Vector3(x, 0, z), fixed=True)
run(2)
shared = 2 * (0.5 - r + math.sqrt(r**2 - (r - 0.005)**2)) - 0.3
check.close(O.interactions[0, 1].phys.jointLength, shared, 1e-6, "two dimensions: length shared by two faces")
check.close(O.interactions[0, 1].phys.contactArea, 3 * shared, 3e-6, "and the area")
phys = tilted(BOTH[1], twoDimension=True, calContactArea=False, unitWidth2D=0.7)
check.equal((phys.contactArea, phys.jointLength), (0.7, 1.0), "two dimensions without area: one unit long")
phys = tilted(BOTH[1], calContactArea=False)
check.equal((phys.contactArea, phys.jointLength), (1.0, 1.0), "no area: of size one")

# A prescribed normal of any length is a direction (the built-in would take it as it is); of no length
# it is none.
for given, expected in ((Vector3(0, 1.2, 1.6), Vector3(0, 0.6, 0.8)), (Vector3(0, 0, 0), Vector3(0, 0, 1))):
    fresh_scene(BOTH[1](), dt=1e-12)
    place(block(isBoundary=True, fixedNormal=True, boundaryNormal=given), Vector3.Zero, fixed=True)
    place(block(), Vector3(0, 0, 0.9), fixed=True)
    run(2)
    check.close(O.interactions[0, 1].geom.normal, expected, 1e-9, f"prescribed normal {given}")

# A boundary whose normal is its own: a floor pushes along it whatever stands on its edge.
def floor(kind):
    fresh_scene(kind(calContactArea=False), dt=1e-5)
    place(block(isBoundary=True, fixedNormal=True, boundaryNormal=(0, 0, 1)), Vector3.Zero, fixed=True)
    place(block(), Vector3(0.35, 0.2, 0.97), turned((1, 2, 0), 0.1))
    run(200)


one, other = both(floor, lambda: (O.interactions[0, 1].geom.normal, O.forces.f(1), O.bodies[1].state.pos))
for a, b, name in zip(one, other, ("normal", "force", "position")):
    check.close(b, a, 1e-4 * a.norm(), f"on a floor with a prescribed normal: {name}")


# Masks: bodies of one mask that has a bit of avoidSelfInteractionMask do not meet; all others do.
def masked(first, second, avoid):
    fresh_scene(BOTH[1](), dt=1e-12)
    O.engines[1].avoidSelfInteractionMask = avoid
    for mask, z in ((first, 0), (second, 0.9)):
        O.bodies[place(block(), Vector3(0, 0, z), fixed=True)].mask = mask
    run(2)
    return functor().calls, len([c for c in O.interactions if c.isReal])


check.equal(masked(3, 3, 2), (0, 0), "two bodies of a mask that avoids itself")
check.equal(masked(1, 3, 2), (2, 1), "a mask that shares a bit with another")
check.equal(masked(3, 3, 0), (2, 1), "the same mask, nothing avoided")
check.equal(masked(1, 2, 0), (0, 0), "masks without a common bit")


# Contacts that are never erased: opened by hand and closed again.
def opened(kind):
    fresh_scene(kind(calContactArea=False), law=yade.Law2_SCG_KnKsPhys_KnKsLaw(neverErase=True), dt=1e-9)
    place(block(), Vector3.Zero, fixed=True)
    place(block(), Vector3(0.1, 0, 0.93), turned((1, 2, 3), 0.05), fixed=True)
    states.clear()
    for z in (0.93, 0.93, 1.2, 1.2, 0.92, 0.92):
        O.bodies[1].state.pos = Vector3(0.1, 0, z)
        O.step()
        contact = O.interactions[0, 1]
        states.append((contact.isReal, contact.geom.penetrationDepth > 0, contact.phys.normalForce[2]))


states = []
one, other = both(opened, lambda: list(states))
check.equal([state[:2] for state in one], [state[:2] for state in other],
            "kept, and open or closed, as the built-in has it")
check.equal([state[:2] for state in other[2:4]], [(True, False)] * 2, "kept while open")
for step, (a, b) in enumerate(zip(one, other)):
    check.close(b[2], a[2], 1e-3 * one[-1][2], f"force in step {step} of a contact that is never erased")
check.equal([state[2] for state in other[2:4]], [0.0, 0.0], "no force while open")


# Clumps: members move as one body, do not meet each other, and meet others as their shapes do.
def clump(kind):
    fresh_scene(kind(calContactArea=False), dt=2e-5)
    place(block(), Vector3(0, 0, -0.005), fixed=True)
    members = [place(block(half=0.3), Vector3(x, 0.1, 0.81)) for x in (-0.25, 0.25)]
    number = O.bodies.clump(members)
    O.bodies[number].state.vel = Vector3(0, 0, -1)
    O.bodies[number].state.angVel = Vector3(0.3, 0.1, 0)
    start = O.bodies[number].state.pos
    run(1500)
    check.true(all(c.id1 == 0 or c.id2 == 0 for c in O.interactions.all()), "members do not meet each other")
    check.true(O.bodies[number].state.vel[2] > 0.5, f"the clump bounced: {O.bodies[number].state.vel}")
    states[:] = [v for b in O.bodies for v in (b.state.pos, b.state.vel, b.state.angVel)]


one, other = both(clump, lambda: list(states))
for index, (a, b) in enumerate(zip(one, other)):
    check.close(b, a, 1e-3, f"clump: {('position', 'velocity', 'spin')[index % 3]} of body {index // 3}")

# Ours in a clump: the same again, with the shape that knows itself.
def own(shape, position):
    return add(shape(r=0.1, k=0.2, R=0.9 * 0.6, half=0.3), position)


fresh_scene(yade.Ig2_ConicPP_ConicPP_ScGeom(calContactArea=False), dt=2e-5)
add(cube(r=0.1, k=0.2), Vector3(0, 0, -0.005), fixed=True)
members = [own(cube, Vector3(x, 0.1, 0.81)) for x in (-0.25, 0.25)]
number = O.bodies.clump(members)
mass = sum(O.bodies[i].state.mass for i in members)
check.close(O.bodies[number].state.mass, mass, 1e-9 * mass, "a clump weighs what its members weigh")
O.bodies[number].state.vel = Vector3(0, 0, -1)
energy = utils.kineticEnergy()
run(1500)
check.true(O.bodies[number].state.vel[2] > 0.5, f"a clump of ours bounced: {O.bodies[number].state.vel}")
check.close(O.bodies[members[1]].state.pos - O.bodies[members[0]].state.pos, Vector3(0.5, 0, 0), 0.05, "as one body")
# Overlap times normal is no gradient of an energy where faces meet off their centres: a percent is
# the law's own, whatever the time step.
check.close(utils.kineticEnergy() / energy, 1, 0.02, "and kept its energy")

check.finish()
