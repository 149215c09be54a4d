# SPDX-License-Identifier: MIT OR Apache-2.0
"""YADE's own functor on the pairs of pairs.py, by the protocol of rust/src/server.rs. Run it inside YADE:

    PAIRS=pairs.txt HERE=benches/peers yade -x -n -j1 benches/peers/yade_pairs.py

Ig2_PP_PP_ScGeom, without contact area. All pairs of a group are one scene, its interactions made by hand; the time is
that of YADE's InteractionLoop by YADE's clock, with the law and the loop in it: less than a microsecond a pair. A call
always starts from what the functor itself remembers.
"""

import json
import os
import sys

sys.path.insert(0, os.environ["HERE"])

import numpy as np
import yade
import yade.log
from yade import Body, Omega, Quaternion, Vector3, utils

import pair_file

O = Omega()
MOST_PAIRS = 20
APART = Vector3(16, 0, 0)  # from pair to pair, so that none meets another


class Scene:
    """The pairs of one group."""

    def __init__(self, group):
        O.reset()
        self.pairs = group.pairs[:MOST_PAIRS]
        collider, self.loop = potential_engines()
        self.bodies = []
        for number, (first, seconds) in enumerate(self.pairs):
            both = [potential(group), potential(group)]
            for body, place in zip(both, (first, seconds[0])):
                body.state.blockedDOFs = "xyzXYZ"
                self.place(body, place, number)
                O.bodies.append(body)
            self.bodies.append(both)
        O.dt = 1e-9
        O.timingEnabled = True
        # createInteraction wants bodies that a collider has seen.
        O.engines = [collider]
        O.step()
        O.engines = [self.loop]
        self.contacts = [utils.createInteraction(one.id, other.id) for one, other in self.bodies]

    def place(self, body, place, number):
        body.state.pos = Vector3(*place[:3]) + number * APART
        body.state.ori = Quaternion(*place[3:]).normalized()

    def step(self, time):
        """Seconds of the loop with every B at its pose of that number."""
        for number, ((_, body), (_, seconds)) in enumerate(zip(self.bodies, self.pairs)):
            self.place(body, seconds[time], number)
        self.loop.execTime = 0
        O.step()
        return 1e-9 * self.loop.execTime

    def time(self, least):
        poses = len(self.pairs[0][1])
        walk = [*range(poses), *range(poses - 2, 0, -1)]
        self.step(0)
        spent, steps = 0.0, 0
        while spent < least:
            spent += sum(self.step(pose) for pose in walk)
            steps += len(walk)
        return spent / steps / len(self.pairs)

    def answers(self):
        for pose in range(len(self.pairs[0][1])):
            self.step(pose)
        return [self.answer(contact, number) for number, contact in enumerate(self.contacts)]

    def answer(self, contact, number):
        if not contact.isReal or contact.geom is None:
            return []
        geom = contact.geom
        sense = 1 if contact.id1 < contact.id2 else -1
        found = [geom.penetrationDepth, *(geom.contactPoint - number * APART), *(sense * geom.normal)]
        if not np.isfinite(found).all():
            return None
        return found if geom.penetrationDepth > 0 else []


def potential(group):
    a, b, c, d = (list(column) for column in zip(*group.planes))
    body = Body()
    body.shape = yade.PotentialParticle(a=a, b=b, c=c, d=d, r=group.r, k=group.k, R=group.shadow)
    utils._commonBodySetup(body, 1.0, Vector3(1, 1, 1), material=FRICTION, pos=Vector3.Zero, fixed=True)
    return body


def potential_engines():
    spring = dict(kn_i=1e7, ks_i=1e7, Knormal=1e7, Kshear=1e7, viscousDamping=0.0, useFaceProperties=False)
    return yade.InsertionSortCollider([yade.PotentialParticle2AABB()], verletDist=0), yade.InteractionLoop(
        [yade.Ig2_PP_PP_ScGeom(calContactArea=False)],
        [yade.Ip2_FrictMat_FrictMat_KnKsPhys(**spring)],
        [yade.Law2_SCG_KnKsPhys_KnKsLaw(neverErase=True)],
    )


FRICTION = yade.FrictMat(young=1e7, poisson=0.3, frictionAngle=0.3, density=2000.0)


def main():
    yade.log.setDefaultLogLevel(
        1)  # fatal errors only: the functor writes a line a call, which takes longer than the call
    groups = pair_file.read(os.environ["PAIRS"])
    kept = (None, None)
    for line in sys.stdin:
        request, name, _, *rest = line.split()
        if kept[0] != name:
            kept = (name, Scene(groups[name]))
        found = kept[1].time(float(rest[1])) if request == "time" else kept[1].answers()
        print(">" + json.dumps(found), flush=True)


main()
