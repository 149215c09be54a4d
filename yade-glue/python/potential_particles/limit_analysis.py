# SPDX-License-Identifier: GPL-3.0-or-later
"""Limit analysis of the scene as it stands: does it stand, how much more could it bear, how much weaker could its
joints be? On elastic joints (docs/equilibrium.md), without a step.
"""
import math

import numpy as np

from .arguments import vector
from .bodies import is_free, lasting, owner, size_of
from .limit_state import Body, asked, clipped, solved

# A face touches where its normal is within this angle of that of the contact, radians.
FLAT = 0.02
# A scene is at rest if its bodies are slower than this part of the speed of a fall by their own size.
SLOW = 0.01
# The least stiffness across a contact over that along its normal: without any nothing would hold bodies.
SOFT = 1e-6


def limit_analysis(question="stands", push=None, loads=None, dilatant=False):
    """Whether the bodies of the scene come to rest on their contacts as they are, loaded from nothing. No step is made.

    question: "stands"; "load", for the largest multiple of the live loads that can be borne; "strength", for the
    factor of safety on the tangents of friction angles and on cohesion. push: (3,), a live load of each body's weight
    in this direction, as an earthquake in shares of gravity. loads: {id: (force, torque)}, other live loads, torque
    about the centre. Of "stands" and "strength" push and loads are there once, as dead ones. dilatant=True: joints open
    as they slip, which gives the bound with its forces and mechanism.

    Dead loads are weights (NewtonIntegrator.gravity) and lasting forces (O.forces.setPermF). Bodies with all
    degrees of freedom blocked are held. Joints (ConicJointMat) have their cohesion and tensile strength as they stand:
    broken ones the residual values, unbonded ones no tension.

    Returns an Equilibrium. ValueError: an unknown question, a scene without contacts, in motion or periodic, bodies
    that are blocked in part or touch nothing, overlaps beyond the rounding radius, or a factor that is infinite.
    RuntimeError: no answer was found; the scene may stand or fall.
    """
    import yade
    asked(question)
    if yade.O.periodic:
        raise ValueError("limit analysis has no periodic cells: hold bodies at the borders in their place")
    gravity = gravity_of(yade.O.engines)
    free = {one.id for one in map(owner, yade.O.bodies) if is_free(one)}
    live = {int(body): load for body, load in (loads or {}).items()}
    if unknown := [body for body in live if body not in free]:
        raise ValueError(f"loads names body {unknown[0]}: no body of this id, or clump of such bodies, is free")
    direction = vector((0, 0, 0) if push is None else push, "push")
    found = [_polygon(contact) for contact in yade.O.interactions if contact.isReal]
    if not found:
        raise ValueError("the scene has no contacts: run a step, so that they are found")
    touched = {one for pair, *_ in found for one in pair}
    if alone := sorted(free - touched):
        raise ValueError(f"body {alone[0]} is free and touches nothing: hold it, take it out, or close a gap")
    ids = sorted(touched)
    place = {body: index for index, body in enumerate(ids)}
    bodies = [_body(yade.O, one, gravity, direction, live.get(one)) for one in ids]
    rows = [((place[first], place[second]), contact.geom.normal, _strength(contact.phys), corners, area,
             _stiffness(contact.phys))
            for (first, second), contact, corners, area in found]
    return solved(question, dilatant, bodies, ids, rows, [(one[1].id1, one[1].id2) for one in found])


def gravity_of(engines):
    """That of NewtonIntegrator, (3,); 0 without one."""
    import yade
    for engine in engines:
        if isinstance(engine, yade.NewtonIntegrator):
            return np.array(engine.gravity)
    return np.zeros(3)


def _body(scene, number, gravity, direction, live):
    body = scene.bodies[number]
    state, blocked = body.state, set(body.state.blockedDOFs)
    free = is_free(body)
    if free and blocked:
        raise ValueError(f"body {number} has blockedDOFs={state.blockedDOFs!r}: limit analysis knows bodies that are "
                         "held and bodies that are free; block all or none")
    made = Body(held=not free)
    made.centre[:] = state.pos
    if free:
        _refuse_motion(body, np.linalg.norm(gravity))
        weight = state.mass * gravity
        made.dead_force[:] = weight + np.array(lasting(scene.forces.permF, body))
        made.dead_torque[:] = lasting(scene.forces.permT, body)
        force, torque = ((0, 0, 0), (0, 0, 0)) if live is None else live
        made.live_force[:] = np.linalg.norm(weight) * direction + vector(force, f"force on body {number}")
        made.live_torque[:] = vector(torque, f"torque on body {number}")
    return made


def _refuse_motion(body, gravity):
    size = size_of(body)
    speed = max(body.state.vel.norm(), size * body.state.angVel.norm())
    if speed > SLOW * math.sqrt(2 * gravity * size) > 0:
        raise ValueError(f"body {body.id} moves at {speed:.3g} m/s: let the scene come to rest, or set velocities to 0")


def _strength(physics):
    """Friction, cohesion and tensile strength of a contact as it stands."""
    friction = getattr(physics, "tangensOfFrictionAngle", None)
    if friction is None:
        raise ValueError(f"{type(physics).__name__} has no friction angle: take FrictPhys or ConicJointPhys")
    if not hasattr(physics, "residualCohesion"):
        return friction, 0.0, 0.0
    if physics.broken:
        return physics.tangensOfResidualFrictionAngle, physics.residualCohesion, 0.0
    return friction, physics.cohesion, physics.tensileStrength if physics.bonded else 0.0


def _stiffness(physics):
    """Per area along the normal and across it, of which ratios alone count; that of points is not known by area."""
    if hasattr(physics, "normalStiffness"):
        return physics.normalStiffness, max(physics.shearStiffness, SOFT * physics.normalStiffness)
    return 1.0, max(physics.ks / physics.kn, SOFT) if physics.kn > 0.0 else 1.0


def _polygon(contact):
    """(ids of what moves, contact, corners (n, 3), area): the part of the plane across the normal at the contact point
    in which both bodies are flat; the point itself where there is none.
    """
    import yade
    pair = [yade.O.bodies[contact.id1], yade.O.bodies[contact.id2]]
    point, normal = np.array(contact.geom.contactPoint), np.array(contact.geom.normal)
    radii = [body.shape.r for body in pair if hasattr(body.shape, "planes") and body.shape.k < 1]
    overlap = contact.geom.penetrationDepth
    if radii and overlap > sum(radii):
        raise ValueError(f"bodies {contact.id1} and {contact.id2} overlap by {overlap:.3g}, more than the rounding radii "
                         "together: start them apart, or take stiffer contacts")
    bounds = [row for body, sense in zip(pair, (1, -1)) for row in _bounds(body, sense * normal)]
    corners = np.array([point])
    if all(one is not None for one in bounds):
        far = [np.linalg.norm(point - body.state.pos) + body.shape.boundingRadius
               for body in pair if hasattr(body.shape, "boundingRadius")]
        flat = clipped(normal, point, bounds, 2.0 * min(far))
        corners = flat if len(flat) else corners
    area = 0.5 * np.linalg.norm(np.cross(corners[1:-1] - corners[0], corners[2:] - corners[0]).sum(axis=0))
    return tuple(owner(body).id for body in pair), contact, corners, float(area)


def _bounds(body, outwards):
    """Half-spaces (n, offset), n.x <= offset, world frame, that bound what is flat of a body on its side of a contact;
    [None] where it is not flat there.
    """
    import yade
    shape, state = body.shape, body.state
    place = np.array(state.pos)
    turn = np.array(state.ori.toRotationMatrix()).reshape(3, 3)
    if hasattr(shape, "planes"):
        planes = np.array(shape.planes, float)
        if not len(planes) or shape.k == 1:
            return [None]
        normals = planes[:, :3] @ turn.T
        face = (normals @ outwards).argmax()
        if normals[face] @ outwards < math.cos(FLAT):
            return [None]
        return [(n, d + n @ place) for i, (n, d) in enumerate(zip(normals, planes[:, 3])) if i != face]
    if isinstance(shape, yade.Wall):
        return []
    if isinstance(shape, yade.Facet):
        corners = [place + turn @ np.array(corner) for corner in shape.vertices]
        normal = np.cross(corners[1] - corners[0], corners[2] - corners[0])
        edges = [(corners[i], np.cross(corners[(i + 1) % 3] - corners[i], normal)) for i in range(3)]
        return [(n / np.linalg.norm(n), n @ at / np.linalg.norm(n)) for at, n in edges]
    if isinstance(shape, yade.Box):
        axes = [(sign * turn[:, i], shape.extents[i]) for i in range(3) for sign in (1, -1)]
        return [(n, d + n @ place) for n, d in axes if abs(n @ outwards) < math.cos(FLAT)]
    return [None]
