# SPDX-License-Identifier: GPL-3.0-or-later
# Bodies that break: at the stress that platens and pulls make, into pieces that fill them and keep mass, momentum and
# moment of momentum.
#
# BREAKS=10000 SEED=7 in the environment: so many random breaks instead of a few.
import os
import warnings

import numpy as np
import potential_particles
from harness import *
from potential_particles import Particle, Pose, SceneWarning, body, detect, shapes

check = Checks()
DENSITY, R = 2000.0, 0.02


def scene(*engines, periodic=False, dt=1e-4, **material):
    """Joints with a stiffness per area, and engines at the end."""
    O.reset()
    O.periodic = periodic
    joint_scene(yade.ConicInteractionLoop,
                yade.ConicJointMat(density=DENSITY, **{"young": 1e7, "normalStiffness": 1e7, "shearStiffness": 5e6,
                                                       "frictionAngle": 0.0, **material}), 0.0, (0, 0, 0), True, dt,
                bonds="tensileStrength" in material)
    O.engines += list(engines)


def cube(place, turn=Quaternion.Identity, edges=(1, 1, 1), r=R, **more):
    return O.bodies.append(body(shapes.cuboid(edges, r=r, k=0), position=place, orientation=turn, **more))


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
ids = [cube((3 * i, 0, 0), r=1e-3) for i in range(1500)]
volume = O.bodies[0].state.mass / DENSITY
check.close(engine.strengthFactor(0), (8.0 / volume)**(1 / 3), 1e-12, "size effect")
engine.seed = 5
first = np.array([engine.strengthFactor(one) for one in ids])
drawn = np.sort(1.0 - np.exp(-(first / engine.referenceVolume**(1 / 3))**3 * volume))
check.close(np.abs(drawn - (np.arange(1500) + 0.5) / 1500).max(), 0.0, 1.63 / 1500**0.5, "Kolmogorov-Smirnov")
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


def break_at_random(seed):
    """(largest relative change of mass, momentum and moment of momentum; overlap of pieces over r; how far pieces reach
    out of the body, over r; number of pieces) of a random rock with spin, cut by random planes.
    """
    global PLANES
    rng = np.random.default_rng(seed)
    kind = shapes.random_rock(seed, size=rng.uniform(0.01, 5), faces=int(rng.integers(8, 30)),
                              elongation=rng.uniform(0.5, 1), flatness=rng.uniform(0.5, 1),
                              rounding=rng.uniform(0.01, 0.15), k=float(rng.choice([0.0, 0.02])))
    way = rng.normal(size=4)
    made = body(kind, position=rng.normal(size=3) * 10, orientation=way, velocity=rng.normal(size=3),
                angular_velocity=rng.normal(size=3) * 5)
    rock = O.bodies.append(made)
    PLANES = rng.normal(size=(int(rng.integers(1, 4)), 3)).tolist()
    if rng.random() < 0.3:  # off the centre
        spot = np.array(made.state.pos) + 0.1 * kind.bounding_radius * rng.normal(size=3)
        PLANES = [(*normal, float(np.dot(normal, spot))) for normal in PLANES]
    before = total([rock])
    engine.leastSize = 0.02 * kind.bounding_radius
    O.step()
    row = engine.history[-1] if len(engine.history) else None
    if row is None or row["parent"] != rock:
        O.bodies.erase(rock)
        return 0.0, 0.0, 0.0, 1
    pieces = list(range(int(row["first"]), int(row["first"] + row["pieces"])))
    after = total(pieces)
    # Moments are judged by those of masses and speeds, which may cancel.
    scales = (before[0], before[1].norm(), before[2].norm() + before[0] * made.state.pos.norm() * made.state.vel.norm())
    # The step moved the body, and then broke it.
    changes = [abs(after[0] - before[0]) / scales[0], (after[1] - before[1]).norm() / scales[1],
               (after[2] - before[2]).norm() / scales[2]]
    particles = [posed(O.bodies[one]) for one in pieces]
    overlap = max((detect(*one, *other).overlap / min(one[0].r, other[0].r) for i, one in enumerate(particles)
                   for other in particles[:i]), default=0.0)
    out = 0.0
    for one in pieces:
        found = potential_particles.mesh(O.bodies[one].shape, 0.05).moved(O.bodies[one].state.pos,
                                                                          O.bodies[one].state.ori)
        for point in found.points:
            local = made.state.ori.conjugate() * (Vector3(*point) - made.state.pos)
            out = max(out, made.shape.potential(local)**0.5 - 1.0)
    for one in pieces:
        O.bodies.erase(one)
    return max(changes), overlap, out, len(pieces)


COUNT, SEED = int(os.environ.get("BREAKS", 150)), int(os.environ.get("SEED", 1))
found = []
for number in range(COUNT):
    if number % 500 == 0:
        engine = Breakage(function=asked, leastSize=0.05, iterPeriod=1, rounding=0.2)
        scene(engine, dt=1e-9)
    found.append(break_at_random(1_000_000 * SEED + number))
change, overlap, out = (max(row[i] for row in found) for i in range(3))
counts = [row[3] for row in found]
print(f"{COUNT} rocks, seed {SEED}: {COUNT - counts.count(1)} broke into {sum(counts)} pieces (most {max(counts)}); "
      f"mass, momentum, moment of momentum change by {change:.2g} at most, overlap {overlap:.2g} r, out {out:.2g}")
check.true(counts.count(1) < 0.1 * COUNT, f"{counts.count(1)} of {COUNT} rocks stayed whole")
check.true(change < 1e-12, f"mass, momentum and moment of momentum: {change}")
check.true(overlap < 1e-9, f"pieces overlap by {overlap} r")
# S rises by the share of r in which a piece is out; k = 0.02 bulges by 1 %.
check.true(out < 0.02, f"pieces reach out of the body: {out}")
PLANES = True

check.finish()
