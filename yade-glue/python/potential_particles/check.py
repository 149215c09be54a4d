# SPDX-License-Identifier: GPL-3.0-or-later
"""What YADE does silently although it is wrong for potential particles, looked for in the scene as it stands."""
import functools
import math
from typing import NamedTuple

import numpy as np

from . import time_step, tools, traps, unserved
from .arguments import is_friction_angle, warn
from .bodies import definition, is_free, volumes
from .clumps import union
from .measures import largest_overlap

# Lever arms of spheres: for bodies of any other shape the torque is wrong.
_SPHERES_ONLY = {
    "Law2_ScGeom_MindlinPhys_HertzWithLinearShear": "Law2_ScGeom_MindlinPhys_Mindlin",
    "Law2_ScGeom_MindlinPhys_MindlinDeresiewitz": "Law2_ScGeom_MindlinPhys_Mindlin",
    "Law2_ScGeom_JCFpmPhys_JointedCohesiveFrictionalPM": "ConicJointMat with its physics and law, which has bonds"
}
# Right in a box, wrong where a pair lies across a border of the cell.
_NOT_PERIODIC = ("Law2_ScGeom_MindlinPhys_Mindlin", "Law2_SCG_KnKsPhys_KnKsLaw")
_PERIODIC = "Law2_ScGeom_FrictPhys_CundallStrack(sphericalBodies=False)"
# Relative; masses of bodies made by hand are rarely better, and moments of inertia that agree as well integrate as
# those of a sphere.
_MASS_TOLERANCE = _INERTIA_TOLERANCE = 0.01
# Shapes made by hand whose volume, and clumps whose union is measured before the first step, at 10 ms each; check()
# measures all.
_MEASURED_AT_FIRST = 50


class Finding(NamedTuple):
    """Something in the scene that is wrong, and what to do."""

    what: str
    remedy: str

    def __str__(self):
        return f"{self.what}: {self.remedy}"


def check():
    """Looks for mistakes of which YADE says nothing; prints a line for each, and returns them as a list of (what,
    remedy).

    Shapes without a box or without a contact functor; prescribed normals (fixedNormal) beside patches; boxes without
    thickness; compaction by growing spheres; friction angles that are no radians in [0, pi/2); laws with the lever arms
    of spheres; overlaps beyond the rounding radius; O.dt beyond critical_time_step(safety=1), or left to a stepper that
    knows no contact yet; masses that are not volume times density (1 %); clumps that are not the union of their
    members; weights that the stiffness cannot bear within r; rotation integrated as that of spheres; YADE's own contact
    functor; boxes that do not follow a turn; materials without Ip2 or law; spins without angular momentum; cells smaller
    than two bodies; engines and laws that do not serve these bodies (tools.py). The list is empty
    where none is found, and in scenes without potential particles. Call it when bodies, engines and O.dt are set, and
    again after some steps, when there are contacts.
    """
    import yade
    from .yade import _prepare_ours
    if not yade.O.running:
        _prepare_ours(yade)
    found = findings(yade.O, math.inf)
    for one in found:
        print(f"potential_particles: {one}")
    return found


def findings(scene, measured=_MEASURED_AT_FIRST):
    """What check() returns; the functors of the scene have been looked up. measured: the most volumes measured."""
    import yade
    from .yade import _dispatchers
    ours = [body for body in scene.bodies if isinstance(body.shape, yade.PotentialParticle)]
    if not ours:
        return []
    bounds, geometry, physics = _dispatchers(yade)
    moving = [body for body in ours if is_free(body)]
    return [*_bounds(scene, bounds), *_contacts(scene, geometry), *_flat_boxes(yade, scene), *_controllers(scene),
            *_angles(yade, ours), *_laws(scene, ours, physics), *_overlap(), *_time_step(scene),
            *_mass(yade, moving, measured), *_clumps(scene, measured), *_weight(scene, moving),
            *_rotation(scene, moving),
            *(Finding(*one) for found in (traps.functors_of_yade(ours, geometry), traps.turning_boxes(scene, moving),
                                          traps.materials_without_law(scene, ours, geometry, physics),
                                          traps.lost_spins(scene, moving), traps.small_cells(scene, ours),
                                          tools.silent_engines(scene, ours)) for one in found)]


class Watch:
    """Warns of what check() finds, of each thing once in a scene: before and after its first step, when it has its first
    contacts, when the first overlap beyond r was counted, and when its bodies or engines have become others; once more after a body has got another shape, whose
    mass YADE leaves as it was.
    """

    def __init__(self):
        self.seen, self.told = None, set()

    def shape_has_changed(self):
        self.seen, self.told = None, set()

    def look(self, scene):
        if scene.iter == 0:
            self.told = set()
        functors = [type(functor).__name__ for engine in scene.engines for part in ("geomDispatcher", "lawDispatcher")
                    for functor in getattr(getattr(engine, part, None), "functors", ())]
        # A scene without a contact loop is not complete, or has its contacts elsewhere.
        now = (len(scene.bodies), functors, scene.iter > 0, scene.interactions.countReal() > 0, _deep_overlaps(scene) > 0)
        if not functors or (scene.iter > 0 and now == self.seen):
            return
        self.seen = now
        try:
            found = findings(scene)
        except Exception as error:  # A look at a scene must not end its run.
            found = [Finding(f"the scene could not be looked at ({error!r})", "please report it")]
        for one in found:
            if one.remedy not in self.told:
                self.told.add(one.remedy)
                warn(str(one))


def _deep_overlaps(scene):
    """How often functors of ours have found an overlap beyond the rounding radius r."""
    return sum(getattr(functor, "deepOverlaps", 0) for engine in scene.engines
               for functor in getattr(getattr(engine, "geomDispatcher", None), "functors", ()))


def notice_shapes(yade, watch):
    """Lets the watch know when a script gives a body in the scene another shape, or a shape another definition."""
    def noticing(setter, counts):
        @functools.wraps(setter)
        def set_and_notice(owner, value):
            setter(owner, value)
            if counts(owner, value):
                watch.shape_has_changed()
        return set_and_notice

    conic, body = yade.wrapper.ConicPotentialParticle, yade.wrapper.Body
    for name in ("planes", "r", "k", "R"):
        given = getattr(conic, name)
        setattr(conic, name, property(given.fget, noticing(given.fset, lambda *_: True), doc=given.__doc__))
    conic.updateAttrs = noticing(conic.updateAttrs,
                                 lambda _, attributes: not {"planes", "r", "k", "R"}.isdisjoint(attributes))
    body.shape = property(body.shape.fget, noticing(body.shape.fset, lambda owner, _: owner.id >= 0),
                          doc=body.shape.__doc__)


def _bodies(ids):
    """A few of the ids, and how many there are."""
    few = ", ".join(map(str, ids[:3])) + (", ..." if len(ids) > 3 else "")
    return f"body {few}" if len(ids) == 1 else f"{len(ids)} bodies ({few})"


def _engines(scene, name):
    return [engine for engine in scene.engines if type(engine).__name__ == name and not engine.dead]


def _bounds(scene, dispatchers):
    import yade
    for group in unserved.groups(scene.bodies):
        known = isinstance(group.shape, yade.PotentialParticle) or group.name in unserved.REMEDIES
        if known and not any(dispatcher.dispFunctor(group.shape) for dispatcher in dispatchers):
            name = "PotentialParticle2AABB" if isinstance(group.shape,
                                                          yade.PotentialParticle) else f"Bo1_{group.name}_Aabb"
            yield Finding(
                f"the collider makes no boxes for {group.name} ({group.count}), so that these bodies touch nothing",
                f"add {name}() to the collider")


def _contacts(scene, dispatchers):
    for pair, remedy in unserved.pairs(scene.bodies, dispatchers):
        yield Finding(f"bodies pass through each other because the contact loop has no functor for {pair}", remedy)
    fixed = [
        body for body in scene.bodies
        if getattr(body.shape, "fixedNormal", False) and body.shape.boundaryNormal.norm() > 0.0
    ]
    for functor in [one.dispFunctor(fixed[0].shape, fixed[0].shape) for one in dispatchers] if fixed else ():
        if getattr(functor, "patch", False):
            yield Finding(
                f"{_bodies([body.id for body in fixed])}: fixedNormal=True, and no contact by {type(functor).__name__}(patch=True), "
                "as a patch has the normal of its pressure",
                "give the shape fixedNormal=False, or the functor patch=False")


def _flat_boxes(yade, scene):
    flat = [body.id for body in scene.bodies if isinstance(body.shape, yade.Box) and not min(body.shape.extents) > 0.0]
    if flat:
        yield Finding(f"{_bodies(flat)}: a Box without thickness is no particle, and bodies pass through it",
                      "give it a thickness, as by aabbWalls(thickness=...), or take Wall or Facet")


def _controllers(scene):
    if any(one.internalCompaction for one in _engines(scene, "TriaxialStressController")):
        yield Finding("TriaxialStressController(internalCompaction=True) lets spheres grow, and does nothing here",
                      "give it internalCompaction=False")


def _angles(yade, ours):
    for material in {body.mat.id: body.mat for body in ours if isinstance(body.mat, yade.FrictMat)}.values():
        if not is_friction_angle(material.frictionAngle):
            yield Finding(f"material {material.id} in O.materials has frictionAngle={material.frictionAngle:g}",
                          "give radians in [0, pi/2)")


def _laws(scene, ours, dispatchers):
    import yade
    # Beside ours there may be spheres with a material and a law of their own.
    materials = list({type(body.mat): body.mat for body in ours if body.mat}.values())
    others = list({type(body.mat): body.mat for body in scene.bodies if body.mat}.values())
    made = {type(functor).__name__ for dispatcher in dispatchers for one in materials for other in others
            for functor in [dispatcher.dispFunctor(one, other)] if functor}
    for name in tools.untried_laws(scene, made):
        yield Finding(f"{name} has not been tried with these bodies; most laws take the lever arms of spheres",
                      "compare torques with arm times force, or use a law of docs/laws.md")
    for law in [
            law for engine in scene.engines for law in getattr(getattr(engine, "lawDispatcher", None), "functors", ())
    ]:
        name, (geometry, physics) = type(law).__name__, law.bases
        without = [
            type(one).__name__ for engine in scene.engines
            for one in getattr(getattr(engine, "geomDispatcher", None), "functors", ())
            if not getattr(one, "rotations", True)
        ]
        if geometry == "ScGeom6D" and without:
            yield Finding(
                f"{name} asks for a geometry with bending and twist, and passes over contacts of potential particles",
                f"give {', '.join(without)} the keyword rotations=True")
        if geometry != "ScGeom" and name != "Law2_SCG_KnKsPhys_KnKsLaw" or not any(
                one.endswith("_" + physics) for one in made):
            continue
        if isinstance(law, yade.Law2_ScGeom_FrictPhys_CundallStrack) and law.sphericalBodies:
            yield Finding(f"{name} takes the lever arms of spheres, and its torques are wrong",
                          "give it sphericalBodies=False")
        elif name in _SPHERES_ONLY:
            instead = _PERIODIC if scene.periodic and _SPHERES_ONLY[name] in _NOT_PERIODIC else _SPHERES_ONLY[name]
            yield Finding(f"{name} takes the lever arms of spheres, and its torques are wrong", f"use {instead}")
        elif scene.periodic and name in _NOT_PERIODIC:
            yield Finding(f"{name} has wrong torques where a pair lies across a border of the periodic cell",
                          f"use {_PERIODIC}")


def _overlap():
    ratio, contact = largest_overlap()
    if ratio > 1.0:
        yield Finding(f"bodies {contact.id1} and {contact.id2} overlap by {ratio:.3g} of the rounding radius r",
                      "start them apart (pack), take a stiffer contact, or a larger r")


def _time_step(scene):
    try:
        limit = time_step.critical_time_step(safety=1.0)
    except ValueError:
        return
    steppers = [one for one in _engines(scene, "GlobalStiffnessTimeStepper") if one.active]
    ours = any("time_step.follow" in one.command for one in _engines(scene, "PyRunner"))
    if not steppers and not ours and scene.dt > limit:
        yield Finding(
            f"O.dt={scene.dt:.3g} s is beyond {limit:.3g} s, up to which contacts are known to act as springs",
            "O.dt = potential_particles.critical_time_step(), or the engine potential_particles.time_stepper()")
    for stepper in steppers:
        if not 0.0 < stepper.defaultDt <= limit and not any(contact.isReal for contact in scene.interactions):
            yield Finding(
                "GlobalStiffnessTimeStepper takes a step of about 1 s as long as there is no contact",
                "use potential_particles.time_stepper(), or give it defaultDt=potential_particles.critical_time_step()")


def _mass(yade, moving, measured):
    wrong, made_by_hand = [], {}
    for body in moving:
        shape, density = body.shape, body.mat.density if body.mat else 0.0
        if not isinstance(shape, yade.ConicPotentialParticle) or not shape.planes or density <= 0.0:
            continue
        key = definition(shape)
        if key not in volumes and key not in made_by_hand:
            if len(made_by_hand) >= measured:
                continue
            # Ten times as fast as shape.volume, and more exact than what is compared.
            made_by_hand[key] = shape.massProperties(0.1 * _MASS_TOLERANCE)[0]
        expected = density * (volumes[key] if key in volumes else made_by_hand[key])
        if not math.isclose(body.state.mass, expected, rel_tol=_MASS_TOLERANCE):
            wrong.append((body, expected))
    if wrong:
        body, expected = wrong[0]
        yield Finding(f"{_bodies([one.id for one, _ in wrong])}: the mass is not volume times density (body {body.id}: "
                      f"{body.state.mass:.4g}, and {expected:.4g} by its shape and material)",
                      "set state.mass and state.inertia (potential_particles.body does)")


def _clumps(scene, measured):
    wrong = []
    clumps = [body for body in scene.bodies if body.isClump and is_free(body)]
    for body in clumps[:int(min(measured, len(clumps)))]:
        try:
            mass, _, inertia, _ = union([scene.bodies[one] for one in body.shape.members], lines=2000)
        except ValueError:  # members of other shapes, or of several densities
            continue
        turn = np.array(body.state.ori.toRotationMatrix())
        found = turn @ np.diag(tuple(body.state.inertia)) @ turn.T
        if (not math.isclose(body.state.mass, mass, rel_tol=_MASS_TOLERANCE)
                or np.abs(found - inertia).max() > _INERTIA_TOLERANCE * np.abs(inertia).max()):
            wrong.append((body, mass))
    if wrong:
        body, mass = wrong[0]
        yield Finding(
            f"{_bodies([one.id for one, _ in wrong])}: mass or inertia are not those of the union of the clump's members (body {body.id}: "
            f"{body.state.mass:.4g}, and {mass:.4g} where overlaps count once)", "make it by potential_particles.clump")


def _weight(scene, moving):
    gravity = max((one.gravity.norm() for one in _engines(scene, "NewtonIntegrator")), default=0.0)
    try:
        stiffness = time_step.stiffness_rule(scene)
        # Force of the weight, and of an overlap r.
        weights = {
            body.id: (body.state.mass * gravity, stiffness(body, time_step.bounding_radius(body)) * body.shape.r)
            for body in moving
        }
    except ValueError:
        return
    deep = [one for one, (weight, most) in weights.items() if weight > most > 0.0]
    if deep:
        weight, most = weights[deep[0]]
        yield Finding(
            f"{_bodies(deep)}: the weight alone makes overlaps beyond the rounding radius r (body {deep[0]}: {weight / most:.3g} r)",
            "raise the stiffness, or check the units of lengths and of density")


def _rotation(scene, moving):
    turning = [body for body in moving if not set("XYZ") <= set(body.state.blockedDOFs) and not body.isClumpMember
               and max(body.state.inertia) > (1.0 + _INERTIA_TOLERANCE) * min(body.state.inertia)]
    if turning and any(not one.exactAsphericalRot for one in _engines(scene, "NewtonIntegrator")):
        yield Finding("NewtonIntegrator turns bodies as if their moments of inertia were equal",
                      "give it exactAsphericalRot=True")
    spheres = [body.id for body in turning if not body.aspherical]
    if spheres:
        yield Finding(f"{_bodies(spheres)}: turned as if the moments of inertia were equal",
                      "set aspherical=True of the body")
