# SPDX-License-Identifier: GPL-3.0-or-later
"""From a polyhedron to a particle: where its faces, its centre and its axes are.

Let h_i be the distance of face i from the centre of the particle. The planes of the particle lie at

    d_i = h_i - r sqrt((1 - k h_i^2/R^2) / (1 - k))

so that S = 1 at the foot of the perpendicular from the centre on the face (as long as no other plane counts there): the particle touches the
face at this foot and lies inside the polyhedron everywhere. Away from the foot a face is deeper by at most r (1/sqrt(1-k) - 1), which is
about r k/2; for k = 0 it is flat, d_i = h_i - r, as YADE has it. Edges and corners are rounded.

The shadow sphere is about the centre, which YADE wants at the centroid: with k > 0 the shape depends on it a little. It is found by
repetition, each time with the centroid of the last shape as the centre.
"""
import numpy as np

from .principal_frame import principal_axes, quaternion
from .shape import Shape

# Fractions of the size (the diameter of the largest ball inside), and k itself: what docs/shapes.md advises.
ROUNDING, SPHERICITY = 0.05, 0.02

# Of volume, centroid and inertia, relative.
TOLERANCE = 1e-6

# The repetition ends when the centre is the centroid to this share of the size (or a tenth of the last tolerance), found with fewer digits, which takes
# far less time. A last step with all digits follows; the shape does not change by it, but in the product of this share and k.
CENTRED, ROUGHLY = 1e-5, 1e-4
MOST_STEPS = 50


def rounded(polyhedron, r, k, R, name, tolerance=TOLERANCE):
    """The Shape of a polyhedron with rounding radius r, sphericity k and shadow radius R, lengths; R=None: to the farthest corner."""
    return _settled(lambda centre: _planes(polyhedron, r, k, R, centre), polyhedron.centroid, 2.0 * polyhedron.ball_radius, name, tolerance)


def ball(radius, name):
    """The Shape of a sphere: k = 1, no planes."""
    return _settled(lambda centre: ([], 0.0, 1.0, radius), np.zeros(3), 2.0 * radius, name, TOLERANCE)


def _planes(polyhedron, r, k, R, centre):
    if R is None:
        R = np.linalg.norm(polyhedron.corners - centre, axis=1).max()
    heights = polyhedron.offsets - polyhedron.normals @ centre
    return about(polyhedron.normals, heights, r, k, R), r, k, R


def about(normals, heights, r, k, R):
    """Rows (a, b, c, d) of faces at `heights` above the centre."""
    if k == 1.0:
        return []
    # A face beyond the sphere is never reached, and keeps its place.
    depth = r * np.sqrt(np.maximum(1.0 - k * (heights / R) ** 2, 0.0) / (1.0 - k))
    return [(*map(float, n), float(d)) for n, d in zip(normals, heights - depth)]


def _settled(definition_about, centre, size, name, tolerance):
    """The Shape with its centroid as its centre, in principal axes. `definition_about(centre)`: planes, r, k, R."""
    from yade.wrapper import ConicPotentialParticle
    rough, near = max(ROUGHLY, 10.0 * tolerance), max(CENTRED, 0.1 * tolerance) * size
    for _ in range(MOST_STEPS):
        planes, r, k, R = definition_about(centre)
        particle = ConicPotentialParticle(planes=planes, r=r, k=k, R=R)
        shift = np.array(particle.massProperties(rough)[1])
        if np.abs(shift).max() <= near:
            break
        centre = centre + shift
    else:
        raise ValueError(f"{name}: no centre is its own centroid, to which k={k:g} with R={R:g} leads: take a smaller k, or a larger R")
    volume, shift, inertia, error = particle.massProperties(tolerance)
    # The centroid is known no better than this.
    if np.abs(np.array(shift)).max() > TOLERANCE * size:
        centre = centre + np.array(shift)
        planes, r, k, R = definition_about(centre)
    axes, moments = principal_axes(np.array([[inertia[i, j] for j in range(3)] for i in range(3)]))
    turned = [(*map(float, np.array(plane[:3]) @ axes), plane[3]) for plane in planes]
    final = ConicPotentialParticle(planes=turned, r=r, k=k, R=R)
    return Shape(
        planes=tuple(turned), r=float(r), k=float(k), R=float(R), volume=float(volume), error=float(error),
        inertia=tuple(map(float, moments)), centroid=tuple(map(float, centre)),
        orientation=tuple(map(float, quaternion(axes))), bounding_radius=float(final.boundingRadius), name=name)
