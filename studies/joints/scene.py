# SPDX-License-Identifier: GPL-3.0-or-later
"""Scenes of blocks with the law of joints, or with YADE's law at one point a contact."""
import os

import yade
from stepping import advance
from yade import Body, Omega, Quaternion, Vector3, utils

O = Omega()
# Of patches, where a row asks for no other.
TOLERANCE = float(os.environ.get("TOLERANCE") or 1e-4)


def block_shape(size, r=0.005, k=0.0):
    """A cuboid of these edge lengths, rounded by r, with a shadow sphere around it."""
    halves = [0.5 * length - r for length in size]
    planes = [(*(sign * (i == axis) for i in range(3)), halves[axis]) for axis in range(3) for sign in (1, -1)]
    return yade.ConicPotentialParticle(planes=planes, r=r, k=k, R=1.2 * Vector3(*size).norm() / 2)


def fresh(patch=True, gravity=(0, 0, -9.81), damping=0.0, track=False, tolerance=TOLERANCE, **material):
    """Empties the scene; with patch=False the law is YADE's of springs at a point, of the same material."""
    O.reset()
    if patch:
        O.materials.append(yade.ConicJointMat(density=2000.0, **material))
        laws = [yade.Ip2_ConicJointMat_ConicJointMat_ConicJointPhys()], [yade.Law2_ScGeomConicPP_ConicJointPhys()]
    else:
        O.materials.append(
            yade.FrictMat(density=2000.0, young=material["young"], poisson=0.3,
                          frictionAngle=material["frictionAngle"]))
        laws = [yade.Ip2_FrictMat_FrictMat_FrictPhys()
                ], [yade.Law2_ScGeom_FrictPhys_CundallStrack(sphericalBodies=False)]
    kinds = (yade.Ig2_ConicPP_ConicPP_ScGeom, yade.Ig2_Wall_ConicPP_ScGeom, yade.Ig2_Facet_ConicPP_ScGeom)
    O.engines = [
        yade.ForceResetter(),
        yade.BoundWatch(),
        yade.InsertionSortCollider(
            [yade.Bo1_ConicPP_Aabb(), yade.Bo1_Wall_Aabb(),
             yade.Bo1_Facet_Aabb()], verletDist=0.005),
        yade.ConicInteractionLoop([kind(patch=patch, patchTolerance=tolerance) for kind in kinds], *laws),
        yade.NewtonIntegrator(damping=damping, exactAsphericalRot=True, gravity=gravity),
    ]
    O.trackEnergy = track


def add(shape, position, orientation=Quaternion.Identity, fixed=False):
    """The body of a shape, with the mass and inertia of the shape."""
    body = Body()
    body.shape = shape
    body.aspherical = True
    volume, moments = shape.volume, shape.inertia.diagonal()  # each takes milliseconds
    utils._commonBodySetup(body, volume, moments, material=-1, pos=Vector3(position), fixed=fixed)
    body.state.mass, body.state.inertia = volume * 2000.0, moments * 2000.0
    body.state.pos, body.state.ori = Vector3(position), orientation
    return O.bodies[O.bodies.append(body)]


def wall(position, axis, sense):
    return O.bodies[O.bodies.append(utils.wall(position, axis=axis, sense=sense))]


def spun(body, spin):
    """Sets a spin, world axes, of a body in its principal axes."""
    body.state.angVel = spin
    local = body.state.ori.conjugate() * spin
    body.state.angMom = body.state.ori * Vector3(*(local[i] * body.state.inertia[i] for i in range(3)))


def kinetic_energy(bodies):
    total = 0.0
    for body in bodies:
        state, spin = body.state, body.state.ori.conjugate() * body.state.angVel
        total += 0.5 * (state.mass * state.vel.squaredNorm() + sum(state.inertia[i] * spin[i]**2 for i in range(3)))
    return total


def run(seconds):
    """Runs for a time, and returns how long that took."""
    return advance(O.iter + max(1, round(seconds / O.dt)))


def moving():
    return [body for body in O.bodies if body.state.mass > 0 and body.state.blockedDOFs != "xyzXYZ"]


def fastest():
    return max(max(body.state.vel.norm(), body.state.angVel.norm() * body.shape.boundingRadius) for body in moving())
