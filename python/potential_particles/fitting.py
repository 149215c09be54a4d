# SPDX-License-Identifier: MIT OR Apache-2.0
"""Few planes for a surface of many: scans as particles.

The library finds the planes and r: src/shapes/fitting.rs. What is decided here is how many planes there are, and how
near they come is measured.
"""
import dataclasses
import math

import numpy as np

from .arguments import positive, warn, whole
from .polyhedron import fitted, rotation, rounded
from .rounding import ROUNDING
from .shape import Fit

# A surface whose faces are all kept loses at most this share of its volume to r, if r is not given; below such a share
# of the size r gets no smaller.
LOST, LEAST_SHARE = 0.01, 1e-4
# Most planes of a surface for which a script says nothing: each costs time in every contact.
MOST_FACES = 60
# Beyond this difference of volume a warning is given.
WARNED = 0.02
# Of mass properties, relative, as they bound it: what they are off is below a thousandth of that, and a fit is off by
# more.
TOLERANCE = 1e-3

_SAMPLES = 2000
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
            return _with_fit(_of_all_faces(hull, rounding, name), samples, volume)
        planes = MOST_FACES
    most = None if planes is None else whole(planes, 4, _LADDER[-1], "planes")
    if error is None:
        shape = _of_planes(hull, samples, volume, most, rounding, name)
        if by_default:
            warn(f"{name}: {len(shape.planes)} planes in the place of the {len(hull.planes)} faces of the hull, up to "
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
        warn(
            f"{what}: the shape has {100.0 * abs(off):.2g} % {'more' if off > 0 else 'less'} volume than the surface: "
            + ("it is not convex; planes=N keeps the volume, shapes.clump_from_mesh the form" if off >
               0 else f"leave r={shape.r:.3g} out, give a smaller one, or planes=N, which keeps the volume"))
    return shape


def _of_planes(hull, samples, volume, number, rounding, name):
    r, k, R = rounding.lengths(hull.size)
    shape = fitted(hull, number, volume, r if rounding.is_chosen else None, k, R, name, TOLERANCE)
    return _with_fit(rounding.told_of(shape), samples, volume)


def _of_all_faces(hull, rounding, name):
    """With all faces where they are; without a given r the largest, up to the default, that costs at most LOST of the
    volume.
    """
    share = ROUNDING
    while True:
        shape = rounded(hull, *rounding.lengths(hull.size, share), name)
        lost = 1.0 - shape.volume / hull.volume
        if rounding.is_chosen or lost <= LOST or share < LEAST_SHARE:
            return rounding.told_of(shape)
        # It goes with the square of r, or more slowly.
        share *= max(0.1, 0.9 * math.sqrt(LOST / lost))


def _with_fit(shape, samples, volume):
    """The shape with its Fit: how far samples (n, 3), in the builder's frame, lie from its surface, to first order."""
    if len(samples) > _SAMPLES:
        samples = samples[np.linspace(0, len(samples) - 1, _SAMPLES).astype(int)]
    local = (samples - np.array(shape.centroid)) @ rotation(shape.orientation)
    distance = np.linalg.norm(local, axis=1)
    rays = local / np.where(distance > 0.0, distance, 1.0)[:, None]
    reach = radii(shape.planes, shape.r, shape.k, shape.R, rays)
    gradient = _gradients(shape.planes, shape.r, shape.k, shape.R, rays * reach[:, None])
    across = np.abs(distance - reach) * (gradient * rays).sum(1) / np.linalg.norm(gradient, axis=1)
    diameter = (6.0 * volume / math.pi) ** (1.0 / 3.0)
    return dataclasses.replace(
        shape, fit=Fit(float(across.max() / diameter), float(np.sqrt((across**2).mean()) / diameter), float(volume)))


def _reach(normals, heights, rays):
    """Where rays (m, 3) from the centre leave {n.x <= h}."""
    slope = rays @ normals.T
    with np.errstate(divide="ignore"):
        return np.where(slope > 0.0, heights / slope, math.inf).min(1)


def radii(planes, r, k, R, rays):
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
