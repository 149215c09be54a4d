# SPDX-License-Identifier: GPL-3.0-or-later
# YADE's laws that hold bodies together, with interactionDistance and rotations: gaps, tension, moments and their limits
# against closed forms, momentum.
import numpy as np
import potential_particles
import yade
from harness import *
from potential_particles import body, shapes

check = Checks()
ROCK, CUBE = shapes.random_rock(1, size=1), shapes.cuboid((1, 1, 1))


def bonded(shape=CUBE, place=(0, 0, -0.999), adhesion=1e5, gravity=(0, 0, -9.81), damping=0.5, turn=(1, 0, 0, 0),
           distance=0.0, fixed=True):
    """Two bodies with YADE's law of cohesion and moments, the first fixed; the contact, if there is one."""
    O.reset()
    O.materials.append(
        yade.CohFrictMat(young=1e7, poisson=0.3, frictionAngle=0.5, density=2000.0, isCohesive=True,
                         normalCohesion=adhesion, shearCohesion=adhesion, momentRotationLaw=True, alphaKr=0.5,
                         alphaKtw=0.5, etaRoll=-1, etaTwist=-1))
    O.engines = [
        yade.ForceResetter(), yade.InsertionSortCollider([yade.PotentialParticle2AABB()], verletDist=0.05),
        yade.InteractionLoop([yade.Ig2_ConicPP_ConicPP_ScGeom(rotations=True, interactionDistance=distance)],
                             [yade.Ip2_CohFrictMat_CohFrictMat_CohFrictPhys(setCohesionNow=True)],
                             [yade.Law2_ScGeom6D_CohFrictPhys_CohesionMoment(useIncrementalForm=False)]),
        yade.NewtonIntegrator(damping=damping, gravity=gravity, exactAsphericalRot=True)]
    O.bodies.append([body(shape, fixed=fixed), body(shape, position=place, orientation=turn)])
    O.dt = 4e-5
    run(2)
    return contact()


def contact():
    return next((one for one in O.interactions if one.isReal), None)


def angular_momentum():
    total = Vector3.Zero
    for state in (one.state for one in O.bodies):
        local = state.ori.conjugate() * state.angVel
        total += state.ori * Vector3(*(i * w
                                       for i, w in zip(state.inertia, local))) + state.mass * state.pos.cross(state.vel)
    return total


# A cube hangs from another: the gap is weight over stiffness.
one = bonded()
check.true(isinstance(one.geom, yade.ScGeom6D), f"the geometry is that of YADE's laws with moments: {one.geom}")
kn, weight = one.phys.kn, O.bodies[1].state.mass * 9.81
run(40000)
one = contact()
check.close(-one.geom.penetrationDepth / (weight / kn), 1.0, 1e-3, "the gap of a cube that hangs")
check.close(O.bodies[1].state.pos, Vector3(0, 0, -1 - weight / kn), 1e-3 * weight / kn, "where it hangs")
check.close(one.phys.normalForce[2] / weight, 1.0, 1e-3, "the force on it")
# The same after a file.
O.saveTmp("hanging")
run(50)
went_on = state_numbers()
O.loadTmp("hanging")
run(50)
check.close(max(abs(a - b) for a, b in zip(went_on, state_numbers())), 0.0, 1e-12, "a loaded run")
# What it bears: adhesion is cohesion times the square of the smaller radius.
radius = potential_particles.time_step.bounding_radius(O.bodies[1])
for share, holds in ((0.98, True), (1.02, False)):
    # Brought to its place slowly: by damping, and from where it hangs.
    bonded(place=(0, 0, -1 - weight / kn), adhesion=weight / share / radius**2, damping=0.9, distance=0.01)
    run(20000)
    check.equal(contact() is not None, holds, f"a weight of {share} of its strength")

# Moments: a torque on the lower one turns it by torque over stiffness, about the normal and across. (Balls: the contact
# of a face moves to the edge as it tilts, and bears a part.)
for axis, name, shape in ((2, "twist", CUBE), (0, "bending", shapes.sphere(0.5))):
    one = bonded(shape, gravity=(0, 0, 0))
    stiffness = one.phys.ktw if axis == 2 else one.phys.kr
    torque = 1e-3 * stiffness
    O.forces.setPermT(1, Vector3(*[torque if i == axis else 0.0 for i in range(3)]))
    run(40000)
    way = O.bodies[1].state.ori.toAxisAngle()
    found = contact().phys
    check.close(way[1] * stiffness / torque, 1.0, 1e-3, f"{name}: the angle")
    moment = found.moment_twist if axis == 2 else found.moment_bending
    check.close(moment.norm() / (stiffness * way[1]), 1.0, 1e-3, f"{name}: the moment")

# Two free rocks that turn about each other, held together: momentum and angular momentum.
place = Vector3(0, 0, -1.2)
bonded(ROCK, place, gravity=(0, 0, 0), damping=0.0, fixed=False)
while contact() is None and place[2] < -0.5:
    place += Vector3(0, 0, 0.002)
    one = bonded(ROCK, place, gravity=(0, 0, 0), damping=0.0, turn=(1, 0.1, 0.2, 0.3), fixed=False, adhesion=1e6)
check.true(contact() is not None, "two rocks touch")
for state, velocity, spin in zip((b.state for b in O.bodies), (Vector3(0.1, 0.05, 0.1), Vector3(0, 0, -0.1)),
                                 (Vector3(0, 0.2, 0), Vector3(0.1, 0, 0.3))):
    state.vel, state.angVel = velocity, spin
    state.angMom = state.ori * Vector3(*(i * w for i, w in zip(state.inertia, state.ori.conjugate() * spin)))
before, spinning = momentum(), angular_momentum()
depths = []
for _ in range(20):
    run(200)
    depths.append(contact().geom.penetrationDepth if contact() else 1.0)
check.true(contact() is not None and min(depths) < 0, f"they stay together, pulled at times: {min(depths)}")
check.close((momentum() - before).norm() / before.norm(), 0.0, 1e-12, "momentum")
check.close((angular_momentum() - spinning).norm() / spinning.norm(), 0.0, 1e-4, "angular momentum")

# An interaction distance: cubes that do not touch yet.
for gap, meets in ((0.004, True), (0.006, False)):
    one = bonded(place=(0, 0, -1 - gap), gravity=(0, 0, 0), distance=0.005, adhesion=1e7)
    check.equal(one is not None, meets, f"a gap of {gap}")
    if one:
        check.close(one.geom.penetrationDepth, -gap, 1e-4 * gap, "the gap is the depth below 0")
# Turned about two axes: along the normal of a face.
tilted = bonded(place=Vector3(0.1, 0.05, -1.004), gravity=(0, 0, 0), distance=0.02, adhesion=1e7, turn=(1, 0, 0, 0.3))
check.close(tilted.geom.penetrationDepth, -0.004, 1e-5, "a gap between turned faces")

# JCFpm holds tension with an interaction distance, too.
def joined(place, gravity):
    O.reset()
    O.materials.append(
        yade.JCFpmMat(young=1e7, poisson=0.3, frictionAngle=0.5, density=2000.0, tensileStrength=1e6, cohesion=1e6))
    O.engines = [
        yade.ForceResetter(), yade.InsertionSortCollider([yade.PotentialParticle2AABB()], verletDist=0.05),
        yade.InteractionLoop([yade.Ig2_ConicPP_ConicPP_ScGeom(interactionDistance=1e-6)],
                             [yade.Ip2_JCFpmMat_JCFpmMat_JCFpmPhys(cohesiveTresholdIteration=5)],
                             [yade.Law2_ScGeom_JCFpmPhys_JointedCohesiveFrictionalPM(recordCracks=False)]),
        yade.NewtonIntegrator(damping=0.5, gravity=gravity, exactAsphericalRot=True)]
    O.bodies.append([body(CUBE, fixed=True), body(CUBE, position=place)])
    O.dt = 4e-5


joined((0, 0, -0.9999), (0, 0, -9.81))
run(40000)
one, weight = contact(), O.bodies[1].state.mass * 9.81
check.true(one is not None and abs(one.phys.normalForce[2] / weight - 1) < 0.01,
           f"JCFpm in tension: {one and one.phys.normalForce}, {weight}")

for settings, words in ((dict(interactionDistance=-1), "interactionDistance"), (dict(
        patch=True, rotations=True), "patch"), (dict(patch=True, interactionDistance=0.1), "patch")):
    check.raises(ValueError, lambda: yade.Ig2_ConicPP_ConicPP_ScGeom(**settings), f"{settings}", words)

check.finish()
