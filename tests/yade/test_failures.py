# SPDX-License-Identifier: GPL-3.0-or-later
# threads
# What cannot be solved is counted and reported once, and YADE lives.
import math

import potential_particles
import yade
from harness import *

check = Checks()
nan = float("nan")

contacts = yade.Ig2_ConicPP_ConicPP_ScGeom()
fresh_scene(contacts, dt=1e-9)
for z in (0, 0.98, 5):
    add(cube(), Vector3(0, 0, z), fixed=True)
run(2)
contact = O.interactions[0, 1]
depth, normal, point = contact.geom.penetrationDepth, contact.geom.normal, contact.geom.contactPoint
check.equal(contacts.failures, 0, "no failure at first")

# A body that flew off to NaN.
O.bodies[1].state.pos = Vector3(0, nan, 0.98)
loop = O.engines[2]
for _ in range(3):
    loop()  # only this engine: the collider would not know where to put the body
report = contacts.failureReport
check.equal(contacts.failures, 3, "every failure is counted")
check.equal(len(report), 1, "and reported once")
if report:
    entry = report[0]
    check.equal((entry["id1"], entry["id2"]), (0, 1), "ids in the report")
    check.true(
        math.isnan(entry["pose2"][0][1]) and entry["pose2"][0][2] == 0.98, f"pose in the report: {entry['pose2']}")
    check.equal(entry["pose1"], ((0, 0, 0), (1, 0, 0, 0)), "pose of body 1")
    check.true("position" in entry["message"], f"message in the report: {entry['message']}")
contact = O.interactions[0, 1]
check.true(contact.isReal, "the contact is not dropped")
kept = contact.geom.penetrationDepth, contact.geom.normal, contact.geom.contactPoint
check.equal(kept, (depth, normal, point), "and keeps its geometry")

# It comes back: the pair is solved again.
O.bodies[1].state.pos = Vector3(0, 0, 0.97)
loop()
check.close(O.interactions[0, 1].geom.penetrationDepth, depth + 0.01, 1e-6, "solved again")
check.equal(contacts.failures, 3, "no new failure")
contacts.resetCounters()
check.equal((contacts.calls, contacts.solved, contacts.rejected, contacts.failures), (0, 0, 0, 0), "counters reset")
check.equal(contacts.failureReport, [], "report emptied")

# Time is added up when asked.
check.equal(contacts.seconds, 0.0, "no time is measured unless asked")
contacts.measureTime = True
run(50)
check.true(contacts.seconds > 0, "time is measured when asked")

# Forced, without a position: YADE gets a geometry and no exception.
O.bodies[2].state.pos = Vector3(nan, 0, 0)
forced = utils.createInteraction(1, 2)
check.true(forced.geom.penetrationDepth < 0, "a forced pair that cannot be solved counts as apart")
check.close(forced.geom.normal.norm(), 1, 1e-12, "with a unit normal")
check.equal(contacts.failures, 1, "and is counted")

# A scene that blows up: first it flies apart, then a body has no velocity, and at last nobody has a position.
# Every engine takes part, the collider too.
for verlet in (0.0, 0.01):
    fresh_scene(yade.Ig2_ConicPP_ConicPP_ScGeom(), dt=1e-5)
    O.engines[1].verletDist = verlet
    for i in range(4):
        add(cube(), Vector3(0, 0, 0.97 * i))
    run(20)
    O.saveTmp("sound")
    for what, spoil in [("huge step", lambda: setattr(O, "dt", 1.0)), ("step NaN", lambda: setattr(O, "dt", nan)),
                        ("velocity", lambda: setattr(O.bodies[1].state, "vel", Vector3(nan, 0, 0))),
                        ("position", lambda: setattr(O.bodies[1].state, "pos", Vector3(0, math.inf, 1))),
                        ("orientation", lambda: setattr(O.bodies[1].state, "ori", Quaternion(nan, nan, nan, nan))),
                        ("no rotation", lambda: setattr(O.bodies[1].state, "ori", Quaternion(0, 0, 0, 0)))]:
        O.loadTmp("sound")
        O.dt = 1e-5
        first = O.iter
        spoil()
        run(50)
        check.equal(O.iter - first, 50, f"{what}, verletDist {verlet}: every step is done")
        report = functor().failureReport
        check.true(len(report) <= 3 and all(entry["message"] for entry in report), f"{what}: once a pair: {report}")
        counted = functor().failures
        # Flown apart they are no pairs; lost to NaN, they cannot be solved.
        check.true(counted == 0 if what == "huge step" else counted > 0, f"{what}: counted {counted}")
    O.loadTmp("sound")
    O.dt = 1e-5
    run(50)
    check.true(all(math.isfinite(x) for x in state_numbers()), "the sound state goes on")

check.finish()
