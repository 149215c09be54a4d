# SPDX-License-Identifier: GPL-3.0-or-later
# Facets that move together: weight, energy, a wall that keeps a stress, a blade; saved and loaded; refusals.
import math
import os
import tempfile

import potential_particles
import yade
from mixed import *
from potential_particles import boundaries

check = Checks()
G = 9.81


def scene(mesh, dt=1e-5, gravity=G, **more):
    """A floor, and a lid (or others) moved by an engine with these attributes."""
    mixed_scene(dt=dt, gravity=(0, 0, -gravity), **more)
    engine = yade.MovingMesh(**mesh)
    O.engines = O.engines[:-1] + [engine] + O.engines[-1:]
    return engine


def moving():
    return engine_of(yade.MovingMesh)


def lid(height, half=1.0):
    return O.bodies.append(boundaries.plate((-half, -half, height), (2 * half, 0, 0), (0, 2 * half, 0), 0, facets=8))


def heights(ids):
    return [O.bodies[i].state.pos[2] for i in ids]


# --- weight: a lid on four balls comes to rest, and what they bear is what it weighs ------------------------
engine = scene(dict(mass=50.0, free="z", gravity=(0, 0, -G), damping=0.4), dt=2e-4, damping=0.4)
place(yade.Wall(axis=2), Vector3.Zero)
for x, y in (-0.6, -0.6), (0.6, -0.6), (-0.6, 0.6), (0.6, 0.6):
    add(ball(0.25), Vector3(x, y, 0.25))
ids = lid(0.5)
moving().ids = ids
before = heights(ids)
run(15000)
weight = 50.0 * G
check.close(moving().contactForce[2] / weight, 1.0, 1e-6, "a lid at rest: sum of contacts over weight")
balls = [b for b in O.bodies if isinstance(b.shape, yade.PotentialParticle)]
check.close(O.forces.f(0)[2] / -(weight + G * sum(b.state.mass for b in balls)), 1.0, 1e-6, "what the floor bears")
check.equal(moving().contactForce[2] > 0 and max(map(abs, moving().velocity)) < 1e-6, True, "it rests")
moved = [now - then for now, then in zip(heights(ids), before)]
check.close(max(moved) - min(moved), 0.0, 1e-14, "facets move together")
check.close(moved[0], moving().displacement[2], 1e-12, "as far as it says")
saved = os.path.join(tempfile.mkdtemp(), "lid.xml")
O.save(saved)


def go_on():
    moving().force = Vector3(0, 0, -100)
    run(500)
    return state_numbers() + list(moving().contactForce) + [moving().contactWork, moving().appliedWork]


expected = go_on()
O.reset()
O.load(saved)
potential_particles.prepare()
check.equal((moving().ids, moving().free, moving().mass), (ids, "z", 50.0), "loaded")
found = go_on()
worst = max(abs(x - y) for x, y in zip(found, expected))
check.true(len(found) == len(expected) and worst <= (0 if O.numThreads == 1 else 1e-9), f"goes on, off by {worst:g}")

# --- energy: a lid falls onto a fixed ball, an elastic spring, and bounces ------------------------------------
for dt, share in (2e-5, 2e-3), (1e-5, 1e-3):
    engine = scene(dict(mass=2.0, free="z", gravity=(0, 0, -G)), dt=dt, young=1e5)
    add(ball(0.25), Vector3(0.3, 0.2, 0), fixed=True)
    engine.ids = lid(0.30)
    O.trackEnergy = True
    stiffness, least, worst, top = None, 1.0, 0.0, -1.0
    for _ in range(60):
        run(round(0.24 / 60 / dt))
        depth = max((i.geom.penetrationDepth for i in touching()), default=0.0)
        stiffness = stiffness or max((i.phys.kn for i in touching()), default=None)
        elastic = 0.5 * (stiffness or 0.0) * depth**2
        height = engine.displacement[2]
        # Half a step apart, velocity and height differ by that much.
        scale = 2.0 * G * 0.05
        worst = max(worst, abs(engine.kineticEnergy + 2.0 * G * height + elastic) / scale)
        least, top = min(least, height), max(top, height if least < -0.05 else -1.0)
        books = engine.appliedWork + engine.contactWork - engine.dissipated
        check.close(engine.kineticEnergy, books, 1e-11, "kinetic energy is the work of all")
    check.true(least < -0.055 and top > -0.01, f"it falls to {least:g} and comes back to {top:g}")
    check.true(worst < share, f"energy of a falling lid is off by {worst:g} at dt={dt:g}")
    check.close(O.energy["meshWork"], -engine.contactWork, 1e-12, "O.energy has its work")

# --- a wall that keeps a stress, on balls in a box --------------------------------------------------------------
sigma, area = 2e4, 1.0
engine = scene(dict(mass=200.0, free="z", damping=0.6, area=area, stress=(0, 0, -sigma)), dt=1e-4, gravity=0,
               damping=0.3)
O.bodies.append(boundaries.box_walls((0, 0, 0), (1, 1, 1), 0))
for x, y, z in [(x, y, z) for x in (0.2, 0.5, 0.8) for y in (0.2, 0.5, 0.8) for z in (0.15, 0.45)]:
    add(ball(0.149), Vector3(x + 0.02 * y, y + 0.01 * z, z))
engine.ids = O.bodies.append(boundaries.plate((0, 0, 0.62), (1, 0, 0), (0, 1, 0), 0))
run(12000)
check.close(engine.contactForce[2] / area / sigma, 1.0, 0.01, "a servo wall reaches its stress")
first = engine.displacement[2]
engine.stress = Vector3(0, 0, -2 * sigma)
run(12000)
check.close(engine.contactForce[2] / area / (2 * sigma), 1.0, 0.01, "and the next one")
check.true(engine.displacement[2] < first, "by going further")
engine.greatestSpeed = 1e-3
engine.stress = Vector3(0, 0, sigma)
run(100)
check.close(abs(engine.velocity[2]), 1e-3, 1e-15, "no faster than it may")

# --- prescribed: a blade that turns pushes as its torque says; a plate that is pushed down ---------------------
engine = scene(dict(angularVelocity=(0, 0, 2.0), centre=(0.5, 0, 0)), dt=1e-4, gravity=0)
engine.ids = O.bodies.append(boundaries.plate((0.5, 0, -0.2), (1.0, 0, 0), (0, 0, 0.4), 0))
add(ball(0.1), Vector3(0.5 + 0.8 * math.cos(1.0), 0.8 * math.sin(1.0), 0))
tip = lambda: [tuple(O.bodies[i].state.pos + O.bodies[i].state.ori * v - Vector3(0.5, 0, 0))[:2] for i in engine.ids
               for v in O.bodies[i].shape.vertices]
radii = [math.hypot(*p) for p in tip()]
angle = 2.0 * 1e-4 * 6000
for _ in range(60):
    run(100)
check.close(max(abs(math.hypot(*p) - r) for p, r in zip(tip(), radii)), 0.0, 1e-11, "a blade stays on its circle")
corner = max(tip(), key=lambda p: math.hypot(*p))
check.close(math.atan2(corner[1], corner[0]), angle, 1e-9, "and turns by its angle")
gained = utils.kineticEnergy()
check.true(gained > 0.1, f"it has struck the ball, {gained:g}")
check.close(-engine.contactWork / gained, 1.0, 2e-2, "whose energy is its work")
check.equal(engine.velocity, Vector3.Zero, "its centre stands")
engine = scene(dict(velocity=(0.1, 0, -0.2), free="y", mass=1.0, force=(0, 3.0, 0)), dt=1e-4, gravity=0)
engine.ids = lid(1.0)
run(1000)
check.close(O.bodies[engine.ids[0]].state.vel, Vector3(0.1, 3.0 * 0.1, -0.2), 1e-12, "prescribed along some axes")
check.close(engine.displacement, Vector3(0.01, 0.015015, -0.02), 1e-12, "and on its way")

# --- refusals -------------------------------------------------------------------------------------------------
for keywords, says in [
    (dict(mass=1.0, free="zz"), "must be some of"), (dict(mass=1.0, free="w"), "free"), (dict(free="z"), "mass = 0"),
    (dict(mass=-1.0), "mass = -1"), (dict(stress=(0, 0, 1)), "area = 0"), (dict(damping=1.0), "damping = 1"),
    (dict(greatestSpeed=-1), "greatestSpeed = -1"), (dict(force=(0, 0, math.nan)), "finite"),
]:
    check.raises(ValueError, lambda: yade.MovingMesh(**keywords), f"{keywords}", says)

# YADE ends with an assertion where the members of a clump have no mass.
O.reset()
O.materials.append(yade.FrictMat(density=2000))
ids = lid(0.0)
check.raises(ValueError, lambda: O.bodies.clump(ids), "a clump of facets", "MovingMesh")
check.raises(ValueError, lambda: O.bodies.appendClumped(boundaries.plate((0, 0, 0), (1, 0, 0), (0, 1, 0), 0)),
             "facets appended as a clump", "have no mass")
check.raises(ValueError, lambda: potential_particles.clump(ids), "our clump of facets", "MovingMesh")
check.equal(O.bodies[O.bodies.clump([O.bodies.append(utils.sphere((x, 5, 5), 0.6)) for x in (0, 1)])].isClump, True,
            "clumps of others are made as ever")
check.finish()
