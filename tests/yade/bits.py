# SPDX-License-Identifier: GPL-3.0-or-later
"""Heaps under each law that ConicInteractionLoop knows; prints one line for each, which says all numbers of the run in
short.

Run by test_sums.py in processes of their own, since the number of threads is of a process: LOOP (the class of the
loop).
"""
import hashlib
import os
import random
import struct

import potential_particles
from mixed import *

STEPS, JOINT_STEPS = 160, 60  # contact patches take their time
loop_class = getattr(yade, os.environ["LOOP"])


def build(loop, physics, law, patch=False, spheres=False):
    """Cubes, pyramids and spheres fall on a floor of facets, a slab and a wall."""
    O.reset()
    if patch:
        O.materials.append(
            yade.ConicJointMat(normalStiffness=1e8, shearStiffness=5e7, frictionAngle=0.5, restitution=0.5,
                               density=2000))
    else:
        O.materials.append(yade.FrictMat(young=1e7, poisson=0.3, frictionAngle=0.5, density=2000.0))
    functors = contacts(calContactArea=False) if not patch else [
        yade.Ig2_ConicPP_ConicPP_ScGeom(patch=True),
        yade.Ig2_Wall_ConicPP_ScGeom(patch=True),
        yade.Ig2_Facet_ConicPP_ScGeom(patch=True)
    ]
    O.engines = [
        yade.ForceResetter(),
        yade.BoundWatch(),
        yade.InsertionSortCollider([yade.Bo1_PP_Aabb_Conic()] + bounds()[1:], verletDist=0.02, label="collider"),
        loop(functors + ([yade.Ig2_Sphere_Sphere_ScGeom()] if spheres else []), [physics], [law]),
        yade.NewtonIntegrator(damping=0.2, exactAsphericalRot=True, gravity=(0, 0, -9.81)),
    ]
    if loop is yade.InteractionLoop:
        O.engines[3].loopOnSortedInteractions = True
    O.dt = 1e-4
    facets([((-2, -2, 0), (2, -2, 0), (2, 2, 0)), ((-2, -2, 0), (2, 2, 0), (-2, 2, 0))])
    place(yade.Wall(axis=0, sense=1), Vector3(-1.3, 0, 0))
    if not patch:
        add(cube(half=0.2, R=0.36, isBoundary=True), Vector3(0.3, 0.1, 0.1), turned((1, 1, 0), 0.3), fixed=True)
    draw = random.Random(11)
    for i in range(12 if patch else 18):
        turn = turned([draw.random() for _ in range(3)], draw.uniform(0, 3))
        at = Vector3(0.7 * (i % 3) - 0.7, 0.7 * (i // 3 % 3) - 0.7, 0.5 + 0.65 * (i // 9))
        if spheres and i % 4 == 0:
            place(yade.Sphere(radius=0.25), at, turn, fixed=False, mass=60.0)
        elif i % 2:
            add(cube(half=0.25, R=0.42, r=0.03), at, turn)
        else:
            add(pyramid(size=0.4, R=0.6, r=0.03), at, turn)
        O.bodies[-1].state.vel = Vector3(draw.uniform(-4, 4), draw.uniform(-4, 4), -8)
    potential_particles.prepare()


def numbers():
    """Of all bodies, contacts and their physics."""
    taken = hashlib.sha256(struct.pack(f"{len(state_numbers())}d", *state_numbers()))
    touching = sorted((i for i in O.interactions if i.isReal), key=lambda i: (i.id1, i.id2))
    for i in touching:
        physics = i.phys.dict()
        if not all(isinstance(O.bodies[n].shape, yade.PotentialParticle) for n in (i.id1, i.id2)):
            # YADE's law reads isBoundary of every shape, also of those that have none.
            for name in "tensionBroken", "cohesionBroken":
                physics.pop(name, None)
        taken.update(
            repr((i.id1, i.id2, i.iterMadeReal, sorted(i.geom.dict().items()), sorted(physics.items()))).encode())
    return taken.hexdigest()[:24], len(touching)


def knks(**keywords):
    return yade.Ip2_FrictMat_FrictMat_KnKsPhys(kn_i=1e6, ks_i=5e5, Knormal=1e6, Kshear=5e5, viscousDamping=0.2,
                                               useFaceProperties=False, **keywords)


CASES = {
    "KnKs": lambda loop: build(loop, knks(), yade.Law2_SCG_KnKsPhys_KnKsLaw(allowViscousAttraction=False)),
    "KnKs, kept": lambda loop: build(loop, knks(), yade.Law2_SCG_KnKsPhys_KnKsLaw(neverErase=True, allowBreakage=True)),
    "Cundall": lambda loop: build(loop, *(one[0] for one in friction_physics()), spheres=True),
    "joint": lambda loop: build(loop, yade.Ip2_ConicJointMat_ConicJointMat_ConicJointPhys(),
                                yade.Law2_ScGeomConicPP_ConicJointPhys(), patch=True),
}
for name, case in CASES.items():
    case(loop_class)
    looks, most = [], 0
    for look in range(3):
        run((JOINT_STEPS if name == "joint" else STEPS) // 3)
        digest, touching = numbers()
        looks.append(digest)
        most = max(most, touching)
        if look == 0:
            O.bodies.erase(8)
            O.trackEnergy = True
            if name == "KnKs":
                for body in O.bodies:
                    body.material.frictionAngle = 0.3
                for contact in O.interactions:
                    if contact.isReal:
                        contact.phys.phi_b = 17.0
    O.trackEnergy = False
    failures = sum(f.failures for f in O.engines[3].geomDispatcher.functors if hasattr(f, "failures"))
    print(f"case|{name}|{O.numThreads}|{most}|{failures}|{' '.join(looks)}", flush=True)
