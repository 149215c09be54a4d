# SPDX-License-Identifier: GPL-3.0-or-later
"""The law of joints of a scene in LAMMPS's words: what its materials give two bodies, as Ip2_ConicJointMat_ConicJointMat_ConicJointPhys has it."""
import math

from .joints import LAW


def settings(scene):
    """(patch tolerance, words after pair_style ... patch TOL, step before which contacts are whole) of the scene's joints; None without its law."""
    for engine in scene.engines:
        laws = [type(law).__name__ for law in getattr(getattr(engine, "lawDispatcher", None), "functors", ())]
        if LAW not in laws:
            continue
        tolerances = [functor.patchTolerance for functor in engine.geomDispatcher.functors if getattr(functor, "patch", False)]
        physics = [functor for functor in engine.physDispatcher.functors if type(functor).__name__ == "Ip2_ConicJointMat_ConicJointMat_ConicJointPhys"]
        if not tolerances or not physics:
            raise ValueError(f"{LAW} without Ip2_ConicJointMat_ConicJointMat_ConicJointPhys, or without patch=True of a contact functor: nothing to carry over")
        return min(tolerances), bool(physics[0].bonds), max(physics[0].cohesiveTresholdIteration - scene.iter, 0)
    return None


def law(one, other, radii, of_wall=False):
    """Coefficients of the joint of two ConicJointMat, of bodies with these bounding radii (that of the particle for a wall, too), as text."""
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

    angle = least("frictionAngle")
    residual = min(material.residualFrictionAngle if material.residualFrictionAngle >= 0 else material.frictionAngle for material, _ in pairs)
    words = f"{mean(normal)!r} {mean(shear)!r} {math.tan(angle)!r} {least('restitution')!r}"
    if least("cohesion") > 0:
        words += f" cohesion {least('cohesion')!r}"
    if least("residualCohesion") > 0 or residual != angle:
        words += f" residual {math.tan(residual)!r} {least('residualCohesion')!r}"
    if not of_wall and least("tensileStrength") > 0:
        words += f" tension {least('tensileStrength')!r} softening {least('softening')!r}"
    return words
