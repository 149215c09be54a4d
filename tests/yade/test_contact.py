# SPDX-License-Identifier: GPL-3.0-or-later
# Two bodies: sign of the normal, momentum, order, force=True, and other laws.
import math

import potential_particles
import yade
from harness import *

check = Checks()

# A bounce: no damping, so the bodies exchange their velocities.
for formulation in ("midway", "closest"):
    contacts = yade.Ig2_ConicPP_ConicPP_ScGeom(formulation=formulation)
    fresh_scene(contacts, dt=5e-5)
    lower, upper = add(cube(), Vector3(0, 0, 0)), add(cube(), Vector3(0.02, 0.01, 1.01), turned((0, 0, 1), 0.3))
    O.bodies[upper].state.vel = Vector3(0, 0, -1)
    before, energy = momentum(), utils.kineticEnergy()
    touched = deepest = 0
    for _ in range(200):
        run(10)
        for contact in O.interactions:
            touched += 1
            deepest = max(deepest, contact.geom.penetrationDepth)
            sense = 1 if contact.id1 == lower else -1
            check.true(sense * contact.geom.normal[2] > 0.99, f"normal from body 1 to 2: {contact.geom.normal}")
            check.true(sense * contact.phys.normalForce[2] >= 0, "positive force on body 2")
        if touched and not any(c.isReal for c in O.interactions):
            break
    check.true(touched > 3 and 0 < deepest < 0.03, f"they touched ({touched} times looked, deepest {deepest})")
    check.close(momentum(), before, 1e-9 * before.norm(), f"{formulation}: momentum")
    check.close(utils.kineticEnergy(), energy, 0.02 * energy, f"{formulation}: energy after the bounce")
    check.close(O.bodies[lower].state.vel[2], -1, 0.02, f"{formulation}: velocity handed over")
    check.equal((contacts.failures, contacts.failureReport), (0, []), f"{formulation}: failures")
    check.true(contacts.calls == contacts.solved + contacts.answers["carried"] + contacts.rejected,
               "every call counted once")

# The contact itself, against what is known of two cubes face to face.
fresh_scene(yade.Ig2_ConicPP_ConicPP_ScGeom(), dt=1e-9)
reach = cube().surfaceDistance([(0, 0, 1)])[0]
add(cube(), Vector3(0, 0, 0), fixed=True)
add(cube(), Vector3(0, 0, 2 * reach - 0.01), fixed=True)
O.step()
O.step()
contact = O.interactions[0, 1]
check.close(contact.geom.normal, Vector3(0, 0, 1), 1e-6, "normal between two faces")
check.close(contact.geom.penetrationDepth, 0.01, 1e-6, "overlap of two faces")
check.close(contact.geom.contactPoint, Vector3(0, 0, reach - 0.005), 1e-5, "contact point between two faces")
check.close(contact.phys.ptOnP1, Vector3(0, 0, reach), 1e-5, "point on body 1")
check.close(contact.phys.ptOnP2, Vector3(0, 0, reach - 0.01), 1e-5, "point on body 2")
check.close((contact.geom.refR1 - cube().boundingRadius), 0, 1e-12, "reference radius")
check.true(0.6 < contact.phys.contactArea < 1.02, f"contact area of two faces of size 1: {contact.phys.contactArea}")

# Order of the bodies: the same contact, seen from the other side. force=True without contact.
def forced(first, second, gap):
    fresh_scene(yade.Ig2_ConicPP_ConicPP_ScGeom(), dt=1e-9)
    add(cube(), Vector3(0, 0, 0), fixed=True)
    add(pyramid(), Vector3(0.1, 0.05, 0.7 + gap), turned((1, 2, 0), 0.4), fixed=True)
    return utils.createInteraction(first, second)


one, other = forced(0, 1, -0.1), forced(1, 0, -0.1)
check.true(one.isReal and one.geom.penetrationDepth > 0, f"createInteraction: overlap {one.geom.penetrationDepth}")
check.equal((other.id1, other.id2), (1, 0), "order as asked")
check.close(other.geom.normal, -one.geom.normal, 1e-6, "swapped normal")
check.close(other.geom.contactPoint, one.geom.contactPoint, 1e-6, "swapped contact point")
check.close(other.geom.penetrationDepth, one.geom.penetrationDepth, 1e-7, "swapped overlap")
for first, second, sense in [(0, 1, 1), (1, 0, -1)]:
    contact = forced(first, second, 2.0)
    check.true(contact.isReal and contact.geom.penetrationDepth < 0, "createInteraction without contact")
    check.close(contact.geom.normal.norm(), 1, 1e-12, "a unit normal all the same")
    check.true(sense * contact.geom.normal[2] > 0.9, "that points from 1 to 2")
    check.true(all(math.isfinite(x) for x in contact.geom.contactPoint), "and a finite point")
    run(3)
    check.equal(len([i for i in O.interactions if i.isReal]), 0, "the law ends it")

# A law that keeps contacts that opened, with a zeroed normal: they close again like new ones.
contacts = yade.Ig2_ConicPP_ConicPP_ScGeom()
fresh_scene(contacts, law=yade.Law2_SCG_KnKsPhys_KnKsLaw(neverErase=True), dt=1e-9)
add(cube(), Vector3(0, 0, 0), fixed=True)
add(cube(), Vector3(0, 0, 0.99), fixed=True)
depths = []
for z in (0.99, 1.01, 1.01, 0.99, 0.99):
    O.bodies[1].state.pos = Vector3(0, 0, z)
    O.step()
    depths.append(O.interactions[0, 1].geom.penetrationDepth)
    check.true(O.interactions[0, 1].isReal, "a contact that is never erased")
check.true(depths[1] < 0 and depths[2] < 0 < depths[0], f"opened and closed: {depths}")
check.close(depths[3], depths[0], 1e-9, "closed as deep as before")
check.close(O.interactions[0, 1].geom.normal, Vector3(0, 0, 1), 1e-6, "normal after closing")

# A law with physics of its own: elastic spheres' law, told to use the true lever arms.
contacts = yade.Ig2_ConicPP_ConicPP_ScGeom()
fresh_scene(contacts, physics=yade.Ip2_FrictMat_FrictMat_FrictPhys(),
            law=yade.Law2_ScGeom_FrictPhys_CundallStrack(sphericalBodies=False), dt=2e-5)
add(cube(), Vector3(0, 0, 0))
add(pyramid(), Vector3(0.1, 0.05, 1.2), turned((1, 2, 0), 0.4))
O.bodies[1].state.vel = Vector3(0, 0, -1)
before, energy = momentum(), utils.kineticEnergy()
spin = lambda: sum((b.state.pos.cross(b.state.mass * b.state.vel) + b.state.angMom for b in O.bodies), Vector3.Zero)
spin_before = spin()
kn = 0
for _ in range(400):
    run(50)
    kn = max([kn] + [c.phys.kn for c in O.interactions if c.isReal])
    if kn and not any(c.isReal for c in O.interactions):
        break
check.true(kn > 1e4, f"stiffness from bounding radii: {kn}")
check.close(momentum(), before, 1e-9 * before.norm(), "FrictPhys: momentum")
check.close(spin(), spin_before, 1e-3 * before.norm(), "FrictPhys: angular momentum")
check.close(utils.kineticEnergy(), energy, 0.03 * energy, "FrictPhys: energy")
check.true(not any(c.isReal for c in O.interactions), "FrictPhys: they part")
check.true(O.bodies[0].state.vel[2] < 0, f"FrictPhys: body 1 was pushed down: {O.bodies[0].state.vel}")
check.equal(contacts.failures, 0, "FrictPhys: failures")

check.finish()
