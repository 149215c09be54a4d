# SPDX-License-Identifier: GPL-3.0-or-later
# threads
# Settings change from Python while O.run() steps: each answer belongs to one whole value of them, and what was
# replaced is freed when no step can be reading it.
#
# Why that suffices without a lock: the thread that sets writes a value nobody else has yet and then stores one pointer
# to it; a thread that answers loads this pointer once. Every order of the two is one of: the old value, the new one.
import builtins
import sys
import time

import potential_particles
import yade
from harness import *

check = Checks()
PATIENCE = 120.0  # seconds, for a busy machine
FLIPS, SEEN = 200, 50  # at least: changes, and answers by either value
retired = potential_particles._glue.retired_count


def ring():
    """One body amid twelve that it overlaps; nothing moves by itself."""
    fresh_scene(yade.Ig2_ConicPP_ConicPP_ScGeom(calContactArea=False), dt=1e-9)
    for i in range(13):
        place = Vector3(0.9 * math.cos(i), 0.9 * math.sin(i), 0.2 * (i % 3 - 1)) if i else Vector3.Zero
        add(cube(), place, turned((1, 2, 3), 0.1 * i), fixed=True)
    run(2)


# Two values that differ in what is for the library (the formulation decides the overlap of most pairs) and in what the
# glue reads itself (twoDimension and unitWidth2D decide the area).
ONE = dict(unitWidth2D=7.0, formulation="midway", twoDimension=True)
OTHER = dict(unitWidth2D=11.0, formulation="closest", twoDimension=False)
ring()
contacts = functor()
pairs = [c for c in O.interactions if c.isReal]


def answers():
    return [(c.geom.penetrationDepth, c.phys.contactArea) for c in pairs]


# A refused update leaves everything as it was, what was set before the refusal too.
before = contacts.dict()
for wrong in ({"tolerance": 1e-6, "nonsense": 1}, {"tolerance": -1.0,
                                                   "nonsense": 1}, {"unitWidth2D": 3.0, "areaTolerance": "a word"}):
    try:
        contacts.updateAttrs(wrong)
        check.true(False, f"{wrong} is accepted")
    except Exception:
        check.true(contacts.dict() == before, f"after {wrong}: {contacts.dict()}")
contacts.measureTime = contacts.measureTime

whole = []
for settings in (ONE, OTHER):
    contacts.updateAttrs(settings)
    run(1)
    whole.append(answers())
telling = [i for i, (one, other) in enumerate(zip(*whole)) if abs(one[0] - other[0]) > 0.01 and one[1] != other[1]]
check.true(len(telling) >= 12, f"pairs of which either number tells the two values apart: {len(telling)}")

torn, seen = [], [0, 0]


def look():
    """In the thread that steps, after its contacts."""
    found = answers()
    for i in telling:
        for which in (0, 1):
            # Where a solution starts shows in its last digits.
            if abs(found[i][0] - whole[which][i][0]) < 1e-6 and found[i][1] == whole[which][i][1]:
                seen[which] += 1
                break
        else:
            torn.append((i, found[i]))


builtins.look = look
O.engines = O.engines + [yade.PyRunner(command="look()", iterPeriod=1)]
usual = sys.getswitchinterval()
sys.setswitchinterval(1e-5)  # the two threads take Python in turns more often
O.run()
begin, flips, most = time.monotonic(), 0, 0
while (flips <= 10 * FLIPS or min(seen) <= SEEN) and time.monotonic() - begin < PATIENCE:
    contacts.updateAttrs(ONE if flips % 2 else OTHER)
    most = max(most, retired())
    flips += 1
check.true(O.running, "the run still goes on")
sys.setswitchinterval(usual)
halt()
check.equal(torn[:3], [], f"answers that belong to neither value, {len(torn)} of {sum(seen) + len(torn)}")
check.true(flips > FLIPS and min(seen) > SEEN, f"{flips} changes; answers by either value: {seen}")
check.equal(contacts.failures, 0, "failures")
contacts.formulation = "midway"
check.true(retired() <= 1, f"held between runs: {retired()}; up to {most} meanwhile")

# A step that lasts: whatever is replaced while it goes on is kept to its end, and freed soon after. Not by a clock.
ring()
contacts, shape = functor(), O.bodies[0].shape
contacts.formulation = "closest"
step = {"begun": False, "go": False}


def wait():
    step["begun"] = True
    while not step["go"]:
        time.sleep(0.001)


builtins.wait = wait
O.engines = O.engines + [yade.PyRunner(command="wait()", iterPeriod=1, nDo=1, initRun=True)]
check.true(retired() <= 1, f"held before: {retired()}")
first = O.iter
O.run()
while not step["begun"]:
    time.sleep(0.001)
for i in range(400):
    contacts.formulation = ("midway", "closest")[i % 2]
    shape.r = 0.04 + 0.01 * (i % 2)
    if i == 200:
        time.sleep(1.2)
check.equal(O.iter, first, "it is still the same step")
check.true(retired() >= 800, f"held in a step that lasts: {retired()}")
step["go"] = True
later = []
for i in range(50):
    last = O.iter
    while O.iter < last + 3:
        time.sleep(0.0005)
    contacts.formulation = ("midway", "closest")[i % 2]
    later.append(retired())
check.true(O.running and max(later[3:]) <= 4, f"held some steps later, while the run goes on: {later}")
halt()
for i in range(1000):
    contacts.formulation = ("midway", "closest")[i % 2]
    shape.r = 0.04 + 0.01 * (i % 2)
    shape.vertices = [Vector3(1, 1, 1)] * (i + 8)
check.true(retired() <= 1, f"held when nothing steps: {retired()}")

# In a step itself, by an engine.
def change():
    for i in range(5):
        shape.r = 0.04 + 0.001 * i


builtins.change = change
builtins.count = lambda: counted.append(retired())
counted = []
O.engines = O.engines[:-1] + [yade.PyRunner(command="change(); count()", iterPeriod=1)]
run(200)
check.true(len(counted) >= 200 and 5 <= max(counted) <= 15, f"held, of five a step: {max(counted)}")

check.finish()
