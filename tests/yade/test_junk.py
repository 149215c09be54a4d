# SPDX-License-Identifier: GPL-3.0-or-later
# Whatever a script sets, in whatever order: an exception of Python or a particle that works. To repeat it
# with another seed, or more of it: `SEED=12 JUNK=20000 pytest -v tests/yade/test_junk.py`.
import copy
import math
import os
import pickle
import random

import potential_particles
import yade
from harness import *

check = Checks()
random.seed(int(os.environ.get("SEED", 11)))
ROUNDS = int(os.environ.get("JUNK", 600))
nan, inf = float("nan"), float("inf")
NUMBERS = [0, 1, -1, 0.05, 0.5, 2, nan, inf, -inf, 1e308, -1e308, 5e-324, 1e-160, 1e160, 2**63, 10**400, True]
THINGS = NUMBERS + [
    None, "", "midway", "closest", "cone_program", "conic", "fast", "00" * 64, "zz" * 64, b"x", [],
    (), {}, [None], ["a"], [[]],
    object(),
    Vector3(1, 2, 3),
    Vector3(nan, 0, 0), Vector3.Zero, Quaternion.Identity,
    range(5), [1e999] * 6
]
EXPECTED = (ValueError, TypeError, RuntimeError, AttributeError, OverflowError, IndexError, KeyError, AssertionError,
            StopIteration)


def number():
    return random.choice(NUMBERS) if random.random() < 0.3 else random.uniform(-1, 1) * 10 ** random.uniform(-3, 3)


def anything(depth=0):
    roll = random.random()
    if roll < 0.4:
        return random.choice(THINGS)
    if roll < 0.6:
        return number()
    if roll < 0.8 or depth > 1:
        return [number() for _ in range(random.choice([0, 1, 3, 4, 6, 6, 6, 40]))]
    if roll < 0.9:
        return random.choice([cube_planes, pyramid_planes])(*random.choice([(), (0.5, 0.05), (1e-3, 1e-4), (1e6, 1e4)]))
    return [anything(depth + 1) for _ in range(random.randrange(7))]


PLAIN_NAMES = ["a", "b", "c", "d", "r", "k", "R", "vertices", "AabbMinMax", "minAabb", "maxAabb", "minAabbRotated",
               "maxAabbRotated", "isBoundary", "fixedNormal", "boundaryNormal"]
SHAPE_NAMES = PLAIN_NAMES + ["planes", "automaticBox", "volume", "color", "nothing"]
FUNCTOR_NAMES = [
    "formulation", "backEnd", "tolerance", "flatRegularisation", "calContactArea", "areaTolerance", "twoDimension",
    "twoDdir", "unitWidth2D", "areaStep", "accuracyTol", "measureTime", "answers", "failures"
]
refused = taken = 0


def attempt(action):
    global refused, taken
    try:
        action()
        taken += 1
    except EXPECTED as error:
        refused += 1
        if not str(error) and not isinstance(error, AssertionError):
            check.true(False, f"an error without a word: {error!r}")


def look(shape):
    for name in ("volume", "centroid", "inertia", "boundingRadius", "planes", "dispHierarchy"):
        attempt(lambda: getattr(shape, name))
    attempt(lambda: shape.potential(anything()))
    attempt(lambda: shape.surfaceDistance(anything()))
    attempt(lambda: shape.dict())


def scene():
    fresh_scene(yade.Ig2_PP_PP_ScGeom_Conic(), dt=1e-6, stiffness=1e3)
    add(cube(), Vector3.Zero)
    add(pyramid(), Vector3(0, 0, 0.7))
    add(plain(cube_planes(), r=0.05, k=0.05, R=0.9), Vector3(0, 0.95, 0), volume=1.0, inertia=Vector3(1, 1, 1))
    add(cube(), Vector3(0.9, 0, 0))
    run(3)


scene()
for number_ in range(ROUNDS):
    shape, contacts = O.bodies[random.randrange(4)].shape, functor()
    names = PLAIN_NAMES if type(shape).__name__ == "PotentialParticle" else SHAPE_NAMES
    roll = random.random()
    if roll < 0.35:
        attempt(lambda: setattr(shape, random.choice(names), anything()))
    elif roll < 0.45:
        attempt(lambda: shape.updateAttrs({random.choice(names): anything() for _ in range(random.randrange(4))}))
    elif roll < 0.55:
        attempt(lambda: yade.ConicPotentialParticle(
            **{random.choice(SHAPE_NAMES): anything()
               for _ in range(random.randrange(5))}))
    elif roll < 0.65:
        attempt(lambda: setattr(contacts, random.choice(FUNCTOR_NAMES), anything()))
    elif roll < 0.7:
        attempt(lambda: yade.ScGeomConicPP(
            **{random.choice(["memory", "normal", "penetrationDepth", "refR1"]): anything()}))
    elif roll < 0.75 and len(O.interactions):
        pair = random.choice(list(O.interactions))
        attempt(lambda: setattr(pair.geom, random.choice(["memory", "normal", "contactPoint", "penetrationDepth"]),
                                anything()))
    elif roll < 0.8:
        # Any memory of the right length: it was never made by a solve.
        for pair in O.interactions:
            attempt(lambda: setattr(pair.geom, "memory", "".join(random.choices("0123456789abcdef", k=128))))
    elif roll < 0.85:
        attempt(lambda: setattr(O.bodies[random.randrange(4)].state, random.choice(["pos", "vel", "angVel"]),
                                Vector3(*[float(random.choice([0, 1, nan, inf, 1e308, -1e-308])) for _ in range(3)])))
    elif roll < 0.9:
        attempt(lambda: (copy.copy(shape), pickle.loads(pickle.dumps(shape))))
    elif type(shape).__name__ != "PotentialParticle":
        look(shape)
    run(1)
    if number_ % 40 == 39:
        scene()
check.true(refused > ROUNDS / 10 and taken > ROUNDS / 10, f"{refused} refused, {taken} taken")

# After all that, a sound scene is what it always was.
scene()
check.equal(functor().failures, 0, "failures of a sound scene")
check.true(O.interactions[0, 1].isReal and math.isfinite(O.interactions[0, 1].geom.penetrationDepth),
           "and it is solved")

check.finish()
