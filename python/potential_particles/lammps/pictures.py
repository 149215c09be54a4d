# SPDX-License-Identifier: MIT OR Apache-2.0
"""From LAMMPS's dumps to ParaView and PNG.

A dump has bodies as they are: dump 1 all custom 500 pile.dump id type x y z vx vy vz d2_orientation[1]
    d2_orientation[2] d2_orientation[3] d2_orientation[4]
"""
import sys

import numpy as np

from ..arguments import needed
from ..files import written
from ..graphics import with_graphics
from ..polyhedron import rotation
from .shapes import read_shapes

QUATERNION = [f"d2_orientation[{n}]" for n in (1, 2, 3, 4)]


def frames(path):
    """Yields (step, {column: array}) of a text dump, atoms in the order of their IDs."""
    with open(path) as file:
        while line := file.readline():
            if line.startswith("ITEM: TIMESTEP"):
                step = int(file.readline())
            elif line.startswith("ITEM: NUMBER OF ATOMS"):
                count = int(file.readline())
            elif line.startswith("ITEM: ATOMS"):
                columns = line.split()[2:]
                for column in ["id", "type", "x", "y", "z"] + QUATERNION:
                    if column not in columns:
                        raise ValueError(f"{path}: the dump has no column {column}: dump it with custom")
                rows = np.array([file.readline().split() for _ in range(count)], float).reshape(count, len(columns))
                rows = rows[np.argsort(rows[:, columns.index("id")])]
                yield step, {name: rows[:, n] for n, name in enumerate(columns)}


def polydata(columns, shapes, tolerance=5e-3):
    """Bodies as one vtkPolyData. shapes: the Particle of each type, from type 1; type, id and speed are data of the
    cells.
    """
    vtk = needed("vtk", "vtk")
    from vtk.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
    points, triangles, owners, first = [], [], [], 0
    meshes = [(mesh.vertices, mesh.triangles) for mesh in (shape.mesh(tolerance) for shape in shapes)]
    x = np.column_stack([columns[c] for c in "xyz"])
    q = np.column_stack([columns[c] for c in QUATERNION])
    for i, kind in enumerate(columns["type"].astype(int)):
        vertices, faces = meshes[kind - 1]
        points.append(x[i] + vertices @ rotation(q[i]).T)
        triangles.append(faces.astype(np.int64) + first)
        owners.append(np.full(len(faces), i))
        first += len(vertices)
    data = vtk.vtkPolyData()
    place = vtk.vtkPoints()
    place.SetData(numpy_to_vtk(np.concatenate(points), deep=True))
    data.SetPoints(place)
    faces = np.concatenate(triangles)
    cells = vtk.vtkCellArray()
    cells.SetCells(len(faces),
                   numpy_to_vtkIdTypeArray(np.column_stack([np.full(len(faces), 3), faces]).ravel(), deep=True))
    data.SetPolys(cells)
    owner = np.concatenate(owners)
    values = {"type": columns["type"], "id": columns["id"]}
    if "vx" in columns:
        values["speed"] = np.sqrt(sum(columns[c]**2 for c in ("vx", "vy", "vz")))
    for name, value in values.items():
        array = numpy_to_vtk(value[owner], deep=True)
        array.SetName(name)
        data.GetCellData().AddArray(array)
    return data


def write_vtk(dump, shapes, stem):
    """Writes stem.STEP.vtp for each frame of a dump, and stem.pvd, which ParaView opens. shapes: the Particle of each
    type.
    """
    vtk = needed("vtk", "vtk")
    entries = []
    for step, columns in frames(dump):
        name = f"{stem}.{step:010d}.vtp"
        writer = vtk.vtkXMLPolyDataWriter()
        writer.SetFileName(name)
        writer.SetInputData(polydata(columns, shapes))
        if not writer.Write():
            raise OSError(f"{name} could not be written")
        entries.append(f'<DataSet timestep="{step}" file="{name.rsplit("/", 1)[-1]}"/>')
    with written(f"{stem}.pvd", text=True) as file:
        file.write('<VTKFile type="Collection"><Collection>\n' + "\n".join(entries) + "\n</Collection></VTKFile>\n")
    return len(entries)


def write_picture(dump, shapes, file, mesh=None, mesh_turn=0.0, frame=-1, view=(0.5, -1.0, 0.45), colour="type",
                  zoom=1.35, pixels=(1200, 900)):
    """The last (or another) frame of a dump as a PNG. mesh: an STL file, drawn transparent, turned about y by
    `mesh_turn` degrees.
    """
    vtk = needed("vtk", "vtk")
    step, columns = list(frames(dump))[frame]
    renderer = vtk.vtkRenderer()
    renderer.SetBackground(1, 1, 1)
    data = polydata(columns, shapes)
    data.GetCellData().SetActiveScalars(colour)
    table = vtk.vtkLookupTable()
    table.SetHueRange(0.58, 0.08)
    table.SetSaturationRange(0.45, 0.65)
    table.SetValueRange(0.85, 0.9)
    low, high = data.GetCellData().GetScalars().GetRange()
    table.SetTableRange(low, max(high, low + 1e-12))
    table.Build()
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputData(data)
    mapper.SetLookupTable(table)
    mapper.UseLookupTableScalarRangeOn()
    actor = vtk.vtkActor()
    actor.SetMapper(mapper)
    renderer.AddActor(actor)
    if mesh:
        reader = vtk.vtkSTLReader()
        reader.SetFileName(mesh)
        wall = vtk.vtkActor()
        wall_mapper = vtk.vtkPolyDataMapper()
        wall_mapper.SetInputConnection(reader.GetOutputPort())
        wall.SetMapper(wall_mapper)
        wall.RotateY(mesh_turn)
        wall.GetProperty().SetOpacity(0.18)
        wall.GetProperty().SetColor(0.3, 0.35, 0.4)
        renderer.AddActor(wall)
    renderer.ResetCamera()
    camera = renderer.GetActiveCamera()
    focus = np.array(camera.GetFocalPoint())
    camera.SetPosition(focus + camera.GetDistance() * np.asarray(view, float) / np.linalg.norm(view))
    camera.SetViewUp(0, 0, 1)
    with_graphics(_save, renderer, str(file), zoom, pixels)
    return step


def _save(window, renderer, file, zoom, pixels):
    vtk = needed("vtk", "vtk")
    # Drawn at twice the size and halved: there are no samples between pixels in such a window.
    window.SetSize(2 * pixels[0], 2 * pixels[1])
    window.AddRenderer(renderer)
    renderer.ResetCamera()
    renderer.GetActiveCamera().Zoom(zoom)
    window.Render()
    grab = vtk.vtkWindowToImageFilter()
    grab.SetInput(window)
    grab.ReadFrontBufferOff()
    half = vtk.vtkImageResize()
    half.SetInputConnection(grab.GetOutputPort())
    half.SetOutputDimensions(*pixels, 1)
    writer = vtk.vtkPNGWriter()
    writer.SetFileName(file)
    writer.SetInputConnection(half.GetOutputPort())
    writer.Write()
    window.RemoveRenderer(renderer)


def main():
    """python3 -m potential_particles.lammps.pictures DUMP SHAPES NAME[,NAME...] STEM [MESH.stl [DEGREES]]"""
    if len(sys.argv) < 5:
        raise SystemExit(main.__doc__)
    known = read_shapes(sys.argv[2])
    shapes = [known[name] for name in sys.argv[3].split(",")]
    count = write_vtk(sys.argv[1], shapes, sys.argv[4])
    write_picture(sys.argv[1], shapes, sys.argv[4] + ".png", *(sys.argv[5:6] or [None]),
                  *(float(x) for x in sys.argv[6:7]))
    print(f"{sys.argv[4]}.pvd with {count} frames, {sys.argv[4]}.png")


if __name__ == "__main__":
    main()
