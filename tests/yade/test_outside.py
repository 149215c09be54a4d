# SPDX-License-Identifier: GPL-3.0-or-later
# threads
# A script changes the scene while YADE steps it in another thread: taken, or refused with a sentence, and the
# process lives. Whatever fails here mostly ends it, which the runner notices.
import builtins
import math
import random
import threading

import potential_particles
import yade
from harness import *

check = Checks()
random.seed(6)
# At least so many of both in each hammering; without protection the process was gone sooner, mostly.
CALLS, STEPS = 600, 100


def prism(sides):
    """Planes of an upright prism that touches what stands around it."""
    angles = [2 * math.pi * i / sides for i in range(sides)]
    return [(math.cos(t), math.sin(t), 0, 0.45) for t in angles] + [(0, 0, 1, 0.45), (0, 0, -1, 0.45)]


def plain_cube(r=0.05):
    return plain(cube_planes(0.5, r), r=r, k=0.05, R=0.9, AabbMinMax=True,
                 vertices=[Vector3(x, y, z) for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)])


def ring(make, functor_):
    """One body amid twelve that it overlaps; nothing moves by itself."""
    fresh_scene(functor_, dt=1e-9)
    O.engines[1].verletDist = 0  # boxes are read in every step, too
    for i in range(13):
        place = Vector3(0.9 * math.cos(i), 0.9 * math.sin(i), 0.2 * (i % 3 - 1)) if i else Vector3.Zero
        add(make(), place, fixed=True, volume=1.0, inertia=Vector3(1, 1, 1))


def hammer(action):
    """Calls it while O.run() goes on."""
    O.run()
    calls, first = 0, O.iter
    while O.running and (calls < CALLS or O.iter - first < STEPS):
        action(calls)
        calls += 1
    check.true(O.running, f"the run still goes on, after {calls} calls and {O.iter - first} steps")
    halt()


def settled():
    """Overlaps after one more step."""
    O.step()
    return {(c.id1, c.id2): c.geom.penetrationDepth for c in O.interactions if c.isReal}


# Planes of our own shape, of numbers that differ, one by one and in groups; its box follows.
choices = [prism(sides) for sides in (3, 4, 6, 9, 15)]
ring(cube, yade.Ig2_ConicPP_ConicPP_ScGeom())
shape = O.bodies[0].shape


def change(i):
    if i % 3:
        shape.planes = choices[i % len(choices)]
    else:
        a, b, c, d = map(list, zip(*choices[i % len(choices)]))
        shape.updateAttrs(dict(a=a, b=b, c=c, d=d, r=0.04 + 0.01 * (i % 2)))


hammer(change)
check.equal((functor().failures, functor().failureReport), (0, []), "failures")
shape.updateAttrs(dict(cube().dict()))
found = settled()
ring(cube, yade.Ig2_ConicPP_ConicPP_ScGeom())
expected = settled()
check.true(found.keys() == expected.keys() and all(abs(found[key] - expected[key]) < 1e-9 for key in expected),
           f"a cube again, it touches as a cube does: {found}, expected {expected}")

# Of a plain shape, list by list: in between they are of unequal length, which is counted and reported once.
ring(plain_cube, yade.Ig2_PP_PP_ScGeom_Conic(calContactArea=False))
shape = O.bodies[0].shape


def change_plain(i):
    a, b, c, d = map(list, zip(*choices[i % len(choices)]))
    if i % 2:
        shape.a, shape.b, shape.c, shape.d = a, b, c, d
    else:
        shape.updateAttrs(dict(a=a, b=b, c=c, d=d))
    shape.vertices = [Vector3(0.5 * math.cos(j), 0.5 * math.sin(j), 0.4) for j in range(4 + i % 9)]


hammer(change_plain)
check.true(
    all("incomplete" in entry["message"] for entry in functor().failureReport) and len(functor().failureReport) <= 12,
    f"only unequal lengths are reported, once a pair: {functor().failureReport}")
counted = functor().failures
shape.a = shape.a[:-1]
settled()
check.true(functor().failures > counted, "lists of unequal length are counted")
report = functor().failureReport
check.true(report and "first body" in report[0]["message"] and "entries" in report[0]["message"],
           f"and reported: {report[:1]}")
shape.updateAttrs(plain_cube().dict())
counted = functor().failures
found = settled()
check.equal(functor().failures, counted, "complete again")
check.true(found.keys() == expected.keys() and all(abs(found[key] - expected[key]) < 1e-9 for key in expected),
           "and it touches as a cube does")

# The functor itself.
ring(cube, yade.Ig2_ConicPP_ConicPP_ScGeom())
contacts = functor()


def tune(i):
    contacts.formulation = ("midway", "closest")[i % 2]
    contacts.backEnd = ("fast", "cone_program")[i % 5 == 0]
    contacts.flatRegularisation = 1e-7 * (i % 3)
    contacts.calContactArea = i % 4 == 0
    contacts.resetCounters()
    len(contacts.failureReport)


hammer(tune)
check.equal(contacts.failures, 0, "failures while settings change")

# Bodies come and go: from within a step they may.
def churn():
    for one in random.sample([b.id for b in O.bodies][1:], 3):
        O.bodies.erase(one)
    for _ in range(3):
        drop()


def drop():
    place = Vector3(random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(1, 4))
    turn = turned((random.random(), 1, 0), 3 * random.random())
    if random.random() < 0.3:
        add(plain_cube(), place, turn, volume=1.0, inertia=Vector3(1, 1, 1) / 6)
    else:
        add(cube() if random.random() < 0.5 else pyramid(), place, turn)


builtins.churn = churn
fresh_scene(yade.Ig2_PP_PP_ScGeom_Conic(calContactArea=False), dt=1e-4, damping=0.2, gravity=(0, 0, -9.81),
            stiffness=1e5)
O.engines[1].verletDist = 0
add(cube(half=4, R=7, isBoundary=True), Vector3(0, 0, -4), fixed=True)
for _ in range(30):
    drop()
O.engines = O.engines + [yade.PyRunner(command="churn()", iterPeriod=5)]
run(400)
check.true(len(O.bodies) > 240, f"ids given: {len(O.bodies)}")
check.equal(len([b for b in O.bodies]), 31, "bodies there")
check.true(all(b.state.pos.norm() < 10 for b in O.bodies), "none was thrown out")
check.equal((functor().failures, functor().failureReport), (0, []), "failures")
check.true(any(c.isReal for c in O.interactions), "in contact")

# From outside, they may not until the run has ended, once protect_runs() was called; O.pause() waits for that.
potential_particles.protect_runs()
potential_particles.protect_runs()  # no more than once
O.engines = O.engines[:-1]
stop = O.stopAtIter
O.run()
for action, name in [(lambda: O.bodies.erase(1), "O.bodies.erase"),
                     (lambda: O.bodies.append(Body()), "O.bodies.append"), (lambda: O.bodies.clear(), "O.bodies.clear"),
                     (lambda: O.interactions.clear(), "O.interactions.clear"),
                     (lambda: setattr(O.bodies[0], "shape", cube()), "Body.shape")]:
    check.raises(RuntimeError, action, f"{name} during a run", name)
check.equal(
    type(utils.sphere((0, 0, 0), 1).shape).__name__, "Sphere", "a body that is in no scene may be given its shape")
heard = []


def elsewhere():
    try:
        O.bodies.erase(1)
    except RuntimeError as refusal:
        heard.append(str(refusal))


thread = threading.Thread(target=elsewhere)
thread.start()
thread.join()
check.true(len(heard) == 1 and "PyRunner" in heard[0], f"from another thread of Python: {heard}")
check.true(O.running, "and the run goes on")
O.pause()
for one in [b.id for b in O.bodies][1:21]:
    step = O.iter
    O.bodies.erase(one)
    check.equal(O.iter, step, "a paused run takes no further step")
    O.run()
    while O.iter == step:
        pass
    O.pause()
check.equal((len([b for b in O.bodies]), O.stopAtIter), (11, stop),
            "bodies left after a pause for each; O.stopAtIter is as before")

check.finish()
