# SPDX-License-Identifier: MIT OR Apache-2.0
"""At which friction angle does a wedge slide on two joints? Simulation B of Boon, Houlsby & Utili. Run it inside YADE:

    yade -x -n -j1 examples/wedge.py          (LAW=joint in the environment: with contact patches)

The wedge slides at two friction angles below the critical one. Its acceleration is linear in tan(friction angle), so
that the line through both tells where it is zero. studies/wedge.py lowers friction under a resting wedge instead, for
19 wedges. SI units, angles in degrees; x east, y north, z up; the toe of the wedge is the origin.
"""
import os

import numpy as np
import potential_particles
from potential_particles import shapes
from yade import *

JOINT_A, JOINT_B, FACE = (40, 130), (60, 220), (70, 185)  # dip and dip direction
ANGLES = (27.0, 30.0)  # friction, at which it slides; far lower and it would tip forwards, too
GRAVITY = 9.81
JOINTS = potential_particles.joints.chosen()


def normal(plane):
    """Unit normal, upwards."""
    dip, bearing = np.radians(plane)
    return np.array([np.sin(dip) * np.sin(bearing), np.sin(dip) * np.cos(bearing), np.cos(dip)])


a, b, face, up = normal(JOINT_A), normal(JOINT_B), normal(FACE), np.array([0, 0, 1.0])
line = np.cross(a, b)
line *= -np.sign(line[2]) / np.linalg.norm(line)  # of intersection, downwards
# Balance across the line gives both normal forces, balance along it the friction angle (Hoek & Bray 1974).
forces = np.linalg.solve([[1, a @ b], [a @ b, 1]], [a[2], b[2]])
closed_form = np.degrees(np.arctan(-line[2] / forces.sum()))


def block(*sides):
    """The rock behind these half spaces (outward normal, offset), with edges rounded by a fiftieth of a metre."""
    return shapes.from_planes([(*outward, offset) for outward, offset in sides], rounding=0.02, k=0.0)


rock = [(face, 0), (up, 1), (-up, 1), (-line, 3), ((1, 0, 0), 3), ((-1, 0, 0), 3), ((0, 1, 0), 3)]
wedge = block((-a, 0), (-b, 0), (face, 0), (up, 1))
blocks = [block((a, 0), (-b, 0), *rock), block((-a, 0), (b, 0), *rock)]


def acceleration(friction_angle):
    """Of the wedge along the line, m/s^2, from a tenth to three tenths of its height on the way."""
    O.reset()
    O.materials.append(FrictMat(young=1e9, poisson=0.5, frictionAngle=np.radians(friction_angle), density=2600))
    O.bodies.append([potential_particles.body(wedge)] + [potential_particles.body(part, fixed=True) for part in blocks])
    state = O.bodies[0].state
    stiffness = MatchMaker(algo="val", val=state.mass * GRAVITY / 1e-4)  # its weight makes an overlap of 0.1 mm
    contacts = Ig2_ConicPP_ConicPP_ScGeom(flatRegularisation=1e-3)
    O.engines = [
        ForceResetter(),
        InsertionSortCollider([PotentialParticle2AABB()], verletDist=0),
        InteractionLoop([contacts], [Ip2_FrictMat_FrictMat_FrictPhys(kn=stiffness, ks=stiffness)],
                        [Law2_ScGeom_FrictPhys_CundallStrack(sphericalBodies=False)]),
        NewtonIntegrator(damping=0.3, gravity=(0, 0, -GRAVITY), exactAsphericalRot=True),
    ]
    if JOINTS:
        # The weight makes that overlap on a square metre.
        potential_particles.use_joints(normalStiffness=state.mass * GRAVITY / 1e-4,
                                       shearStiffness=state.mass * GRAVITY / 1e-4, restitution=0.5)
    O.dt = 1e-4
    looks = []
    begin = np.array(state.pos)
    while not looks or looks[-1][1] < 0.3:
        for _ in range(20):
            O.step()
        looks.append((O.time, line @ (np.array(state.pos) - begin), line @ np.array(state.vel)))
    if contacts.failures:
        raise SystemExit(f"{contacts.failures} contacts could not be found")
    time, way, speed = np.array(looks).T
    return np.polyfit(time[way > 0.1], speed[way > 0.1], 1)[0]


(one, other), tangents = [acceleration(angle) for angle in ANGLES], np.tan(np.radians(ANGLES))
found = np.degrees(np.arctan(tangents[0] + one * (tangents[1] - tangents[0]) / (one - other)))
print(f"slides below {found:.4f} degrees; closed form {closed_form:.4f}, paper 33.49, 3DEC 33.19")
