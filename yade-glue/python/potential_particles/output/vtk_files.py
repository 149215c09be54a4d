# SPDX-License-Identifier: GPL-3.0-or-later
"""Files for ParaView, written by VTK's Python modules (Debian's python3-vtk9). Each appears under its name when it is whole."""
import os

import numpy as np


def _vtk():
    try:
        from vtkmodules import vtkCommonCore, vtkCommonDataModel, vtkIOGeometry, vtkIOXML
        from vtkmodules.util import numpy_support
    except ImportError as error:
        raise ImportError(f"files for ParaView need VTK's Python modules: apt install python3-vtk9 ({error})") from error
    return vtkCommonCore, vtkCommonDataModel, vtkIOGeometry, vtkIOXML, numpy_support


def triangles(points, triangles, point_data=None, cell_data=None, normals=None):
    """VTK's polygons over points (n, 3) and triangles (m, 3); data: name to (n,), (n, 3), or (m,), (m, 3).

    normals: the name of the point data by which surfaces are to be shaded; without them triangles are shown flat.
    """
    data, cells = _with_points(points), _vtk()[1].vtkCellArray()
    offsets = np.arange(0, 3 * len(triangles) + 1, 3)
    cells.SetData(_array(offsets.astype(np.int64)), _array(np.ascontiguousarray(triangles, np.int64).ravel()))
    data.SetPolys(cells)
    _enter(data.GetPointData(), point_data)
    _enter(data.GetCellData(), cell_data)
    if normals:
        data.GetPointData().SetActiveNormals(normals)
    return data


def vertices(points, point_data):
    """VTK's points (n, 3), each a cell of its own so that ParaView shows it; data: name to (n,) or (n, 3)."""
    data, cells = _with_points(points), _vtk()[1].vtkCellArray()
    cells.SetData(_array(np.arange(len(points) + 1)), _array(np.arange(len(points))))
    data.SetVerts(cells)
    _enter(data.GetPointData(), point_data)
    return data


def lines(segments):
    """VTK's lines from segments (n, 2, 3)."""
    data, cells = _with_points(segments.reshape(-1, 3)), _vtk()[1].vtkCellArray()
    cells.SetData(_array(2 * np.arange(len(segments) + 1)), _array(np.arange(2 * len(segments))))
    data.SetLines(cells)
    return data


def write(file, data):
    """Writes polygons as .stl or .vtp, or points as .vtp."""
    _, _, geometry, xml, _ = _vtk()
    stl = str(file).endswith(".stl")
    writer = geometry.vtkSTLWriter() if stl else xml.vtkXMLPolyDataWriter()
    if stl:
        writer.SetFileTypeToBinary()
    part = unfinished(file)
    # Where that fails it says why, which VTK's writers do not.
    open(part, "wb").close()
    writer.SetFileName(part)
    writer.SetInputData(data)
    try:
        if not writer.Write() or writer.GetErrorCode():
            raise OSError(f"{file} could not be written: is there room on the disk?")
        os.replace(part, file)
    finally:
        if os.path.exists(part):
            os.remove(part)


def read(file):
    """A .vtp file as {name: array}, with `points` and, for polygons, `triangles` (m, 3) among them."""
    _, _, _, xml, numpy_support = _vtk()
    reader = xml.vtkXMLPolyDataReader()
    reader.SetFileName(str(file))
    reader.Update()
    data = reader.GetOutput()
    if reader.GetErrorCode() or data.GetPoints() is None:
        raise OSError(f"{file} is no whole .vtp file")
    arrays = {"points": numpy_support.vtk_to_numpy(data.GetPoints().GetData())}
    if data.GetNumberOfPolys():
        arrays["triangles"] = numpy_support.vtk_to_numpy(data.GetPolys().GetConnectivityArray()).reshape(-1, 3)
    for group in (data.GetPointData(), data.GetCellData()):
        for i in range(group.GetNumberOfArrays()):
            arrays[group.GetArrayName(i)] = numpy_support.vtk_to_numpy(group.GetArray(i))
    return arrays


def write_index(file, frames):
    """A .pvd file that plays .vtp files as a series; frames: (time, name of the file beside it) each."""
    rows = [f'<DataSet timestep="{time:.9g}" part="0" file="{name}"/>\n' for time, name in frames]
    part = unfinished(file)
    with open(part, "w") as out:
        out.write('<?xml version="1.0"?>\n<VTKFile type="Collection" version="0.1">\n<Collection>\n'
                  + "".join(rows) + "</Collection>\n</VTKFile>\n")
    os.replace(part, file)


def unfinished(file):
    """The name of a file while it is being written."""
    return f"{file}.part"


def _with_points(points):
    core, model = _vtk()[:2]
    data, where = model.vtkPolyData(), core.vtkPoints()
    where.SetData(_array(points))
    data.SetPoints(where)
    return data


def _enter(group, arrays):
    for name, values in (arrays or {}).items():
        array = _array(values)
        array.SetName(name)
        group.AddArray(array)


def _array(values):
    # A copy of its own: numpy may free the memory before VTK writes it.
    return _vtk()[-1].numpy_to_vtk(np.ascontiguousarray(values), deep=True)
