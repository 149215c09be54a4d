# SPDX-License-Identifier: GPL-3.0-or-later
"""The shape of a surface from a file: its convex hull, if the surface is that hull or the script accepts it."""
import os

import numpy as np
from . import fitting
from .arguments import bearable, positive
from .gts_file import read_gts
from .mesh_text import read_obj, read_stl
from .polyhedron import Polyhedron
from .rounding import SPHERICITY, Rounding

# How far from its plane four corners may put a face, over the largest coordinate, if each is off by half a unit of the
# seventh digit, 5e-7 at most, or of the last digit of single precision, 6e-8.
OF_SEVEN_DIGITS, OF_SINGLE = 4e-6, 5e-7

READABLE = ".stl (binary or text), .obj, .gts"


def from_mesh(file, rounding=None, k=SPHERICITY, R=None, hull=False, scale=1.0, name=None, planes=None, error=None, *,
              r=None):
    """Of a closed convex surface in a file (.stl, .obj, .gts), in the file's frame, all lengths multiplied by `scale`.

    A surface that is open, not convex or crosses itself is a ValueError that says where, in the file's numbers;
    hull=True takes its convex hull instead. A flat one is an error in any case.
    Its faces are those of the hull, if they are at most 60, else 60 planes with a SceneWarning; planes="all": all of
    them; planes=N: at most N; error=e: as few as leave no point of the surface further away than e times its equivalent
    diameter. Without rounding and r, r is chosen so that the volume is that of the surface where N or e is given, else
    it is the default, or less where that would cost more than 1 % of the volume. A shape that is more than 2 % off is
    made with a SceneWarning. `shape.fit` has the distances, of all faces too.
    """
    scale = positive(scale, "scale")
    points, triangles = read(file)
    known = known_to(points)
    try:
        # With the numbers of the file, which the errors name.
        surface = Polyhedron.of_points(points, known) if hull else Polyhedron.of_surface(points, triangles, known)
    except ValueError as error:
        raise ValueError(f"{file}: {error}{' (hull=True)' if 'hull of its points' in str(error) else ''}") from None
    if scale != 1.0:
        points = scaled(points, scale, file)
        surface = Polyhedron.of_points(points, known * scale)
    samples = np.concatenate([points[np.unique(triangles)], points[triangles].mean(1)])
    name = name or os.path.splitext(os.path.basename(file))[0]
    shape = fitting.of_surface(surface, samples, volume_within(points, triangles), Rounding(rounding, k, r, R), name,
                               planes, error)
    return fitting.warn_of_volume(shape, f"{file}")


def known_to(points):
    """The length to which points of a file are known, by their digits."""
    some = points[:1000].ravel()
    is_short = all(float(f"{one:.7g}") == one for one in some)
    of_digits = OF_SEVEN_DIGITS if is_short else OF_SINGLE if np.array_equal(some, some.astype(np.float32)) else 0.0
    return of_digits * float(np.abs(points).max())


def volume_within(points, triangles):
    """Volume of a closed surface whose triangles all go round the same way, or else of the convex hull."""
    ways = triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)
    closed = len(np.unique(ways, axis=0)) == len(ways) and np.array_equal(np.unique(ways, axis=0),
                                                                          np.unique(ways[:, ::-1], axis=0))
    middle = points.mean(0)
    a, b, c = (points[triangles[:, i]] - middle for i in range(3))
    return abs(np.einsum("ij,ij->i", a, np.cross(b, c)).sum()) / 6.0 if closed else Polyhedron.of_points(points).volume


def read(file):
    """Points (n, 3) and triangles (m, 3), numbers of points, of a file; equal points are one. ValueError if it holds
    none.
    """
    file = os.fspath(file)
    if not os.path.isfile(file):
        raise ValueError(f"{file} is no file")
    kind = os.path.splitext(file)[1].lower()
    readers = {".stl": read_stl, ".obj": read_obj, ".gts": read_gts}
    if kind not in readers:
        raise ValueError(f"{file}: files that can be read are {READABLE}")
    try:
        points, polygons = readers[kind](file)
    except (OSError, ValueError) as error:
        raise ValueError(f"{file} cannot be read as {kind}: {error}") from None
    points, triangles = bearable(points, f"{file}: point"), polygons
    if kind != ".gts" and len(polygons):
        points, triangles = _once(points, polygons)
    if len(triangles) == 0:
        raise ValueError(f"{file} holds no triangles: it is empty, or not what its ending says")
    return points, triangles


def scaled(points, scale, file):
    """Points of a file times its scale, or ValueError."""
    return bearable(points * scale, f"{file}, times scale={scale:g}: point")


def _once(points, polygons):
    """Points of which those within 1e-7 of the diagonal of the body are one, and polygons as triangles, by VTK."""
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkFiltersCore import vtkCleanPolyData, vtkTriangleFilter
    from .output import vtk_files
    once, triangles = vtkCleanPolyData(), vtkTriangleFilter()
    once.SetTolerance(1e-7)
    triangles.PassVertsOff()
    triangles.PassLinesOff()
    once.SetInputData(vtk_files.polygons(points, polygons))
    triangles.SetInputConnection(once.GetOutputPort())
    triangles.Update()
    found = triangles.GetOutput()
    if found.GetNumberOfPolys() == 0:
        return points, np.zeros((0, 3), int)
    return (vtk_to_numpy(found.GetPoints().GetData()).astype(float),
            vtk_to_numpy(found.GetPolys().GetConnectivityArray()).reshape(-1, 3).astype(int))
