# SPDX-License-Identifier: GPL-3.0-or-later
# The laws that take ScGeom, each against what is known in closed form, and what each needs of the functor.
import math

import potential_particles
import yade
from harness import *

check = Checks()


def pair(physics, law, gap=-0.01, material=None, speed=0.0, fixed=False, aside=0.0, dt=1e-6, **contact):
    """Two cubes, one above the other, the upper one coming down; face to face by `gap`."""
    fresh_scene(yade.Ig2_ConicPP_ConicPP_ScGeom(**contact), physics=physics, law=law, dt=dt)
    if material:
        O.materials.append(material)
    reach = cube().surfaceDistance([(0, 0, 1)])[0]
    for position in (Vector3.Zero, Vector3(aside, 0, 2 * reach + gap)):
        body = O.bodies[add(cube(), position, fixed=fixed)]
        body.mat = O.materials[-1]
        # Never turning, so that the bounce of two faces stays a bounce of two masses.
        if not fixed and not aside:
            body.state.blockedDOFs = "XYZ"
    O.bodies[1].state.vel = Vector3(0, 0, -speed)
    return functor()


def bounce(steps):
    """Steps until the two have met and parted."""
    touched = False
    for _ in range(steps // 50):
        run(50)
        touching = any(c.isReal for c in O.interactions)
        if touched and not touching:
            break
        touched = touched or touching
    check.true(touched and not touching, "they met and parted")


# The first step of a contact: physics do not exist when the functor runs. KnKsPhys then has no area yet, and the law
# gives no force; with physics that know no area the force is whole at once.
knks = lambda: (
    yade.Ip2_FrictMat_FrictMat_KnKsPhys(
        kn_i=1e8, ks_i=1e7, Knormal=1e8, Kshear=1e7, useFaceProperties=False, viscousDamping=0.0
    ),
    yade.Law2_SCG_KnKsPhys_KnKsLaw(),
)
frict = lambda: (yade.Ip2_FrictMat_FrictMat_FrictPhys(), yade.Law2_ScGeom_FrictPhys_CundallStrack(sphericalBodies=False)
                 )
fresh_scene(yade.Ig2_PP_PP_ScGeom_Conic(), *knks(), dt=1e-9)
for z in (0, 0.9):
    add(plain(cube_planes(0.5, 0.1), r=0.1, k=0.2, R=0.9), Vector3(0, 0, z), fixed=True, volume=1.0,
        inertia=Vector3(1, 1, 1))
forces, areas = [], []
for _ in range(3):
    O.step()
    forces.append(O.interactions[0, 1].phys.normalForce.norm())
    areas.append(O.interactions[0, 1].phys.contactArea)
check.true(areas[1] > 0.5 and areas[2] == areas[1], f"area from the second step on: {areas}")
check.true(forces[0] < 1e-9 * forces[1], f"next to no force in the first step: {forces}")
check.close(forces[1] / (1e8 * O.interactions[0, 1].geom.penetrationDepth * areas[1]), 1, 1e-9,
            "force in the second step")

# Areas are computed where physics have a place for them, in contact, when asked; never else.
for physics, law, contact, gap, areas in [
        (*knks(), {}, -0.01, 4), (*knks(), dict(calContactArea=False), -0.01, 0), (*knks(), {}, 0.005, 0),
        (*knks(), dict(twoDimension=True), -0.01, 4), (*frict(), {}, -0.01, 0)]:
    functor_ = pair(physics, law, gap, fixed=True, **contact)
    for _ in range(5):
        O.step()
    check.equal((functor_.calls, functor_.areas), (5, areas),
                f"{type(law).__name__}, {contact}, gap {gap}: calls and areas")

# Cundall and Strack: k_n from Young's moduli and radii, at once.
pair(*frict(), fixed=True)
O.step()
contact = O.interactions[0, 1]
check.true(contact.phys.kn > 0, f"stiffness {contact.phys.kn}")
check.close(contact.phys.normalForce.norm() / (contact.phys.kn * contact.geom.penetrationDepth), 1, 1e-12,
            "Cundall-Strack: force in the first step")

# Hertz and Mindlin: F = 4/3 E* sqrt(R*) u^1.5, with the bounding radii as the spheres'.
mindlin = lambda: (yade.Ip2_FrictMat_FrictMat_MindlinPhys(), yade.Law2_ScGeom_MindlinPhys_Mindlin())
pair(*mindlin(), fixed=True)
O.step()
contact = O.interactions[0, 1]
young = 1e7 / (1 - 0.3**2) / 2
expected = 4 / 3 * young * math.sqrt(cube().boundingRadius / 2) * contact.geom.penetrationDepth**1.5
check.close(contact.phys.normalForce.norm() / expected, 1, 1e-9, "Mindlin: force")
check.close(contact.phys.normalForce.normalized(), Vector3(0, 0, 1), 1e-6, "Mindlin: its direction")

# Mindlin: an elastic bounce hands the velocity over and keeps the energy.
pair(*mindlin(), gap=0.005, speed=1.0, dt=1e-5)
energy = utils.kineticEnergy()
bounce(40000)
check.close(utils.kineticEnergy() / energy, 1, 1e-4, "Mindlin: energy after a bounce")
check.close(O.bodies[0].state.vel, Vector3(0, 0, -1), 1e-4, "Mindlin: velocity handed over")

# Viscous springs: the law lets nothing attract, so a bounce ends when spring and dashpot balance
# (Schwager and Poeschel 2007), with a restitution above the nominal one.
for nominal in (0.3, 0.7, 1.0):
    pair(yade.Ip2_ViscElMat_ViscElMat_ViscElPhys(), yade.Law2_ScGeom_ViscElPhys_Basic(), gap=0.005, speed=1.0, dt=4e-6,
         material=yade.ViscElMat(tc=1e-2, en=nominal, et=1.0, frictionAngle=0.0, density=2000.0))
    before = momentum()
    bounce(20000)
    log = math.log(nominal)
    damping = -log / math.hypot(math.pi, log)
    root = math.sqrt(1 - damping**2)
    duration = math.pi - math.atan2(2 * damping * root, 1 - 2 * damping**2)
    expected = math.exp(-damping / root * duration)
    restitution = O.bodies[1].state.vel[2] - O.bodies[0].state.vel[2]
    check.close(restitution, expected, 2e-3, f"viscous, nominally {nominal}: restitution")
    check.close(momentum(), before, 1e-9 * before.norm(), f"viscous, nominally {nominal}: momentum")

# Off the centres and with friction, every law must keep momentum and angular momentum: its lever arms are
# those of the contact point. (Cundall and Strack: in test_contact.py.)
spin = lambda: sum((b.state.pos.cross(b.state.mass * b.state.vel) + b.state.angMom for b in O.bodies), Vector3.Zero)
for name, physics, law, material in [
        ("KnKs", *knks(), yade.FrictMat(young=1e7, poisson=0.3, frictionAngle=0.5, density=2000.0)),
        ("Mindlin", *mindlin(), yade.FrictMat(young=1e7, poisson=0.3, frictionAngle=0.5, density=2000.0)),
        ("viscous", yade.Ip2_ViscElMat_ViscElMat_ViscElPhys(), yade.Law2_ScGeom_ViscElPhys_Basic(),
         yade.ViscElMat(tc=1e-2, en=0.8, et=0.8, frictionAngle=0.5, density=2000.0))]:
    functor_ = pair(physics, law, gap=0.01, material=material, speed=1.0, aside=0.4, dt=1e-5)
    O.bodies[1].state.vel += Vector3(0.3, 0.2, 0)
    O.bodies[1].state.ori = turned((1, 2, 0), 0.05)
    before, about = momentum(), spin()
    bounce(20000)
    check.close(momentum(), before, 1e-9 * before.norm(), f"{name}: momentum of a skew bounce")
    check.close(spin(), about, 2e-3 * before.norm(), f"{name}: its angular momentum")
    check.true(O.bodies[0].state.angVel.norm() > 0.1, f"{name}: it sets them turning: {O.bodies[0].state.angVel}")
    check.equal(functor_.failures, 0, f"{name}: failures")

check.finish()
