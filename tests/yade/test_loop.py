# SPDX-License-Identifier: GPL-3.0-or-later
# threads
# ConicInteractionLoop finds what InteractionLoop finds, whatever bodies, shapes and scenes do between its calls.
import math
import os
import random
import tempfile

import potential_particles
import yade
from harness import *

check = Checks()
folder = tempfile.mkdtemp()


def conic_loop():
    """Puts a ConicInteractionLoop in the place of the scene's loop, and returns it."""
    engines = O.engines
    old = engines[2]
    engines[2] = yade.ConicInteractionLoop(old.geomDispatcher.functors, old.physDispatcher.functors,
                                           old.lawDispatcher.functors)
    O.engines = engines
    return O.engines[2]


def one_thread():
    """By YADE's loop forces are summed in an order of their own by each thread: bits can be compared with one alone,
    and in the order of ids.
    """
    for engine in O.engines:
        engine.ompThreads = 1
    if type(O.engines[2]) is yade.InteractionLoop:
        O.engines[2].loopOnSortedInteractions = True


def some_contact(area=False, **keywords):
    return yade.Ig2_PP_PP_ScGeom_Conic(calContactArea=area, **keywords)


def heap(loop, functor_, plain_shapes=False):
    """36 cubes and pyramids fall on a floor."""
    fresh_scene(functor_, dt=1e-4, damping=0.2, gravity=(0, 0, -9.81), friction=0.5)
    one_thread()
    draw = random.Random(4)
    add(cube(half=2.5, R=4.3, isBoundary=True), Vector3(0, 0, -2.5), fixed=True)
    for i in range(36):
        turn = turned([draw.random() for _ in range(3)], draw.uniform(0, 3))
        place = Vector3(0.95 * (i % 3) - 0.95, 0.95 * (i // 3 % 3) - 0.95, 0.5 + 0.95 * (i // 9))
        if i % 2:
            shape, planes, more = cube(half=0.3, R=0.5, r=0.04), cube_planes(0.3, 0.04), dict(r=0.04, k=0.05, R=0.5)
        else:
            shape, planes, more = pyramid(size=0.45, R=0.7, r=0.04), pyramid_planes(0.45,
                                                                                    0.04), dict(r=0.04, k=0.05, R=0.7)
        volume, inertia = shape.volume, shape.inertia.diagonal()
        add(plain(planes, **more) if plain_shapes else shape, place, turn, volume=volume, inertia=inertia)
    if loop is yade.ConicInteractionLoop:
        conic_loop()
        one_thread()
    potential_particles.prepare()


def forces():
    return [x for b in O.bodies for v in (O.forces.f(b.id), O.forces.t(b.id)) for x in v]


def touching():
    return {(i.id1, i.id2) for i in O.interactions if i.isReal}


def fallen(looks=8, steps=250):
    """What moves, forces and real contacts, at each of the looks."""
    seen = []
    for _ in range(looks):
        run(steps)
        seen.append((state_numbers(), forces(), touching()))
    return seen, functor()


def worst_of(found, expected, part):
    return max(abs(x - y) for one, other in zip(found, expected) for x, y in zip(one[part], other[part]))


# --- the same scene by both loops -----------------------------------------------------------
for plain_shapes in (True, False):
    text = "plain shapes" if plain_shapes else "our shapes"
    heap(yade.InteractionLoop, some_contact(carryTolerance=0), plain_shapes)
    expected, usual = fallen()
    heap(yade.ConicInteractionLoop, some_contact(carryTolerance=0), plain_shapes)
    found, contacts = fallen()
    check.equal(type(O.engines[2]).__name__, "ConicInteractionLoop", "which loop ran")
    most = max(len(one[2]) for one in expected)
    check.true(most >= 10, f"{text}: contacts at a time: {most}")
    check.equal([found[i] == one for i, one in enumerate(expected)], [True] * len(expected),
                f"{text}: motion, forces and contacts to the last bit, off by {worst_of(found, expected, 0):g}")
    check.equal((contacts.failures, contacts.calls, contacts.overlapping), (0, usual.calls, usual.overlapping),
                f"{text}: counters")
    check.equal(contacts.answers, usual.answers, f"{text}: answers")
    check.equal(contacts.answers["carried"], 0, f"{text}: none is carried on with carryTolerance=0")
    check.true(contacts.answers["motion"] > 0.5 * (contacts.calls - contacts.overlapping),
               f"{text}: most sleep: {contacts.answers}")

    # Carried on, the same contacts to within what its tolerance allows; what falls on corners is no chaos yet.
    heap(yade.ConicInteractionLoop, some_contact(), plain_shapes)
    carried, contacts = fallen()
    check.equal([one[2] for one in carried], [one[2] for one in expected], f"{text}: the same contacts when carried on")
    off = worst_of(carried, expected, 0)
    check.true(0 < off < 1e-5, f"{text}: carried on, motion differs by {off:g}")
    check.true(contacts.answers["carried"] > 0.5 * contacts.overlapping,
               f"{text}: most contacts are carried on: {contacts.answers}")
    check.equal(contacts.answers["carried"] + contacts.rejected + contacts.solved, contacts.calls,
                f"{text}: every call is one answer")
    check.equal(contacts.failures, 0, f"{text}: failures")
    print(f"{text}: carried on, motion differs by {off:g}; {contacts.answers}")

# As many threads as there are.
heap(yade.ConicInteractionLoop, some_contact())
for engine in O.engines:
    engine.ompThreads = -1
shared, contacts = fallen()
check.true(shared == carried,
           f"one thread and {O.numThreads}, to the last bit: motion differs by {worst_of(shared, carried, 0):g}")
check.equal((contacts.failures, sum(contacts.answers.values())), (0, contacts.calls),
            "failures, and every call is one answer")

# --- energy and momentum ----------------------------------------------------------------------
def bouncing(tolerance):
    """Relative change of the energy of two turning cubes that bounce between two fixed ones, and their momentum."""
    fresh_scene(some_contact(carryTolerance=tolerance), law=yade.Law2_SCG_KnKsPhys_KnKsLaw(neverErase=True),
                stiffness=1e4)
    for number, (x, fixed) in enumerate([(-0.6, False), (0.6, False), (-1.8, True), (1.8, True)]):
        add(cube(0.1, 0.1, math.sqrt(0.75)), Vector3(x, 0, 0), turned((1, 0, 0), 0.3 * number), fixed, density=1.0)
    conic_loop()
    O.bodies[0].state.vel, O.bodies[1].state.vel = Vector3(1, 0, 0), Vector3(-1, 0, 0)
    O.dt = 1e-4
    first, free, bounces, touched = utils.kineticEnergy(), [], 0, False
    for _ in range(6000):
        O.step()
        depth = max([i.geom.penetrationDepth for i in O.interactions if i.isReal], default=-1)
        if touched and depth <= 0:
            free.append(utils.kineticEnergy() / first - 1)
        touched = depth > 0
    return free, momentum(), functor()


(carried_energy, carried_momentum, contacts), (energy, solved_momentum, _) = bouncing(1e-9), bouncing(0)
check.true(contacts.answers["carried"] > 100, f"contacts of the bounces are carried on: {contacts.answers}")
check.true(len(energy) == len(carried_energy) >= 2, f"bounces: {len(energy)} and {len(carried_energy)}")
drift = max(map(abs, energy))
check.true(drift < 1e-3, f"energy changes by {drift:g}")
difference = max(abs(one - other) for one, other in zip(energy, carried_energy))
check.true(difference < 1e-10, f"and by as much when carried on, to within {difference:g}")
for one in (carried_momentum, solved_momentum):
    check.close(one, Vector3.Zero, 1e-7, "momentum of the mirrored pair")
print(f"energy: {drift:g} in {len(energy)} bounces, carried on differs by {difference:g}")

# --- counters and settings ----------------------------------------------------------------------
def pair(gap, first=None, second=None, functor_=None):
    """Two fixed bodies, the second above the first; returns the loop."""
    fresh_scene(functor_ or some_contact(), dt=1e-9)
    add(first or cube(), Vector3.Zero, fixed=True)
    add(second or cube(), Vector3(0, 0, 1 + gap), fixed=True)
    collide()
    return conic_loop()


def collide():
    """Makes YADE forget its interactions, and find every pair anew in the next step, however far apart it is."""
    O.interactions.clear()
    engines = O.engines
    engines[1] = yade.InsertionSortCollider([yade.PotentialParticle2AABB()], verletDist=3.0)
    O.engines = engines
    for body in O.bodies:
        body.bound = None  # boxes of what does not move are widened once


pair(-0.02)
run(20)
check.true(functor().answers["carried"] >= 15, f"at rest, contacts are carried on: {functor().answers}")
pair(0.5)
run(20)
check.equal(functor().answers["motion"], 19, f"at rest, what is apart sleeps: {functor().answers}")
for value in (-1.0, 0.2, float("nan"), float("inf")):
    check.raises(ValueError, lambda: some_contact(carryTolerance=value), f"carryTolerance={value}", "carryTolerance")
    check.raises(ValueError, lambda: setattr(functor(), "carryTolerance", value), f"set to {value}", "carryTolerance")
check.equal(functor().carryTolerance, 1e-9, "the value before stays")
pair(-0.02, functor_=some_contact(carryTolerance=0))
run(5)
functor().carryTolerance = 1e-9
run(5)
check.true(functor().answers["carried"] >= 3, "the setting takes effect in a run")
carried_before = functor().answers["carried"]
functor().carryTolerance = 0
run(5)
check.equal(functor().answers["carried"], carried_before, "and so does 0")

# --- shapes that change or are replaced ---------------------------------------------------------
def insert(body):
    """In the place of body 1, where this YADE can do so."""
    return O.bodies.insertAtId(body, 1) if hasattr(O.bodies, "insertAtId") else O.bodies.append(body)


for plain_shapes in (False, True):
    kind = "plain shapes" if plain_shapes else "our shapes"

    def shape(half):
        return plain(cube_planes(half), r=0.05, k=0.05, R=1.8 * half) if plain_shapes else cube(half=half, R=1.8 * half)

    def two():
        pair(0.2)
        O.bodies[0].shape, O.bodies[1].shape = shape(0.5), shape(0.5)

    two()
    run(3)
    check.equal((touching(), functor().answers["motion"]), (set(), 2), f"{kind}: asleep")
    changed = O.bodies[1].shape
    if plain_shapes:
        changed.a, changed.b, changed.c, changed.d = map(list, zip(*cube_planes(0.8)))
    else:
        changed.planes = cube_planes(0.8)
    run(1)
    check.equal(touching(), {(0, 1)}, f"{kind}: planes that were changed are seen in the next step")

    # Shapes of many sizes, so that one is made where another was in memory: the pair sleeps with the small one only.
    two()
    wrong = 0
    for attempt in range(50):
        O.bodies[1].shape = None
        O.bodies[1].shape = shape(0.5 - 1e-3 * attempt)
        collide()
        run(3)
        wrong += bool(touching())
        O.bodies[1].shape = None
        O.bodies[1].shape = shape(0.8 + 1e-3 * attempt)
        run(1)
        wrong += not touching()
    check.equal(wrong, 0, f"{kind}: wrong answers after a shape was replaced")

    # So it is for an id that a new body takes.
    two()
    wrong, last = 0, 1
    for attempt in range(50):
        for half, meets in ((0.5 - 1e-3 * attempt, False), (0.8 + 1e-3 * attempt, True)):
            O.bodies.erase(last)
            body = Body()
            body.shape = shape(half)
            utils._commonBodySetup(body, 1, Vector3(1, 1, 1), material=-1, pos=Vector3(0, 0, 1.2), fixed=True)
            last = insert(body)
            collide()
            run(3)
            wrong += bool(touching()) != meets
    check.equal(wrong, 0, f"{kind}: wrong answers after an id was used again")

# An invalid particle, and a valid one after it.
pair(0.2, second=cube(half=0.5))
run(2)
O.bodies[1].shape = yade.PotentialParticle(a=[1], b=[0], c=[0], d=[0.4], r=-1.0, k=0.05, R=0.9)
run(2)
check.equal((touching(), functor().failures), (set(), 2), "an invalid particle is a failure in each step, not a sleep")
O.bodies[1].shape = plain(cube_planes(0.8), r=0.05, k=0.05, R=1.4)
run(1)
check.equal((touching(), functor().failures), ({(0, 1)}, 2), "and a valid one in its place is seen")

# --- walls and facets -----------------------------------------------------------------------------
def above_flat(flat, functor_):
    """A fixed cube 0.2 above a boundary that is body 0; the loop, after three steps."""
    fresh_scene(functor_, dt=1e-9)
    O.bodies.append(flat)
    add(cube(), Vector3(0, 0, 0.7), fixed=True)
    engines = O.engines
    engines[1] = yade.InsertionSortCollider(
        [yade.PotentialParticle2AABB(), yade.Bo1_Wall_Aabb(),
         yade.Bo1_Facet_Aabb()], verletDist=3.0)
    O.engines = engines
    loop = conic_loop()
    run(3)
    return loop


corners = ((-1, -1, 0), (2, -1, 0), (-1, 2, 0))
for flat, functor_ in (lambda: utils.facet(corners, fixed=True),
                       yade.Ig2_Facet_ConicPP_ScGeom), (lambda: utils.wall(0, axis=2), yade.Ig2_Wall_ConicPP_ScGeom):
    kind = functor_.__name__
    loop = above_flat(flat(), functor_())
    check.equal((touching(), functor().answers["motion"]), (set(), 2), f"{kind}: asleep")
    boundary, start = O.bodies[0], O.bodies[0].state.pos
    wrong = 0
    for number in range(120):
        height = 0.0021 * number if number % 40 else 0.3
        boundary.state.pos = start + Vector3(0, 0, height)
        loop()
        depth = [i.geom.penetrationDepth for i in O.interactions if i.isReal]
        wrong += abs(height - 0.2) > 0.01 and (bool(depth) and depth[0] > 0) != (height > 0.2
                                                                                 )  # its face bulges a little
    check.equal(wrong, 0, f"{kind}: is seen when it moves")

loop = above_flat(utils.facet(corners, fixed=True), yade.Ig2_Facet_ConicPP_ScGeom())
O.bodies[0].shape.vertices = [vertex + Vector3(0, 0, 0.25) for vertex in O.bodies[0].shape.vertices]
run(1)
check.equal(touching(), {(0, 1)}, "vertices that were changed are seen in the next step")
loop = above_flat(utils.facet(corners, fixed=True), yade.Ig2_Facet_ConicPP_ScGeom())
O.bodies[0].state.ori = turned((1, 0, 0), 0.6)
run(1)
check.equal(touching(), {(0, 1)}, "and a facet that has turned")
loop = above_flat(utils.facet(corners, fixed=True), yade.Ig2_Facet_ConicPP_ScGeom())
run(100)
O.bodies[0].shape = utils.facet([(x, y, 0.6) for x, y, _ in corners]).shape
O.bodies[0].state.pos = Vector3(0, 0, 0.3)
run(1)
check.equal(touching(), {(0, 1)}, "and one with another shape")
loop = above_flat(utils.wall(0, axis=2), yade.Ig2_Wall_ConicPP_ScGeom())
O.bodies[0].shape.axis = 0
run(1)
check.equal(touching(), {(0, 1)}, "and a wall with another axis")

# --- bodies that are moved between calls --------------------------------------------------------
loop = pair(0.5)
run(2)
upper = O.bodies[1].state
wrong = 0
for number in range(200):
    upper.pos = Vector3(0, 0, 1.5 - 0.003 * number if number % 50 else 0.99)
    upper.ori = turned((0, 0, 1), 0.01 * number)
    loop()  # several times in one step of YADE's
    depth = [i.geom.penetrationDepth for i in O.interactions if i.isReal]
    wrong += (bool(depth) and depth[0] > 0) != (upper.pos[2] < 1)
check.equal(wrong, 0, "a loop called by hand after each move, within one step")
upper.pos = Vector3(0, 0, math.nan)
failures = functor().failures
loop()
check.equal(functor().failures, failures + 1, "a pose that is not a number fails")
upper.pos = Vector3(0, 0, 0.99)
loop()
check.true(touching() and O.interactions[0, 1].geom.penetrationDepth > 0, "and is forgotten after it")
upper.pos, upper.ori = Vector3(0, 0, 1e8), Quaternion.Identity
loop()
loop()
upper.pos = Vector3(0, 0, 0.99)
loop()
check.true(touching() and O.interactions[0, 1].geom.penetrationDepth > 0, "from far away and back")

# An interaction that YADE made anew is looked at anew, so that it remembers what it would by InteractionLoop.
edge = cube().surfaceDistance([(0, 1, 1)])[0]
pair(2 * edge + 0.002 - 1)
O.bodies[0].state.ori, O.bodies[1].state.ori = turned((1, 0, 0), math.pi / 4), turned((0, 1, 0), math.pi / 4)
run(5)
check.equal((functor().answers["motion"], O.interactions[0, 1].isReal), (4, False),
            f"edges that cross sleep: {functor().answers}")
remembered = O.interactions[0, 1].geom.memory
collide()
run(2)
check.true(O.interactions[0, 1].geom is not None, "a new interaction has a geometry")
check.equal(O.interactions[0, 1].geom.memory, remembered, "and remembers as much as the one before")

# --- two scenes -----------------------------------------------------------------------------------
pair(-0.02)
name = os.path.join(folder, "touching.xml")
O.save(name)
loop = pair(0.5)
run(3)
O.switchScene()
O.load(name)  # not pair(), which empties both
shared = O.engines
shared[2] = loop
shared[2].geomDispatcher.functors = [some_contact()]
O.engines = shared  # the loop itself, which met bodies of the same ids and shapes in the other scene
run(3)
check.equal(touching(), {(0, 1)}, "one loop in two scenes: a contact in the second")
O.switchScene()
run(2)
check.equal(touching(), set(), "and none in the first")
O.bodies[1].state.pos = Vector3(0, 0, 0.99)
run(1)
check.equal(touching(), {(0, 1)}, "until they meet there")

# --- a saved scene --------------------------------------------------------------------------------
for ending in ("xml", "yade.gz"):
    heap(yade.ConicInteractionLoop, some_contact(carryTolerance=0))
    run(1500)
    name = os.path.join(folder, "heap." + ending)
    O.save(name)
    run(300)
    expected = state_numbers(), touching()
    O.reset()
    O.load(name)
    check.equal(type(O.engines[2]).__name__, "ConicInteractionLoop", f"{ending}: the loop is loaded")
    potential_particles.prepare()
    run(300)
    check.equal(touching(), expected[1], f"{ending}: contacts go on")
    off = max(abs(x - y) for x, y in zip(state_numbers(), expected[0]))
    check.equal(off, 0.0, f"{ending}: and so does the motion, to the last bit")
    O.load(name)  # over a scene that has run
    run(300)
    again = max(abs(x - y) for x, y in zip(state_numbers(), expected[0]))
    check.equal(again, off, f"{ending}: loaded once more")

# --- periodic cells -------------------------------------------------------------------------------
def gas(loop, steps):
    """Cubes that fly through a periodic cell which shrinks; motion and contacts at each look."""
    fresh_scene(some_contact(carryTolerance=0), dt=1e-4, periodic=True)
    one_thread()
    O.cell.setBox(4, 4, 4)
    draw = random.Random(7)
    for i in range(27):
        place = Vector3(i % 3, i // 3 % 3, i // 9) * 4 / 3 + Vector3(0.1, 0.1, 0.1)
        add(cube(half=0.4, R=0.72), place, turned([draw.random() for _ in range(3)], draw.uniform(0, 3)))
        O.bodies[i].state.vel = Vector3([draw.uniform(-5, 5) for _ in range(3)])
        O.bodies[i].state.angVel = Vector3([draw.uniform(-5, 5) for _ in range(3)])
    O.cell.velGrad = yade.Matrix3(-0.5, 0.2, 0, 0, -0.5, 0, 0, 0, -0.5)
    if loop is yade.ConicInteractionLoop:
        conic_loop()
        one_thread()
    O.engines[2].loopOnSortedInteractions = True
    seen = []
    for _ in range(10):
        run(steps)
        seen.append((state_numbers(), touching()))
    return seen, functor().answers, {tuple(i.cellDist) for i in O.interactions if i.isReal}


expected, usual, images = gas(yade.InteractionLoop, 300)
found, answers, _ = gas(yade.ConicInteractionLoop, 300)
check.true(len(images) > 1 and sum(len(one[1]) for one in expected) > 10, f"contacts of several images: {images}")
check.equal([found[i] == one for i, one in enumerate(expected)], [True] * 10, "a periodic cell, to the last bit")
check.equal(answers, usual, "and its answers")
O.periodic = False

check.finish()
