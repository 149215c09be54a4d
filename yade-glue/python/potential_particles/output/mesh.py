# SPDX-License-Identifier: GPL-3.0-or-later
"""Closed triangle meshes of shapes, and the files .stl and .vtp that hold them."""
import os
from dataclasses import dataclass

import numpy as np

from .. import _glue
from ..bodies import conic_particle
from ..shape import Shape


@dataclass
class Mesh:
    """Triangles, local frame of their shape.

    points (n, 3); normals (n, 3), of the surface at the points, unit length, outwards; triangles (m, 3), indices of
    points, counter-clockwise from outside; error: no point of the surface is further from the mesh, length.
    """

    points: np.ndarray
    normals: np.ndarray
    triangles: np.ndarray
    error: float

    def moved(self, position, orientation):
        """The mesh of the shape at a position, turned by a quaternion of YADE."""
        turn = rotation_matrix(orientation)
        return Mesh(self.points @ turn.T + np.asarray(position, float), self.normals @ turn.T, self.triangles,
                    self.error)


def mesh(shape, tolerance=1e-3):
    """The surface of a PotentialParticle, or of a Shape of this package, as a Mesh: closed, inside the particle, its
    points on the surface.

    tolerance: the largest distance from the surface to the mesh, over the bounding radius of the particle, 1e-5 to 1.
    The bound that the mesh keeps is its `error`. ValueError for a tolerance out of range and a shape that is no
    particle.
    """
    if isinstance(shape, Shape):
        shape = conic_particle(shape)
    points, normals, triangles, error = _glue.surface_mesh(shape, float(tolerance))
    return Mesh(np.frombuffer(points).reshape(-1, 3), np.frombuffer(normals).reshape(-1, 3),
                np.frombuffer(triangles, np.uint32).reshape(-1, 3).astype(np.int64), error)


def save_mesh(file, what, tolerance=1e-3, position=(0, 0, 0), orientation=None):
    """Writes a mesh to a file .stl (binary) or .vtp (with the normals of the surface at the points).

    what: a shape, a Mesh, or a body, which is written where it stands. position, orientation: where a shape or a Mesh
    is put. The file is written whole or not at all. ValueError for another ending.
    """
    ending = os.path.splitext(file)[1]
    if ending not in (".stl", ".vtp"):
        raise ValueError(f"{file}: a mesh is written as .stl or .vtp, give the file one of these endings")
    if hasattr(what, "state"):
        what, position, orientation = what.shape, what.state.pos, what.state.ori
    made = what if isinstance(what, Mesh) else mesh(what, tolerance)
    if orientation is not None:
        made = made.moved(position, orientation)
    elif any(position):
        made = Mesh(made.points + np.asarray(position, float), made.normals, made.triangles, made.error)
    from . import vtk_files
    if ending == ".stl":
        vtk_files.write_stl(file, made.points, made.triangles)
    else:
        vtk_files.write(file, vtk_files.triangles(made.points, made.triangles, {"normal": made.normals}))


def rotation_matrix(orientation):
    """Of a quaternion of YADE, (3, 3): local to world."""
    return np.array(orientation.toRotationMatrix())
