# SPDX-License-Identifier: GPL-3.0-or-later
# Many bodies: a heap of cubes and pyramids on a fixed floor, with as many threads as YADE was given.
import math
import random

import potential_particles
import yade
from harness import *

check = Checks()
random.seed(4)


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
    O.run(250, True)
    most = max(most, sum(1 for c in O.interactions if c.isReal))
moving = [b.state for b in O.bodies][1:]
check.true(most >= 10, f"contacts at a time: {most}")
check.true(all(math.isfinite(x) for x in state_numbers()), "all states are finite")
lowest = min(s.pos[2] for s in moving)
check.true(lowest > -0.05, f"nobody fell through the floor: lowest {lowest}")
check.true(max(s.pos[2] for s in moving) < highest, "they fell")
check.true(all(s.vel.norm() < 10 for s in moving), "and none was thrown out")
check.equal((contacts.failures, contacts.failureReport), (0, []), "failures")
check.equal(contacts.calls, contacts.solved + contacts.rejected, "every call is counted once, in every thread")
deepest = max(c.geom.penetrationDepth for c in O.interactions if c.isReal)
# The law's stiffness is per area of contact, so corners dip in deep; not by their own size, though.
check.true(0 < deepest < 0.3, f"largest overlap {deepest}")

check.finish()
