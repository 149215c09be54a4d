# SPDX-License-Identifier: GPL-3.0-or-later
# Bodies that break: at the stress that platens and pulls make, into pieces that fill them and keep mass, momentum and
# moment of momentum.
#
# BREAKS=10000 SEED=7 in the environment: so many random breaks instead of a few.
import functools
import os
import tempfile
import warnings

import numpy as np
import potential_particles
from harness import *
from potential_particles import Particle, Pose, SceneWarning, body, detect, shapes
from potential_particles.breakage import sharp_planes

check = Checks()
DENSITY, ROUNDING = 2000.0, 2e-3


def scene(*engines, periodic=False, dt=1e-4, **material):
    """Joints with a stiffness per area, and engines at the end."""
    O.reset()
    O.periodic = periodic
    joint_scene(yade.ConicInteractionLoop,
                yade.ConicJointMat(density=DENSITY, **{"young": 1e7, "normalStiffness": 1e7, "shearStiffness": 5e6,
                                                       "frictionAngle": 0.0, **material}), 0.0, (0, 0, 0), True, dt,
                bonds="tensileStrength" in material)
    O.engines += list(engines)


CUBE = shapes.cuboid((1, 1, 1), rounding=ROUNDING, k=0)


def cube(place, turn=Quaternion.Identity, **more):
    return O.bodies.append(body(CUBE, position=place, orientation=turn, **more))


def wall(place, axis, speed=0.0):
    made = utils.wall(place, axis=axis, sense=0, material=0)
    made.state.vel[axis] = speed
    return O.bodies.append(made)


def until_broken(engine, steps, look):
    """What look() saw in the step in which a body broke; None if none did."""
    for _ in range(steps):
        O.step()
        if len(engine.history):
            return look()
    return None


# --- strength ------------------------------------------------------------------------------

# Between platens: force over area is the compressive strength.
STRENGTH = 1e4
engine = Breakage(compressiveStrength=STRENGTH, leastSize=0.05, iterPeriod=1, pieces=4)
scene(engine)
cube((0, 0, 0))
lower, upper = wall(-0.5, 2, 0.01), wall(0.5, 2, -0.01)
forces = until_broken(engine, 2000, lambda: [O.forces.f(one)[2] for one in (lower, upper)])
check.true(forces is not None, "a cube breaks between platens")
check.close(forces[1] / STRENGTH, 1.0, 0.01, "at its strength: force over area")
row = engine.history[0]
check.equal((row["parent"], row["pieces"], len(O.bodies)), (0, 4, 7), "into four pieces, and O.bodies has them")
check.close(row["least"] / -STRENGTH, 1.0, 0.01, "least principal stress")
check.close(row["area"], 2.0, 1e-9, "area of two cuts through a unit cube")
check.true(O.bodies[0] is None, "the body is gone")
# Axial cuts: each piece reaches both platens, so that these feel the same force.
O.step()
check.close(O.forces.f(upper)[2] / forces[1], 1.0, 0.03, "the platen is held on")
check.equal(sorted(engine.generations.values()), [1] * 4, "first generation")
check.equal(set(engine.parents.values()), {0}, "their parent")

# With both strengths: by Mohr-Coulomb under lateral pressure p, at s3 = -C (1 + p/T).
TENSILE, PRESSURE = 5e3, 4e3
engine = Breakage(tensileStrength=TENSILE, compressiveStrength=STRENGTH, leastSize=0.05, iterPeriod=1)
scene(engine)
cube((0, 0, 0))
# Walls as stiff as the cube: the overlap of each is p over the stiffness per area.
sides = [wall(sign * (0.5 - PRESSURE / 1e7), axis) for axis in (0, 1) for sign in (-1, 1)]
lower, upper = wall(-0.5, 2, 0.01), wall(0.5, 2, -0.01)
seen = until_broken(engine, 4000, lambda: (O.forces.f(upper)[2], O.forces.f(sides[1])[0]))
check.true(seen is not None, "it breaks under lateral pressure")
axial, lateral = seen
check.close(axial / (STRENGTH * (1 + lateral / TENSILE)), 1.0, 0.01, f"Mohr-Coulomb, p = {lateral:.4g}")
check.close(lateral / PRESSURE, 1.0, 0.05, "the pressure that was asked for")

# Pulled by bonds at both ends: force over area is the tensile strength.
engine = Breakage(tensileStrength=TENSILE, leastSize=0.05, iterPeriod=1)
scene(engine, tensileStrength=1e9, cohesion=1e9)
turn = turned((0, 0, 1), 0.4)
cube((0, 0, 0), turn)
ends = [cube((0, 0, sign * (1 - 1e-6)), turn, fixed=True) for sign in (-1, 1)]
O.step()
for end, sign in zip(ends, (-1, 1)):
    O.bodies[end].state.vel = Vector3(0, 0, 0.01 * sign)
force = until_broken(engine, 3000, lambda: O.forces.f(ends[1])[2])
check.true(force is not None, "it breaks where it is pulled")
# Roundings take a little from the bonded faces, nothing from the body.
check.close(-force / TENSILE, 1.0, 0.01, "at its strength: force over area")
check.close(engine.history[0]["largest"] / TENSILE, 1.0, 0.01, "largest principal stress")
middles = sorted(O.bodies[one].state.pos[2] for one in engine.parents)
check.true(len(middles) == 2 and middles[0] < -0.2 and middles[1] > 0.2, f"cut across the pull: {middles}")
check.true(engine.history[0]["elastic_energy"] > 0.99 * force**2 / 1e7, "both bonds are lost, with their energy")
check.equal([c.phys.bonded for c in O.interactions if c.isReal], [], "no bond is left")


# Weibull: (V0/V)^(1/m) without scatter; with it, survival exp(-1) at the strength of V0, the same from run to run.
engine = Breakage(tensileStrength=1.0, weibullModulus=3.0, referenceVolume=8.0, leastSize=0.01)
scene(engine)
ids = [cube((3 * i, 0, 0)) for i in range(600)]
volume = O.bodies[0].state.mass / DENSITY
check.close(engine.strengthFactor(0), (8.0 / volume)**(1 / 3), 1e-12, "size effect")
engine.seed = 5
first = np.array([engine.strengthFactor(one) for one in ids])
drawn = np.sort(1.0 - np.exp(-(first / engine.referenceVolume**(1 / 3))**3 * volume))
check.close(np.abs(drawn - (np.arange(600) + 0.5) / 600).max(), 0.0, 1.63 / 600**0.5, "Kolmogorov-Smirnov")
again = Breakage(tensileStrength=1.0, weibullModulus=3.0, referenceVolume=8.0, leastSize=0.01, seed=5)
check.true(all(again.strengthFactor(one) == found for one, found in zip(ids, first)), "of seed and id alone")
again.seed = 6
check.true(np.mean([again.strengthFactor(one) == found for one, found in zip(ids, first)]) < 0.01, "another seed")


# --- pieces --------------------------------------------------------------------------------


def total(ids):
    """Mass, momentum, moment of momentum about the origin."""
    states = [O.bodies[one].state for one in ids]
    return (sum(one.mass for one in states), sum((one.mass * one.vel for one in states), Vector3.Zero),
            sum((one.pos.cross(one.mass * one.vel) + one.angMom for one in states), Vector3.Zero))


def posed(one):
    shape, state = one.shape, one.state
    w, x, y, z = state.ori[3], *(state.ori[i] for i in range(3))
    return Particle(np.array(shape.planes), shape.r, shape.k, shape.R), Pose(list(state.pos), (w, x, y, z))


def asked(one, stress):
    """What breaks the bodies of a test: PLANES, or whatever they hold."""
    return PLANES


@functools.lru_cache(maxsize=None)
def rock(which):
    rng = np.random.default_rng(which)
    return shapes.random_rock(which, faces=int(rng.integers(8, 30)), elongation=rng.uniform(0.5, 1),
                              flatness=rng.uniform(0.5, 1), rounding=rng.uniform(0.01, 0.15), k=0.02 * (which % 2))


def break_at_random(seed):
    """(largest relative change of mass, momentum and moment of momentum; overlap of pieces over r; how far pieces reach
    out of the body, over r; number of pieces) of a random rock with spin, cut by random planes.
    """
    global PLANES
    rng = np.random.default_rng(seed)
    kind = rock(int(rng.integers(16))).scaled(rng.uniform(0.01, 5))
    way = rng.normal(size=4)
    made = body(kind, position=rng.normal(size=3) * 10, orientation=way, velocity=rng.normal(size=3),
                angular_velocity=rng.normal(size=3) * 5)
    number = O.bodies.append(made)
    PLANES = rng.normal(size=(int(rng.integers(1, 4)), 3)).tolist()
    if rng.random() < 0.3:  # off the centre
        spot = np.array(made.state.pos) + 0.1 * kind.bounding_radius * rng.normal(size=3)
        PLANES = [(*normal, float(np.dot(normal, spot))) for normal in PLANES]
    before = total([number])
    engine.leastSize = 0.02 * kind.bounding_radius
    O.step()
    row = engine.history[-1] if len(engine.history) else None
    if row is None or row["parent"] != number:
        O.bodies.erase(number)
        return 0.0, 0.0, 0.0, 1
    pieces = list(range(int(row["first"]), int(row["first"] + row["pieces"])))
    after = total(pieces)
    # Moments are judged by those of masses and speeds, which may cancel.
    scales = (before[0], before[1].norm(), before[2].norm() + before[0] * made.state.pos.norm() * made.state.vel.norm())
    # The step moved the body, and then broke it.
    changes = [abs(after[0] - before[0]) / scales[0], (after[1] - before[1]).norm() / scales[1],
               (after[2] - before[2]).norm() / scales[2]]
    particles = [posed(O.bodies[one]) for one in pieces]
    overlap = 0.0
    for i, one in enumerate(particles):
        for other in particles[:i]:
            contact = detect(*one, *other)
            if contact.kind == "overlapping":
                overlap = max(overlap, contact.overlap / min(one[0].r, other[0].r))
    out = 0.0
    planes = sharp_planes(made.shape)
    for piece in (O.bodies[one] for one in pieces):
        surface = potential_particles.mesh(piece.shape, 0.2).moved(piece.state.pos, piece.state.ori).points
        local = (surface - np.array(made.state.pos)) @ np.array(made.state.ori.toRotationMatrix())
        out = max(out, (local @ planes[:, :3].T - planes[:, 3]).max() / kind.r)
        # With its rounding it lies within the rounded body, too, but for the bulge of faces.
        if math.isclose(piece.shape.r, kind.r, rel_tol=1e-9):
            out = max(out, max((1.0 + made.shape.potential(Vector3(*point)))**0.5 - 1.0 for point in local) - kind.k)
    for one in pieces:
        O.bodies.erase(one)
    return max(changes), overlap, out, len(pieces)


COUNT, SEED = int(os.environ.get("BREAKS", 100)), int(os.environ.get("SEED", 1))
found = []
for number in range(COUNT):
    if number % 500 == 0:
        engine = Breakage(function=asked, leastSize=0.05, iterPeriod=1, rounding=0.2)
        # So short that the step itself, whose spins may be half a step behind the turns, changes nothing.
        scene(engine, dt=1e-13)
    found.append(break_at_random(1_000_000 * SEED + number))
change, overlap, out = (max(row[i] for row in found) for i in range(3))
counts = [row[3] for row in found]
print(f"{COUNT} rocks, seed {SEED}: {COUNT - counts.count(1)} broke into {sum(counts)} pieces (most {max(counts)}); "
      f"mass, momentum, moment of momentum change by {change:.2g} at most, overlap {overlap:.2g} r, out {out:.2g}")
check.true(counts.count(1) < 0.1 * COUNT, f"{counts.count(1)} of {COUNT} rocks stayed whole")
check.true(change < 1e-12, f"mass, momentum and moment of momentum: {change}")
check.true(overlap < 1e-9, f"pieces overlap by {overlap} r")
check.true(out < 1e-9, f"pieces reach out of the body: {out}")


def broken_once(place=(0, 0, 0), turn=Quaternion.Identity, edges=None, **more):
    """The engine, and the ids of the pieces of a cube that its function breaks."""
    global PLANES
    PLANES = more.pop("planes", True)
    engine = Breakage(**{"function": asked, "leastSize": 0.05, "iterPeriod": 1, **more})
    scene(engine, dt=1e-9)
    if edges is None:
        cube(place, turn)
    else:
        O.bodies.append(body(shapes.cuboid(edges, k=0), position=place, orientation=turn))
    O.step()
    return engine, list(engine.parents)


# Given joints are planes in the axes of the body, through its centroid: here across x.
turn = turned((1, 2, 3), 0.7)
engine, pieces = broken_once((5, 6, 7), turn, joints=[(1, 0, 0)])
ends = sorted((turn.conjugate() * (O.bodies[one].state.pos - Vector3(5, 6, 7)) for one in pieces), key=lambda one: one[0])
check.true(len(ends) == 2, f"joints: {len(ends)} pieces")
check.close(ends[0], Vector3(-0.25, 0, 0), 1e-12, "joints: one piece")
check.close(ends[1], Vector3(0.25, 0, 0), 1e-12, "and the other")
check.equal(engine.joints, [1, 0, 0], "joints, flat")
# Planes that a function gives, a x + b y + c z = d in world axes: pieces of 0.2 and 0.8.
engine, pieces = broken_once((0, 0, 3), planes=[(0, 0, 2, 5.4)])
masses = sorted(O.bodies[one].state.mass for one in pieces)
check.close(masses[0] / sum(masses), 0.2, 1e-12, "a plane off the centre")
# By stress: one, two, three planes.
for count in (2, 4, 8):
    check.equal(len(broken_once(pieces=count)[1]), count, "pieces")
for answer in (False, None, np.False_, []):
    check.equal(broken_once(planes=answer)[1], [], f"{answer!r}: whole")
# Least size: the halves of a unit cube hold a ball of 0.5.
check.equal(len(broken_once(leastSize=0.499)[1]), 2, "least size is kept")
check.equal(len(broken_once(leastSize=0.501)[1]), 0, "a cut that makes smaller ones is left out")
# A quarter of the cuts of an oblong: the first halves its length, the second would make them too thin.
check.equal(len(broken_once(edges=(2, 1, 1), leastSize=0.6, joints=[(1, 0, 0), (0, 1, 0)])[1]), 2, "others are made")
# Pieces break again, and tell their parents.
engine, pieces = broken_once()
O.step()
generations = engine.generations
check.equal(sorted(generations.values()), [1] * 2 + [2] * 4, "second generation")
check.equal({engine.parents[one] for one, age in generations.items() if age == 2}, set(pieces), "of the first")
check.true(all(generations[one] == 1 + generations.get(parent, 0) for one, parent in engine.parents.items()),
           "each one after its parent")

# What never breaks: what no force moves, members of clumps, bodies without faces.
engine = Breakage(function=asked, leastSize=0.01, iterPeriod=1)
PLANES = True
scene(engine, dt=1e-9)
cube((0, 0, 0), fixed=True)
O.bodies.clump([cube((3, 0, 0)), cube((3, 0, 1.5))])
O.bodies.append([body(shapes.sphere(0.5), position=(6, 0, 0)), body(shapes.ellipsoid((1, 0.8, 0.6)), position=(9, 0, 0)),
                 body(shapes.capsule(), position=(12, 0, 0))])
with warnings.catch_warnings():
    warnings.simplefilter("ignore", SceneWarning)
    O.step()
check.equal(len(engine.history), 0, f"these stay whole: {engine.history}")


# --- saved and loaded, periodic ------------------------------------------------------------


STONES = [shapes.random_rock(number, k=0) for number in range(2)]


def crushed():
    """Rocks between platens that close, by springs at points."""
    fresh_scene(yade.Ig2_ConicPP_ConicPP_ScGeom(), yade.Ip2_FrictMat_FrictMat_FrictPhys(),
                yade.Law2_ScGeom_FrictPhys_CundallStrack(sphericalBodies=False), dt=1e-4, damping=0.3, friction=0.4)
    resetter, collider, loop, integrator = O.engines
    collider.boundDispatcher.functors += [yade.Bo1_Wall_Aabb()]
    # The loop that adds up forces in the same order in a loaded scene.
    loop = yade.ConicInteractionLoop(loop.geomDispatcher.functors + [yade.Ig2_Wall_ConicPP_ScGeom()],
                                     loop.physDispatcher.functors, loop.lawDispatcher.functors)
    O.engines = [resetter, collider, loop, integrator, Breakage(tensileStrength=5e3, compressiveStrength=5e4, weibullModulus=3, referenceVolume=0.5, seed=3,
                           leastSize=0.2, pieces=4, iterPeriod=5)]
    for number in range(2):
        O.bodies.append(body(STONES[number], position=(1.2 * number, 0, 0)))
    wall(-0.5, 2, 0.1), wall(0.5, 2, -0.1)
    run(225)


crushed()
engine = O.engines[-1]
count = len(engine.history)
check.true(count > 1, f"{count} rocks broke before the scene is saved")
with tempfile.TemporaryDirectory() as folder:
    for ending in ("xml", "yade.bz2"):
        file = os.path.join(folder, f"crushed.{ending}")
        O.save(file)
    run(200)
    engine = O.engines[-1]
    after, rows = state_numbers(), engine.history.tolist()
    check.true(len(rows) > count, f"{len(rows)} after it")
    for ending in ("xml", "yade.bz2"):
        O.load(os.path.join(folder, f"crushed.{ending}"))
        check.equal(len(O.engines[-1].history), count, f"{ending}: what broke is saved")
        run(200)
        check.true(O.engines[-1].history.tolist() == rows, f"{ending}: the same break after loading")
        apart = max(abs(one - other) for one, other in zip(state_numbers(), after))
        check.equal(apart, 0.0, f"{ending}: and move in the same way")

# A column of three cubes through a periodic cell: stress and pieces across its boundary.
DEPTH = 1e-3
engine = Breakage(compressiveStrength=STRENGTH, leastSize=0.05, iterPeriod=1)
scene(engine, periodic=True)
O.cell.hSize = Matrix3(4, 0, 0, 0, 4, 0, 0, 0, 3 * (1 - DEPTH))
column = [cube((1, 1, (1 - DEPTH) * (i + 0.1)), velocity=(0.1, 0, 0)) for i in range(3)]
engine.dead = True
O.step()
O.step()
expected = -1e7 * DEPTH
stresses = potential_particles.body_stresses()
for one in column:
    check.close(stresses[one][2, 2] / expected, 1.0, 0.01, f"stress of cube {one}")
engine.dead, engine.compressiveStrength = False, -1.02 * expected
O.step()
check.equal(len(engine.history), 0, "below the strength")
before = total(column)
engine.compressiveStrength = -0.98 * expected
O.step()
check.equal((len(engine.history), len(engine.parents)), (3, 6), "above it")
after = total(engine.parents)
check.close(after[0] / before[0], 1.0, 1e-12, "mass in a periodic cell")
engine.dead = True
O.step()
forces = [c.phys.normalForce.norm() for c in O.interactions if c.isReal]
check.close(sum(forces) / (3 * -expected), 1.0, 0.05, f"pieces press on as before: {forces}")


# --- errors --------------------------------------------------------------------------------

scene()
for settings, text in ((dict(pieces=3), "pieces=3 must be 2, 4 or 8"), (dict(tensileStrength=-1.0), "tensileStrength=-1"),
                       (dict(iterPeriod=0), "iterPeriod=0"), (dict(rounding=0.5), "rounding=0.5 must lie between"),
                       (dict(joints=[(0, 0, 0)]), "not all 0"), (dict(leastSize=float("nan")), "leastSize = nan"),
                       (dict(function=lambda one, stress: True), "define it by def")):
    check.raises(ValueError, lambda settings=settings: Breakage(**settings), f"{settings}", text)
whole = Breakage(leastSize=0.1, tensileStrength=1)
check.raises(ValueError, lambda: setattr(whole, "pieces", 5), "set", "pieces=5")
check.equal(whole.pieces, 2, "what was refused is not taken")
check.raises(AttributeError, lambda: Breakage(tensilestrength=1), "a name that is none")


def wrong(one, stress):
    raise KeyError("of the script")


def odd(one, stress):
    return [(1, 2)]


for settings, text in ((dict(tensileStrength=1.0), "leastSize=0 must be above 0"), (dict(leastSize=0.1), "nothing breaks"),
                       (dict(leastSize=0.1, tensileStrength=1, seed=1), "weibullModulus=0"),
                       (dict(leastSize=0.1, tensileStrength=1, weibullModulus=3), "referenceVolume=0 must be above 0"),
                       (dict(leastSize=0.1, function="no_such"), "function=no_such is not there"),
                       (dict(leastSize=0.1, function=wrong), "KeyError: 'of the script'"),
                       (dict(leastSize=0.1, function=odd), "row 0 has 2 numbers")):
    engine = Breakage(iterPeriod=1, **settings)
    scene(engine)
    cube((0, 0, 0))
    # As YADE hands on what is wrong in a step.
    check.raises(RuntimeError, lambda: run(1), f"{settings}", "YADE stopped")
    check.raises((RuntimeError, ValueError), engine, f"{settings}", text)

check.finish()
