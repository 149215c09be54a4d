# SPDX-License-Identifier: GPL-3.0-or-later
"""From a polyhedron to a particle: where its faces, its centre and its axes are.

Let h_i be the distance of face i from the centre of the particle. The planes of the particle lie at

    d_i = h_i - r sqrt((1 - k h_i^2/R^2) / (1 - k))

so that S = 1 at the foot of the perpendicular from the centre on the face (as long as no other plane counts there): the particle touches the
face at this foot and lies inside the polyhedron everywhere. Away from the foot a face is deeper by at most r (1/sqrt(1-k) - 1), which is
about r k/2; for k = 0 it is flat, d_i = h_i - r, as YADE has it. Edges and corners are rounded.

The shadow sphere is about the centre, which YADE wants at the centroid: with k > 0 the shape depends on it a little. It is found by
repetition, each time with the centroid of the last shape as the centre (the library's src/shapes/rounding.rs).
"""
import numpy as np

# Fractions of the size (the diameter of the largest ball inside), and k itself: what docs/shapes.md advises.
ROUNDING, SPHERICITY = 0.05, 0.02


def about(normals, heights, r, k, R):
    """Rows (a, b, c, d) of faces at `heights` above the centre."""
    if k == 1.0:
        return []
    # A face beyond the sphere is never reached, and keeps its place.
    depth = r * np.sqrt(np.maximum(1.0 - k * (heights / R) ** 2, 0.0) / (1.0 - k))
    return [(*map(float, n), float(d)) for n, d in zip(normals, heights - depth)]
