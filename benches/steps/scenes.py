# SPDX-License-Identifier: MIT OR Apache-2.0
"""Rocks on a floor of facets, in a drum, out of a hopper, and compressed between walls, in YADE: boundaries, rocks and
engines.

A scene is settled once and kept, its shapes too, so that the packages of all commits go on from the same state. SI
units, z up.
"""
import dataclasses
import pickle

import numpy as np
import potential_particles
from potential_particles import shapes
from yade import (BoundWatch, Bo1_ConicPP_Aabb, Bo1_Facet_Aabb, Bo1_Wall_Aabb, ConicInteractionLoop, ForceResetter,
                  FrictMat, Ig2_ConicPP_ConicPP_ScGeom, Ig2_Facet_ConicPP_ScGeom, Ig2_Wall_ConicPP_ScGeom,
                  InsertionSortCollider, Ip2_FrictMat_FrictMat_FrictPhys, Law2_ScGeom_FrictPhys_CundallStrack,
                  NewtonIntegrator, O, RotationEngine, TranslationEngine, Vector3, utils)

DIAMETER = 0.045  # intermediate extent of a rock, m
BOUNDARY_MASK = 3  # bit 2 is the boundaries' own: no pairs of two of them
FIELDS = ("planes", "r", "k", "R", "volume", "inertia", "error", "centroid", "orientation", "bounding_radius")
FLOOR_CELL, FLOOR_WAVE = 0.02, 0.004  # legs of a facet, height of the floor's waves, m
DRUM_RADIUS, DRUM_LENGTH, DRUM_SPEED = 0.6, 0.6, 1.0  # m, rad/s
OUTLET, MOUTH, HOPPER = 0.15, 0.75, 0.9  # radii of the hopper and its height, m
BOX, LID, COMPRESSION = 0.6, 0.55, 0.4  # edge and first height of the lid, m; its speed, m/s


def facets(strips):
    """Bodies of the triangles between neighbouring rows of points; all rows of equal length."""
    triangles = [three for low, high in zip(strips, strips[1:]) for i in range(len(low) - 1)
                 for three in ((low[i], low[i + 1], high[i + 1]), (low[i], high[i + 1], high[i]))]
    bodies = [utils.facet([tuple(point) for point in three], fixed=True) for three in triangles]
    for body in bodies:
        body.mask = BOUNDARY_MASK
    return O.bodies.append(bodies)


def walls(places):
    return O.bodies.append([utils.wall(place, axis=axis, sense=sense) for place, axis, sense in places])


def floor(shift=0.0, cells=50):
    at = lambda i, j: (shift + i * FLOOR_CELL, j * FLOOR_CELL, FLOOR_WAVE * np.sin(40 * i * FLOOR_CELL) * np.cos(
        35 * j * FLOOR_CELL))
    return facets([[at(i, j) for j in range(cells + 1)] for i in range(cells + 1)])


def on_floor(settling):
    floor()
    return []


def on_floor_of_two(settling):
    """The same with 45,000 triangles elsewhere, which nobody touches."""
    floor()
    floor(shift=10.0, cells=150)
    return []


def in_drum(settling):
    circle = np.linspace(0, 2 * np.pi, 51)
    ids = facets([[(DRUM_RADIUS * np.cos(a), y, DRUM_RADIUS * np.sin(a)) for a in circle]
                  for y in np.linspace(0, DRUM_LENGTH, 11)])
    walls([(0, 1, 1), (DRUM_LENGTH, 1, -1)])
    return [
        RotationEngine(ids=ids, rotationAxis=(0, 1, 0), angularVelocity=DRUM_SPEED, rotateAroundZero=True,
                       zeroPoint=(0, 0, 0), label="mover")
    ]


def in_hopper(settling):
    circle, levels = np.linspace(0, 2 * np.pi, 73), np.linspace(0, 1, 37)
    radius = lambda level: OUTLET + (MOUTH - OUTLET) * level
    facets([[(radius(level) * np.cos(a), radius(level) * np.sin(a), HOPPER * level) for a in circle]
            for level in levels])
    if settling:
        walls([(0, 2, 1)])
    return []


def compressed(settling):
    *_, lid = walls([(side * 0.5 * BOX, axis, -side) for axis in (0, 1)
                     for side in (-1, 1)] + [(0, 2, 1), (LID, 2, -1)])
    return [TranslationEngine(ids=[lid], translationAxis=(0, 0, -1), velocity=COMPRESSION, label="mover")]


@dataclasses.dataclass
class Kind:
    boundaries: callable
    count: int  # rocks
    settling: int  # steps
    room: object  # lower and upper corner of the box in which rocks begin


KINDS = {
    "5,000 facets": Kind(on_floor, 256, 3000, ((0, 0, 0.03), (1, 1, 0.3))),
    "5,000 facets and 45,000 far off": Kind(on_floor_of_two, 256, 3000, ((0, 0, 0.03), (1, 1, 0.3))),
    "drum": Kind(in_drum, 2000, 8000, ((-0.42, 0, -0.42), (0.42, DRUM_LENGTH, 0.42))),
    "hopper": Kind(in_hopper, 1000, 15000, ((-0.4, -0.4, 0.55), (0.4, 0.4, 1.3))),
    "compression": Kind(compressed, 1000, 10000, ((-0.5 * BOX, -0.5 * BOX, 0), (0.5 * BOX, 0.5 * BOX, LID))),
}


def start(kind, rocks, settling):
    """Boundaries, engines and the rocks, from what states() has of them and the numbers of their shapes. Gives the
    rocks' ids.
    """
    O.materials.append(FrictMat(young=2e7, poisson=0.3, frictionAngle=np.radians(30), density=2650))
    movers = kind.boundaries(settling)
    for body, position, orientation in zip(O.bodies,
                                           *(rocks.get("boundaries", {}).get(part, ()) for part in ("pos", "ori"))):
        body.state.pos, body.state.ori = position, type(body.state.ori)(*orientation)
    functors = [Ig2_ConicPP_ConicPP_ScGeom(), Ig2_Facet_ConicPP_ScGeom(), Ig2_Wall_ConicPP_ScGeom()]
    O.engines = [
        ForceResetter(label="reset"),
        BoundWatch(label="watch"),
        InsertionSortCollider(
            [Bo1_ConicPP_Aabb(), Bo1_Facet_Aabb(), Bo1_Wall_Aabb()], verletDist=0.05 * DIAMETER,
            avoidSelfInteractionMask=2, label="collider"),
        ConicInteractionLoop(functors, [Ip2_FrictMat_FrictMat_FrictPhys()],
                             [Law2_ScGeom_FrictPhys_CundallStrack(sphericalBodies=False)], label="contacts"), *movers,
        NewtonIntegrator(damping=0.3, gravity=(0, 0, -9.81), exactAsphericalRot=True, label="motion")
    ]
    made = [shapes.Shape(**definition) for definition in rocks["shapes"]]
    ids = []
    for which, position, orientation, velocity, spin in zip(*(rocks[part]
                                                              for part in ("which", "pos", "ori", "vel", "angVel"))):
        body = potential_particles.body(made[which], velocity=velocity, angular_velocity=spin)
        body.state.pos, body.state.ori = position, type(body.state.ori)(*orientation)
        # YADE goes on from the angular momentum, which body() has for the orientation that it was given.
        inwards = body.state.ori.conjugate()
        body.state.angMom = body.state.ori * Vector3(*(i * w
                                                       for i, w in zip(body.state.inertia, inwards * Vector3(*spin))))
        ids.append(O.bodies.append(body))
    return ids


def settle(kind, path):
    """Makes the rocks and lets them come to where they are measured from."""
    from potential_particles import packing

    made = [shapes.random_rock(seed, size=DIAMETER, elongation=0.8, flatness=0.75) for seed in range(8)]
    placed = potential_particles.pack(packing.Box(*kind.room), made, number=kind.count, dense=True)
    O.materials.append(FrictMat(density=2650))
    bodies = [potential_particles.body(one.shape, position=one.position, orientation=one.orientation) for one in placed]
    rocks = states(bodies) | {"which": [made.index(one.shape) for one in placed],
                              "shapes": [{name: getattr(shape, name) for name in FIELDS} for shape in made]}
    O.reset()
    ids = start(kind, rocks, settling=True)
    O.dt = potential_particles.critical_time_step()
    O.run(kind.settling, True)
    rocks |= states([O.bodies[i] for i in ids
                     ]) | {"dt": O.dt, "boundaries": states([body for body in O.bodies if body.id < ids[0]])}
    path.write_bytes(pickle.dumps(rocks))
    O.reset()


def states(bodies):
    return {
        "pos": [tuple(b.state.pos) for b in bodies],
        "ori": [tuple(b.state.ori[i] for i in (3, 0, 1, 2)) for b in bodies],
        "vel": [tuple(b.state.vel) for b in bodies], "angVel": [tuple(b.state.angVel) for b in bodies]
    }
