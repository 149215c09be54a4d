# SPDX-License-Identifier: GPL-3.0-or-later
# YADE's Polyhedra in place: what stays of a body, its volume by YADE's own, and contacts where the faces were.
import warnings

import numpy as np
import potential_particles
import yade
from harness import *

check = Checks()
if not hasattr(yade.wrapper, "Polyhedra"):
    check.true(True, "this YADE has no Polyhedra")
    check.finish()
from yade import polyhedra_utils

O.reset()
stone = O.materials.append(yade.PolyhedraMat(young=1e7, poisson=0.3, frictionAngle=0.5, density=2600, label="stone"))
rocks = [polyhedra_utils.polyhedra(O.materials[stone], size=(1, 0.8, 0.7), seed=seed) for seed in (3, 4)]
cubes = [polyhedra_utils.polyhedra(O.materials[stone], v=[(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)])
         for _ in range(2)]
for i, body in enumerate(rocks):
    body.state.pos, body.state.vel, body.state.angVel = (4 * i, 9, 1), (i, 2, 3), (0.1, 0.2, 0.3)
    body.shape.color = (0.1 * i, 0.5, 0.6)
    body.mask = i + 1
cubes[0].state.pos, cubes[1].state.pos = (0, 0, 0), (0.3, 0.2, 1.99)
cubes[0].state.blockedDOFs = "xyzXYZ"
sphere = utils.sphere((50, 0, 0), 1, material=stone)
O.bodies.append(rocks + cubes + [sphere])
O.engines = [
    yade.ForceResetter(),
    yade.InsertionSortCollider([yade.Bo1_Polyhedra_Aabb(), yade.Bo1_Sphere_Aabb()], verletDist=0),
    yade.InteractionLoop([yade.Ig2_Polyhedra_Polyhedra_PolyhedraGeom()],
                         [yade.Ip2_PolyhedraMat_PolyhedraMat_PolyhedraPhys()],
                         [yade.Law2_PolyhedraGeom_PolyhedraPhys_Volumetric()])
]
O.dt = 1e-9
O.step()
check.equal(O.interactions.countReal(), 1, "the cubes touch as Polyhedra")


def kept(body):
    """What must be the same before and after."""
    state = body.state
    return (body.id, state.mass, state.inertia, state.pos, state.ori, state.vel, state.angVel, state.blockedDOFs,
            body.mat.label, body.mask, body.shape.color)


four = [O.bodies[i] for i in range(4)]
before = [kept(body) for body in four]
volumes = [body.shape.GetVolume() for body in four]
corners = [np.array([body.state.pos + body.state.ori * one for one in body.shape.v]) for body in four]
with warnings.catch_warnings(record=True) as told:
    warnings.simplefilter("always")
    ids = potential_particles.replace_polyhedra()
check.equal(ids, [0, 1, 2, 3], "the bodies that were replaced")
check.equal([kept(O.bodies[i]) for i in ids], before, "state, material, mask and colour stay")
check.equal(type(sphere.shape).__name__, "Sphere", "other bodies stay")
check.true("replaced 4 Polyhedra: rounding took" in str(told[0].message), f"it is said: {told[0].message}")
for i, volume, points in zip(ids, volumes, corners):
    shape, state = O.bodies[i].shape, O.bodies[i].state
    check.equal(type(shape).__name__, "ConicPotentialParticle", "class of the shape")
    lost = 1 - shape.volume / volume
    check.true(0 < lost <= 0.0101, f"volume lost of body {i}: {lost}")
    planes = np.array([tuple(plane) for plane in shape.planes])
    particle = potential_particles.Particle(planes, shape.r, shape.k, shape.R)
    local = (points - np.array(state.pos)) @ np.array(state.ori.toRotationMatrix())
    # Nothing lies outside, and the larger faces, which come first, are touched.
    surface = particle.mesh(1e-3).vertices
    off = [(surface @ plane[:3]).max() - (local @ plane[:3]).max() for plane in particle.planes]
    check.true(max(off) <= 1e-9 and min(off[:6]) > -0.05 * shape.r, f"faces of body {i} are off by {off}")
check.equal(O.interactions.countReal(), 0, "their contacts are out")
O.engines = [
    yade.ForceResetter(),
    yade.InsertionSortCollider([yade.PotentialParticle2AABB(), yade.Bo1_Sphere_Aabb()], verletDist=0),
    yade.InteractionLoop([yade.Ig2_ConicPP_ConicPP_ScGeom()], [yade.Ip2_FrictMat_FrictMat_FrictPhys()],
                         [yade.Law2_ScGeom_FrictPhys_CundallStrack(sphericalBodies=False)])
]
O.step()
check.close(O.interactions[2, 3].geom.penetrationDepth, 0.01, 1e-3, "overlap of the cubes, whose faces have not moved")
check.close(abs(O.interactions[2, 3].geom.normal[2]), 1.0, 1e-6, "its normal")
found = [one for one in potential_particles.check() if "the mass is not" in str(one)]
check.equal(found, [], "check() has nothing to say of mass")
check.equal(potential_particles.replace_polyhedra(), [], "and there are no more of them")
check.finish()
