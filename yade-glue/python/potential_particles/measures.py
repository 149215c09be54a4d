# SPDX-License-Identifier: GPL-3.0-or-later
"""Extrema, volume, porosity, contacts and stress of scenes with potential particles.

YADE's own count spheres alone: what utils.aabbExtrema(), porosity(), voxelPorosity(), getSpheresVolume() and
RayleighWaveTimeStep() give for these bodies is undefined. kineticEnergy(), momentum(), angularMomentum() and
unbalancedForce() are right (the last is NaN as long as there is no contact).
"""
import math

import numpy as np

from .arguments import positive, vector
from .bodies import image_shift, is_free


def extrema(bodies=None):
    """Lower and upper corner (two Vector3) of a box, world axes, that holds all potential particles and spheres of the
    scene, or those with these ids. It is that of their bounding polyhedra: around a corner or an edge it reaches out
    beyond the surface by what the rounding takes off. ValueError where there is none.
    """
    import yade
    lower, upper = [math.inf] * 3, [-math.inf] * 3
    for body in counted(bodies):
        for axis, (low, high) in enumerate(_extent(body)):
            lower[axis], upper[axis] = min(lower[axis], low), max(upper[axis], high)
    if not all(low <= high for low, high in zip(lower, upper)):
        raise ValueError("there is no potential particle and no sphere, and so no box that holds them")
    return yade.Vector3(*lower), yade.Vector3(*upper)


def solid_volume(bodies=None):
    """Volume of all potential particles and spheres that are no boundaries and not fixed, or of those with these ids,
    length^3; of a clump that of its mass, once.
    """
    return sum(volumes_of_grains(bodies).values())


def volumes_of_grains(bodies=None):
    """{id: volume} of what moves as one: bodies, and clumps by their own id."""
    import yade
    found = {}
    for body in counted(bodies):
        if body.isClumpMember:
            one = yade.O.bodies[body.clumpId]
            found[one.id] = one.state.mass / body.mat.density
        elif bodies is not None or is_grain(body):
            found[body.id] = volume_of(body)
    return found


def porosity(lower=None, upper=None, bodies=None):
    """1 - solid volume / volume of the box between two corners; default: the periodic cell, else extrema() of the
    bodies that move.

    All of a body counts, whether or not it lies within the box; overlaps count twice.
    """
    import yade
    ids = [body.id for body in counted(bodies) if bodies is not None or is_grain(body)]
    if not ids:
        raise ValueError("there is no potential particle and no sphere that moves, and so no porosity")
    if lower is not None or upper is not None:
        sides = vector(upper, "upper") - vector(lower, "lower")
        volume = positive(sides.prod() if (sides > 0.0).all() else 0.0, "volume of the box")
    elif yade.O.periodic:
        volume = yade.O.cell.volume
    else:
        low, high = extrema(ids)
        volume = (high[0] - low[0]) * (high[1] - low[1]) * (high[2] - low[2])
    return 1.0 - solid_volume(ids) / volume


def stress(volume=None, moving=False):
    """Mean stress (Love-Weber) of potential particles and spheres, a Matrix3 in Pa, negative in compression as that of
    YADE's getStress():

        sigma = 1/volume sum over particles, sum over their contacts  f (x_c - x)^T

    f: force on the particle at the contact point x_c, x: its centre of mass (of its clump), so that a contact of two
    particles counts with the vector between their centres and one with a wall from centre to wall. Where all is at
    rest, without gravity, this is force by area of smooth walls. volume: length^3; default: that of the periodic cell.
    ValueError where there is none. Forces are those of normalForce and shearForce of the contact's physics: dashpots
    that a law does not write there are left out.

    moving=True adds 1/volume sum over particles F (x - x_m)^T, F the sum of the contact forces on a particle, which
    accelerates it or is taken by numerical damping, x_m the mean of all x. It is then the stress on the walls to
    rounding, at rest or not (with contact points for places of the walls, and as long as the sum of all F is small
    against the force of a wall); without it the stress within. In a periodic cell, which has no walls, ValueError.
    """
    import yade
    if volume is None and not yade.O.periodic:
        raise ValueError("there is no periodic cell: give the volume in which the particles are, as stress(volume=...)")
    if moving and yade.O.periodic:
        raise ValueError("a periodic cell has no walls: moving=True is for particles between walls")
    sides = _sides()
    total = _sum_of_moments(sides, yade) + (_moment_of_net_forces(sides, yade) if moving else yade.Matrix3.Zero)
    return total / (yade.O.cell.volume if volume is None else positive(volume, "volume"))


def body_stresses():
    """Mean stress within each potential particle and sphere that moves (of clumps, each member by itself): {id:
    Matrix3}, Pa, as stress() with the volume of the body.
    """
    import yade
    from . import _glue
    moments = np.frombuffer(_glue.force_moments()).reshape(-1, 9)
    return {
        body.id: yade.Matrix3(*(moments[body.id] / volume_of(body)).tolist())
        for body in counted(None) if is_grain(body)
    }


def fabric_tensor():
    """1/N sum of n n^T over the N contacts of particles, those with walls included: a Matrix3 of trace 1, n the contact
    normal.

    ValueError where there is no contact.
    """
    import yade
    normals = list({(contact.id1, contact.id2): contact.geom.normal for _, contact, _, _ in _sides()}.values())
    if not normals:
        raise ValueError("there is no contact, and so no fabric tensor")
    return sum((normal.outer(normal) for normal in normals), yade.Matrix3.Zero) / len(normals)


def coordination_number(skip_free=False):
    """Mean number of contacts of a particle, those with walls included.

    skip_free: without particles that bear nothing, of no contact or of one, and without their contacts: (2 C - N_1) /
    (N - N_0 - N_1). ValueError where no particle is left.
    """
    count = {body.id: 0 for body in counted(None) if is_grain(body)}
    for body, _, _, _ in _sides():
        count[body.id] += 1
    numbers = list(count.values())
    left = sum(number > 1 for number in numbers) if skip_free else len(numbers)
    if not left:
        raise ValueError("there is no particle that bears a load" if skip_free else "there is no particle")
    return (sum(numbers) - (numbers.count(1) if skip_free else 0)) / left


def contacts():
    """The scene's contacts. YADE keeps those of an erased body until the next step; they do not count."""
    import yade
    there = {body.id for body in yade.O.bodies}
    return [
        contact for contact in yade.O.interactions if contact.isReal and contact.id1 in there and contact.id2 in there
    ]


def _sides():
    """(body, contact, force on the body, arm from its centre of mass) of each particle that moves in each contact that
    touches or is bonded.
    """
    import yade
    scene, found = yade.O, []
    for contact in contacts():
        if not (getattr(contact.geom, "penetrationDepth", 0.0) > 0.0 or getattr(contact.phys, "bonded", False)):
            continue
        for number, sign in ((contact.id1, -1.0), (contact.id2, 1.0)):
            body = scene.bodies[number]
            if isinstance(body.shape, (yade.PotentialParticle, yade.Sphere)) and is_grain(body):
                centre = scene.bodies[body.clumpId].state.pos if body.isClumpMember else body.state.pos
                if sign > 0.0:
                    centre = centre + image_shift(contact)
                force = sign * (contact.phys.normalForce + contact.phys.shearForce)
                found.append((body, contact, force, contact.geom.contactPoint - centre))
    return found


def _sum_of_moments(sides, yade):
    return sum((force.outer(arm) for _, _, force, arm in sides), yade.Matrix3.Zero)


def _moment_of_net_forces(sides, yade):
    forces, places = {}, {}
    for body, contact, force, arm in sides:
        forces[body.id] = forces.get(body.id, yade.Vector3.Zero) + force
        places[body.id] = contact.geom.contactPoint - arm
    middle = sum(places.values(), yade.Vector3.Zero) / max(len(places), 1)
    return sum((forces[one].outer(places[one] - middle) for one in forces), yade.Matrix3.Zero)


def counted(bodies):
    import yade
    if bodies is None:
        chosen = yade.O.bodies
    else:
        chosen = [one if isinstance(one, yade.Body) else yade.O.bodies[int(one)] for one in bodies]
    return [body for body in chosen if isinstance(body.shape, (yade.PotentialParticle, yade.Sphere))]


def is_grain(body):
    return is_free(body) and not getattr(body.shape, "isBoundary", False)


def _extent(body):
    """(low, high) along each axis."""
    import yade
    shape, place = body.shape, body.state.pos
    if isinstance(shape, yade.Sphere):
        return [(place[axis] - shape.radius, place[axis] + shape.radius) for axis in range(3)]
    if not shape.vertices:
        raise ValueError(f"body {body.id} is a plain PotentialParticle without vertices: its extent is not known")
    corners = [body.state.ori * corner for corner in shape.vertices]
    radius = getattr(shape, "boundingRadius", math.inf)
    along = [[corner[axis] for corner in corners] for axis in range(3)]
    return [(place[axis] + max(min(along[axis]), -radius), place[axis] + min(max(along[axis]), radius))
            for axis in range(3)]


def volume_of(body):
    import yade
    if isinstance(body.shape, yade.Sphere):
        return 4.0 / 3.0 * math.pi * body.shape.radius**3
    density = body.mat.density if body.mat else 0.0
    # Bodies of body() carry their volume as a mass, which takes no time; others are measured.
    if body.state.mass > 0.0 and density > 0.0:
        return body.state.mass / density
    if isinstance(body.shape, yade.ConicPotentialParticle):
        return body.shape.volume
    raise ValueError(f"body {body.id} is a plain PotentialParticle without mass: its volume is not known")


def overlap_ratio():
    """The largest overlap of a contact of potential particles over its rounding radius, the smaller r of the two; 0
    without a contact.

    Of a contact patch it is the largest depth. Results are those of rounded bodies as long as it is below 1.
    """
    return largest_overlap()[0]


def largest_overlap():
    """(overlap over rounding radius, contact) of the contact in which that is largest, or (0, None)."""
    import yade
    largest = 0.0, None
    for contact in contacts():
        if not hasattr(contact.geom, "penetrationDepth"):
            continue
        shapes = (yade.O.bodies[contact.id1].shape, yade.O.bodies[contact.id2].shape)
        # A ball has no rounding but its radius.
        radii = [shape.r if shape.k < 1.0 else shape.R for shape in shapes if isinstance(shape, yade.PotentialParticle)]
        if radii:
            depth = max(contact.geom.penetrationDepth, getattr(contact.geom, "largestDepth", 0.0))
            largest = max(largest, (depth / min(radii), contact), key=lambda one: one[0])
    return largest
