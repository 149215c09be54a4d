# SPDX-License-Identifier: GPL-3.0-or-later
"""The law of joints in the place of another, bonds of joints, what the law needs before a scene steps, and what engines
give to joints.
"""

import json
import math
import os

from .arguments import radians

LAW = "Law2_ScGeomConicPP_ConicJointPhys"
# Of engines made by rock.joint_engine, whose tables stand in the scene's tags.
FOLLOWS = "potential_particles.rock.scene.follow"
_tables = {}


def table(tag, text):
    """{(lower id, higher id): values by name} of what an engine of rock.joint_engine gives contacts, from the text of
    its tag.
    """
    known = _tables.get(tag)
    if known is None or known[0] != text:
        read = json.loads(text)
        known = _tables[tag] = text, {(a, b): read["values"][str(entry)] for a, b, entry in read["pairs"]}
    return known[1]


def given_by_engines(scene):
    """The same of all such engines of the scene together."""
    found = {}
    for engine in scene.engines:
        command = getattr(engine, "command", "")
        if FOLLOWS in command and not engine.dead:
            tag = command.partition(FOLLOWS)[2].strip("('\")") or "potential_particles.rock"
            found.update(table(tag, scene.tags[tag]))
    return found


def of_engine(values):
    """Values of table() as attributes of ConicJointPhys, by name; stiffnesses of 0 are left out, which leave a joint
    its own.
    """
    tangents = {
        f"tangensOf{name[0].upper()}{name[1:]}": math.tan(values[name])
        for name in ("frictionAngle", "residualFrictionAngle")
    }
    others = {
        name: float(value)
        for name, value in values.items()
        if not name.endswith("Angle") and not (name.endswith("Stiffness") and value <= 0.0)
    }
    return {**tangents, **others}


def require_patches(engines):
    """ValueError where a contact loop with the law of joints has contact functors that do not find the patch: no joint
    would have a force.
    """
    for engine in engines:
        laws = [type(law).__name__ for law in getattr(getattr(engine, "lawDispatcher", None), "functors", ())]
        if LAW not in laws:
            continue
        ours = [functor for functor in engine.geomDispatcher.functors if hasattr(functor, "patch")]
        without = [type(functor).__name__ for functor in ours if not functor.patch]
        # Beside another law a functor may serve that one.
        if without and (len(laws) == 1 or len(without) == len(ours)):
            raise ValueError(f"{LAW} needs the contact patch: give {', '.join(without)} the keyword patch=True")


def require_angles(scene):
    """ValueError where a ConicJointMat has an invalid friction angle: the attribute is YADE's, which takes any number.
    """
    import yade
    for material in scene.materials:
        if isinstance(material, yade.ConicJointMat):
            radians(material.frictionAngle, f"frictionAngle of ConicJointMat {material.id} in O.materials")


def chosen():
    """Whether LAW in the environment is "joint", as the examples ask; False for "point" and without it. SystemExit with
    a sentence for anything else.
    """
    law = os.environ.get("LAW") or "point"
    if law not in ("point", "joint"):
        raise SystemExit(
            f"LAW={law!r} in the environment: it is point (or nothing), or joint for contact patches with the law of joints"
        )
    return law == "joint"


def use_joints(**material):
    """Gives a scene that is set up, and has not stepped, the law of joints (docs/joints.md) in the place of the law of
    its contact loop.

    Each FrictMat of a body becomes a ConicJointMat of the same density, Young's modulus, Poisson's ratio and friction
    angle; `material`: further attributes of all of them, or in the place of those. The contact functors of this package
    get patch=True, and the physics functors and laws of the contact loop give way to those of joints. ValueError where
    there is no contact loop or already a contact, or a body has another material.
    """
    import yade
    scene = yade.O
    loops = [engine for engine in scene.engines if hasattr(engine, "lawDispatcher")]
    if not loops:
        raise ValueError("the scene has no contact loop yet: set O.engines first")
    if any(contact.isReal for contact in scene.interactions):
        raise ValueError(
            "there are contacts already, with physics of another law: call use_joints before the first step")
    joints = {}
    for body in [body for body in scene.bodies if body.mat is not None]:
        if not isinstance(body.mat, yade.FrictMat):
            raise ValueError(
                f"body {body.id} has a {type(body.mat).__name__}: use_joints takes FrictMat and what is derived from it"
            )
        if body.mat.id not in joints:
            given = {name: getattr(body.mat, name) for name in ("density", "young", "poisson", "frictionAngle")}
            joints[body.mat.id] = scene.materials[scene.materials.append(yade.ConicJointMat(**{**given, **material}))]
        body.mat = joints[body.mat.id]
    for loop in loops:
        for functor in loop.geomDispatcher.functors:
            if hasattr(functor, "patch"):
                functor.patch = True
        loop.physDispatcher.functors = [yade.Ip2_ConicJointMat_ConicJointMat_ConicJointPhys()]
        loop.lawDispatcher.functors = [yade.Law2_ScGeomConicPP_ConicJointPhys()]


def bond_contacts(bodies=None):
    """Bonds the joints that there are, all or those between bodies with these ids, as they are in the next step;
    returns their number.

    Joints are contacts with ConicJointPhys. Those that have broken are whole again. For joints that are made later see
    `bonds` of Ip2_ConicJointMat_ConicJointMat_ConicJointPhys.
    """
    import yade
    chosen = None if bodies is None else {int(one) for one in bodies}
    joints = [contact.phys for contact in yade.O.interactions
              if contact.isReal and isinstance(contact.phys, yade.ConicJointPhys)
              and (chosen is None or {contact.id1, contact.id2} <= chosen)]
    for joint in joints:
        joint.bonded = True
    return len(joints)
