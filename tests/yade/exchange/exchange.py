# SPDX-License-Identifier: GPL-3.0-or-later
"""A scene saved by one YADE and loaded by another: scripts/exchange_saves.sh runs both halves.

    yade -x -n exchange.py save|load FOLDER builtin|plugin

"whole" is the scene as it is, "bare" the same with O.engines empty, "bodies" also without contacts. What another YADE
makes of them is in docs/yade_versions.md.
"""
import json
import os
import sys

import yade
import yade.config

action, folder, kind = sys.argv[1:4]
if kind == "plugin":
    import potential_particles
from harness import *

PLACES = [Vector3(0, 0, 0), Vector3(0.05, 0.03, 0.98)]
NAMES = ("whole", "bare", "bodies")
ENDINGS = ("yade.gz", "xml.bz2")
NOTES = os.path.join(folder, kind + ".json")


def set_engines():
    functor_ = yade.Ig2_ConicPP_ConicPP_ScGeom() if kind == "plugin" else yade.Ig2_PP_PP_ScGeom(calContactArea=False)
    O.engines = [
        yade.ForceResetter(),
        yade.InsertionSortCollider([yade.PotentialParticle2AABB()], verletDist=0.01),
        yade.InteractionLoop([functor_],
                             [yade.Ip2_FrictMat_FrictMat_KnKsPhys(kn_i=1e7, ks_i=1e7, Knormal=1e7, Kshear=1e7,
                                                                  viscousDamping=0.0, useFaceProperties=False)],
                             [yade.Law2_SCG_KnKsPhys_KnKsLaw(neverErase=False)]),
        yade.NewtonIntegrator(damping=0.2, exactAsphericalRot=True, gravity=(0, 0, -9.81))]
    O.dt = 1e-5


def numbers():
    """What a file must bring back to the last digit. (The overlap is not in it: YADE computes that anew in each step.)
    """
    contacts = [(list(c.geom.contactPoint), list(c.phys.normalForce), getattr(c.geom, "memory",
                                                                              None), type(c.geom).__name__)
                for c in O.interactions if c.isReal]
    shapes = [[b.shape.r, b.shape.R, b.shape.k, *b.shape.a, *b.shape.d] for b in O.bodies]
    return {
        "state": state_numbers(), "shapes": shapes, "contacts": contacts,
        "classes": [type(b.shape).__name__ for b in O.bodies]
    }


def save(check):
    fresh_scene(yade.Ig2_PP_PP_ScGeom(calContactArea=False))
    set_engines()
    for i, place in enumerate(PLACES):
        shape = cube() if kind == "plugin" else plain(cube_planes(), r=0.05, k=0.05, R=0.9)
        add(shape, place, fixed=i == 0, volume=1.0, inertia=Vector3(1, 1, 1) / 6)
    run(20)
    overlap = O.interactions[0, 1].geom.penetrationDepth
    check.true(overlap > 0.01, f"in contact when saved: {overlap}")
    notes = {}
    for name in NAMES:
        if name == "bare":
            O.engines = []
        if name == "bodies":
            O.interactions.clear()
        notes[name] = numbers()
        for ending in ENDINGS:
            O.save(os.path.join(folder, f"{kind}-{name}.{ending}"))
    with open(NOTES, "w") as file:
        json.dump({"yade": yade.config.version, "boost": boost(), "numbers": notes}, file)


def boost():
    return list(yade.libVersions.getAllVersionsCpp()["boost"][0])


def may_load(name, ending, writer):
    """Whether this YADE reads such a file: binary ones of a newer Boost never, engines only of the same YADE, and
    contacts only if FrictPhys is the same, which has an attribute more since 2026.
    """
    if writer["yade"] == yade.config.version:
        return True
    if ending == "yade.gz" and writer["boost"] > boost():
        return False
    same_physics = (writer["yade"] >= "2026") == (yade.config.version >= "2026")
    return name == "bodies" or name == "bare" and same_physics


def load(check):
    with open(NOTES) as file:
        writer = json.load(file)
    for name in NAMES:
        for ending in ENDINGS:
            what = f"{kind}-{name}.{ending} of YADE {writer['yade']} in {yade.config.version}"
            path = os.path.join(folder, f"{kind}-{name}.{ending}")
            O.reset()
            if not may_load(name, ending, writer):
                # The plugin adds a sentence on what to do; YADE alone says what its reader met.
                ours = kind == "plugin"
                check.raises(RuntimeError if ours else (RuntimeError, MemoryError), lambda: O.load(path), what,
                             "O.engines = []" if ours else "")
                continue
            try:
                O.load(path)
            except Exception as error:
                check.true(False, f"{what}: {error!r}")
                continue
            # By way of JSON, as the notes came: lists, and numbers by their shortest digits.
            check.equal(json.loads(json.dumps(numbers())), writer["numbers"][name], what)
            set_engines()
            if kind == "plugin":
                potential_particles.prepare()
            before = O.bodies[1].state.pos[2]
            run(200)
            check.true(O.interactions[0, 1].isReal and abs(O.bodies[1].state.pos[2] - before) < 0.01,
                       f"{what}: it goes on")


checks = Checks()
os.makedirs(folder, exist_ok=True)
(save if action == "save" else load)(checks)
checks.finish()
