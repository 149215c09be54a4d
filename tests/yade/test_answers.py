# SPDX-License-Identifier: GPL-3.0-or-later
# The functor says in which way it answered each pair; a pair apart is answered without a solve from its
# second step on.
import math

import potential_particles
import yade
from harness import *

check = Checks()
PATHS = ["motion", "spheres", "face", "memory", "proof", "carried", "warm", "cold", "cone_program"]


def answers(position, orientation=Quaternion.Identity, steps=3, **keywords):
    """Of a cube at the origin with another one, in so many steps in which nothing moves."""
    fresh_scene(yade.Ig2_ConicPP_ConicPP_ScGeom(**keywords), dt=1e-9)
    add(cube(), Vector3.Zero, turned((1, 0, 0), math.pi / 4), fixed=True)
    add(cube(), position, orientation, fixed=True)
    # The pair is called whatever the boxes say: spheres cannot be apart where boxes are tight.
    O.engines[1].verletDist = 0.5
    run(steps)
    found = functor().answers
    check.equal(list(found), PATHS, "names, cheapest first")
    check.equal(sum(found.values()), functor().calls, "every call is one answer")
    check.equal(functor().rejected, sum(found[name] for name in PATHS[:5]), "rejected")
    check.equal(functor().solved, sum(found[name] for name in PATHS[6:]), "solved")
    return {name: count for name, count in found.items() if count}, functor().skippedShare, functor().overlapping


edge = cube().surfaceDistance([(0, 1, 1)])[0]
crossed = turned((0, 1, 0), math.pi / 4)  # the lowest edge of one lies across the highest of the other
check.equal(answers(Vector3(0, 0, 2 * cube().boundingRadius + 0.01)), ({"spheres": 1, "motion": 2}, 1.0, 0),
            "far apart")
check.equal(answers(Vector3(0, 0.9, 0.9)), ({"face": 1, "motion": 2}, 1.0, 0), "face to face")
found, share, touching = answers(Vector3(0, 0, 2 * edge + 0.002), crossed, steps=20)
# The proof tells the distance, so that they sleep from then on.
check.equal((found, touching), ({"proof": 1, "motion": 19}, 0), "edges that cross")
check.close(share, 0.95, 1e-12, "share of those without a solve")
found, share, touching = answers(Vector3(0, 0, 2 * edge - 0.002), crossed)
check.equal((found, touching), ({"carried": 2, "cold": 1}, 3), "edges that touch")
check.true(math.isnan(share), "nobody is apart")
found, share, touching = answers(Vector3(0, 0, 2 * edge - 0.002), crossed, carryTolerance=0)
check.equal((found, touching), ({"warm": 2, "cold": 1}, 3), "and are not carried on")
check.true(math.isnan(share), "nor is anybody apart then")
found, _, touching = answers(Vector3(0, 0, 2 * edge - 0.002), crossed, backEnd="cone_program")
check.equal((found, touching), ({"cone_program": 3}, 3), "by the cone-program back end")

# What moves is looked at again once it may have met what it was apart from, whichever way it moves: the answers are
# those of a functor that never saw the pair before.
def once(position, orientation):
    """Whether the pair touches, looked at without any past."""
    O.interactions.clear()
    fresh = yade.Ig2_ConicPP_ConicPP_ScGeom()
    O.engines[2].geomDispatcher.functors = [fresh]
    O.bodies[1].state.pos, O.bodies[1].state.ori = position, orientation
    O.step()
    return fresh.overlapping == 1


ways = {
    "nearer": lambda t: (Vector3(0, 0, 2 * edge + 0.02 - 0.03 * t), crossed),
    "turning": lambda t: (Vector3(0, 0, 2 * edge - 0.01), turned((0, 1, 0), 0.5 * (1 - t)) * crossed),
    "both": lambda t: (Vector3(0.05 * t, 0, 2 * edge + 0.02 - 0.03 * t), crossed * turned((3, 1, 2), 0.02 * t)),
}
for name, way in ways.items():
    touched = []
    for memory in (True, False):
        fresh_scene(yade.Ig2_ConicPP_ConicPP_ScGeom(), dt=1e-9)
        O.engines[1].verletDist = 0.5
        add(cube(), Vector3.Zero, turned((1, 0, 0), math.pi / 4), fixed=True)
        add(cube(), Vector3(0, 0, 3), crossed, fixed=True)
        touched.append([])
        for step in range(200):
            position, orientation = way(step / 199)
            if memory:
                before = functor().overlapping
                O.bodies[1].state.pos, O.bodies[1].state.ori = position, orientation
                O.step()
                touched[-1].append(functor().overlapping > before)
            else:
                touched[-1].append(once(position, orientation))
        if memory:
            skipped = functor().answers["motion"]
    check.true(skipped > 20, f"{name}: {skipped} answered by motion")
    check.true(any(touched[0]) and not all(touched[0]), f"{name}: they meet on the way")
    check.equal(touched[0], touched[1], f"{name}: the same with and without a past")

# Another shape in the same place is another pair.
fresh_scene(yade.Ig2_ConicPP_ConicPP_ScGeom(), dt=1e-9)
add(cube(), Vector3.Zero, fixed=True)
add(cube(), Vector3(0, 0, 1.1), fixed=True)
O.engines[1].verletDist = 0.5
run(3)
check.equal((functor().answers["motion"], functor().overlapping), (2, 0), "apart")
O.bodies[1].shape.d = [1.5 * d for d in O.bodies[1].shape.d]
run(1)
check.equal((functor().answers["motion"], functor().overlapping), (2, 1), "a shape that has grown is looked at again")

# A pair that comes near and goes again: memory is left and taken up as it moves.
fresh_scene(yade.Ig2_ConicPP_ConicPP_ScGeom(), dt=1e-9)
add(cube(), Vector3.Zero, turned((1, 0, 0), math.pi / 4), fixed=True)
add(cube(), Vector3(0, 0, 3), crossed, fixed=True)
for step in range(800):
    O.bodies[1].state.pos = Vector3(0.1, 0.02, 2 * edge + 0.02 * math.cos(step / 80) + 0.005)
    O.bodies[1].state.ori = crossed * turned((1, 2, 3), 0.05 * math.sin(step / 124))
    O.step()
found = functor().answers
check.true(functor().overlapping > 20 and functor().skippedShare > 0.5,
           f"to and fro: {functor().skippedShare:.3f} of those apart without a solve; {found}")
functor().resetCounters()
check.equal(sum(functor().answers.values()), 0, "reset")

check.finish()
