# SPDX-License-Identifier: MIT OR Apache-2.0
"""The sharp convex polyhedron behind a particle, and the Shape that is made of it by rounding: by the library."""
import numpy as np

from ._core import _shapes
from .shape import Shape

Polyhedron = _shapes.Polyhedron
refuse_open = _shapes.refuse_open

__all__ = ["Polyhedron", "fitted", "principal_axes", "refuse_open", "rotation", "round_shape", "rounded"]


def rounded(polyhedron, r, k, R, name):
    """The Shape whose faces are those of a Polyhedron, with rounding radius r (length), sphericity k and shadow radius R
    (length).

    R=None: to the farthest corner.
    """
    return _named(polyhedron.rounded(r, k, R), name)


def fitted(polyhedron, planes, volume, r, k, R, name, tolerance):
    """The Shape of at most so many planes that comes nearest and has this volume; r=None: what comes nearest."""
    return _named(polyhedron.fitted(planes, volume, r, k, R, tolerance), name)


def round_shape(form, sizes, name, planes=0, rounding=(None, 0.0, None)):
    """The Shape of the size of a round form; `rounding`: r, None for what keeps the size, k and R, lengths."""
    return _named(_shapes.round_form(form, [float(one) for one in sizes], planes, *rounding), name)


def _named(built, name):
    """What _core has built, as a Shape with a name."""
    particle, mass = built.particle, built.mass
    return Shape(planes=tuple(map(tuple, particle.planes.tolist())), r=particle.r, k=particle.k, R=particle.R,
                 volume=mass.volume, sharp_volume=built.sharp_volume, error=mass.error,
                 inertia=tuple(np.diag(mass.inertia).tolist()), centroid=tuple(built.centroid.tolist()),
                 orientation=tuple(built.orientation.tolist()), bounding_radius=particle.bounding_radius, name=name)


def principal_axes(inertia):
    """Principal axes of a symmetric matrix (3, 3), each the one nearest to an axis of its frame.

    (w, x, y, z), w >= 0, from them to the frame; the same as a rotation (3, 3), whose columns they are; the moments
    about them (3,).
    """
    inertia = np.asarray(inertia, float)
    orientation = _shapes.principal_orientation(inertia)
    axes = rotation(orientation)
    return orientation, axes, np.diag(axes.T @ inertia @ axes)


def rotation(orientation):
    """The rotation matrix (3, 3) of (w, x, y, z) of unit length."""
    w, x, y, z = orientation
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                     [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                     [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])
