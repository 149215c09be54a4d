# SPDX-License-Identifier: GPL-3.0-or-later
# The law of joints on a contact patch: stiffness of a face, friction against twist and slip, energy, restitution.
import math

from harness import *
import potential_particles
import yade

check = Checks()

STIFFNESS = 1e9  # per area, N/m^3
HALF, RADIUS, DENSITY = 0.5, 0.01, 2000.0
AREA = (2 * (HALF - RADIUS))**2  # of the flat part of a face


def scene(gravity=(0, 0, 0), damping=0.0, track=False, loop=yade.InteractionLoop, **material):
    O.reset()
    given = dict(normalStiffness=STIFFNESS, shearStiffness=STIFFNESS / 2, frictionAngle=math.atan(0.5), density=DENSITY)
    O.materials.append(yade.ConicJointMat(**{**given, **material}))
    O.engines = [
        yade.ForceResetter(),
        yade.InsertionSortCollider([yade.PotentialParticle2AABB(), yade.Bo1_Wall_Aabb(), yade.Bo1_Facet_Aabb()], verletDist=0.01),
        loop([yade.Ig2_ConicPP_ConicPP_ScGeom(patch=True), yade.Ig2_Wall_ConicPP_ScGeom(patch=True),
              yade.Ig2_Facet_ConicPP_ScGeom(patch=True)],
             [yade.Ip2_ConicJointMat_ConicJointMat_ConicJointPhys()],
             [yade.Law2_ScGeomConicPP_ConicJointPhys()]),
        yade.NewtonIntegrator(damping=damping, exactAsphericalRot=True, gravity=gravity),
    ]
    O.trackEnergy = track
    O.dt = 1e-5


def block(position, orientation=Quaternion.Identity, fixed=False, half=HALF, r=RADIUS, k=0.0):
    return O.bodies[add(cube(r=r, k=k, half=half), Vector3(position), orientation, fixed)]


def wall():
    return O.bodies[O.bodies.append(utils.wall((0, 0, 0), axis=2, sense=1))]


def force_on(body):
    return O.forces.f(body.id), O.forces.t(body.id)


# --- a face on a wall: N = K A overlap, M = K I tilt ---------------------------------------------------------

for overlap in (1e-5, 1e-6):
    scene()
    floor = wall()
    body = block((0, 0, HALF - overlap), fixed=True)
    O.step()
    force, torque = force_on(body)
    # The rounding adds to the face: a rim of the width sqrt(2 overlap r) whose depth falls to 0.
    check.true(0 <= force[2] / (STIFFNESS * AREA * overlap) - 1 < 10 * math.sqrt(overlap * RADIUS), f"N = K A overlap: {force}")
    check.close(torque, Vector3.Zero, 1e-9 * force[2], "no moment")
    check.close(Vector3(force[0], force[1], 0), Vector3.Zero, 1e-9 * force[2], "no force along the wall")
    contact = O.interactions[0, 1]
    check.close(contact.phys.normalForce, force, 1e-9 * force[2], "normalForce acts on body 2")

    straight = force[2]
    tilt = 0.1 * overlap / HALF
    body.state.ori = turned((0, 1, 0), tilt)
    O.step()
    force, torque = force_on(body)
    side = 2 * (HALF - RADIUS)
    check.true(abs(torque[1] / (-STIFFNESS * side**4 / 12 * tilt) - 1) < 20 * math.sqrt(overlap * RADIUS), f"M = K I tilt: {torque}")
    check.close(force[2], straight, 1e-4 * straight, "tilting does not change N")


check.finish()
