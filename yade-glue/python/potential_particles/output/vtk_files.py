# SPDX-License-Identifier: GPL-3.0-or-later
"""Files for ParaView, by VTK's Python modules (Debian's python3-vtk9), and .stl. Each is written whole or not at all.
"""
import numpy as np

from ..files import written


def _vtk():
    try:
        from vtkmodules import vtkCommonCore, vtkCommonDataModel, vtkIOXML
        from vtkmodules.util import numpy_support
    except ImportError as error:
        raise ImportError(
            f"files for ParaView need VTK's Python modules: apt install python3-vtk9 ({error})") from error
    return vtkCommonCore, vtkCommonDataModel, vtkIOXML, numpy_support


def triangles(points, triangles, point_data=None, cell_data=None, normals=None):
    """VTK's polygons over points (n, 3) and triangles (m, 3); data: name to (n,), (n, 3), or (m,), (m, 3).

    normals: the name of the point data by which surfaces are to be shaded; without them triangles are shown flat.
    """
    data = polygons(points, triangles)
    _enter(data.GetPointData(), point_data)
    _enter(data.GetCellData(), cell_data)
    if normals:
        data.GetPointData().SetActiveNormals(normals)
    return data


def polygons(points, polygons):
    """VTK's polygons over points (n, 3), an array (m, k) or lists of numbers of points."""
    data, cells = _with_points(points), _vtk()[1].vtkCellArray()
    if isinstance(polygons, np.ndarray):
        offsets, corners = np.arange(len(polygons) + 1) * polygons.shape[1], polygons.ravel()
    else:
        offsets, corners = np.cumsum([0, *map(len, polygons)]), np.array(
            [corner for polygon in polygons for corner in polygon])
    cells.SetData(_array(offsets.astype(np.int64)), _array(corners.astype(np.int64)))
    data.SetPolys(cells)
    return data


def vertices(points, point_data):
    """VTK's points (n, 3), each a cell of its own so that ParaView shows it; data: name to (n,) or (n, 3)."""
    data, cells = _with_points(points), _vtk()[1].vtkCellArray()
    cells.SetData(_array(np.arange(len(points) + 1)), _array(np.arange(len(points))))
    data.SetVerts(cells)
    _enter(data.GetPointData(), point_data)
    return data


def lines(segments, cell_data=None):
    """VTK's lines from segments (n, 2, 3); data: name to (n,) or (n, 3)."""
    data, cells = _with_points(segments.reshape(-1, 3)), _vtk()[1].vtkCellArray()
    cells.SetData(_array(2 * np.arange(len(segments) + 1)), _array(np.arange(2 * len(segments))))
    data.SetLines(cells)
    _enter(data.GetCellData(), cell_data)
    return data


def write(file, data):
    """Writes polygons or points as .vtp."""
    writer = _vtk()[2].vtkXMLPolyDataWriter()
    # Not to the file: VTK does not notice all that could not be written.
    writer.WriteToOutputStringOn()
    writer.SetInputData(data)
    if not writer.Write() or writer.GetErrorCode():
        raise OSError(f"{file} could not be written: VTK makes no .vtp of it")
    with written(file, text=True) as out:
        out.write(writer.GetOutputString())


_STL = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])


def write_stl(file, points, triangles):
    """Writes triangles (m, 3) over points (n, 3) as a binary .stl."""
    facets = np.zeros(len(triangles), _STL)
    facets["corners"] = corners = np.asarray(points, float)[triangles]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    length = np.linalg.norm(normals, axis=1, keepdims=True)
    facets["normal"] = np.divide(normals, length, out=np.zeros_like(normals), where=length > 0.0)
    with written(file) as out:
        out.write(b"potential_particles".ljust(80) + len(facets).to_bytes(4, "little") + facets.tobytes())


def read(file):
    """A .vtp file as {name: array}, with `points` and, for polygons, `triangles` (m, 3) among them."""
    _, _, xml, numpy_support = _vtk()
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
    with written(file, text=True) as out:
        out.write('<?xml version="1.0"?>\n<VTKFile type="Collection" version="0.1">\n<Collection>\n'
                  + "".join(rows) + "</Collection>\n</VTKFile>\n")


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
