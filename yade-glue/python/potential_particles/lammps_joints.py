# SPDX-License-Identifier: GPL-3.0-or-later
"""The law of joints of a scene in LAMMPS's words: what its materials give two bodies, as
Ip2_ConicJointMat_ConicJointMat_ConicJointPhys has it, and how the joints that there are begin.
"""
import math
from typing import NamedTuple

from .bodies import image_shift
from .joints import LAW, of_engine
from .lammps_limits import warn

# Relative, of numbers that a contact was given and those that its materials give.
_SAME = 1e-6
# Of the force across a bond.
_NO_FORCE = 1e-6


class Settings(NamedTuple):
    """patch tolerance; whether joints of bodies that are whole are bonded; steps before which joints of bodies, and of
    walls, are whole.
    """

    tolerance: float
    bonds: bool
    whole: int
    whole_at_walls: int


def settings(scene, given):
    """Settings of the scene's joints, None without its law; ValueError where they are what LAMMPS cannot begin with.
    given: as of joints.given_by_engines.
    """
    for engine in scene.engines:
        laws = [type(law).__name__ for law in getattr(getattr(engine, "lawDispatcher", None), "functors", ())]
        if LAW not in laws:
            continue
        tolerances = [
            functor.patchTolerance for functor in engine.geomDispatcher.functors if getattr(functor, "patch", False)
        ]
        physics = [
            functor for functor in engine.physDispatcher.functors
            if type(functor).__name__ == "Ip2_ConicJointMat_ConicJointMat_ConicJointPhys"
        ]
        if not tolerances or not physics:
            raise ValueError(
                f"{LAW} without Ip2_ConicJointMat_ConicJointMat_ConicJointPhys, or without patch=True of a contact functor: nothing to carry over"
            )
        of_bodies, of_walls = _joints(scene)
        _as_their_materials(scene, of_bodies + of_walls, given)
        later = max(physics[0].cohesiveTresholdIteration - scene.iter, 0)
        bonds, whole = _of_bodies(scene, of_bodies, bool(physics[0].bonds), later)
        return Settings(min(tolerances), bonds, whole, _of_walls(of_walls, later))
    return None


def _joints(scene):
    """The joints that there are: between bodies, and with walls or facets."""
    of_bodies, of_walls = [], []
    for contact in scene.interactions:
        if contact.isReal and type(contact.phys).__name__ == "ConicJointPhys":
            kinds = {type(scene.bodies[one].shape).__name__ for one in (contact.id1, contact.id2)}
            (of_walls if kinds & {"Wall", "Facet"} else of_bodies).append(contact)
    return of_bodies, of_walls


def _as_their_materials(scene, joints, given):
    """ValueError where joints have other numbers than LAMMPS is told for their types."""
    wrong = []
    for contact in joints:
        one, other = (scene.bodies[number].mat for number in (contact.id1, contact.id2))
        values = parameters(one, other, (contact.geom.refR1, contact.geom.refR2), given.get(_pair(contact)))
        for name, value in values.items():
            if name != "restitution" and not math.isclose(getattr(contact.phys, name), value, rel_tol=_SAME,
                                                          abs_tol=1e-12):
                wrong.append(
                    f"{name} of {contact.id1} and {contact.id2} is {getattr(contact.phys, name):g}, and {value:g} by their materials"
                )
                break
    if wrong:
        raise ValueError(
            f"{_count(len(wrong), 'joint has', 'joints have')} other numbers than materials and joint_engine give ({wrong[0]}), and LAMMPS has them by types "
            "alone: change the materials as a script changed the joints, or convert the scene before that")


def _of_bodies(scene, joints, makes_bonds, later):
    """(bonds, whole) with which LAMMPS begins with these joints: whole all of them or none, and all of those with
    strength bonded or none.
    """
    bonded = [contact for contact in joints if contact.phys.bonded]
    if bonded or any(_would_lose(contact.phys) for contact in joints):
        bonds, whole = bool(bonded), max(later, 1)
    else:
        bonds, whole = makes_bonds, later
    lost = []
    if whole > 0:
        broken = [contact for contact in joints if contact.phys.broken and _weakens(contact.phys)]
        lost += _few(broken, "joint has broken, and would be whole", "joints have broken, and would be whole")
        loose = [contact for contact in joints if not contact.phys.bonded and _has_strength(contact.phys)
                 and not (contact.phys.broken and _weakens(contact.phys))]
        lost += _few(loose if bonds else [], "joint has no bond, and would have one",
                     "joints have no bond, and would have one")
    lost += _few([contact for contact in bonded if contact.phys.damage > 0], "bond is damaged, and would not be",
                 "bonds are damaged, and would not be")
    lost += _few([contact for contact in bonded if _opens(scene, contact)],
                 "bond has opened at an edge, and would lose its area there",
                 "bonds have opened at an edge, and would lose their area there")
    if later > 1 and bonds != makes_bonds:
        lost.append(f"joints made in the next {later - 1} steps would {'' if bonds else 'not '}be bonded")
    if lost:
        raise ValueError(
            f"the scene has {_count(len(bonded), 'bond', 'bonds')} in {_count(len(joints), 'joint', 'joints')}, and LAMMPS begins with new ones, all alike: "
            + "; ".join(lost) + ". Convert the scene before its first step, or while its bonds are as they were made")
    sheared = [
        contact for contact in bonded
        if max(contact.phys.shearForce.norm(),
               abs(contact.phys.twistMoment) / _reach(contact.phys)) > _NO_FORCE * contact.phys.normalForce.norm()
    ]
    if sheared:
        most = max(contact.phys.shearForce.norm() for contact in sheared)
        warn(
            f"{_few(sheared, 'bond holds shear or twist', 'bonds hold shear or twist')[0]}, up to {most:.3g} N, and LAMMPS begins without that: convert the scene before its first step"
        )
    return bonds, whole


def _of_walls(joints, later):
    """Steps before which joints with walls are whole."""
    bonded = [contact for contact in joints if contact.phys.bondArea > 0]
    if bonded:
        warn(
            f"{_few(bonded, 'bond with a wall', 'bonds with walls')[0]}: walls of LAMMPS make none; take fixed bodies in their place"
        )
    kept = any(_would_lose(contact.phys) for contact in joints)
    whole = max(later, 1) if kept else later
    broken = [contact for contact in joints if contact.phys.broken and _weakens(contact.phys)]
    if whole > 0 and broken:
        raise ValueError(
            f"{_few(broken, 'joint with a wall has broken, and would be whole', 'joints with walls have broken, and would be whole')[0]}: "
            "LAMMPS begins with all joints alike; convert the scene before its first step")
    return whole


def _weakens(phys):
    """Whether the joint has less strength once it has broken."""
    return phys.cohesion != phys.residualCohesion or phys.tangensOfFrictionAngle != phys.tangensOfResidualFrictionAngle


def _would_lose(phys):
    return not phys.broken and _weakens(phys)


def _has_strength(phys):
    return phys.cohesion > 0 or phys.tensileStrength > 0


def _reach(phys):
    """Of the bond from its centre, length."""
    return max((math.hypot(*phys.bondRim[i:i + 2]) for i in range(0, len(phys.bondRim), 2)), default=1.0) or 1.0


def _opens(scene, contact):
    """Whether the springs of a bond are open at a corner of it, so that the bodies do not overlap there."""
    phys = contact.phys
    if phys.bondArea <= 0:
        return False
    one, other = scene.bodies[contact.id1].state, scene.bodies[contact.id2].state
    axes1, axes2 = one.ori * phys.bondTurn1, other.ori * phys.bondTurn2
    axis, angle = (axes1.conjugate() * axes2).toAxisAngle()
    midway = axes1 * type(one.ori)(axis, 0.5 * angle)
    way = other.pos + image_shift(contact) + other.ori * phys.bondPoint2 - one.pos - one.ori * phys.bondPoint1
    along, turn = (midway.conjugate() * way + phys.bondDisplacement)[0], angle * axis + phys.bondRotation
    rim = phys.bondRim
    openings = [along + turn[1] * z - turn[2] * y for y, z in zip(rim[::2], rim[1::2])] or [along]
    return max(openings) > 1e-3 * max(0.0, -min(openings))


def _pair(contact):
    return min(contact.id1, contact.id2), max(contact.id1, contact.id2)


def _count(number, one, more):
    return f"{number} {one if number == 1 else more}"


def _few(contacts, one, more):
    """[how many, what, and the first of them]; [] for none."""
    if not contacts:
        return []
    names = ", ".join(f"{contact.id1} and {contact.id2}"
                      for contact in contacts[:3]) + (", ..." if len(contacts) > 3 else "")
    return [f"{_count(len(contacts), one, more)} ({names})"]


def parameters(one, other, radii, given=None):
    """What ConicJointPhys of two ConicJointMat has, of bodies with these bounding radii (that of the particle for a
    wall, too), by name, and restitution.

    given: what an engine of rock.joint_engine gives the joint, in the place of that.
    """
    pairs = list(zip((one, other), radii))
    for material, _ in pairs:
        if type(material).__name__ != "ConicJointMat":
            raise ValueError(f"a body has a {type(material).__name__}: the law of joints takes ConicJointMat")

    def normal(material, radius):
        return material.normalStiffness or material.young / (2 * radius)

    def shear(material, radius):
        return material.shearStiffness or material.poisson * normal(material, radius)

    def mean(stiffness):
        left, right = (stiffness(*pair) for pair in pairs)
        return 2 * left * right / (left + right) if left + right > 0 else 0.0

    def least(name):
        return min(float(getattr(material, name)) for material, _ in pairs)

    residual = min(material.residualFrictionAngle if material.residualFrictionAngle >= 0 else material.frictionAngle
                   for material, _ in pairs)
    found = {
        "normalStiffness": mean(normal), "shearStiffness": mean(shear), "tangensOfFrictionAngle": math.tan(
            least("frictionAngle")), "tangensOfResidualFrictionAngle": math.tan(residual), **{
                name: least(name)
                for name in ("restitution", "cohesion", "residualCohesion", "tensileStrength", "softening")
            }
    }
    return {**found, **of_engine(given)} if given else found


def law(one, other, radii, of_wall=False, given=None):
    """The same as coefficients of LAMMPS."""
    of = parameters(one, other, radii, given)
    friction, residual = of["tangensOfFrictionAngle"], of["tangensOfResidualFrictionAngle"]
    words = f"{of['normalStiffness']!r} {of['shearStiffness']!r} {friction!r} {of['restitution']!r}"
    if of["cohesion"] > 0:
        words += f" cohesion {of['cohesion']!r}"
    if of["residualCohesion"] > 0 or residual != friction:
        words += f" residual {residual!r} {of['residualCohesion']!r}"
    if not of_wall and of["tensileStrength"] > 0:
        words += f" tension {of['tensileStrength']!r} softening {of['softening']!r}"
    return words
