# SPDX-License-Identifier: GPL-3.0-or-later
"""Few planes for a surface of many: scans as particles.

The facets of the convex hull are gathered into N groups of like direction, by Lloyd's method on their normals with
their areas as weights (the metric L2,1 of Cohen-Steiner, Alliez & Desbrun 2004, Variational shape approximation). A
plane with the mean direction of each group touches the hull, so that the planes lie about it and hold too much; the
rounding radius r is chosen so that what it takes away at edges and corners is this surplus, and the particle has the
volume of the surface. Where that takes r out of its range, all planes move by one distance instead.
"""
import dataclasses
import math
import warnings

import numpy as np
from scipy.optimize import brentq

from .arguments import MOST_PLANES, positive, whole
from .polyhedron import Polyhedron, rotation
from .rounding import ROUNDING
from .shape import Fit

# Of the size: between them r is chosen. Below, overlaps would have to be tiny; beyond, faces are hardly flat any more.
LEAST_R, MOST_R = 0.02, 0.3
# A surface whose faces are all kept loses at most this share of its volume to r, if r is not given.
LOST = 0.01
# Most planes of a surface for which a script says nothing: each costs time in every contact.
MOST_FACES = 60
# Beyond this difference of volume a warning is given.
WARNED = 0.02
# Of mass properties, relative, as they bound it: what they are off is below a thousandth of that, and a fit is off by
# more.
TOLERANCE = 1e-3

_ROUNDS, _RAYS, _SAMPLES = 15, 600, 2000
# Numbers of planes that are tried for a given error.
_LADDER = (6, 8, 10, 12, 15, 18, 22, 27, 33, 40, 50, 60, 75, 90, 110, 135, 165, 200, 250, 300, 400, 500, 700, 1000)


def of_surface(hull, samples, volume, rounding, name, planes=None, error=None):
    """The Shape of a hull, a Polyhedron, with its Fit to samples (m, 3) of the surface and its volume.

    planes: at most so many, or "all" faces of the hull, where they are; error: as few as leave no sample further from
    the particle than this share of the equivalent diameter; with neither, all faces of a hull of at most MOST_FACES,
    else so many planes, with a warning that tells the error. rounding: a Rounding; where it does not say how large r
    is, the volume is kept.
    """
    by_default = planes is None and error is None
    if by_default or planes == "all":
        if planes == "all" or len(hull.planes) <= MOST_FACES:
            share = ROUNDING if rounding.is_chosen else _share_of_all_faces(hull, rounding)
            return _with_fit(hull.rounded(*rounding.lengths(hull.size, share), name), samples, volume)
        planes = MOST_FACES
    most = None if planes is None else whole(planes, 4, MOST_PLANES, "planes")
    if error is None:
        shape = _of_planes(hull, samples, volume, most, rounding, name)
        if by_default:
            _warn(f"{name}: {len(shape.planes)} planes in the place of the {len(hull.planes)} faces of the hull, up to "
                  f"{shape.fit.largest:.2g} of its diameter off: planes=N or error=e chooses, planes=\"all\" keeps all")
        return shape
    error, closest = positive(error, "error"), math.inf
    for number in [one for one in _LADDER if most is None or one < most] + ([] if most is None else [most]):
        shape = _of_planes(hull, samples, volume, number, rounding, name)
        if shape.fit.largest <= error:
            return shape
        closest = min(closest, shape.fit.largest)
        if len(hull.planes) <= number:
            break
    raise ValueError(
        f"{name}: error={error:g} is not reached with up to {number} planes, which leave {closest:.2g} of the diameter: "
        "allow a larger error or more planes, or cut a surface that is not convex (shapes.clump_from_mesh)")


def warn_of_volume(shape, what):
    """SceneWarning where the volume of a shape is more than 2 % off that of its surface."""
    off = shape.volume / shape.fit.volume - 1.0
    if abs(off) > WARNED:
        _warn(
            f"{what}: the shape has {100.0 * abs(off):.2g} % {'more' if off > 0 else 'less'} volume than the surface: "
            + ("it is not convex; planes=N keeps the volume, shapes.clump_from_mesh the form" if off >
               0 else f"leave r={shape.r:.3g} out, give a smaller one, or planes=N, which keeps the volume"))
    return shape


def _warn(text):
    from .check import SceneWarning
    warnings.warn_explicit(f"potential_particles: {text}", SceneWarning, "potential_particles", 0)


def _of_planes(hull, samples, volume, number, rounding, name):
    normals = _directions(hull, number)
    middle = hull.centroid
    offsets = (normals @ (hull.corners - middle).T).max(1)
    outer = Polyhedron.of_planes(normals, offsets)
    size, centre = outer.size, outer.centroid
    heights = outer.offsets - outer.normals @ centre
    given, k, shadow = rounding.lengths(size, 0.1)
    R = np.linalg.norm(outer.corners - centre, axis=1).max() if shadow is None else shadow
    rays = _sphere(_RAYS)
    # Of this grid of rays the volume is off by less than a thousandth; the hull itself says by how much.
    wanted = volume * (_reach(hull.normals, hull.offsets - hull.normals @ (middle + centre), rays)**
                       3).sum() / hull.volume

    def surplus(share, shift):
        return (_radii(_lowered(outer.normals, heights + shift, size * share, k, R), size * share, k, R, rays)**
                3).sum() - wanted

    # A shift that would turn the body inside out is beyond any fit.
    least, most = -0.3 * size, 0.3 * size
    share, shift = given / size, 0.0
    if not rounding.is_chosen:
        low, high = surplus(LEAST_R, 0.0), surplus(MOST_R, 0.0)
        share = LEAST_R if low <= 0.0 else MOST_R if high >= 0.0 else brentq(surplus, LEAST_R, MOST_R,
                                                                             (0.0, ), xtol=1e-4)
    if rounding.is_chosen or share in (LEAST_R, MOST_R):
        if surplus(share, least) > 0.0 or surplus(share, most) < 0.0:
            raise ValueError(
                f"{name}: {number} planes about its hull do not enclose the volume of the surface: it is far from convex "
                "(shapes.clump_from_mesh cuts it into convex parts), or r is too large")
        shift = brentq(lambda moved: surplus(share, moved), least, most, xtol=1e-6 * size) if k < 1.0 else 0.0
    polyhedron = outer if shift == 0.0 else Polyhedron.of_planes(outer.normals, outer.offsets + shift)
    shape = polyhedron.rounded(size * share, k, shadow, name, TOLERANCE)
    # About its own centroid: it stays where it is.
    centroid = tuple((np.array(shape.centroid) + middle).tolist())
    shape = dataclasses.replace(shape.scaled((volume / shape.volume) ** (1.0 / 3.0)), centroid=centroid)
    return _with_fit(shape, samples, volume)


def _directions(hull, number):
    """At most so many unit normals (n, 3) for the facets of a hull."""
    a, b, c = (hull.corners[hull.triangles[:, i]] for i in range(3))
    facets = np.cross(b - a, c - a)
    weights = np.linalg.norm(facets, axis=1)
    facets = facets / np.where(weights > 0.0, weights, 1.0)[:, None]
    # The first ones by area times distance from those that there are.
    chosen = [facets[np.argmax(weights)]]
    distance = np.full(len(facets), math.inf)
    while True:
        distance = np.minimum(distance, ((facets - chosen[-1]) ** 2).sum(1))
        worst = int(np.argmax(weights * distance))
        if len(chosen) == number or distance[worst] < 1e-12:
            break
        chosen.append(facets[worst])
    normals = np.array(chosen)
    for _ in range(_ROUNDS):
        group = np.argmax(facets @ normals.T, axis=1)
        sums = np.stack([np.bincount(group, weights * facets[:, axis], len(normals)) for axis in range(3)], axis=1)
        lengths = np.linalg.norm(sums, axis=1)
        new = np.where(lengths[:, None] > 0.0, sums / np.where(lengths > 0.0, lengths, 1.0)[:, None], normals)
        if np.abs(new - normals).max() < 1e-6:
            break
        normals = new
    return normals


def _share_of_all_faces(hull, rounding):
    """The largest r, as a share of the size and up to the default, which costs at most LOST of the volume."""
    centre, rays = hull.centroid, _sphere(_RAYS)
    heights = hull.offsets - hull.normals @ centre
    farthest = np.linalg.norm(hull.corners - centre, axis=1).max()
    whole_body = (_reach(hull.normals, heights, rays) ** 3).sum()

    def lost(share):
        r, k, shadow = rounding.lengths(hull.size, share)
        R = farthest if shadow is None else shadow
        return 1.0 - (_radii(_lowered(hull.normals, heights, r, k, R), r, k, R, rays) ** 3).sum() / whole_body

    if rounding.k == 1.0 or lost(ROUNDING) <= LOST:
        return ROUNDING
    return brentq(lambda share: lost(share) - LOST, 1e-6, ROUNDING, xtol=1e-5) if lost(1e-6) < LOST else 1e-3


def _lowered(normals, heights, r, k, R):
    """Planes (n, 4) of the particle whose faces are at `heights` above its centre: src/shapes/rounding.rs."""
    if k == 1.0:
        return []
    depth = r * np.sqrt(np.maximum(1.0 - k * (heights / R) ** 2, 0.0) / (1.0 - k))
    return np.column_stack([normals, heights - depth])


def _reach(normals, heights, rays):
    """Where rays (m, 3) from the centre leave {n.x <= h}."""
    slope = rays @ normals.T
    with np.errstate(divide="ignore"):
        return np.where(slope > 0.0, heights / slope, math.inf).min(1)


def _with_fit(shape, samples, volume):
    """The shape with its Fit: how far samples (n, 3), in the builder's frame, lie from its surface, to first order."""
    if len(samples) > _SAMPLES:
        samples = samples[np.linspace(0, len(samples) - 1, _SAMPLES).astype(int)]
    local = (samples - np.array(shape.centroid)) @ rotation(shape.orientation)
    distance = np.linalg.norm(local, axis=1)
    rays = local / np.where(distance > 0.0, distance, 1.0)[:, None]
    radii = _radii(shape.planes, shape.r, shape.k, shape.R, rays)
    gradient = _gradients(shape.planes, shape.r, shape.k, shape.R, rays * radii[:, None])
    across = np.abs(distance - radii) * (gradient * rays).sum(1) / np.linalg.norm(gradient, axis=1)
    diameter = (6.0 * volume / math.pi) ** (1.0 / 3.0)
    return dataclasses.replace(
        shape, fit=Fit(float(across.max() / diameter), float(np.sqrt((across**2).mean()) / diameter), float(volume)))


def _sphere(number):
    """Unit vectors (number, 3) spread evenly: Fibonacci's spiral."""
    z = 1.0 - (2.0 * np.arange(number) + 1.0) / number
    angle = np.pi * (3.0 - math.sqrt(5.0)) * np.arange(number)
    return np.column_stack([np.sqrt(1.0 - z * z) * np.cos(angle), np.sqrt(1.0 - z * z) * np.sin(angle), z])


def _radii(planes, r, k, R, rays):
    """Where rays (n, 3) from the centre leave the particle: the root of S - 1, convex along a ray, by Newton's method
    from outside.
    """
    if not len(planes):
        return np.full(len(rays), R / math.sqrt(k))
    planes = np.asarray(planes, float)
    slope, offsets = rays @ planes[:, :3].T, planes[:, 3]
    weight, ball = (1.0 - k) / r**2, k / R**2
    # Beyond one plane by r / sqrt(1 - k), S is 1 at least.
    reach = _reach(planes[:, :3], offsets + r / math.sqrt(1.0 - k), rays)
    reach = np.minimum(reach, R / math.sqrt(k)) if k > 0.0 else reach
    for _ in range(50):
        beyond = np.maximum(reach[:, None] * slope - offsets, 0.0)
        step = (weight * (beyond**2).sum(1) + ball * reach**2 - 1.0) / (2.0 * weight *
                                                                        (beyond * slope).sum(1) + 2.0 * ball * reach)
        reach = reach - np.maximum(step, 0.0)
        if (step <= 1e-12 * reach).all():
            break
    return reach


def _gradients(planes, r, k, R, points):
    """Of S/2 at points (n, 3)."""
    if not len(planes):
        return points
    planes = np.asarray(planes, float)
    beyond = np.maximum(points @ planes[:, :3].T - planes[:, 3], 0.0)
    return (1.0 - k) / r**2 * beyond @ planes[:, :3] + k / R**2 * points
