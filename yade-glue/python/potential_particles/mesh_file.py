# SPDX-License-Identifier: GPL-3.0-or-later
"""The shape of a surface from a file: its convex hull, if the surface is that hull or the script accepts it."""
import os

import numpy as np
from scipy.spatial import ConvexHull

from . import fitting
from .arguments import positive
from .gts_file import read_gts
from .mesh_check import refuse_misstated
from .polyhedron import COPLANAR, refuse_flat
from .rounding import SPHERICITY

READABLE = ".stl (binary or text), .obj, .gts"


def from_mesh(file, r=None, k=SPHERICITY, R=None, hull=False, scale=1.0, name=None, planes=None, error=None):
    """Of a closed convex surface in a file (.stl, .obj, .gts), in the file's frame, all lengths multiplied by `scale`.

    A surface that is open, not convex or crosses itself is a ValueError that says where, in the file's numbers;
    hull=True takes its convex hull instead. A flat one is an error in any case.
    Its faces are those of the hull; planes=N: at most N; error=e: as few as leave no point of the surface further away than e times its equivalent
    diameter. r=None: chosen so that the volume is that of the surface where N or e is given, else the default, or less where that would
    cost more than 1 % of the volume. A shape that is more than 2 % off is made with a SceneWarning. `shape.fit` has the distances, of all faces too.
    """
    scale = positive(scale, "scale")
    points, triangles = read(file)
    remedy = ""
    try:
        refuse_flat(points)
        remedy = f"; hull=True takes the convex hull of its {len(points)} points"
        if not hull:
            refuse_open(points, triangles)
            refuse_concave(points, triangles)
    except ValueError as error:
        raise ValueError(f"{file}: {error}{remedy}") from None
    points = points * scale
    samples = np.concatenate([points[np.unique(triangles)], points[triangles].mean(1)])
    shape = fitting.of_surface(points, samples, volume_within(points, triangles), r, k, R, name or os.path.splitext(os.path.basename(file))[0], planes, error)
    return fitting.warn_of_volume(shape, f"{file}")


def volume_within(points, triangles):
    """Volume of a closed surface whose triangles all go round the same way, or else of the convex hull."""
    ways = triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)
    closed = len(np.unique(ways, axis=0)) == len(ways) and np.array_equal(np.unique(ways, axis=0), np.unique(ways[:, ::-1], axis=0))
    middle = points.mean(0)
    a, b, c = (points[triangles[:, i]] - middle for i in range(3))
    return abs(np.einsum("ij,ij->i", a, np.cross(b, c)).sum()) / 6.0 if closed else ConvexHull(points - middle).volume


def read(file):
    """Points (n, 3) and triangles (m, 3), numbers of points, of a file; equal points are one. ValueError if it holds none."""
    file = os.fspath(file)
    if not os.path.isfile(file):
        raise ValueError(f"{file} is no file")
    kind = os.path.splitext(file)[1].lower()
    readers = {".stl": _by_vtk, ".obj": _by_vtk, ".gts": _by_gts}
    if kind not in readers:
        raise ValueError(f"{file}: files that can be read are {READABLE}")
    points, triangles = readers[kind](file, kind)
    if len(triangles) == 0:
        raise ValueError(f"{file} holds no triangles: it is empty, or not what its ending says")
    if not np.isfinite(points).all():
        raise ValueError(f"{file}: point {int(np.argmin(np.isfinite(points).all(1)))} is not finite")
    return points, triangles


def refuse_open(points, triangles):
    """ValueError if an edge does not join two triangles."""
    edges = np.sort(triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    edges, counts = np.unique(edges, axis=0, return_counts=True)
    for wrong, what in ((counts == 1, "open: {} edges belong to one triangle alone"),
                        (counts > 2, "no single surface: {} edges belong to more than two triangles")):
        if wrong.any():
            raise ValueError(f"the surface is {what.format(np.count_nonzero(wrong))}, the first from {_place(points[edges[wrong][0, 0]])} "
                             f"to {_place(points[edges[wrong][0, 1]])}")


def refuse_concave(points, triangles):
    """ValueError unless the triangles are the surface of the convex hull of the points, and cover it once."""
    middle, size = 0.5 * (points.max(0) + points.min(0)), np.ptp(points, axis=0).max()
    unit = (points - middle) / size
    hull = ConvexHull(unit)
    planes = np.unique(np.round(hull.equations, 12), axis=0)
    centres = unit[triangles].mean(1)
    for places, what in ((unit[np.unique(triangles)], "point"), (centres, "triangle")):
        depths = _depths(planes, places)
        deepest = int(np.argmax(depths))
        if depths[deepest] > COPLANAR:
            raise ValueError(f"the surface is not convex, or crosses itself: the {what} at {_place(places[deepest] * size + middle)} lies "
                             f"{depths[deepest] * size:.3g} inside the convex hull")
    a, b, c = (unit[triangles[:, i]] for i in range(3))
    covered = 0.5 * np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / hull.area
    if abs(covered - 1.0) > 1e-3:
        raise ValueError(f"the surface crosses itself: its triangles cover its convex hull {covered:.4g} times")


def _depths(planes, places):
    """How far points lie below the nearest of the planes (n, 4) of a hull; in parts, for memory."""
    step = max(1, 10_000_000 // len(planes))
    parts = [places[i:i + step] for i in range(0, len(places), step)]
    return np.concatenate([-(part @ planes[:, :3].T + planes[:, 3]).max(1) for part in parts])


def _place(point):
    return "(" + ", ".join(f"{one:.6g}" for one in point) + ")"


def _by_vtk(file, kind):
    refuse_misstated(file, kind)
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkCommonCore import vtkObject
    from vtkmodules.vtkFiltersCore import vtkCleanPolyData, vtkTriangleFilter
    from vtkmodules.vtkIOGeometry import vtkOBJReader, vtkSTLReader
    reader = {".stl": vtkSTLReader, ".obj": vtkOBJReader}[kind]()
    said = []

    # VTK's sign for an observer that wants the message.
    def hear(_caller, _event, text):
        said.append(text)
    hear.CallDataType = "string0"
    reader.AddObserver("ErrorEvent", hear)
    reader.SetFileName(file)
    once, triangles = vtkCleanPolyData(), vtkTriangleFilter()
    # Of the diagonal of the body.
    once.SetTolerance(1e-7)
    triangles.PassVertsOff()
    triangles.PassLinesOff()
    once.SetInputConnection(reader.GetOutputPort())
    triangles.SetInputConnection(once.GetOutputPort())
    warnings = vtkObject.GetGlobalWarningDisplay()
    vtkObject.GlobalWarningDisplayOff()
    try:
        triangles.Update()
    finally:
        vtkObject.SetGlobalWarningDisplay(warnings)
    found = triangles.GetOutput()
    if said or found.GetNumberOfPolys() == 0:
        reason = " ".join(said[0].split("\n")[-1].split()) if said else "no triangles were found"
        raise ValueError(f"{file} cannot be read as {kind}: {reason}")
    return (vtk_to_numpy(found.GetPoints().GetData()).astype(float),
            vtk_to_numpy(found.GetPolys().GetConnectivityArray()).reshape(-1, 3).astype(int))


def _by_gts(file, kind):
    try:
        return read_gts(file)
    except (OSError, ValueError) as error:
        raise ValueError(f"{file} cannot be read as {kind}: {error}") from None
