# SPDX-License-Identifier: GPL-3.0-or-later
"""The largest time step with which contacts act as springs and not as explosions.

Leapfrog is stable for dt < 2/omega, omega the highest circular frequency. A contact with stiffness K_c (3, 3) moves
body b at the arm x by B u, u = (displacement, turn), B = [1, -x cross]. Since |B_1 u_1 - B_2 u_2|^2 <= 2 |B_1 u_1|^2 +
2 |B_2 u_2|^2, the stiffness of all contacts is at most twice that of each body alone, held by its own contacts, and
with M_b of mass and inertia

    omega^2 <= 2 max over bodies of the largest eigenvalue of M_b^-1 sum over its contacts B^T K_c B.

A new contact at the point x holds against the turn that moves x most: of B^T B the eigenvalue 1/m + l, l the larger
    root of l^2 - t l + p = 0,

    t = sum (|x|^2 - x_i^2) / I_i,    p = |x|^2 sum x_i^2 I_i / (I_1 I_2 I_3)    (principal axes),

which is largest at a corner of the box of the body, since it is convex in x, and at most |x|^2 / min I. A contact
patch holds against turning as well: its stiffness has a part for turns alone, K J across the normal and k_s J about it,
J the polar moment of the patch or, where there is one, of the bond. So does the point of a contact of flat faces, which
moves as they turn (rolling.py).

Dashpots lower the limit. Those of joints, of the ratio z to the critical one, to dt < 2/omega (sqrt(1 + z^2) - z),
which is taken into account, omega with three times the stiffness of patches against tilting, as their dashpots stand at
the edges; for others safety leaves room, below about half of the critical damping.
"""
import itertools
import math

import numpy as np

from . import rolling
from .arguments import LARGE, MANY, number, positive, whole
from .bodies import image_shift, is_free
from .joints import given_by_engines
from .materials import CONTACTS, SAFETY


_CORNERS = np.array(list(itertools.product((False, True), repeat=3)))


def critical_time_step(stiffness=None, bodies=None, contacts=CONTACTS, safety=SAFETY):
    """A time step, s, safe for the contacts that there are, and for `contacts` new ones at the worst corner of the box
    of each body.

    stiffness: of a contact, N/m; None: from the scene's physics functor. For KnKsPhys that is Knormal, times the area
    of the body's largest circle where the contact functor computes areas (calContactArea); for laws with springs from E
    and radii (FrictPhys), young times the bounding radius; for ConicJointMat its stiffness per area, or that of
    rock.joint_engine where it is larger, times the area of the largest circle. Where a joint is stiffer in shear, that
    counts. bodies: ids, default all; clumps move as one body, with the contacts of their members. safety: share of the
    proved limit that is used, 0 to 1. ValueError where nothing moves or no stiffness is known.
    """
    import yade
    scene = yade.O
    contacts, safety = whole(contacts, 1, MANY, "contacts"), _share(safety)
    stiffness = None if stiffness is None else positive(stiffness, "stiffness")
    movers = _movers(scene, bodies)
    if not movers:
        raise ValueError("no body with a shape and a mass is free to move: there is no time step to find")
    rule = stiffness_rule(scene, stiffness, in_shear=True)
    largest, damping = max(_eigenvalues(scene, movers), default=0.0), 0.0
    for body, parts in movers:
        mass = body.state.mass
        for part in parts:
            damping = max(damping, _damping_ratio(getattr(part.mat, "restitution", 1.0)))
            radius = bounding_radius(part)
            largest = max(largest, contacts * rule(part, radius) * (1.0 / mass + _largest_lever(body, part, radius)))
    return safety * 2.0 / math.sqrt(2.0 * largest) * (math.hypot(1.0, damping) - damping)


def time_stepper(period=200, contacts=CONTACTS, safety=SAFETY):
    """An engine that sets O.dt to critical_time_step(contacts=contacts, safety=safety) in the first step and then every
    `period` steps.

    It is a PyRunner, to stand between the contact loop and NewtonIntegrator, and follows what a script changes: bodies,
    masses, stiffness, laws. While nothing is free to move O.dt stays. Saved with the scene; a script that loads it
    imports potential_particles. A call takes about 0.1 ms for each contact.
    """
    import yade
    period, contacts = whole(period, 1, LARGE, "period"), whole(contacts, 1, MANY, "contacts")
    return yade.PyRunner(
        command=f"import potential_particles; potential_particles.time_step.follow(contacts={contacts}, safety={_share(safety)!r})",
        iterPeriod=period,
        initRun=True,
    )


def follow(contacts, safety):
    """What time_stepper() does when it runs."""
    import yade
    if _movers(yade.O, None):
        yade.O.dt = critical_time_step(contacts=contacts, safety=safety)


def _share(safety):
    if positive(safety, "safety") > 1.0:
        raise ValueError(f"safety={safety:g} is a share of the limit and must lie between 0 and 1")
    return float(safety)


def _damping_ratio(restitution):
    """At least that of a joint with this restitution e: e < exp(-2 z) up to z = 1, and 1/(4 z^2) < e < 1/(2 z^2)
    beyond.
    """
    return 0.0 if restitution >= 1.0 else max(-0.5 * math.log(restitution),
                                              math.sqrt(0.5 / restitution) if restitution < 0.14 else 0.0)


def _largest_lever(body, part, radius):
    """The largest l of a point of a body, or of a member of a clump, 1/kg: what a force of 1 N there moves it by the
    turn, against 1/m by the shift.
    """
    principal = np.array(list(body.state.inertia))
    turn, place = np.eye(3), np.zeros(3)
    if part is not body:
        back = body.state.ori.conjugate()
        turn, place = np.array((back * part.state.ori).toRotationMatrix()), np.array(back *
                                                                                     (part.state.pos - body.state.pos))
    most = (radius + np.linalg.norm(place)) ** 2 / principal.min()
    if not hasattr(part.shape, "boundingRadius"):
        return most
    # Distances from the centre of the body, along its axes.
    lower, upper = -np.array(part.shape.minAabb), np.array(part.shape.maxAabb)
    corners = np.where(_CORNERS, upper, lower) @ turn.T + place
    squares = corners**2
    distance = squares.sum(1)
    trace = (distance[:, None] - squares) @ (1.0 / principal)
    product = distance * (squares @ principal) / principal.prod()
    return min(most, float((0.5 * (trace + np.sqrt(np.maximum(trace**2 - 4.0 * product, 0.0)))).max()))


def _movers(scene, bodies):
    """(body, its parts) of each that forces move: a clump with its members, any other body with itself."""
    chosen = scene.bodies if bodies is None else [scene.bodies[int(one)] for one in bodies]
    numbers = {body.clumpId if body.isClumpMember else body.id for body in chosen}
    found = []
    for body in (scene.bodies[one] for one in sorted(numbers)):
        if (body.shape is not None and body.state.mass > 0.0 and min(body.state.inertia) > 0.0 and is_free(body)):
            found.append((body, [scene.bodies[one] for one in body.shape.members] if body.isClump else [body]))
    return found


def bounding_radius(body):
    """Radius about the centre within which all of the body lies."""
    shape = body.shape
    for name in ("boundingRadius", "radius"):
        if hasattr(shape, name):
            return getattr(shape, name)
    # A plain potential particle lies within the sphere R/sqrt(k), or nothing is known.
    if getattr(shape, "k", 0.0) > 0.0:
        return shape.R / math.sqrt(shape.k)
    raise ValueError(
        f"body {body.id} is a {type(shape).__name__} of unknown extent: use ConicPotentialParticle, or name other bodies"
    )


def stiffness_rule(scene, stiffness=None, in_shear=False):
    """Stiffness of a new contact of a body along its normal, N/m, as a function of body and bounding radius; in_shear:
    the larger one of along and across.
    """
    if stiffness is not None:
        return lambda body, radius: stiffness
    loop = next((one for one in scene.engines if hasattr(one, "physDispatcher")), None)
    functor = loop.physDispatcher.functors[0] if loop and loop.physDispatcher.functors else None
    knormal = getattr(functor, "Knormal", None)
    if knormal is not None and number(knormal, "Knormal") > 0.0:
        with_area = any(getattr(one, "calContactArea", False) for one in loop.geomDispatcher.functors)
        most = max(knormal, number(functor.Kshear, "Kshear")) if in_shear and hasattr(functor, "Kshear") else knormal
        return lambda body, radius: most * (math.pi * radius**2 if with_area else 1.0)
    if type(functor).__name__ == "Ip2_ConicJointMat_ConicJointMat_ConicJointPhys":
        given = _given_to_bodies(scene, in_shear)
        return lambda body, radius: max(_joint_stiffness(body, radius, in_shear), given.get(body.id, 0.0)
                                        ) * math.pi * radius**2
    if functor is not None and type(functor).__name__.startswith("Ip2_FrictMat_FrictMat_"):
        return lambda body, radius: (positive(body.mat.young, f"young of the material of body {body.id}") * radius
                                     * (max(1.0, body.mat.poisson) if in_shear else 1.0))
    raise ValueError(
        "the scene has no physics functor with a known stiffness: set O.engines first, or give stiffness in N/m")


def _joint_stiffness(body, radius, in_shear):
    """Per area, N/m^3, the largest that a joint of this body can have: twice its own, if its neighbour is rigid."""
    material = body.mat
    normal = (getattr(material, "normalStiffness", 0.0)
              or positive(material.young, f"young of the material of body {body.id}") / (2.0 * radius))
    shear = getattr(material, "shearStiffness", 0.0) or material.poisson * normal
    return 2.0 * (max(normal, shear) if in_shear else normal)


def _given_to_bodies(scene, in_shear):
    """Per area, N/m^3, by id: the largest stiffness that an engine of rock.joint_engine gives a joint of the body."""
    names = ("normalStiffness", "shearStiffness") if in_shear else ("normalStiffness",)
    most = {}
    for pair, values in given_by_engines(scene).items():
        for one in pair:
            most[one] = max(most.get(one, 0.0), *(values.get(name, 0.0) for name in names))
    return most


def _of_contact(scene, contact):
    """(normal, point, kn, ks, stiffness against turns across the normal, about it) of a real contact, world axes."""
    geometry, physics = contact.geom, contact.phys
    # Only physics of joints hold against turns.
    if not hasattr(physics, "twistStiffness"):
        return geometry.normal, geometry.contactPoint, physics.kn, physics.ks, 0.0, 0.0
    # Dashpots at the edges of a patch resist tilting as three times its springs.
    normal, point, polar_moment = geometry.normal, geometry.contactPoint, geometry.polarMoment * (
        3.0 if physics.dampingRatio > 0.0 else 1.0)
    if physics.bondArea > 0.0:
        # The contact of a bond may lie elsewhere: where the bodies overlap now.
        one = scene.bodies[contact.id1].state
        normal = (one.ori * physics.bondTurn1).toRotationMatrix().col(0)
        point, polar_moment = one.pos + one.ori * physics.bondPoint1, physics.bondMoments[0]
    return normal, point, physics.kn, physics.ks, physics.normalStiffness * polar_moment, physics.twistStiffness


def _of_moving_points(contacts):
    """(m, 2, 3, 3), for both bodies of rows (contact, normal, point, normal force, kn)."""
    found = np.zeros((len(contacts), 2, 3, 3))
    pressed = [row for row, one in enumerate(contacts) if one[3] > 0.0 and one[4] > 0.0]
    if pressed:
        of_contact, normals, points, forces, stiffnesses = zip(*(contacts[row] for row in pressed))
        found[pressed] = rolling.turning_stiffness(
            of_contact, *(np.array([list(one) for one in given]) for given in (normals, points)), np.array(forces),
            np.array(stiffnesses))
    return found


def _eigenvalues(scene, movers):
    """Largest eigenvalue of M^-1 sum B^T K B of each body with a contact, 1/s^2."""
    bodies = [body for body, _ in movers]
    row_of = {part.id: row for row, (_, parts) in enumerate(movers) for part in parts}
    centres = [body.state.pos for body in bodies]
    rows, arms, numbers = [], [], []
    moving, at = [], []
    for contact in scene.interactions:
        if not contact.isReal or contact.id1 not in row_of and contact.id2 not in row_of:
            continue
        normal, point, *rest = _of_contact(scene, contact)
        force = 0.0 if hasattr(contact.phys, "twistStiffness") else contact.phys.normalForce.norm()
        moving.append((contact, normal, point, force, rest[0]))
        for number in (contact.id1, contact.id2):
            if number in row_of:
                row = row_of[number]
                arm = point - centres[row]
                if number == contact.id2:
                    arm -= image_shift(contact)
                rows.append(row)
                at.append((len(moving) - 1, int(number == contact.id2)))
                arms.append(tuple(arm))
                numbers.append((*normal, *rest))
    if not rows:
        return []
    arms, numbers = np.array(arms), np.array(numbers)
    along = numbers[:, :3, None] * numbers[:, None, :3]
    across = np.eye(3) - along
    kn, ks, bending, twist = numbers[:, 3:, None, None].swapaxes(0, 1)
    # B = [1, -arm cross].
    moved = np.zeros((len(rows), 3, 6))
    moved[:, range(3), range(3)] = 1.0
    for i, j, k in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
        moved[:, i, 3 + j], moved[:, j, 3 + i] = arms[:, k], -arms[:, k]
    parts = moved.swapaxes(1, 2) @ (kn * along + ks * across) @ moved
    parts[:, 3:, 3:] += bending * across + twist * along + _of_moving_points(moving)[tuple(np.array(at).T)]
    sums = np.zeros((len(bodies), 6, 6))
    np.add.at(sums, rows, parts)
    roots = np.zeros_like(sums)
    for row in set(rows):
        state = bodies[row].state
        turn = np.array(state.ori.toRotationMatrix())
        roots[row, :3, :3] = np.eye(3) / math.sqrt(state.mass)
        roots[row, 3:, 3:] = turn @ np.diag(1.0 / np.sqrt(list(state.inertia))) @ turn.T
    return np.linalg.eigvalsh(roots @ sums @ roots)[:, -1].tolist()
