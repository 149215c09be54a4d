# SPDX-License-Identifier: GPL-3.0-or-later
# threads
# Many bodies: a heap of cubes and pyramids on a fixed floor, with as many threads as YADE was given.
import builtins
import math
import random

import potential_particles
import yade
from harness import *

check = Checks()
random.seed(4)


def entries():
    """Of the tables of bounds and geometry: what is looked up already."""
    return set(O.engines[2].boundDispatcher.dispMatrix()), set(O.engines[3].geomDispatcher.dispMatrix())


def look():
    seen.append(entries())


# Before the first parallel loop of a scene, every functor has been looked up; nothing need be called
# for that. With one thread there is no race and no look-up ahead. (The tables must not say so anyway:
# the engine that looks comes before the others.)
builtins.look, ours = look, "ConicPotentialParticle"
for start in (lambda: O.run(1, True), O.step):
    fresh_scene(yade.Ig2_PP_PP_ScGeom_Conic(), dt=1e-9)
    for z in (0, 0.98):
        add(cube(), Vector3(0, 0, z), fixed=True)
    O.engines = [yade.PyRunner(command="look()", iterPeriod=1, initRun=True)] + O.engines
    seen = []
    start()
    ahead = {(ours,), (ours, ours)}
    check.equal([bool(ahead <= set.union(*found)) for found in seen], [True], "looked up before the first step")
    check.true(ahead <= set.union(*entries()), "and after it")
    O.saveTmp()
    O.loadTmp()
    check.true(not ahead & set.union(*entries()), "a scene that was loaded has new tables")
    seen = []
    start()
    check.equal([bool(ahead <= set.union(*found)) for found in seen], [True], "looked up before the next step")

# prepare() does so for every class in the scene, materials too.
fresh_scene(yade.Ig2_PP_PP_ScGeom_Conic(), dt=1e-9)
O.materials.append(yade.CohFrictMat())
add(cube(), Vector3(0, 0, 0))
potential_particles.prepare()
check.true(("CohFrictMat", "CohFrictMat") in O.engines[2].physDispatcher.dispMatrix(),
           "prepare() and a derived material")


def heap(functor_):
    fresh_scene(functor_, dt=1e-4, damping=0.2, gravity=(0, 0, -9.81), friction=0.5, stiffness=1e7)
    add(cube(half=2.5, R=4.3, isBoundary=True), Vector3(0, 0, -2.5), fixed=True)
    for i in range(3):
        for j in range(3):
            for layer in range(3):
                turn = turned((random.random(), random.random(), random.random()), random.uniform(0, 3))
                shape = cube(half=0.3, R=0.5, r=0.04) if (i + j + layer) % 2 else pyramid(size=0.45, R=0.7, r=0.04)
                add(shape, Vector3(1.1 * i - 1.1, 1.1 * j - 1.1, 0.7 + 1.1 * layer), turn)
    potential_particles.prepare()


contacts = yade.Ig2_ConicPP_ConicPP_ScGeom(calContactArea=True)
heap(contacts)
highest = max(b.state.pos[2] for b in O.bodies)
most = 0
for _ in range(12):
    run(250)
    most = max(most, sum(1 for c in O.interactions if c.isReal))
moving = [b.state for b in O.bodies][1:]
check.true(most >= 10, f"contacts at a time: {most}")
check.true(all(math.isfinite(x) for x in state_numbers()), "all states are finite")
lowest = min(s.pos[2] for s in moving)
check.true(lowest > -0.05, f"nobody fell through the floor: lowest {lowest}")
check.true(max(s.pos[2] for s in moving) < highest, "they fell")
check.true(all(s.vel.norm() < 10 for s in moving), "and none was thrown out")
check.equal((contacts.failures, contacts.failureReport), (0, []), "failures")
check.equal(contacts.calls, contacts.solved + contacts.rejected + contacts.answers["carried"],
            "every call is counted once, in every thread")
check.equal(sum(contacts.answers.values()), contacts.calls, "and answered in one way")
deepest = max(c.geom.penetrationDepth for c in O.interactions if c.isReal)
# The law's stiffness is per area of contact, so corners dip in deep; not by their own size, though.
check.true(0 < deepest < 0.3, f"largest overlap {deepest}")

# The same steps by one thread and by all: the sums of the forces round differently, no more.
O.saveTmp("heap")


def after_steps(threads):
    O.loadTmp("heap")
    for engine in O.engines:
        engine.ompThreads = threads
    run(100)
    return state_numbers(), functor().calls


(one, calls), (all_, calls_of_all) = after_steps(1), after_steps(-1)
worst = max(abs(x - y) for x, y in zip(one, all_))
check.true(len(one) == len(all_) and worst < 1e-8, f"one thread and {O.numThreads} differ by {worst:g}")
check.equal(calls, calls_of_all, "calls by one thread and by all")

check.finish()
