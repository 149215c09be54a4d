# SPDX-License-Identifier: GPL-3.0-or-later
"""YADE bodies made of shapes; what moves a body and with it, its size, and where
its periodic image is."""
import difflib
import functools
import inspect
import math

from ._core import _packing
from .arguments import number, unit_quaternion, vector
from .packing import obstacles_of

# By definition (planes, r, k, R), of the shapes that have made particles: to measure a volume takes 10 ms.
volumes = {}


def definition(particle):
    """A number of 64 bits by which the definition of a ConicPotentialParticle is known; the definitions themselves
    would fill the memory.
    """
    return hash((tuple(particle.planes), particle.r, particle.k, particle.R))


def conic_particle(shape, **attributes):
    """A new ConicPotentialParticle of a Shape; `attributes` are further ones of it (isBoundary, color, ...)."""
    from yade.wrapper import ConicPotentialParticle
    made = ConicPotentialParticle(planes=list(shape.planes), r=shape.r, k=shape.k, R=shape.R, **attributes)
    volumes[definition(made)] = shape.volume
    return made


def guard(container):
    """O.bodies.append of a shape names body(), where YADE lists the types of its arguments; O.bodies.clump of bodies
    without mass, which ends YADE, names what moves them together.
    """
    import yade
    from .shape import Shape
    append = container.append

    @functools.wraps(append)
    def appended(self, *arguments, **keywords):
        shape = arguments and isinstance(arguments[0], (Shape, yade.Shape)) and type(arguments[0]).__name__
        if shape:
            raise TypeError(f"O.bodies.append takes bodies, and this is a {shape}: "
                            "make one by potential_particles.body(shape, position=...)")
        return append(self, *arguments, **keywords)

    clump, append_clumped = container.clump, container.appendClumped

    @functools.wraps(clump)
    def clumped(self, ids, *arguments, **keywords):
        _require_mass([self[int(one)] for one in ids])
        return clump(self, ids, *arguments, **keywords)

    @functools.wraps(append_clumped)
    def appended_clumped(self, bodies, *arguments, **keywords):
        _require_mass(bodies)
        return append_clumped(self, bodies, *arguments, **keywords)

    container.append, container.clump, container.appendClumped = appended, clumped, appended_clumped


def _require_mass(members):
    if members and not any(one is not None and one.state.mass > 0.0 for one in members):
        kinds = ", ".join(sorted({type(one.shape).__name__ for one in members if one is not None}))
        raise ValueError(f"the members of the clump ({kinds}) have no mass, of which YADE makes no clump: facets move "
                         "together by MovingMesh(ids=..., mass=..., free=\"z\")")


def body(shape, material=None, position=(0.0, 0.0, 0.0), orientation=(1.0, 0.0, 0.0, 0.0), fixed=False, color=None,
         mask=None, velocity=None, angular_velocity=None, **attributes):
    """A yade Body of a Shape, with mass, inertia and box, ready for O.bodies.append.

    material: a Material, the number or label of one in O.materials, or None for the last one there. position (length)
    and orientation (a Quaternion, or w, x, y, z) place the frame in which the shape was built: for a shape about its
    centroid, as sphere(), cuboid() or platonic_solid() make them, that is the centre; one from a file stands as in the
    file, for the default values. The state of the body is that of its centroid and principal axes. velocity (of the
    centroid) and angular_velocity: world frame.
    fixed: no force moves it. attributes: further ones of ConicPotentialParticle (isBoundary, wire, ...).
    ValueError for what makes no body; the scene is never touched.
    """
    import yade
    from .shape import Shape
    known = set(inspect.signature(body).parameters) | set(yade.ConicPotentialParticle().dict())
    for name in attributes:
        if name not in known:
            near = difflib.get_close_matches(name, known - {"attributes"}, 1)
            raise ValueError(f"body has no keyword {name}" + (f": did you mean {near[0]}?" if near else ""))
    if not isinstance(shape, Shape):
        raise ValueError(f"shape is {type(shape).__name__}, not a Shape: make one by potential_particles.shapes")
    material = material_of(material)
    to_frame, from_principal = _quaternion(orientation, "orientation"), _quaternion(shape.orientation,
                                                                                    "shape.orientation")
    place = yade.Vector3(*vector(position, "position")) + to_frame * yade.Vector3(*shape.centroid)
    if color is not None:
        attributes["color"] = yade.Vector3(*vector(color, "color"))

    made = yade.Body()
    made.shape = conic_particle(shape, **attributes)
    made.mat = material
    made.state = material.newAssocState()
    made.state.mass = shape.volume * material.density
    made.state.inertia = yade.Vector3(*shape.inertia) * material.density
    made.state.pos = made.state.refPos = place
    made.state.ori = made.state.refOri = to_frame * from_principal
    if velocity is not None:
        made.state.vel = yade.Vector3(*vector(velocity, "velocity"))
    if angular_velocity is not None:
        made.state.angVel = yade.Vector3(*vector(angular_velocity, "angular_velocity"))
        # What YADE's integrator of bodies that are no spheres goes on from.
        made.state.angMom = _angular_momentum(made.state)
    made.aspherical = True
    if mask is not None:
        made.mask = int(mask)
    if fixed:
        made.state.blockedDOFs = "xyzXYZ"
    return made


def add_packing(placements, material=None, **more):
    """Appends the bodies of a packing to O.bodies; their ids. `more` goes to body() (fixed, color, mask, ...).

    ValueError where one overlaps what the scene has, which pack() leaves free by obstacles=O.bodies.
    """
    import yade
    scaled = {}
    made, placements = [], list(placements)
    _require_free(placements)
    for placement in placements:
        key = id(placement.shape), placement.scale
        if key not in scaled:
            scaled[key] = placement.shape.scaled(placement.scale)
        made.append(body(scaled[key], material, placement.position, placement.orientation, **more))
    return yade.O.bodies.append(made)


def _require_free(placements):
    import yade
    from . import _glue
    if not placements:
        return
    at = [(one.pose.position, one.shape.bounding_radius * one.scale) for one in placements]
    lower = [min(place[axis] - radius for place, radius in at) for axis in range(3)]
    upper = [max(place[axis] + radius for place, radius in at) for axis in range(3)]
    near = _glue.bodies_near(yade.Vector3(*lower), yade.Vector3(*upper), False)
    there = obstacles_of(yade.O.bodies[i] for i in near)
    free = _packing.are_free([(one.particle, one.pose) for one in placements], there) if there else []
    if not all(free):
        raise ValueError(f"{free.count(False)} of {len(free)} bodies overlap what the scene has: "
                         "pack(..., obstacles=O.bodies) leaves that free")


def is_free(body):
    """Whether forces move a body in any of its degrees of freedom."""
    return set(body.state.blockedDOFs) != set("xyzXYZ")


def owner(body):
    """What moves: the clump of a member, any other body itself."""
    import yade
    return yade.O.bodies[body.clumpId] if body.isClumpMember else body


def size_of(body):
    """The radius of a ball of its mass and its largest moment of inertia, length."""
    return math.sqrt(2.5 * max(body.state.inertia) / body.state.mass)


def lasting(of, body):
    """What O.forces.permF or permT has of a body."""
    import yade
    if not yade.O.forces.getPermForceUsed():
        return yade.Vector3.Zero
    # YADE reads beyond its table for bodies that have none, until forces are summed up.
    yade.O.forces.f(len(yade.O.bodies) - 1, True)
    return of(body.id)


def image_shift(contact):
    """From body id2 of a contact to its periodic image that touches body id1, world axes, length."""
    import yade
    return yade.O.cell.hSize * contact.cellDist if yade.O.periodic else yade.Vector3.Zero


def into_cell(body):
    """From a body to where it is drawn in a periodic cell, as YADE draws spheres; a clump's members stay together."""
    import yade
    if not yade.O.periodic:
        return yade.Vector3.Zero
    place = owner(body).state.pos
    return yade.O.cell.wrap(place) - place


def material_of(material):
    """A Material, from itself, its number or label in O.materials, or None for the last one there."""
    import yade
    known = yade.O.materials
    if material is None:
        if len(known) == 0:
            raise ValueError("there is no material: append one to O.materials, or give material=FrictMat(...)")
        material = len(known) - 1
    if not isinstance(material, yade.Material):
        try:
            material = known[material]
        except (IndexError, KeyError, TypeError, RuntimeError) as error:
            raise ValueError(
                f"material={material!r} is neither a Material nor the number or label of one in O.materials") from error
    if not number(material.density, "density") > 0.0:
        raise ValueError(f"density={material.density:g} of the material must be above 0")
    return material


def _quaternion(value, name):
    import yade
    w, x, y, z = map(float, unit_quaternion(value, name))
    return yade.Quaternion(w, x, y, z)


def _angular_momentum(state):
    local = state.ori.conjugate() * state.angVel
    return state.ori * type(local)(*(i * w for i, w in zip(state.inertia, local)))
