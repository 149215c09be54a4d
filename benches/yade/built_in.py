# SPDX-License-Identifier: MIT OR Apache-2.0
"""YADE's own contact functor for potential particles, Ig2_PP_PP_ScGeom, as a server of single pairs.

    yade -x -n -j1 benches/yade/built_in.py

Reads one JSON object a line from stdin: {"A": {n, d, r, k, R}, "B": ..., "a": {pos, q}, "b": ...,
"tolerance", "area"}; q is (w, x, y, z), area whether to find the contact area. Answers one line each,
after a '>': {"version", "seconds", "touching", "depth", "point", "normal"}, the point relative to
b.pos, world axes. A pair that takes YADE down ends this process: whoever asks sees the end of the stream.

The time is that of YADE's InteractionLoop by its own clock, in a scene that holds this loop and the
two bodies alone. The functor dominates it; the law and the loop add less than a microsecond.
"""

import json
import statistics
import sys

import yade
from yade import Body, Omega, PotentialParticle, Quaternion, Vector3, utils

O = Omega()

# Long enough for a median, short enough for hundreds of pairs.
LEAST_STEPS = 5
MOST_STEPS = 25
SECONDS = 5e-3


def body(shape, place):
    a, b, c = (list(column) for column in zip(*shape["n"]))
    it = Body()
    it.shape = PotentialParticle(a=a, b=b, c=c, d=shape["d"], r=shape["r"], k=shape["k"], R=shape["R"])
    utils._commonBodySetup(it, 1.0, Vector3(1, 1, 1), material=-1, pos=Vector3(place["pos"]), fixed=True)
    w, x, y, z = place["q"]
    it.state.ori = Quaternion(w, x, y, z).normalized()
    return O.bodies.append(it)


def solve(pair):
    O.reset()
    O.materials.append(yade.FrictMat(young=1e7, poisson=0.3, frictionAngle=0.3, density=2000.0))
    loop = yade.InteractionLoop(
        [yade.Ig2_PP_PP_ScGeom(accuracyTol=pair["tolerance"], calContactArea=pair["area"])],
        [yade.Ip2_FrictMat_FrictMat_KnKsPhys(kn_i=1e7, ks_i=1e7, Knormal=1e7, Kshear=1e7, viscousDamping=0.0,
                                             useFaceProperties=False)],
        # Kept when it opens, so that a separated pair is solved in every step as a touching one is.
        [yade.Law2_SCG_KnKsPhys_KnKsLaw(neverErase=True)])
    O.dt = 1e-9
    first, second = body(pair["A"], pair["a"]), body(pair["B"], pair["b"])
    # createInteraction wants bodies that a collider has seen.
    O.engines = [yade.InsertionSortCollider([yade.PotentialParticle2AABB()], verletDist=0)]
    O.step()
    O.engines = [loop]
    contact = utils.createInteraction(first, second)
    # The first step still makes the physics; the steps after it are like any in a simulation. O.step runs
    # in this thread, while O.run(..., True) sleeps between looks at another.
    O.step()
    times = []
    while len(times) < LEAST_STEPS or (sum(times) < SECONDS and len(times) < MOST_STEPS):
        loop.execTime = 0
        O.step()
        times.append(1e-9 * loop.execTime)
    sense = 1 if contact.id1 == first else -1
    point = contact.geom.contactPoint - O.bodies[second].state.pos
    depth = contact.geom.penetrationDepth
    return {"version": yade.config.version, "seconds": statistics.median(times), "touching": depth > 0,
            "depth": depth, "point": list(point), "normal": list(sense * contact.geom.normal)}


def main():
    O.timingEnabled = True
    for line in sys.stdin:
        print(">" + json.dumps(solve(json.loads(line))), flush=True)


main()
