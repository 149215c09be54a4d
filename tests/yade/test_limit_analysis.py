# SPDX-License-Identifier: GPL-3.0-or-later
# Limit analysis of scenes as they stand: closed forms, what carries them, what a simulation does, and bad input.
import math

import numpy as np
import potential_particles
from harness import *
from potential_particles import limit_analysis, shapes

check = Checks()
HEIGHT, ROUNDING = 2.0, 1e-3
# The faces of a cuboid of width 1 are flat up to its roundings.
FLAT = 1.0 - 2 * ROUNDING


def floor(kind):
    """A held body with its upper side at z = 0."""
    if kind == "wall":
        return utils.wall(0.0, axis=2, sense=1)
    if kind == "facet":
        return utils.facet([(-9, -9, 0), (9, -9, 0), (0, 18, 0)], fixed=True)
    if kind == "box":
        return utils.box((0, 0, -1), (4, 4, 1), fixed=True)
    return potential_particles.body(shapes.cuboid((8, 8, 2), r=ROUNDING, k=0), position=(0, 0, -1), fixed=True)


def block_on(kind="particle", friction=0.5, angle=0.0, joints=True, height=HEIGHT, **strength):
    """A cuboid of width 1 on a floor, gravity turned about y by an angle; one step has been made."""
    O.reset()
    common = dict(young=1e9, poisson=0.3, density=1000, frictionAngle=math.atan(friction))
    O.materials.append(ConicJointMat(**common, **strength) if joints else FrictMat(**common))
    O.bodies.append(floor(kind))
    block = shapes.cuboid((1, 1, height), r=ROUNDING, k=0)
    O.bodies.append(potential_particles.body(block, position=(0, 0, 0.5 * height - 1e-5)))
    functors = [Ig2_PP_PP_ScGeom_Conic(patch=joints), Ig2_Wall_ConicPP_ScGeom(patch=joints),
                Ig2_Facet_ConicPP_ScGeom(patch=joints)] + [Ig2_Box_ConicPP_ScGeom()] * (kind == "box")
    laws = ([Ip2_ConicJointMat_ConicJointMat_ConicJointPhys()], [Law2_ScGeomConicPP_ConicJointPhys()]) if joints else (
        [Ip2_FrictMat_FrictMat_FrictPhys()], [Law2_ScGeom_FrictPhys_CundallStrack(sphericalBodies=False)])
    boxes = [PotentialParticle2AABB(), Bo1_Box_Aabb(), Bo1_Wall_Aabb(), Bo1_Facet_Aabb()]
    gravity = 9.81 * Vector3(math.sin(angle), 0, -math.cos(angle))
    O.engines = [ForceResetter(), InsertionSortCollider(boxes),
                 InteractionLoop(functors, *laws), NewtonIntegrator(gravity=gravity)]
    O.dt = 1e-6
    O.step()


# A block on each kind of floor: it slides or turns over under a push, and slides on a slope.
for kind in ("particle", "wall", "facet", "box"):
    block_on(kind, joints=kind != "box")
    steps = O.iter
    found = limit_analysis("load", push=(1, 0, 0))
    check.equal((found.stands, len(found.contacts), len(found.corners)), (True, 1, 4), f"{kind}: {found}")
    check.close(found.factor, FLAT / HEIGHT, 2e-5, f"{kind}: it turns over")
    turning = found.velocities[1][1]
    check.true(turning[1] > 0.1 and abs(turning[0]) < 1e-3, f"{kind}: about y, {turning}")
    weight = O.bodies[1].state.mass * 9.81
    sense = 1 if O.interactions.all()[0].id2 == 1 else -1
    total = sense * found.forces.sum(axis=0)
    check.close(Vector3(*total), weight * Vector3(-found.factor, 0, 1), 1e-5 * weight, f"{kind}: forces at the corners")
    check.equal(O.iter, steps, f"{kind}: no step is made")
    block_on(kind, friction=0.3, joints=kind != "box")
    check.close(limit_analysis("load", push=(0, -1, 0)).factor, 0.3, 1e-5, f"{kind}: it slides")
    check.close(limit_analysis("strength", push=(0, 0.1, 0)).factor, 3.0, 1e-4, f"{kind}: strength under a push")
    check.true(limit_analysis().stands and not limit_analysis(push=(0, 0.4, 0)).stands, f"{kind}: it stands")
    block_on(kind, friction=0.6, angle=0.2, joints=kind != "box")
    check.close(limit_analysis("strength").factor, 0.6 / math.tan(0.2), 1e-4, f"{kind}: factor of safety")

# Just above and below the limit, a simulation says the same.
for friction in (0.98 * math.tan(0.3), 1.02 * math.tan(0.3)):
    # A low block, which does not rock where gravity sets in.
    block_on(friction=friction, angle=0.3, height=0.3, restitution=0.1)
    says = limit_analysis().stands
    O.dt = potential_particles.critical_time_step()
    O.run(int(0.2 / O.dt), wait=True)
    speed = O.bodies[1].state.vel.norm()
    sliding = 9.81 * math.cos(0.3) * (math.tan(0.3) - friction) * 0.2
    check.close(speed, max(sliding, 0.0), 2e-3, f"friction {friction:.4f}: it {'stands' if says else 'slides'}")
    check.equal(says, sliding < 0.0, f"friction {friction:.4f}: as the simulation")

# Strength of joints as they stand, lasting forces, other live loads.
block_on(friction=0.3, cohesion=2e3)
weight = O.bodies[1].state.mass * 9.81
joint = O.interactions[0, 1]
held = (0.3 * weight + 2e3 * FLAT**2) / weight if not joint.phys.broken else 0.3
check.close(limit_analysis("load", push=(0.5, 0, 0)).factor, 2 * min(held, FLAT / HEIGHT), 1e-3, "cohesion as it stands")
block_on(friction=0.3)
O.forces.setPermF(1, (0, 0, -weight))
found = limit_analysis("load", loads={1: ((weight, 0, 0), (0, -0.5 * HEIGHT * weight, 0))})
check.close(found.factor, 0.6, 1e-4, "a lasting force presses, a live force and torque push at the foot")
check.true(limit_analysis("load", push=(1, 0, 0), dilatant=True).factor >= 0.6 - 1e-4, "the bound is above")

# The bound comes with every factor, and what bears it.
block_on(friction=0.6, angle=0.2)
found = limit_analysis("strength")
check.true(found.factor <= found.bound * (1 + 1e-6) and found.may_stand, f"bounded: {found}")
check.close(found.largest, math.cos(0.2) * math.hypot(1, math.tan(0.2)), 1e-4, "one contact carries the weight")

# A polygon with a sharp point is all there: a triangle of 1 by 25.
O.reset()
O.materials.append(ConicJointMat(young=1e9, poisson=0.3, density=1000, frictionAngle=0.5))
O.bodies.append(floor("wall"))
corners = [(0, -0.5, 0), (0, 0.5, 0), (25, 0, 0)]
prism = shapes.from_vertices([(x, y, z) for x, y, _ in corners for z in (0, 1)], r=ROUNDING, k=0)
O.bodies.append(potential_particles.body(prism, position=(0, 0, -1e-5)))
O.engines = [ForceResetter(), InsertionSortCollider([PotentialParticle2AABB(), Bo1_Wall_Aabb()]),
             InteractionLoop([Ig2_Wall_ConicPP_ScGeom(patch=True)], [Ip2_ConicJointMat_ConicJointMat_ConicJointPhys()],
                             [Law2_ScGeomConicPP_ConicJointPhys()]), NewtonIntegrator(gravity=(0, 0, -9.81))]
O.dt = 1e-7
O.step()
held = np.ptp(limit_analysis().corners, axis=0)
check.true(held[0] > 24.0, f"the point of a triangle of 25 is at {held[0]:.4g}")

# By simulation: a block on a slope, and one that is pushed until it slides. Two threads take forty times as long for
# a step of one block as one does, and there are a million.
simulated = (("strength", 0.3, None, 0.6 / math.tan(0.3)), ("load", 0.0, (1, 0, 0), 0.6),
             ("strength", 0.0, (0.3, 0, 0), 2.0))
for question, angle, push, expected in simulated if O.numThreads == 1 else ():
    block_on(friction=0.6, angle=angle, height=0.3, restitution=0.1)
    O.dt = 0.5 * potential_particles.critical_time_step()
    O.run(int(0.3 / O.dt), wait=True)
    place = Vector3(O.bodies[1].state.pos)
    found = potential_particles.factor_by_simulation(question, push=push, tolerance=0.03, progress=False)
    check.true(found.stands < expected < found.falls and found.falls - found.stands < 0.03 * found.falls,
               f"{question} by simulation: {found} for {expected:.4f}")
    check.equal(O.bodies[1].state.pos, place, f"{question}: the scene is as it was")
check.raises(ValueError, lambda: potential_particles.factor_by_simulation("stands"), "no factor", "has no factor")
check.raises(ValueError, lambda: potential_particles.factor_by_simulation("load", stiffnesses=(1, 1)), "twice",
             "stiffnesses=[1.0, 1.0]")


def leaning(stiffness):
    """The load factor of a pier that leans by θ on its toe, at the θ where it is largest."""
    turns = np.linspace(1e-4, 0.1, 10_000)
    strip = np.sqrt(2.0 * weight / (FLAT * stiffness * turns))
    return ((0.5 * FLAT - strip / 3.0 - 0.5 * HEIGHT * turns) / (0.5 * HEIGHT)).max()


# Soft joints cost it a seventh, eight times as stiff ones half of that; rigid ones turn over at the corners.
block_on(friction=0.9, normalStiffness=1e8, shearStiffness=1e8, restitution=0.1)
weight = O.bodies[1].state.mass * 9.81
O.dt = potential_particles.critical_time_step()
O.run(int(0.6 / O.dt), wait=True)
before = state_numbers()
if O.numThreads == 1:
    found = potential_particles.factor_by_simulation("load", push=(1, 0, 0), tolerance=0.03, progress=False,
                                                       stiffnesses=(1, 8))
    for stiffness, (stands, falls) in found.brackets.items():
        expected = leaning(1e8 * stiffness)
        check.true(0.96 * expected < stands < expected < 1.02 * falls, f"leaning: {found} for {expected:.4f}")
    check.true(abs(found.factor - FLAT / HEIGHT) < found.uncertainty < 0.03, f"of rigid joints: {found}")
    check.equal(state_numbers(), before, "with other stiffnesses, too, the scene is as it was")

# Ctrl-C in the third run: what is known by then.
simulated_run, answers = potential_particles.simulated._run, iter(("stands", "falls"))


def interrupted(*_):
    said = next(answers, None)
    if said is None:
        raise KeyboardInterrupt
    return said, 0.0


potential_particles.simulated._run = interrupted
found = potential_particles.factor_by_simulation("load", push=(1, 0, 0), first=0.4, progress=False, stiffnesses=(1, 8))
potential_particles.simulated._run = simulated_run
check.true(found.stands < 0.4 < found.falls and len(found.runs) == 2 and math.isnan(found.factor), f"Ctrl-C: {found}")
check.equal(state_numbers(), before, "Ctrl-C: the scene is as it was")

# What has no answer is refused by name.
for change, text in (
    (lambda: limit_analysis("falls"), "'falls' is unknown"), (lambda: limit_analysis("load"), "live load"),
    (lambda: limit_analysis(loads={7: ((1, 0, 0), (0, 0, 0))}), "names body 7"),
    (lambda: limit_analysis(loads={0: ((1, 0, 0), (0, 0, 0))}), "names body 0"),
    (lambda: limit_analysis(push=(1, math.nan, 0)), "push"), (lambda: limit_analysis("strength"), "however small")):
    block_on()
    check.raises(ValueError, change, f"refused: {text}", text)
block_on()
O.bodies[1].state.vel = (1, 0, 0)
check.raises(ValueError, limit_analysis, "in motion", "body 1 moves at 1 m/s")
block_on()
O.bodies[1].state.blockedDOFs = "y"
check.raises(ValueError, limit_analysis, "blocked in part", "blockedDOFs='y'")
block_on()
O.bodies.append(potential_particles.body(shapes.cuboid((1, 1, 1), r=ROUNDING, k=0), position=(0, 0, 9)))
check.raises(ValueError, limit_analysis, "in the air", "body 2 is free and touches nothing")
block_on()
O.bodies[0].state.blockedDOFs = ""
check.raises(ValueError, limit_analysis, "no support", "no body is held")
O.reset()
check.raises(ValueError, limit_analysis, "an empty scene", "has no contacts")

check.finish()
