# SPDX-License-Identifier: GPL-3.0-or-later
"""A start of a simulation from the forces of limit analysis: the scene at rest, before its first step.

Friction and twist of a joint are springs with a memory, and are set to the forces of the program; so are all springs of
a bond. What presses in a joint follows from the poses of its two bodies, which are moved by Newton's method,

    (K + h D) u = w + f,

w the weights of the bodies, f the other forces on them as YADE's own functors find them, K the stiffness of the
contacts, D its first diagonal and u shifts and turns, until nothing is left. In the first rounds the springs of friction,
twist and bonds are set to the program's forces again; later they go with the bodies, as in a step, and slip where
friction is at its limit. Where a round leaves more than the one before, as contacts have opened or slipped, the drag h
grows.
"""
import contextlib
import dataclasses

import numpy as np

from .bodies import is_free, lasting, owner, size_of
from .limit_analysis import gravity_of

# Largest force that may be left on a body, over the mean load of one; the rounds end at LEFT.
ENOUGH, LEFT = 1e-6, 1e-8
ROUNDS = 200
# Rounds in which friction and bonds are those of the program; walls near their limit need all four (measured).
FIRST = 4
# Drag: the least, the first after a round that was worse, the most, and by how much it grows or falls.
LEAST, WORSE, MOST, FACTOR = 1e-9, 1e-3, 1.0, 4.0
# Seconds of a step in which bodies move by u: so long that dashpots do nothing.
LONG = 1e3
# Stiffness along a joint that slides, over that of one that sticks: with none, nothing would hold its bodies.
STICK = 1e-2
# Strength of a bond while rest is sought, Pa: finite, for what divides by it.
UNBROKEN = 1e30


@dataclasses.dataclass(frozen=True)
class Start:
    """How a scene was brought to rest."""
    unbalanced: float  #: the largest force, or torque over size, left on a body, over the mean load of one
    rounds: int  #: of Newton's method
    moved: float  #: the largest shift of a body, length
    changed: float  #: the largest difference of the force of a contact from the program's, over the mean load of one


def start_from(found):
    """Brings the scene to rest with the forces of an answer of limit_analysis("stands"), so that a run begins in
    equilibrium. The largest force then left on a body is at most 1e-6 of the mean load (weight and lasting force) of a
    body. Returns a Start.

    Bodies move by about the overlaps that carry them, velocities become 0; O.iter and O.time stay. Contacts are joints
    (ConicJointMat). Bonds take all of the program's forces, joints its friction and twist. Where equilibrium alone does
    not determine the forces, joints share the loads by their stiffness: `changed` says how far from the program.

    ValueError: an answer that does not stand or is none to "stands", or has other contacts than the scene; other laws,
    whose points carry a moment only by where they lie; held bodies that move. RuntimeError: no rest was found, as of
    scenes that stand only by forces at the very corners, which elastic joints cannot carry; the scene is then as it
    was, but for velocities.
    """
    import yade
    scene = _Scene(yade.O)
    programs = _programs(found)
    _refuse(yade.O, found, scene, programs)
    before = [(part, part.state.pos, part.state.ori) for parts in scene.parts for part in parts]
    springs = [(one.phys, one.phys.dict()) for one in scene.contacts()]
    left, rounds = scene.rest(programs)
    if not left <= ENOUGH:
        for part, pos, ori in before:
            part.state.pos, part.state.ori = pos, ori
        for physics, values in springs:
            physics.updateAttrs(values)
        raise RuntimeError(f"no rest was found: after {rounds} rounds {left:.1e} of the mean load is left on a body; "
                           "the loads are near their limit, or joints too soft for it")
    changed = [np.linalg.norm(np.array(one.phys.normalForce + one.phys.shearForce) - programs[one.id1, one.id2][0])
               for one in scene.contacts() if (one.id1, one.id2) in programs]
    return Start(left, rounds, max((part.state.pos - pos).norm() for part, pos, _ in before),
                 max(changed) / scene.mean_load)


def _programs(found):
    """{(id1, id2): force on id2 and its moment about the origin}."""
    forces, moments = (np.zeros((len(found.contacts), 3)) for _ in range(2))
    np.add.at(forces, found.contact_of_corner, found.forces)
    np.add.at(moments, found.contact_of_corner, np.cross(found.corners, found.forces))
    return dict(zip(found.contacts, zip(forces, moments)))


def _refuse(omega, found, scene, programs):
    if found.question != "stands":
        raise ValueError(f'this answers "{found.question}": a start takes limit_analysis("stands"), whose forces bear '
                         "the loads that are there; a live load becomes one by O.forces.setPermF")
    if not found.stands:
        raise ValueError("the scene falls: no forces hold it, so that there is no start at rest")
    if {(one.id1, one.id2) for one in scene.contacts()} != set(programs):
        raise ValueError("the scene has other contacts than the answer: ask limit_analysis() again")
    for contact in scene.contacts():
        physics = contact.phys
        if not hasattr(physics, "shearDisplacement"):
            raise ValueError(f"{type(physics).__name__} has no springs against tilt and twist: take the law of joints, "
                             "as by use_joints()")
    for body in omega.bodies:
        if not is_free(owner(body)) and body.state.vel.norm() + body.state.angVel.norm() > 0.0:
            raise ValueError(f"body {body.id} is held and moves: set its velocities to 0")


class _Scene:
    """What Newton's method needs of the scene."""

    def __init__(self, omega):
        import yade
        self.omega = omega
        self.engines = [one for one in omega.engines
                        if not one.dead and (isinstance(one, yade.Collider) or hasattr(one, "lawDispatcher"))]
        owners = [(body, owner(body)) for body in omega.bodies]
        self.bodies = [body for body, own in owners if body.id == own.id and is_free(body)]
        place = {body.id: row for row, body in enumerate(self.bodies)}
        self.row_of = {body.id: place[own.id] for body, own in owners if own.id in place}
        self.parts = [[] for _ in self.bodies]
        for body, own in owners:
            if own.id in place:
                self.parts[place[own.id]].append(body)
        masses = np.array([body.state.mass for body in self.bodies])
        self.weights = np.pad(np.outer(masses, gravity_of(omega.engines)), ((0, 0), (0, 3)))
        lasts = [list(lasting(omega.forces.permF, body)) for body in self.bodies]
        self.mean_load = np.linalg.norm(self.weights[:, :3] + lasts, axis=1).mean()
        sizes = np.array([size_of(body) for body in self.bodies])
        self.scale = np.repeat(np.stack([np.ones_like(sizes), sizes], axis=1), 3, axis=1)
        self.diagonal = None

    def contacts(self):
        return [one for one in self.omega.interactions if one.isReal]

    def rest(self, programs):
        """Moves bodies until they rest: (largest force left over the mean load of one, rounds)."""
        last, drag, moves = np.inf, LEAST, None
        with self._alone(), _unbroken(self.contacts()):
            for rounds in range(1, ROUNDS + 1):
                freely = rounds > FIRST
                left = self.left(moves if freely else None)
                if not freely:
                    self.set_springs(programs)
                    left = self.left()
                now = self.unbalanced(left)
                if not now > LEFT:
                    break
                if freely:
                    drag = max(drag / FACTOR, LEAST) if now < last else min(max(drag * FACTOR, WORSE), MOST)
                last, moves = now, self.moves(left, drag, freely)
                if rounds < FIRST:
                    self.move(moves)
        # A bond ends in the step after the one that breaks it.
        self.left()
        return self.unbalanced(self.left()), rounds

    def set_springs(self, programs):
        """Gives bonds, and friction of joints, the forces of the program."""
        for contact in self.contacts():
            if (contact.id1, contact.id2) in programs:
                set_one = _set_bond if contact.phys.bondArea > 0.0 else _set_friction
                set_one(contact, *programs[contact.id1, contact.id2])

    @contextlib.contextmanager
    def _alone(self):
        """Without dashpots, and without a trace in O.energy."""
        omega = self.omega
        step, tracked = omega.dt, omega.trackEnergy
        omega.dt, omega.trackEnergy = LONG, False
        try:
            yield
        finally:
            omega.dt, omega.trackEnergy = step, tracked

    def left(self, moves=None):
        """Forces and torques (n, 6) left on the bodies, after moves (n, 6) with which the springs of friction go."""
        if moves is not None:
            self.move(moves, 1.0 / LONG)
        forces = self.omega.forces
        forces.reset(False)
        for engine in self.engines:
            engine()
        found = self.weights.copy()
        for row, (body, parts) in enumerate(zip(self.bodies, self.parts)):
            for part in parts:
                # Lasting forces are among them.
                force, torque = forces.f(part.id, True), forces.t(part.id, True)
                found[row, :3] += force
                found[row, 3:] += torque + (part.state.pos - body.state.pos).cross(force)
                part.state.vel = part.state.angVel = part.state.angMom = (0, 0, 0)
        return found

    def move(self, moves, rate=0.0):
        """Shifts and turns bodies; rate: their velocities over that."""
        import yade
        for body, parts, six in zip(self.bodies, self.parts, moves):
            shift, turn, centre = yade.Vector3(*six[:3]), yade.Vector3(*six[3:]), body.state.pos
            angle = turn.norm()
            by = yade.Quaternion(turn / angle, angle) if angle > 0.0 else yade.Quaternion.Identity
            for part in parts:
                arm = by * (part.state.pos - centre)
                part.state.pos = centre + shift + arm
                part.state.ori = (by * part.state.ori).normalized()
                part.state.vel, part.state.angVel = rate * (shift + turn.cross(arm)), rate * turn

    def unbalanced(self, left):
        """The largest force, or torque over size, over the mean load of a body."""
        return np.linalg.norm((left / self.scale).reshape(-1, 3), axis=1).max() / self.mean_load

    def moves(self, left, drag, slides):
        """u (n, 6). slides: friction at its limit stays there."""
        from scipy import sparse
        from scipy.sparse.linalg import spsolve
        blocks = {(row, row): np.zeros((6, 6)) for row in range(len(self.bodies))}
        for contact in self.contacts():
            stiffness, point = _stiffness(contact, slides), np.array(contact.geom.contactPoint)
            ends = [(self.row_of[one], sign * _shifted(point - np.array(self.bodies[self.row_of[one]].state.pos)))
                    for one, sign in ((contact.id1, -1.0), (contact.id2, 1.0)) if one in self.row_of]
            for row, one in ends:
                for column, other in ends:
                    blocks[row, column] = blocks.get((row, column), 0.0) + one.T @ stiffness @ other
        # Coordinates are lengths.
        in_block = np.indices((6, 6)).reshape(2, 1, 36)
        rows, columns = (6 * np.array(list(blocks)).T[:, :, None] + in_block).reshape(2, -1)
        scale = self.scale.ravel()
        matrix = sparse.csc_matrix((np.ravel(list(blocks.values())) / (scale[rows] * scale[columns]), (rows, columns)))
        if self.diagonal is None:
            self.diagonal = matrix.diagonal().reshape(-1, 3).mean(axis=1).repeat(3)
        solved = spsolve(matrix + sparse.diags(drag * self.diagonal, format="csc"), left.ravel() / scale)
        return (solved / scale).reshape(-1, 6)


@contextlib.contextmanager
def _unbroken(contacts):
    """Joints and bonds are whole while rest is sought: what is too much on the way need not be in the end."""
    kept = []
    for physics in [one.phys for one in contacts]:
        names = ()
        if physics.bonded:
            names = dict.fromkeys(("tensileStrength", "cohesion"), UNBROKEN)
        elif not physics.broken:
            names = {"tangensOfResidualFrictionAngle": physics.tangensOfFrictionAngle,
                     "residualCohesion": physics.cohesion, "broken": False}
        kept += [(physics, name, getattr(physics, name)) for name in names]
        for name in names:
            setattr(physics, name, names[name])
    try:
        yield
    finally:
        for physics, name, value in kept:
            setattr(physics, name, value)


def _set_friction(contact, force, moment):
    """Springs along a contact hold what the program's force, and its moment about the origin, ask of them."""
    import yade
    geometry, physics = contact.geom, contact.phys
    normal = np.array(geometry.normal)
    along = force - force @ normal * normal
    twisting = (moment - np.cross(geometry.contactPoint, force)) @ normal
    if physics.ks > 0.0 and physics.twistStiffness > 0.0:
        physics.shearDisplacement = yade.Vector3(*(-along / physics.ks))
        physics.twist = -twisting / physics.twistStiffness


def _axes(contact):
    """Of a bond, as columns: the normal and two across it."""
    import yade
    return np.array((yade.O.bodies[contact.id1].state.ori * contact.phys.bondTurn1).toRotationMatrix())


def _bending(physics):
    """Stiffness of a bond against turns about its axes, N m."""
    return np.array(physics.bondMoments) * [physics.shearStiffness, physics.normalStiffness, physics.normalStiffness]


def _set_bond(contact, force, moment):
    """The springs of a bond hold the program's force, and its moment about the origin."""
    import yade
    physics, axes = contact.phys, _axes(contact)
    stiffness = physics.bondArea * np.array([physics.normalStiffness, physics.shearStiffness, physics.shearStiffness])
    bending = _bending(physics)
    now = np.array(physics.normalForce + physics.shearForce)
    turning = np.array(physics.bendingMoment + physics.twistMoment * contact.geom.normal)
    wanted = moment - np.cross(contact.geom.contactPoint, force)
    if (stiffness > 0.0).all() and (bending > 0.0).all():
        physics.bondDisplacement += yade.Vector3(*(axes.T @ (now - force) / stiffness))
        physics.bondRotation += yade.Vector3(*(axes.T @ (turning - wanted) / bending))


def _stiffness(contact, slides):
    """(6, 6) of a contact at its point, against shifts and turns of body id2, world axes."""
    geometry, physics = contact.geom, contact.phys
    normal = np.array(geometry.normal)
    across = np.outer(normal, normal)
    found = np.zeros((6, 6))
    found[:3, :3] = physics.kn * across + physics.ks * (np.eye(3) - across)
    if physics.bondArea > 0.0:
        axes = _axes(contact)
        found[3:, 3:] = axes @ np.diag(_bending(physics)) @ axes.T
        return found
    # A point y of the patch presses by n u + (y x n) t, u the shift and t the turn.
    centroid, turned = np.array(geometry.centroid), -_cross(normal)
    moment = np.array(geometry.secondMoment) + geometry.contactArea * np.outer(centroid, centroid)
    found[3:, 3:] = physics.normalStiffness * turned @ moment @ turned.T + physics.twistStiffness * across
    found[:3, 3:] = physics.kn * np.outer(normal, turned @ centroid)
    found[3:, :3] = found[:3, 3:].T
    shear, pressing = np.array(physics.shearForce), physics.normalForce.norm()
    size = np.linalg.norm(shear)
    if slides and physics.isSliding and size > 0.0 and pressing > 0.0:
        # Friction keeps its direction, and follows the pressure.
        found[:3, :3] -= (1.0 - STICK) * physics.ks * np.outer(shear, shear) / size**2
        found[:3] += np.outer(shear / pressing, normal @ found[:3])
    return found


def _shifted(arm):
    """Motion of the point at an arm from the centre, of shift and turn there: (6, 6)."""
    found = np.eye(6)
    found[:3, 3:] = -_cross(arm)
    return found


def _cross(a):
    """The matrix of a x."""
    return np.array([[0.0, -a[2], a[1]], [a[2], 0.0, -a[0]], [-a[1], a[0], 0.0]])
