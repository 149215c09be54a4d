# SPDX-License-Identifier: MIT OR Apache-2.0
"""The shape of a surface from a file: its convex hull, if the surface is that hull or the script accepts it."""
import itertools
import os

import numpy as np
from . import fitting, mesh_text
from .arguments import bearable, needed, positive
from .gts_file import read_gts
from .polyhedron import Polyhedron
from .rounding import SPHERICITY, Rounding

# Of the extent of a body: points nearer than that are one.
SAME = 1e-7
READERS = {**mesh_text.READERS, ".gts": read_gts}


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
    known = mesh_text.known_to(points)
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


def volume_within(points, triangles):
    """Volume of a closed surface whose triangles all go round the same way, or else of the convex hull; so, too, of one
    that encloses nothing.
    """
    ways = triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)
    closed = len(np.unique(ways, axis=0)) == len(ways) and np.array_equal(np.unique(ways, axis=0),
                                                                          np.unique(ways[:, ::-1], axis=0))
    middle = points.mean(0)
    a, b, c = (points[triangles[:, i]] - middle for i in range(3))
    enclosed = abs(np.einsum("ij,ij->i", a, np.cross(b, c)).sum()) / 6.0 if closed else 0.0
    return enclosed or Polyhedron.of_points(points).volume


def read(file):
    """Points (n, 3) and triangles (m, 3), numbers of points, of a file; equal points are one. ValueError if it holds
    none.
    """
    points, polygons = mesh_text.read(file, READERS, ".stl (binary or text), .obj and .gts")
    points = bearable(points, f"{file}: point")
    if os.fspath(file).lower().endswith(".gts"):
        return points, polygons
    points, triangles = _once(points, polygons)
    if len(triangles) == 0:
        raise ValueError(f"{file} holds no triangles of three different points")
    return points, triangles


def scaled(points, scale, file):
    """Points of a file times its scale, or ValueError."""
    return bearable(points * scale, f"{file}, times scale={scale:g}: point")


def _once(points, polygons):
    """Points of which those within about 1e-7 of the extent of the body are one, the first, and polygons as triangles
    of three different points.
    """
    # Equal points first, which files of triangles are full of.
    _, first, equal = np.unique(points, axis=0, return_index=True, return_inverse=True)
    distinct, near = points[first], first.copy()
    size = SAME * np.ptp(points, axis=0).max()
    # Of two points as near as that one of eight grids, shifted by half a cell, has both in one cell.
    for shift in np.ndindex(2, 2, 2) if size > 0.0 else ():
        cells = np.floor((distinct - points.min(0)) / (2.0 * size) + 0.5 * np.array(shift))
        _, of_cell = np.unique(cells, axis=0, return_inverse=True)
        least = np.full(len(distinct), len(points))
        np.minimum.at(least, of_cell.ravel(), near)
        near = least[of_cell.ravel()]
    first = near[equal.ravel()]
    kept, places = np.unique(first, return_inverse=True)
    if not isinstance(polygons, np.ndarray):  # which are triangles
        corners = itertools.chain.from_iterable(_triangles(points, polygon) for polygon in polygons)
        polygons = np.fromiter(corners, np.dtype((np.int64, 3)))
    triangles = places.ravel()[polygons]
    return points[kept], triangles[(triangles != np.roll(triangles, 1, axis=1)).all(axis=1)]


def _triangles(points, polygon):
    """A polygon as triangles: a fan, or, where it is not convex, what VTK makes of it."""
    if len(polygon) == 3:
        return [polygon]
    around = points[polygon] - np.mean(points[polygon], axis=0)
    turns = np.cross(around - np.roll(around, 1, axis=0), np.roll(around, -1, axis=0) - around)
    if (turns @ np.cross(around, np.roll(around, -1, axis=0)).sum(axis=0) < 0.0).any():
        shape = needed("vtkmodules.vtkCommonDataModel", "vtk").vtkPolygon()
        for number, point in enumerate(points[polygon]):
            shape.GetPointIds().InsertNextId(number)
            shape.GetPoints().InsertNextPoint(point)
        found = needed("vtkmodules.vtkCommonCore", "vtk").vtkIdList()
        shape.Triangulate(found)
        numbers = [polygon[found.GetId(i)] for i in range(found.GetNumberOfIds())]
        return list(zip(numbers[::3], numbers[1::3], numbers[2::3]))
    return [(polygon[0], *two) for two in zip(polygon[1:-1], polygon[2:])]
