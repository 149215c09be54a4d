# SPDX-License-Identifier: GPL-3.0-or-later
"""The largest time step with which contacts act as springs and not as explosions.

Leapfrog is stable for dt < 2/omega, omega the highest circular frequency. A contact with stiffness K_c (3, 3) moves body b at the arm
x by B u, u = (displacement, turn), B = [1, -x cross]. Since |B_1 u_1 - B_2 u_2|^2 <= 2 |B_1 u_1|^2 + 2 |B_2 u_2|^2, the
stiffness of all contacts is at most twice that of each body alone, held by its own contacts, and with M_b of mass and inertia

    omega^2 <= 2 max over bodies of the largest eigenvalue of M_b^-1 sum over its contacts B^T K_c B.

A contact patch holds against turning as well: its stiffness has a part for turns alone, K J across the normal and k_s J about it, J the
polar moment of the patch or, where there is one, of the bond.

Dashpots lower the limit. Those of joints, of the ratio z to the critical one, to dt < 2/omega (sqrt(1 + z^2) - z), which is taken into
account; for others safety leaves room, below about half of the critical damping.
"""
import math

import numpy as np

from .arguments import number, positive, whole


def critical_time_step(stiffness=None, bodies=None, contacts=3, safety=0.5):
    """A time step, s, safe for the contacts that there are, and for `contacts` new ones at the farthest point of each body.

    stiffness: of a contact, N/m; None: from the scene's physics functor. For KnKsPhys that is Knormal, times the area of the body's largest
    circle where the contact functor computes areas (calContactArea); for laws with springs from E and radii (FrictPhys), young times
    the bounding radius; for ConicJointMat its stiffness per area times the area of the largest circle. bodies: ids, default all. safety: share of the proved limit that is used, 0 to 1.
    ValueError where nothing moves or no stiffness is known.
    """
    import yade
    scene = yade.O
    contacts, safety = whole(contacts, 1, "contacts"), positive(safety, "safety")
    if safety > 1.0:
        raise ValueError(f"safety={safety:g} is a share of the limit and must lie between 0 and 1")
    stiffness = None if stiffness is None else positive(stiffness, "stiffness")
    chosen = [body for body in _chosen(scene, bodies) if _moves(body)]
    if not chosen:
        raise ValueError("no body with a shape and a mass is free to move: there is no time step to find")
    rule = stiffness_rule(scene, stiffness)
    largest, damping = 0.0, 0.0
    for body in chosen:
        damping = max(damping, _damping_ratio(getattr(body.mat, "restitution", 1.0)))
        present = _eigenvalue(body, [_of_contact(scene, body, one) for one in body.intrs() if one.isReal])
        mass, inertia, radius = body.state.mass, min(body.state.inertia), bounding_radius(body)
        assumed = contacts * rule(body, radius) * (1.0 / mass + radius**2 / inertia)
        largest = max(largest, present, assumed)
    return safety * 2.0 / math.sqrt(2.0 * largest) * (math.hypot(1.0, damping) - damping)


def _damping_ratio(restitution):
    """At least that of a joint with this restitution e: e < exp(-2 z) up to z = 1, and 1/(4 z^2) < e < 1/(2 z^2) beyond."""
    return 0.0 if restitution >= 1.0 else max(-0.5 * math.log(restitution), math.sqrt(0.5 / restitution) if restitution < 0.14 else 0.0)


def _chosen(scene, bodies):
    return scene.bodies if bodies is None else [scene.bodies[int(one)] for one in bodies]


def _moves(body):
    return (body is not None and body.shape is not None and body.state.mass > 0.0 and min(body.state.inertia) > 0.0
            and set(body.state.blockedDOFs) != set("xyzXYZ"))


def bounding_radius(body):
    """Radius about the centre within which all of the body lies."""
    shape = body.shape
    for name in ("boundingRadius", "radius"):
        if hasattr(shape, name):
            return getattr(shape, name)
    # A plain potential particle lies within the sphere R/sqrt(k), or nothing is known.
    if getattr(shape, "k", 0.0) > 0.0:
        return shape.R / math.sqrt(shape.k)
    raise ValueError(f"body {body.id} is a {type(shape).__name__} of unknown extent: use ConicPotentialParticle, or name other bodies")


def stiffness_rule(scene, stiffness=None):
    """Stiffness of a new contact of a body, N/m, as a function of body and bounding radius."""
    if stiffness is not None:
        return lambda body, radius: stiffness
    loop = next((one for one in scene.engines if hasattr(one, "physDispatcher")), None)
    functor = loop.physDispatcher.functors[0] if loop and loop.physDispatcher.functors else None
    knormal = getattr(functor, "Knormal", None)
    if knormal is not None and number(knormal, "Knormal") > 0.0:
        with_area = any(getattr(one, "calContactArea", False) for one in loop.geomDispatcher.functors)
        return lambda body, radius: knormal * (math.pi * radius**2 if with_area else 1.0)
    if type(functor).__name__ == "Ip2_ConicJointMat_ConicJointMat_ConicJointPhys":
        return lambda body, radius: _joint_stiffness(body, radius) * math.pi * radius**2
    if functor is not None and type(functor).__name__.startswith("Ip2_FrictMat_FrictMat_"):
        return lambda body, radius: positive(body.mat.young, f"young of the material of body {body.id}") * radius
    raise ValueError("the scene has no physics functor with a known stiffness: set O.engines first, or give stiffness in N/m")


def _joint_stiffness(body, radius):
    """Per area, N/m^3, the largest that a joint of this body can have: twice its own, if its neighbour is rigid."""
    material = body.mat
    return 2.0 * (getattr(material, "normalStiffness", 0.0)
                  or positive(material.young, f"young of the material of body {body.id}") / (2.0 * radius))


def _of_contact(scene, body, contact):
    """Arm (3,), stiffness against displacement there (3, 3) and against turns alone (3, 3) of a real contact, world axes."""
    kn, ks = contact.phys.kn, contact.phys.ks
    bonded = getattr(contact.phys, "bondArea", 0.0) > 0.0
    if bonded:
        # The contact of a bond may lie elsewhere: where the bodies overlap now.
        one = scene.bodies[contact.id1].state
        normal = np.array((one.ori * contact.phys.bondTurn1).toRotationMatrix().col(0))
        point, polar_moment = one.pos + one.ori * contact.phys.bondPoint1, contact.phys.bondMoments[0]
    else:
        normal, point, polar_moment = np.array(contact.geom.normal), contact.geom.contactPoint, getattr(contact.geom, "polarMoment", 0.0)
    along = np.outer(normal, normal)
    arm = np.array(point - body.state.pos)
    if scene.periodic and contact.id2 == body.id:
        arm = arm - np.array(scene.cell.hSize * contact.cellDist)
    turning = np.zeros((3, 3))
    if hasattr(contact.phys, "twistStiffness"):
        turning = (contact.phys.normalStiffness * polar_moment * (np.eye(3) - along)
                   + contact.phys.twistStiffness * along)
    return arm, kn * along + ks * (np.eye(3) - along), turning


def _eigenvalue(body, contacts):
    """Largest eigenvalue of M^-1 sum B^T K B, 1/s^2, about the centre of the body in its principal axes."""
    if not contacts:
        return 0.0
    turn = body.state.ori.toRotationMatrix()
    turn = np.array([[turn[i, j] for j in range(3)] for i in range(3)])
    whole_stiffness = np.zeros((6, 6))
    for arm, stiffness, turning in contacts:
        x, y, z = turn.T @ arm
        moved = np.hstack([np.eye(3), [[0, z, -y], [-z, 0, x], [y, -x, 0]]])
        whole_stiffness += moved.T @ (turn.T @ stiffness @ turn) @ moved
        whole_stiffness[3:, 3:] += turn.T @ turning @ turn
    scale = 1.0 / np.sqrt([body.state.mass] * 3 + list(body.state.inertia))
    return float(np.linalg.eigvalsh(scale[:, None] * whole_stiffness * scale)[-1])
