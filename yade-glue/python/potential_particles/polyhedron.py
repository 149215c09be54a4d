# SPDX-License-Identifier: GPL-3.0-or-later
"""The sharp convex polyhedron behind a particle, and the particle that is made of it by rounding: by the library."""
import functools
import weakref

import numpy as np

from . import library
from .shape import Shape


class Polyhedron:
    """{x : n_i.x <= h_i}, bounded. The frame is that of the planes or points of which it is made."""

    def __init__(self, handle):
        self._handle = handle
        weakref.finalize(self, library.free, "pp_polyhedron_free", handle).atexit = False

    @classmethod
    def of_points(cls, points, known=0.0):
        """The convex hull of points (n, 3); ValueError where it has no volume.

        Triangles that lie within 1e-6 of the extent of the plane of a larger one are one face with it, or within
        `known`, the length to which the points are known.
        """
        points = _rows(points, 3)
        return cls(library.made("pp_polyhedron_from_points", points, len(points), float(known)))

    @classmethod
    def of_planes(cls, normals, offsets):
        """{n_i.x <= h_i}, normals of any length; planes that make no face of their own are left out.

        ValueError where that is empty or has no end.
        """
        planes = np.column_stack([normals, offsets]).astype(float)
        return cls(library.made("pp_polyhedron_from_faces", np.ascontiguousarray(planes), len(planes)))

    @classmethod
    def of_surface(cls, points, triangles, known=0.0):
        """What a closed convex surface encloses: points (n, 3), triangles (m, 3).

        ValueError that says where it is open, not convex or crosses itself.
        """
        points, triangles = _rows(points, 3), np.ascontiguousarray(triangles, np.uint32)
        given = points, len(points), triangles, len(triangles), float(known)
        return cls(library.made("pp_polyhedron_from_surface", *given))

    @classmethod
    def prism(cls, sides, radius, top_radius, height):
        """A regular prism, frustum or pyramid along z from -height/2 to height/2; the first side faces x.

        radius, top_radius: of the circles within its ends.
        """
        return cls(library.made("pp_polyhedron_prism", int(sides), float(radius), float(top_radius), float(height)))

    @classmethod
    def regular_solid(cls, faces, edge):
        """The regular solid of 4, 6, 8, 12 or 20 faces with this length of edges, about the origin."""
        return cls(library.made("pp_polyhedron_regular_solid", int(faces), float(edge)))

    @functools.cached_property
    def planes(self):
        """Rows (n, 4) of a, b, c, h, unit normals: half-spaces in the order given, else the largest face first."""
        return library.rows("pp_polyhedron_faces", self._handle, 4)

    @property
    def normals(self):
        """(n, 3), of unit length."""
        return self.planes[:, :3]

    @property
    def offsets(self):
        """(n,) h, length."""
        return self.planes[:, 3]

    @functools.cached_property
    def corners(self):
        """(m, 3)."""
        return library.rows("pp_polyhedron_corners", self._handle, 3)

    @functools.cached_property
    def triangles(self):
        """(l, 3) numbers of corners, counter-clockwise from outside; those of a face may be several."""
        return library.rows("pp_polyhedron_triangles", self._handle, 3, np.uint32)

    @functools.cached_property
    def _properties(self):
        mass, size = np.empty(11), np.empty(1)
        library.call("pp_polyhedron_properties", self._handle, mass, size)
        return mass, float(size[0])

    @property
    def volume(self):
        """Of the sharp body."""
        return float(self._properties[0][0])

    @property
    def centroid(self):
        """Of the volume."""
        return self._properties[0][1:4]

    @property
    def inertia(self):
        """(3, 3) about the centroid for density 1."""
        xx, yy, zz, xy, yz, zx = self._properties[0][4:10]
        return np.array([[xx, xy, zx], [xy, yy, yz], [zx, yz, zz]])

    @property
    def size(self):
        """The diameter of the largest ball that fits inside."""
        return self._properties[1]

    def rounded(self, r, k, R, name, tolerance=0.0):
        """The Shape whose faces are here, with rounding radius r (length), sphericity k and shadow radius R (length).

        R=None: to the farthest corner. tolerance: of volume and inertia, relative; 0: 1e-6, or 1e-4 of many planes.
        """
        return built("pp_particle_from_polyhedron", self._handle, float(r), float(k), float(R or 0.0), float(tolerance),
                     name=name)

    def fitted(self, planes, volume, r, k, R, name, tolerance=0.0):
        """The Shape of at most so many planes that comes nearest and has this volume; r=None: what comes nearest."""
        return built("pp_particle_fitted", self._handle, int(planes), float(volume), float(r or 0.0), float(k),
                     float(R or 0.0), float(tolerance), name=name)


# Forms of pp_particle_round.
CYLINDER, CONE, ELLIPSOID, CAPSULE, SUPERQUADRIC = range(5)


def round_shape(form, sizes, name, planes=0, rounding=None):
    """The Shape of the size of a round form; `rounding`: r, None for what keeps the size, k and R, lengths."""
    r, k, R = rounding or (None, 0.0, None)
    five = np.zeros(5)
    five[:len(sizes)] = sizes
    return built("pp_particle_round", form, five, int(planes), float(r or 0.0), float(k), float(R or 0.0), name=name)


def built(function, *given, name):
    """The Shape that a function of the library builds."""
    how = np.empty(19)
    particle = library.made(function, *given, results=[how])
    try:
        numbers = np.empty(5)
        for i, what in enumerate(("rounding_radius", "sphericity", "shadow_radius", "bounding_radius")):
            library.call(f"pp_particle_{what}", particle, numbers[i:i + 1])
        planes = library.rows("pp_particle_planes", particle, 4)
    finally:
        library.free("pp_particle_free", particle)
    r, k, shadow, bounding, _ = numbers.tolist()
    how = how.tolist()
    return Shape(planes=tuple(map(tuple, planes.tolist())), r=r, k=k, R=shadow, volume=how[7], sharp_volume=how[18],
                 error=how[17], inertia=tuple(how[11:14]), centroid=tuple(how[:3]), orientation=tuple(how[3:7]),
                 bounding_radius=bounding, name=name)


def refuse_open(points, triangles):
    """ValueError that says where, if an edge of a surface does not join two triangles."""
    points, triangles = _rows(points, 3), np.ascontiguousarray(triangles, np.uint32)
    library.refuse("pp_surface_is_closed", points, len(points), triangles, len(triangles))


def principal_axes(inertia):
    """Principal axes of a symmetric matrix (3, 3), each the one nearest to an axis of its frame.

    (w, x, y, z), w >= 0, from them to the frame; the same as a rotation (3, 3), whose columns they are; the moments
    about them (3,).
    """
    inertia, orientation = np.asarray(inertia, float), np.empty(4)
    six = np.array([inertia[i, j] for i, j in ((0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (0, 2))])
    library.call("pp_principal_axes", six, orientation)
    axes = rotation(orientation)
    return orientation, axes, np.diag(axes.T @ inertia @ axes)


def rotation(orientation):
    """The rotation matrix (3, 3) of (w, x, y, z) of unit length."""
    w, x, y, z = orientation
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                     [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                     [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])


def _rows(points, width):
    return np.ascontiguousarray(points, float).reshape(-1, width)
