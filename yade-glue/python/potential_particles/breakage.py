# SPDX-License-Identifier: GPL-3.0-or-later
"""How the engine Breakage cuts a body: into pieces that have its mass, momentum and moment of momentum."""
import dataclasses
import importlib
import math
import warnings

import numpy as np

from .arguments import SceneWarning, rows
from .output.mesh import rotation_matrix
from .rock.domain import Domain
from .rock.joints import Joint
from .rock.mass import OF_DOMAIN
from .rock.mass import slice as sliced
from .rock.scene import TOUCH, block_shape
from .rounding import Rounding

#: `history` of the engine: the step and the body that broke; its pieces have the ids from `first` on; the largest and
#: the least principal stress (Pa, tension positive); the area of the cuts and what that took at surfaceEnergy; and what
#: was lost of elastic energy: that of bonds and of springs along contacts.
HISTORY = np.dtype([("step", "i8"), ("parent", "i8"), ("first", "i8"), ("pieces", "i8"), ("largest", "f8"),
                    ("least", "f8"), ("area", "f8"), ("surface_energy", "f8"), ("elastic_energy", "f8")])


def cut(engine, ids, stresses):
    """Breaks bodies with these stresses, as bytes of int32 and of 9 doubles each; a list of those that stayed whole."""
    import yade
    whole = []
    for one, stress in zip(np.frombuffer(ids, np.int32).tolist(), np.frombuffer(stresses).reshape(-1, 3, 3)):
        body = yade.O.bodies[one]
        joints = _joints(engine, body, stress)
        if joints and not _broken(engine, body, joints, np.linalg.eigvalsh(stress)):
            whole.append(one)
    return whole


def _joints(engine, body, stress):
    """The Joints that cut a body, in its axes; none if its function says that it is whole."""
    import yade
    turn = rotation_matrix(body.state.ori)
    if engine.function:
        said = _named(engine.function)(body, yade.Matrix3(*stress.ravel().tolist()))
        if said is None or isinstance(said, (bool, np.bool_)) and not said:
            return []
        if not isinstance(said, (bool, np.bool_)):
            given = [list(row) for row in said]
            width = len(given[0]) if given else 3
            planes = rows(given, 4 if width == 4 else 3, f"what {engine.function} returned",
                          "three numbers of a normal, or the four numbers a, b, c, d")
            places = (planes[:, 3] - planes[:, :3] @ np.array(body.state.pos)) if width == 4 else np.zeros(len(planes))
            normals = planes[:, :3] @ turn
            return [Joint(tuple(normal * place / (normal @ normal)), tuple(normal)) for normal, place in
                    zip(normals, places)]
    if engine.joints:
        normals = np.reshape(engine.joints, (-1, 3))
    else:
        # Across the largest tension first.
        normals = np.linalg.eigh(stress)[1].T[::-1][:int(math.log2(engine.pieces))] @ turn
    return [Joint((0.0, 0.0, 0.0), tuple(normal)) for normal in normals]


def _broken(engine, body, joints, principal):
    """Whether the body has given way to its pieces."""
    import yade
    from .bodies import body as made_of
    sharp = sharp_planes(body.shape)
    try:
        # A round body, such as an ellipsoid, is made of planes that are no faces.
        if not all(d > 0.0 for _, _, _, d in body.shape.planes):
            raise ValueError("it is round")
        mass = sliced(Domain(sharp), joints, least_width=engine.leastSize, threads=1, progress=False)
    except ValueError as error:
        warnings.warn(f"potential_particles: Breakage leaves body {body.id} whole, as it has no faces that enclose it: "
                      f"{error}", SceneWarning)
        return False
    if len(mass) < 2:
        return False
    state, scene, number = body.state, yade.O, body.id
    # Sharp pieces fill the sharp body: what roundings took of its mass is made up for.
    made_up = state.mass / (mass.volume * body.material.density)
    made = []
    for block in (mass[one] for one in range(len(mass))):
        own = mass.faces[block.faces]
        others = np.delete(sharp, own["index"][own["of"] == OF_DOMAIN].astype(int), 0)
        shape, orientation = _shape(block, others, body.shape.r, engine.rounding)
        shape = dataclasses.replace(shape, volume=shape.volume * made_up,
                                    inertia=tuple(made_up * one for one in shape.inertia))
        piece = made_of(shape, body.material, state.pos + state.ori * yade.Vector3(*block.centroid),
                        state.ori * _quaternion(orientation), color=body.shape.color, mask=body.mask,
                        wire=body.shape.wire, highlight=body.shape.highlight)
        piece.state.blockedDOFs, piece.state.isDamped = state.blockedDOFs, state.isDamped
        made.append(piece)
    share_motion(body, [piece.state for piece in made])
    lost = _lost(body)
    for contact in body.intrs():
        scene.interactions.erase(contact.id1, contact.id2)
    scene.bodies.erase(number)
    # One by one: of a list YADE keeps the bodies for ever.
    first = [scene.bodies.append(piece) for piece in made][0]
    # The forces of this step, of which YADE says nothing for as long as there are new bodies.
    scene.forces.f(first, True)
    area = float(mass.partners["area"].sum())
    engine.addRecord((scene.iter, number, first, len(made), principal[2], principal[0], area,
                      area * engine.surfaceEnergy, lost))
    return True


def sharp_planes(shape):
    """Rows (a, b, c, h) of the polyhedron within which a potential particle lies and touches each face: its axes."""
    planes, r, k, R = np.array(shape.planes, float).reshape(-1, 4), shape.r, shape.k, shape.R
    # (1-k)/r^2 (h-d)^2 + k/R^2 h^2 = 1; a plane beyond the shadow sphere is none.
    plane, ball, d = (1.0 - k) / r**2, k / R**2, planes[:, 3]
    under = (plane * d)**2 - (plane + ball) * (plane * d**2 - 1.0)
    faces = under > 0.0
    heights = (plane * d[faces] + np.sqrt(under[faces])) / (plane + ball)
    return np.column_stack([planes[faces, :3], heights])


def _shape(block, others, r, largest_share):
    """The Shape of a piece and the orientation of its axes. It has the rounding of the body that broke, and those of
    its `other` planes that come into this rounding: so it lies within that body.
    """
    size = 2.0 * float((block.planes[:, 3] - block.planes[:, :3] @ block.centroid).min())
    share = min(r / size, largest_share)
    near = (block.corners @ others[:, :3].T).max(0, initial=-math.inf) > others[:, 3] - share * size
    # Pieces touch to rounding: parted by as little, none has to look for its patch.
    return block_shape(block, Rounding(share, 0.0), -TOUCH * size, others[near])


def share_motion(body, states):
    """Gives states, whose masses sum to that of the body, the one motion of a rigid body that has its momentum and
    moment of momentum.
    """
    import yade
    whole = body.state
    masses = np.array([one.mass for one in states])
    places = np.array([list(one.pos) for one in states])
    momentum = whole.mass * np.array(whole.vel)
    middle = masses @ places / masses.sum()
    arms = places - middle
    turns = [rotation_matrix(one.ori) for one in states]
    own = [turn @ np.diag(list(one.inertia)) @ turn.T for turn, one in zip(turns, states)]
    inertia = sum(own) + sum(mass * (arm @ arm * np.eye(3) - np.outer(arm, arm)) for mass, arm in zip(masses, arms))
    spin = np.linalg.solve(inertia, _spin(body) + np.cross(np.array(whole.pos) - middle, momentum))
    for one, arm, moment in zip(states, arms, own):
        one.vel = yade.Vector3(*(momentum / masses.sum() + np.cross(spin, arm)))
        one.angVel, one.angMom = yade.Vector3(*spin), yade.Vector3(*(moment @ spin))


def _spin(body):
    """Moment of momentum about its centre."""
    state = body.state
    if body.aspherical:
        return np.array(state.angMom)
    turn = rotation_matrix(state.ori)
    return turn @ (np.array(state.inertia) * (turn.T @ np.array(state.angVel)))


def _lost(body):
    """Of the elastic energy of its contacts what their pieces do not take over: springs along them, and bonds."""
    total = 0.0
    for physics in (contact.phys for contact in body.intrs() if contact.isReal):
        kn, ks = getattr(physics, "kn", 0.0), getattr(physics, "ks", 0.0)
        if ks > 0.0:
            total += 0.5 * physics.shearForce.squaredNorm() / ks
        if kn > 0.0 and getattr(physics, "bonded", False):
            total += 0.5 * physics.normalForce.squaredNorm() / kn
        total += 0.5 * getattr(physics, "twistStiffness", 0.0) * getattr(physics, "twist", 0.0)**2
    return total


def history(engine):
    """HISTORY of an engine."""
    rows_of = np.frombuffer(engine.recordBytes()).reshape(-1, len(HISTORY))
    return np.array([tuple(row) for row in rows_of], HISTORY)


def parents(engine):
    """{id of a piece: id of the body that broke}."""
    return {
        int(row["first"]) + place: int(row["parent"])
        for row in history(engine) for place in range(int(row["pieces"]))
    }


def generations(engine):
    """{id of a piece: how often what it was part of has broken}."""
    found = {}
    for piece, parent in parents(engine).items():
        found[piece] = found.get(parent, 0) + 1
    return found


def joints(given):
    """Attribute `joints` of rows, or flat."""
    flat = np.array(given, float).ravel()
    if flat.size % 3 or not np.isfinite(flat).all() or not np.abs(flat.reshape(-1, 3)).max(1, initial=0.0).all():
        raise ValueError(f"Breakage: joints={given!r} must be normals of three numbers, not all 0")
    return flat.tolist()


def function(given):
    """Attribute `function` of a function or of its name."""
    if not callable(given):
        return given
    name = f"{given.__module__}.{given.__qualname__}"
    if "<" in name:
        raise ValueError(f"Breakage: function={name} has no name by which a loaded scene finds it: define it by def in "
                         "the script or a module")
    return name


def _named(name):
    module, _, path = name.rpartition(".")
    try:
        return getattr(importlib.import_module(module or "__main__"), path)
    except (ImportError, AttributeError):
        raise ValueError(f"function={name} is not there: define it in the script, or import its module, before the "
                         "scene runs") from None


def _quaternion(orientation):
    import yade
    return yade.Quaternion(*map(float, orientation))
