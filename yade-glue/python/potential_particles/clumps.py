# SPDX-License-Identifier: GPL-3.0-or-later
"""Clumps of bodies that overlap: mass and inertia of their union.

O.bodies.clump() adds up the members, and counts twice where they overlap. Here the moments of the members, which are
known, are added up and what
overlaps is taken off: the moments of chords less those of their union, along parallel lines. Where nothing overlaps the
    sum is that of YADE.
"""
import numpy as np

from . import chords
from .time_step import bounding_radius

_DIRECTION = (0.4123, 0.6181, 0.6692)  # of the lines: along no face of a body whose faces lie along the axes


def clump(bodies, lines=20_000, seed=0):
    """Makes a clump of bodies, given by their ids, with the mass and inertia of their union; returns the id of the
    clump.

    Members keep their place; potential particles and spheres of one density. Overlaps are measured along about `lines`
    lines in grids that are shifted at random by `seed`: of cubes that share a quarter, to 1e-4 of the mass. ValueError
    for bodies that make no clump.
    """
    import yade
    members = [yade.O.bodies[int(one)] for one in bodies]
    mass, centre, inertia, _ = union(members, lines, seed)
    moments, axes = np.linalg.eigh(inertia)
    axes[:, 2] *= np.sign(np.linalg.det(axes))
    # YADE finds place and axes of a clump from its members, once: here from one that has the mass of all, and goes
    # again. It turns the inertia of a member the other way round, which is why this one stands so.
    whole_body = yade.Body()
    whole_body.shape, whole_body.mat = yade.Shape(), members[0].mat
    whole_body.state.pos, whole_body.state.ori = yade.Vector3(*centre), _quaternion(axes.T)
    whole_body.state.mass, whole_body.state.inertia = mass, yade.Vector3(*moments)
    own = [(one.shape, one.state.mass, yade.Vector3(*one.state.inertia)) for one in members]
    for one, (_, weight, about) in zip(members, own):
        # Of spheres YADE would take the radius.
        one.shape, one.state.mass, one.state.inertia = yade.Shape(), 1e-30 * weight, 1e-30 * about
    carrier = yade.O.bodies.append(whole_body)
    number = yade.O.bodies.clump([one.id for one in members] + [carrier])
    yade.O.bodies.erase(carrier)
    for one, (shape, weight, about) in zip(members, own):
        one.shape, one.state.mass, one.state.inertia = shape, weight, about
    return number


def add_clump(parts, material=None, position=(0.0, 0.0, 0.0), orientation=(1.0, 0.0, 0.0, 0.0), **more):
    """Appends bodies of shapes.clump_from_mesh (or of any Shapes that stand in one frame) and makes a clump of them;
    returns its id.

    position, orientation: of the frame of the file, as for body(), to which `more` goes (color, mask, ...).
    """
    import yade
    from .bodies import body
    shapes = getattr(parts, "shapes", parts)
    ids = yade.O.bodies.append([body(one, material, position, orientation, **more) for one in shapes])
    return clump(ids) if len(ids) > 1 else ids[0]


def union(members, lines=20_000, seed=0):
    """(mass, centre of mass (3,), inertia about it (3, 3), error of the mass over it) of the union of bodies of one
    density, world axes.
    """
    import yade
    if len(members) < 2:
        raise ValueError("a clump has two members or more")
    for one in members:
        if one is None or not isinstance(one.shape, (yade.PotentialParticle, yade.Sphere)) or not one.state.mass > 0.0:
            raise ValueError(
                f"body {None if one is None else one.id}: members are potential particles and spheres with a "
                "mass; facets move together by MovingMesh(ids=..., mass=..., free=\"z\")")
        if one.mat is None or one.mat.density != members[0].mat.density:
            raise ValueError(
                "the members differ in density, and what the overlap weighs is not known: give them one density")
    origin = np.mean([list(one.state.pos) for one in members], axis=0)
    excess, scattered = chords.scatter(
        [members[0].mat.density * one for one in _overlaps(members, origin, lines, seed)])
    total = _sum_of_members(members, origin) - excess
    mass, first, second = total[0], total[1:4], total[4:].reshape(3, 3)
    centre = first / mass
    about = second - mass * np.outer(centre, centre)
    return mass, origin + centre, np.trace(about) * np.eye(3) - about, scattered[0] / mass


def _sum_of_members(members, origin):
    """Mass, first and second moments (13,) about the origin."""
    total = np.zeros(13)
    for one in members:
        turn = np.array(one.state.ori.toRotationMatrix())
        inertia = np.array(list(one.state.inertia))
        place, mass = np.array(one.state.pos) - origin, one.state.mass
        second = turn @ np.diag(0.5 * inertia.sum() - inertia) @ turn.T + mass * np.outer(place, place)
        total += np.concatenate([[mass], mass * place, second.ravel()])
    return total


def _overlaps(members, origin, lines, seed):
    """For each grid of lines, volume and moments (13,) of the members less those of their union."""
    along = np.array(_DIRECTION) / np.linalg.norm(_DIRECTION)
    across = np.linalg.svd(along[None])[2][1:]
    places = [np.array(one.state.pos) - origin for one in members]
    radii = [bounding_radius(one) for one in members]
    lower = np.min([across @ place - radius for place, radius in zip(places, radii)], axis=0)
    upper = np.max([across @ place + radius for place, radius in zip(places, radii)], axis=0)
    feet, count = chords.grids(lines, seed)
    feet = (feet * (upper - lower) + lower) @ across
    number, begin, end = [], [], []
    for one, place, radius in zip(members, places, radii):
        back = np.array(one.state.ori.conjugate().toRotationMatrix())
        enter, leave = chords.chords(one.shape, (feet - place) @ back.T, back @ along, radius)
        hit = np.flatnonzero(leave > enter)
        number.append(hit)
        begin.append(enter[hit])
        end.append(leave[hit])
    number, begin, end = map(np.concatenate, (number, begin, end))
    area = np.prod(upper - lower) / count
    difference = _moments(feet, along, number, begin, end) - _moments(feet, along, *chords.united(number, begin, end))
    return area * difference.reshape(chords.GRIDS, -1, 13).sum(1)


def _moments(feet, along, line, begin, end):
    """Length, first and second moments (13,) of the intervals on each line, (lines, 13)."""
    powers = [(end**n - begin**n) / n for n in (1, 2, 3)]
    zeroth, first, second = (np.bincount(line, one, len(feet)) for one in powers)
    mixed = feet[:, :, None] * along
    products = (zeroth[:, None, None] * feet[:, :, None] * feet[:, None, :] + first[:, None, None] *
                (mixed + mixed.swapaxes(1, 2)) + second[:, None, None] * np.outer(along, along))
    return np.concatenate([zeroth[:, None], zeroth[:, None] * feet + first[:, None] * along,
                           products.reshape(-1, 9)], axis=1)


def _quaternion(axes):
    import yade
    return yade.Quaternion(yade.Matrix3(*axes.ravel()))
