# SPDX-License-Identifier: GPL-3.0-or-later
# Bad particles are refused when they are made or changed; good changes take effect at once.
import math
import warnings

import potential_particles
import yade
from harness import *

check = Checks()
nan, inf = float("nan"), float("inf")

# Refused at creation, with a sentence that names the culprit.
for keywords, containing in [(dict(r=-1.0), "r=-1"), (dict(r=nan), "r=NaN"), (dict(r=0.0), "r=0"),
                             (dict(k=-0.1), "k=-0.1"), (dict(k=1.5), "k=1.5"), (dict(k=nan), "k=NaN"),
                             (dict(R=0.0), "R=0"), (dict(R=inf), "R=inf"),
                             (dict(planes=[(0, 0, 0, 1)] + cube_planes()), "plane 0"),
                             (dict(planes=[(1, 0, 0, 1), (1, 0, nan, 1)]), "plane 1"),
                             (dict(planes=[(1, 0, 0, -3)]), "f(0)"),
                             (dict(planes=cube_planes()[:5], k=0.0), "do not enclose")]:
    given = dict(planes=cube_planes(), r=0.05, k=0.05, R=0.9)
    given.update(keywords)
    check.raises(ValueError, lambda: yade.ConicPotentialParticle(**given), f"{keywords}", containing)
check.raises(ValueError, lambda: yade.ConicPotentialParticle(planes=[(1, 0, 0)]), "row of three", "row 0")

# Taken with a warning: planes of which one is missing, where only the shadow sphere bounds the particle.
def warned(make):
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always")
        make()
    return [str(one.message) for one in said]


given = dict(r=0.05, k=0.04, R=0.9)
lines = warned(lambda: yade.ConicPotentialParticle(planes=cube_planes()[:5], **given))
check.true(
    len(lines) == 1 and "the 5 planes enclose no volume" in lines[0] and "4.5" in lines[0],
    f"a cube without a face: {lines}")
check.equal(warned(lambda: yade.ConicPotentialParticle(planes=cube_planes(), **given)), [], "a whole cube")
check.equal(warned(lambda: yade.ConicPotentialParticle(k=1.0, R=1.0)), [], "a sphere has no planes")
with warnings.catch_warnings():
    warnings.simplefilter("error")
    check.raises(UserWarning, lambda: yade.ConicPotentialParticle(planes=cube_planes()[:5], **given),
                 "warnings as errors", "missing")

# Refused when changed, and the old value stays.
shape = cube()
for name, value in [("r", -1.0), ("k", 2.0), ("R", 0.0), ("planes", [(0, 0, 0, 1)]), ("d", [nan] * 6),
                    ("a", [inf] * 6)]:
    before, volume = getattr(shape, name), shape.volume
    check.raises(ValueError, lambda: setattr(shape, name, value), f"{name} = {value}")
    check.equal(getattr(shape, name), before, f"{name} after a refused value")
    check.equal(shape.volume, volume, f"volume after a refused {name}")
check.raises(ValueError, lambda: shape.updateAttrs(dict(r=-1.0, k=0.1)), "updateAttrs")
check.equal((shape.r, shape.k), (0.05, 0.05), "after refused updateAttrs")

# A group of which one attribute cannot be set: none of them is.
for last, kind in [(dict(noSuchThing=1), AttributeError), (dict(k="round"), TypeError),
                   (dict(planes=[(1, 0, 0)]), ValueError)]:
    before = shape.dict()
    check.raises(kind, lambda: shape.updateAttrs(dict(a=[1.0], r=0.2, **last)), f"a group with {last}")
    check.equal((shape.a, shape.r, shape.planes), (before["a"], before["r"], cube_planes()),
                f"after a group with {last}")
    check.true(shape.volume > 0, f"and the particle is there after {last}")

# Changes take effect.
sphere = yade.ConicPotentialParticle(k=1.0, R=2.0)
check.close(sphere.volume, 4 / 3 * math.pi * 8, 0.01, "volume of a sphere")
sphere.R = 1.0
check.close(sphere.volume, 4 / 3 * math.pi, 0.01, "volume after a change of R")
check.close(sphere.surfaceDistance([(1, 1, 0), (0, 0, -5)])[1], 1.0, 1e-12, "surfaceDistance")
check.close(sphere.potential((0, 0, 1.5)), 1.25, 1e-12, "potential")
check.close(sphere.potential((0, 0, 0)), -1.0, 1e-12, "potential at the centre")
check.true(1.0 <= sphere.boundingRadius < 1.001, f"bounding radius {sphere.boundingRadius}")
check.close(sphere.inertia[0, 0], 8 / 15 * math.pi, 0.01, "inertia of a sphere")
check.close(cube().centroid, Vector3.Zero, 1e-9, "centroid of a cube")
shape = cube()
wide = shape.surfaceDistance([(1, 0, 0)])[0]
shape.planes = cube_planes(half=1.0)
check.close(shape.surfaceDistance([(1, 0, 0)])[0] - wide, 0.5, 0.05, "planes set at once")
shape.planes = pyramid_planes()
check.equal(len(shape.a), 5, "planes of another number")
shape.updateAttrs(dict(k=0.2, r=0.02))
check.equal((shape.k, shape.r), (0.2, 0.02), "updateAttrs of several")

# Lists of different lengths wait for each other.
shape = cube()
shape.a = [1, -1, 0, 0]
check.raises(ValueError, lambda: shape.volume, "volume of an incomplete particle", "a, b, c, d have 4, 6, 6 and 6")
shape.b, shape.c = [0, 0, 1, -1], [0, 0, 0, 0]
check.raises(ValueError, lambda: shape.planes, "planes of an incomplete particle", "6 entries")
shape.d = [0.4, 0.4, 0.4, 0.4]
check.true(shape.volume > 0, "complete again")

# The box: rigorous and tight when computed, untouched when given.
def box_holds(one, text):
    directions = [(x, y, z) for x in (-1, 0, 1) for y in (-1, 0, 1) for z in (-1, 0, 1) if (x, y, z) != (0, 0, 0)]
    for direction, distance in zip(directions, one.surfaceDistance(directions)):
        point = Vector3(direction).normalized() * distance
        inside = all(-one.minAabb[i] - 1e-9 <= point[i] <= one.maxAabb[i] + 1e-9 for i in range(3))
        held = all(min(v[i] for v in one.vertices) - 1e-9 <= point[i] <= max(v[i] for v in one.vertices) + 1e-9
                   for i in range(3))
        check.true(inside and held, f"{text}: surface point {point} inside the box")


shape = pyramid()
check.true(shape.AabbMinMax and shape.automaticBox and len(shape.vertices) > 3, "a box is computed")
box_holds(shape, "pyramid")
check.close(shape.minAabb[2], shape.surfaceDistance([(0, 0, -1)])[0], 0.02, "tight at the base")
shape.planes = pyramid_planes(size=2.0)
box_holds(shape, "grown pyramid")
box_holds(sphere, "sphere")
given = dict(AabbMinMax=True, minAabb=Vector3(1, 2, 3), maxAabb=Vector3(4, 5, 6), minAabbRotated=Vector3(7, 8, 9),
             maxAabbRotated=Vector3(10, 11, 12))
shape = cube(**given)
check.equal({key: getattr(shape, key) for key in given}, given, "a box that was given")
check.true(not shape.automaticBox and shape.vertices == [], "nothing added to it")
shape.r = 0.06
check.equal(shape.minAabb, Vector3(1, 2, 3), "a given box after a change of shape")
shape.automaticBox = True
box_holds(shape, "box turned back to automatic")
shape.maxAabb = (5, 5, 5)
shape.r = 0.05
check.equal(shape.maxAabb, Vector3(5, 5, 5), "a box that was set later")

# In a scene: changes between steps are seen by the next one.
contacts = yade.Ig2_ConicPP_ConicPP_ScGeom()
fresh_scene(contacts, dt=1e-9)
add(cube(), Vector3(0, 0, 0), fixed=True)
add(cube(), Vector3(0, 0, 0.98), fixed=True)
O.step()
before = O.interactions[0, 1].geom.penetrationDepth
O.bodies[1].shape.d = [x + 0.01 for x in O.bodies[1].shape.d]
O.step()
check.close(O.interactions[0, 1].geom.penetrationDepth - before, 0.01, 1e-3, "overlap after a change of d")
# An incomplete shape: the pair is reported, not dropped, and YADE goes on.
depth = O.interactions[0, 1].geom.penetrationDepth
O.bodies[1].shape.a = [1, -1, 0, 0]
O.step()
O.step()
check.equal((contacts.failures, len(contacts.failureReport)), (2, 1), "failures of an incomplete shape")
message = contacts.failureReport[0]["message"]
check.true("second body" in message and "incomplete" in message, f"their message: {message}")
check.true(O.interactions[0, 1].isReal, "the contact is kept")
check.equal(O.interactions[0, 1].geom.penetrationDepth, depth, "with its last overlap")
O.bodies[1].shape.planes = cube_planes()
O.step()
check.close(O.interactions[0, 1].geom.penetrationDepth, before, 1e-9, "complete again in the next step")

check.finish()
