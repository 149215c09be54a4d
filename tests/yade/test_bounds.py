# SPDX-License-Identifier: GPL-3.0-or-later
# A collider that rests: whatever bodies do, no two boxes meet that are no pair.
import itertools
import math
import os
import random
import tempfile

import potential_particles
import yade
from harness import *

check = Checks()
VERLET = 0.05


def collider(functor_, watch=True, verlet=VERLET):
    """BoundWatch if wanted, the collider, and a look at the scene after it, in each step."""
    watches = [yade.BoundWatch(label="watch")] if watch else []
    return watches + [
        yade.InsertionSortCollider([functor_], verletDist=verlet, allowBiggerThanPeriod=True, label="collider"),
        yade.PyRunner(command="look()", iterPeriod=1)
    ]


def engine(label):
    return next(engine for engine in O.engines if engine.label == label)


def prism(width, length, r=0.005, **more):
    sides = [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0)]
    return yade.ConicPotentialParticle(
        planes=[(*n, width / 2 - r) for n in sides] + [(0, 0, z, length / 2 - r) for z in (1, -1)], r=r, k=0.0,
        R=length, **more)


# --- a needle that falls over about its centre ---------------------------------------------------

def tip(functor_, watch):
    """The contact that a needle makes with what lies beside it, and how often the collider ran in how many steps."""
    global look
    contacts = yade.Ig2_ConicPP_ConicPP_ScGeom(calContactArea=False)
    look = lambda: None
    fresh_scene(contacts, dt=1e-3)
    O.engines = O.engines[:1] + collider(functor_, watch) + O.engines[2:]
    needle = O.bodies[add(prism(0.02, 1.0), Vector3(0, 0, 0.02))]
    needle.state.blockedDOFs = "xyz"  # its centre stays where it is
    needle.state.angVel = Vector3(0, 1, 0)
    needle.state.angMom = Vector3(0, needle.state.inertia[1], 0)  # by which YADE before 2025 integrates
    add(prism(0.2, 0.2), Vector3(0.45, 0, -0.11), fixed=True)
    run(1700)  # past a quarter of a turn
    return contacts.overlapping, engine("collider").numAction


print(f"YADE's own boxes: contacts of the needle that are found: {tip(yade.PotentialParticle2AABB(), watch=False)[0]}")
for functor_, watch in ((yade.Bo1_ConicPP_Aabb(), True), (yade.Bo1_PP_Aabb_Conic(), True),
                        (yade.PotentialParticle2AABB(), True), (yade.Bo1_ConicPP_Aabb(), False)):
    found, runs = tip(functor_, watch)
    check.true(found > 0,
               f"{type(functor_).__name__}, {'with' if watch else 'without'} BoundWatch: the contact is found")
    if not isinstance(functor_, yade.PotentialParticle2AABB):  # by which YADE does not widen what only turns
        check.true(runs < 400, f"and the collider rests: {runs} runs in 1700 steps")


# --- random motion: each pair of boxes that meet is a pair -----------------------------------------

def ends(shape):
    """Points of the surface towards each corner, local axes: their box is almost that of the shape."""
    directions = [corner.normalized() for corner in shape.vertices]
    return [u * distance for u, distance in zip(directions, shape.surfaceDistance(directions))]


def sorted_box(body):
    """Box of the ends, in the axes in which the collider sorts."""
    points = [body.state.pos + body.state.ori * end for end in motion.ends[body.id]]
    if O.periodic:
        points = [O.cell.unshearPt(point) for point in points]
    return [(min(p[i] for p in points), max(p[i] for p in points)) for i in range(3)]


def meet(one, other, period):
    """Of two intervals, in a cell of this period."""
    (low, high), (lower, upper) = one, other
    if not period:
        return low <= upper and lower <= high
    return math.ceil((low - upper) / period) <= math.floor((high - lower) / period)


def unseen():
    size = O.cell.size if O.periodic else (0, 0, 0)
    boxes = [sorted_box(body) for body in O.bodies]
    pairs = {(min(c.id1, c.id2), max(c.id1, c.id2)) for c in O.interactions.all()}
    touching = [(i, j) for i, j in itertools.combinations(range(len(boxes)), 2)
                if all(meet(a, b, period) for a, b, period in zip(boxes[i], boxes[j], size))]
    return len(touching), [pair for pair in touching if pair not in pairs]


class Motion:
    """Bodies that start, stop, spin and jump at random; and a count of the pairs that the collider did not see."""

    def __init__(self, seed, jumps):
        self.random, self.jumps = random.Random(seed), jumps
        self.met = self.missed = 0
        self.ends = {}

    def vector(self, size):
        return Vector3(*(self.random.gauss(0, size) for _ in range(3)))

    def move(self):
        for body in O.bodies:
            state, choice = body.state, self.random.random()
            if choice < 0.02:
                state.angVel = self.vector(5) if choice < 0.01 else Vector3.Zero
            elif choice < 0.04:
                state.vel = self.vector(0.05) if choice < 0.03 else Vector3.Zero
            elif choice < 0.0405 and self.jumps:
                state.pos, state.ori = state.pos + self.vector(0.3), turned(self.vector(1), 3 * self.random.random())

    def look(self):
        met, missed = unseen()
        self.met += met
        self.missed += len(missed)


def shake(functor_, watch, seed, jumps=True, size=None, shear=0.0, rate=0.0, steps=400, plain_shapes=False):
    global motion, move, look
    O.reset()
    O.materials.append(yade.FrictMat())
    O.periodic = size is not None
    O.dt = 2e-3
    motion = Motion(seed, jumps)
    move, look = motion.move, motion.look
    O.engines = [yade.ForceResetter(), yade.PyRunner(command="move()", iterPeriod=1), *collider(functor_, watch),
                 yade.NewtonIntegrator(damping=0, exactAsphericalRot=False)]
    if size:
        O.cell.hSize = yade.Matrix3(size, shear * size, 0, 0, size, 0, 0, 0, size)
        O.cell.velGrad = yade.Matrix3(0, rate, 0, 0, 0, 0, 0, 0, 0)
    for _ in range(24):
        shape = prism(0.05, 0.3 + 0.5 * motion.random.random())
        given = plain_of(shape) if plain_shapes else shape
        body = add(given, motion.vector(0.6), turned(motion.vector(1), 3 * motion.random.random()), volume=1,
                   inertia=Vector3(1, 1, 1))
        motion.ends[body] = ends(shape)
    run(steps)
    return motion


def plain_of(conic):
    return plain(conic.planes, r=conic.r, k=conic.k, R=conic.R, AabbMinMax=True, vertices=conic.vertices)


# The look at a scene sees pairs that the collider does not have.
shake(yade.Bo1_ConicPP_Aabb(), True, 1, steps=50)
O.interactions.clear()
met, missed = unseen()
check.true(met > 0 and len(missed) == met, f"pairs that are not there: {len(missed)} of {met}")
for seed in (1, 2):
    for functor_ in (yade.Bo1_ConicPP_Aabb(), yade.Bo1_PP_Aabb_Conic()):
        kept = shake(functor_, True, seed)
        check.true(kept.met > 1000, f"boxes meet: {kept.met} times")
        check.equal(kept.missed, 0, f"{type(functor_).__name__}, seed {seed}: pairs missed")
        check.true(
            engine("collider").numAction < O.iter,
            f"the collider rests: {engine('collider').numAction} runs in {O.iter} steps")
        check.true(0 < engine("watch").requests < O.iter, f"and is asked to run: {engine('watch').requests} times")
check.equal(
    shake(yade.Bo1_PP_Aabb_Conic(), True, 3, plain_shapes=True).missed, 0, "plain shapes with boxes: pairs missed")
# Without a watch, the box of all turns: right for any motion that YADE integrates.
kept = shake(yade.Bo1_ConicPP_Aabb(), False, 4, jumps=False)
check.true(kept.met > 1000 and kept.missed == 0, f"without BoundWatch: {kept.missed} of {kept.met} missed")

for shear, rate, what in ((0.0, 0.0, "periodic"), (0.3, 0.0, "sheared"), (0.2, 0.2, "shearing")):
    kept = shake(yade.Bo1_ConicPP_Aabb(), True, 5, size=3.0, shear=shear, rate=rate, steps=200)
    check.true(kept.met > 500, f"{what} cell: boxes meet {kept.met} times")
    check.equal(kept.missed, 0, f"{what} cell: pairs missed")
    if rate:
        check.equal(engine("collider").numAction, O.iter, "while the cell changes the collider runs in each step")

# --- saved and loaded ------------------------------------------------------------------------------

with tempfile.TemporaryDirectory() as folder:
    for ending in ("yade.gz", "xml"):
        shake(yade.Bo1_ConicPP_Aabb(), True, 6, steps=100)
        name = os.path.join(folder, "scene." + ending)
        O.save(name)
        O.load(name)
        check.equal([type(e).__name__ for e in O.engines[2:4]], ["BoundWatch", "InsertionSortCollider"],
                    f"{ending}: engines")
        check.equal(
            type(engine("collider").boundDispatcher.functors[0]).__name__, "Bo1_ConicPP_Aabb", f"{ending}: functor")
        motion.met = motion.missed = 0
        run(100)
        check.true(motion.met > 200 and motion.missed == 0,
                   f"{ending}: {motion.missed} of {motion.met} missed after loading")

# --- the boxes themselves ----------------------------------------------------------------------------

look = lambda: None


def bound(shape, watch=True, verlet=0.0, orientation=turned((1, 2, 3), 0.7), functor_=None):
    fresh_scene(yade.Ig2_PP_PP_ScGeom_Conic())
    O.engines = O.engines[:1] + collider(functor_ or yade.Bo1_PP_Aabb_Conic(), watch, verlet) + O.engines[2:]
    body = O.bodies[add(shape, Vector3(5, 6, 7), orientation, fixed=True, volume=1, inertia=Vector3(1, 1, 1))]
    run(1)
    return body.bound.min, body.bound.max, body


def corners(points, body):
    turned_points = [body.state.ori * point for point in points]
    return [body.state.pos + Vector3(*(pick(p[i] for p in turned_points) for i in range(3))) for pick in (min, max)]


for make in (cube, pyramid, lambda: prism(0.1, 1.0)):
    lower, upper, body = bound(make())
    directions = [motion.vector(1).normalized() for _ in range(2000)]
    surface = [u * s for u, s in zip(directions, body.shape.surfaceDistance(directions))]
    inside = [body.state.pos + body.state.ori * point for point in surface + ends(body.shape)]
    check.true(all(lower[i] <= point[i] <= upper[i] for point in inside for i in range(3)), "the box holds the surface")
    for i in range(3):
        extent, shown = upper[i] - lower[i], max(p[i] for p in inside) - min(p[i] for p in inside)
        sharp = corners(body.shape.vertices, body)[1][i] - corners(body.shape.vertices, body)[0][i]
        check.true(extent < sharp - 0.5 * body.shape.r, f"and leaves out the sharp corners: {extent} of {sharp}")
        check.true(extent < shown + 0.06 * body.shape.boundingRadius, f"and is not much larger: {extent}, {shown}")
    exact = lower, upper
    lower, upper, body = bound(make(), watch=False, verlet=0.125)
    for i in range(3):
        check.close(upper[i] - lower[i], 2 * (body.shape.boundingRadius + 0.125), 1e-12,
                    "without BoundWatch: of all turns, and widened")
    lower, upper, body = bound(make(), verlet=0.125)
    for found, expected, sign in zip((lower, upper), exact, (-1, 1)):
        check.close(found, expected + sign * 0.125 * Vector3(1, 1, 1), 1e-12, "with verletDist: widened by it")

given = [Vector3(1, 2, 3), Vector3(-2, 0, 1), Vector3(0, -3, -0.5)]
for shape in (cube(AabbMinMax=True, vertices=given), cube(AabbMinMax=True, vertices=given, automaticBox=False),
              plain(cube_planes(), r=0.05, k=0.05, R=0.9, AabbMinMax=True, vertices=given)):
    lower, upper, body = bound(shape)
    for found, expected in zip((lower, upper), corners(given, body)):
        check.close(found, expected, 1e-12, "a box that the script gave is kept")
    lower, upper, body = bound(shape, watch=False)
    check.close(upper[0] - 5, math.sqrt(14), 1e-12, "and turned in all ways without BoundWatch")
slab = plain(cube_planes(), r=0.05, k=0.05, R=0.9, AabbMinMax=True, minAabbRotated=(3, 2, 1),
             maxAabbRotated=(3, 2, 0.5))
lower, upper, body = bound(slab, orientation=Quaternion.Identity)
check.close(lower, Vector3(2, 4, 6), 1e-12, "by its lengths: below")
check.close(upper, Vector3(8, 8, 7.5), 1e-12, "by its lengths: above")
bare = plain(cube_planes(), r=0.05, k=0.05, R=0.9)
lower, upper, body = bound(bare, orientation=Quaternion.Identity)
check.close(upper, Vector3(5.5, 6.5, 7.5), 3e-3, "a plain shape without a box: the library's")

# A shape keeps the functor that served it first. What counts is the scene that steps, not the one of which that functor
# knows.
shared = cube()
_, of_all_turns, _ = bound(shared, watch=False, orientation=Quaternion.Identity)
O.switchToScene(O.addScene())
O.materials.append(yade.FrictMat())
O.engines = [yade.ForceResetter(), *collider(yade.Bo1_PP_Aabb_Conic(), verlet=0.0)]
body = O.bodies[add(shared, Vector3(5, 6, 7), Quaternion.Identity, fixed=True, volume=1, inertia=Vector3(1, 1, 1))]
run(1)
found = body.bound.max
_, as_it_stands, _ = bound(cube(), orientation=Quaternion.Identity)
check.true(as_it_stands[0] < of_all_turns[0] - 0.1, "with a watch the box is smaller")
check.close(found, as_it_stands, 1e-12, "a shape that was in a scene without a watch: the box of this scene")

check.finish()
