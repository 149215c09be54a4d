# SPDX-License-Identifier: GPL-3.0-or-later
"""The sharp convex polyhedron behind a particle, from its planes or its points (scipy's Qhull and HiGHS)."""
import numpy as np
from scipy.optimize import linprog
from scipy.spatial import ConvexHull, QhullError

# Two faces are one if, relative to the size of the body, the corners of one lie this close to the plane of the other.
# The numbers of a binary .stl file are good to 6e-8.
COPLANAR = 1e-6

# A body thinner than this share of its length is flat.
FLAT = 1e-9

OPEN = "the planes enclose no volume: add the planes that are missing"


class Polyhedron:
    """{x : n_i.x <= h_i}, bounded: rows of `normals` (n, 3) of unit length, `offsets` (n,), `corners` (m, 3), one frame."""

    def __init__(self, normals, offsets, corners):
        self.normals, self.offsets, self.corners = normals, offsets, corners
        self.ball_centre, self.ball_radius = largest_ball(normals, offsets)

    @classmethod
    def of_points(cls, points):
        """The convex hull of points (n, 3), coplanar triangles of it as one face; ValueError where it has no volume."""
        if len(points) < 4:
            raise ValueError(f"{len(points)} points enclose no volume: at least 4 are needed")
        refuse_flat(points)
        # About their middle and with one length of 1, so that the places and units of the points do not matter.
        middle = 0.5 * (points.max(0) + points.min(0))
        scale = np.ptp(points, axis=0).max()
        hull = ConvexHull((points - middle) / scale)
        normals, offsets = _faces(hull)
        return cls(normals, scale * offsets + normals @ middle, points[hull.vertices])

    @classmethod
    def of_planes(cls, normals, offsets):
        """{n_i.x <= h_i}, without planes that make no face; ValueError where that is empty or has no end."""
        lengths = np.linalg.norm(normals, axis=1)
        if not np.all(lengths > 0.0):
            raise ValueError(f"plane {int(np.argmin(lengths))} has a normal of length zero: give it a direction or remove it")
        normals, offsets = normals / lengths[:, None], offsets / lengths
        centre, radius = largest_ball(normals, offsets)
        # Polar reciprocal about the centre of the ball: the facets of the hull of n/h are the corners of the polyhedron.
        dual = normals * (radius / (offsets - normals @ centre))[:, None]
        try:
            hull = ConvexHull(dual)
        except QhullError:
            raise ValueError(OPEN) from None
        heights = -hull.equations[:, 3]
        if not np.all(heights > FLAT):
            raise ValueError(OPEN)
        corners = centre + radius * hull.equations[:, :3] / heights[:, None]
        used = hull.vertices
        return cls(normals[used], offsets[used], corners)

    @property
    def volume(self):
        """Of the sharp body."""
        return ConvexHull(self.corners - self.ball_centre).volume

    @property
    def centroid(self):
        """Of the volume."""
        hull = ConvexHull(self.corners - self.ball_centre)
        a, b, c = (hull.points[hull.simplices[:, i]] for i in range(3))
        volumes = np.abs(np.einsum("ij,ij->i", a, np.cross(b, c)))
        return self.ball_centre + volumes @ (a + b + c) / (4.0 * volumes.sum())


def largest_ball(normals, offsets):
    """Centre and radius of the largest ball in {n_i.x <= h_i}, |n_i| = 1; ValueError where there is none."""
    scale = np.abs(offsets).max()
    if not scale > 0.0:
        raise ValueError("all planes pass through one point: the planes enclose no volume")
    system = np.column_stack([normals, np.ones(len(normals))])
    found = linprog([0.0, 0.0, 0.0, -1.0], system, offsets / scale, bounds=[(None, None)] * 3 + [(0.0, None)], method="highs")
    if found.status == 2 or found.status == 0 and found.x[3] <= FLAT:
        raise ValueError("no point lies inside all planes: turn their normals outwards, or move them apart")
    if found.status != 0:
        raise ValueError(OPEN)
    return found.x[:3] * scale, found.x[3] * scale


def refuse_flat(points):
    """ValueError if points (n, 3) lie in a plane."""
    middle = points.mean(0)
    _, extents, axes = np.linalg.svd(points - middle, full_matrices=False)
    if not extents[-1] > FLAT * extents[0]:
        normal = ", ".join(f"{one:.3g}" for one in axes[-1])
        place = ", ".join(f"{one:.6g}" for one in middle)
        raise ValueError(f"the {len(points)} points are flat: all lie in the plane through ({place}) with the normal ({normal})")


def _faces(hull):
    """Normals and offsets of the faces of a hull of size 1, large triangles first, without those that lie in another's plane."""
    a, b, c = (hull.points[hull.simplices[:, i]] for i in range(3))
    areas = np.linalg.norm(np.cross(b - a, c - a), axis=1)
    left = np.argsort(-areas, kind="stable")
    normals = []
    while len(left):
        normal = hull.equations[left[0], :3]
        height = (hull.points[hull.vertices] @ normal).max()
        corners = hull.points[hull.simplices[left]] @ normal
        left = left[1:][(corners.min(1) < height - COPLANAR)[1:]]
        normals.append(normal)
    normals = np.array(normals)
    # No corner is cut off.
    return normals, (hull.points[hull.vertices] @ normals.T).max(0)
