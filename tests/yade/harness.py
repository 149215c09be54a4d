# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks, and small scenes of potential particles, for the scripts in this folder."""
import math
import sys
import time
from pathlib import Path

import yade
from yade import Body, Omega, Quaternion, Vector3, utils

sys.path.append(str(Path(__file__).resolve().parents[1]))
from checks import Checks

O = Omega()


def turned(axis, angle):
    """Rotation by an angle about an axis of any length (Quaternion itself wants a unit axis)."""
    return Quaternion(Vector3(axis).normalized(), angle)


def cube_planes(half=0.5, r=0.05):
    """Planes of a rounded cube of half size about `half`."""
    return [(*n, half - r) for n in [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)]]


def pyramid_planes(size=0.5, r=0.05):
    """A five-plane pyramid about its centre."""
    slope = 1 / math.sqrt(2)
    sides = [(slope, 0, slope), (-slope, 0, slope), (0, slope, slope), (0, -slope, slope)]
    return [(*n, 0.6 * size - r) for n in sides] + [(0, 0, -1, 0.5 * size - r)]


def cube(r=0.05, k=0.05, R=0.9, half=0.5, **more):
    return yade.ConicPotentialParticle(planes=cube_planes(half, r), r=r, k=k, R=R, **more)


def pyramid(r=0.05, k=0.05, R=0.7, size=0.5, **more):
    return yade.ConicPotentialParticle(planes=pyramid_planes(size, r), r=r, k=k, R=R, **more)


def plain(planes, **more):
    """The same as YADE's own shape, with a box that its bounds functor can use."""
    a, b, c, d = map(list, zip(*planes))
    return yade.PotentialParticle(a=a, b=b, c=c, d=d, **more)


def add(shape, position, orientation=Quaternion.Identity, fixed=False, density=2000.0, volume=None, inertia=None):
    """Appends a body; mass and inertia of the shape itself where it knows them."""
    body = Body()
    body.shape = shape
    body.aspherical = True
    if volume is None:
        volume, inertia = shape.volume, shape.inertia.diagonal()
    utils._commonBodySetup(body, volume, inertia, material=-1, pos=position, fixed=fixed)
    body.state.mass = volume * density
    body.state.inertia = inertia * density
    body.state.pos, body.state.ori = position, orientation
    return O.bodies.append(body)


def fresh_scene(functor, physics=None, law=None, dt=1e-5, damping=0.0, gravity=(0, 0, 0), stiffness=1e7,
                friction=0.0, periodic=False):
    """Empties the scene and sets up YADE's usual engines around a contact functor."""
    O.reset()
    O.materials.append(yade.FrictMat(young=1e7, poisson=0.3, frictionAngle=friction, density=2000.0))
    O.periodic = periodic
    O.engines = [
        yade.ForceResetter(),
        yade.InsertionSortCollider([yade.PotentialParticle2AABB()], verletDist=0.01, allowBiggerThanPeriod=True),
        yade.InteractionLoop(
            [functor],
            [physics or yade.Ip2_FrictMat_FrictMat_KnKsPhys(
                kn_i=stiffness, ks_i=stiffness, Knormal=stiffness, Kshear=stiffness, viscousDamping=0.0,
                useFaceProperties=False)],
            [law or yade.Law2_SCG_KnKsPhys_KnKsLaw(neverErase=False)]),
        yade.NewtonIntegrator(damping=damping, exactAsphericalRot=True, gravity=gravity),
    ]
    O.dt = dt


def joint_scene(loop, material, damping, gravity, track, dt, **physics):
    """Engines of the law of joints; physics: attributes of its Ip2 functor."""
    O.materials.append(material)
    O.engines = [
        yade.ForceResetter(),
        yade.InsertionSortCollider(
            [yade.PotentialParticle2AABB(), yade.Bo1_Wall_Aabb(),
             yade.Bo1_Facet_Aabb()], verletDist=0.01),
        loop([
            yade.Ig2_ConicPP_ConicPP_ScGeom(patch=True),
            yade.Ig2_Wall_ConicPP_ScGeom(patch=True),
            yade.Ig2_Facet_ConicPP_ScGeom(patch=True)
        ], [yade.Ip2_ConicJointMat_ConicJointMat_ConicJointPhys(**physics)],
             [yade.Law2_ScGeomConicPP_ConicJointPhys()]),
        yade.NewtonIntegrator(damping=damping, exactAsphericalRot=True, gravity=gravity),
    ]
    O.trackEnergy = track
    O.dt = dt


def run(steps):
    """So many steps. O.run(steps, True) would look only every 40 ms whether they are done."""
    stop = O.iter + steps
    O.run(steps)
    while O.running:
        time.sleep(0.0005)
    if O.iter != stop:
        raise RuntimeError(f"YADE stopped at step {O.iter} of {stop}; its message stands above")


def halt():
    """Ends a run from another thread, after the step it is in. (YADE's O.pause() returns in the midst of that step.)"""
    while O.running:
        O.stopAtIter = O.iter + 1
        time.sleep(0.0005)


def engine_of(kind):
    """The first engine of a class in the present scene."""
    return next(engine for engine in O.engines if isinstance(engine, kind))


def functor():
    """The contact functor of the present scene (after O.load the script's own object is another)."""
    return engine_of(yade.InteractionLoop).geomDispatcher.functors[0]


def momentum():
    return sum((b.state.mass * b.state.vel for b in O.bodies), Vector3.Zero)


def state_numbers():
    """Everything that moves, as one list of numbers."""
    return [x for b in O.bodies for v in (b.state.pos, b.state.ori, b.state.vel, b.state.angVel) for x in v]
