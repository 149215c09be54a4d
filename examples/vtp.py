# SPDX-License-Identifier: MIT OR Apache-2.0
"""VTK PolyData files (.vtp) that ParaView opens, and a .pvd that plays them as a series.

Binary, zlib-compressed, base64 so that the file stays well-formed XML. Format: "VTK XML file
formats", appended data: per array one header (block count, block size, last block size, size of
each compressed block) and the blocks.
"""

import base64
import sys
import xml.etree.ElementTree as ElementTree
import zlib

import numpy as np

VTK_TYPES = {"float32": "Float32", "float64": "Float64", "int32": "Int32", "int64": "Int64"}
COMPRESSION = 1  # of 0..9: the fastest; higher gains little here


class Encoded:
    """One array, compressed once, so that what never changes costs nothing in the next frame."""

    def __init__(self, array):
        array = np.ascontiguousarray(array)
        self.vtk_type = VTK_TYPES[array.dtype.name]
        self.components = array.shape[1] if array.ndim == 2 else 1
        raw = array.tobytes()
        packed = zlib.compress(raw, COMPRESSION)
        header = np.array([1, len(raw), len(raw), len(packed)], np.uint64).tobytes()
        self.text = base64.b64encode(header) + base64.b64encode(packed)


def write_vtp(path, points, triangles, point_data=None, cell_data=None):
    """Writes triangles (m, 3) over points (n, 3); data: name -> array. Arrays may be Encoded."""
    points, triangles = _encoded(points), _encoded(triangles)
    triangle_count = _length(triangles) // 3
    groups = [
        ("PointData", point_data or {}),
        ("CellData", cell_data or {}),
        ("Points", {"Points": points}),
        (
            "Polys",
            {
                "connectivity": triangles,
                "offsets": np.arange(3, 3 * triangle_count + 1, 3, dtype=np.int32),
            },
        ),
    ]
    body, appended, offset = [], [], 0
    for group, arrays in groups:
        normals = ' Normals="normal"' if "normal" in arrays else ""
        body.append(f"<{group}{normals}>")
        for name, array in arrays.items():
            array = _encoded(array)
            # A connectivity given as (m, 3) is still one flat list to VTK.
            components = 1 if group == "Polys" else array.components
            body.append(
                f'<DataArray type="{array.vtk_type}" Name="{name}" '
                f'NumberOfComponents="{components}" format="appended" offset="{offset}"/>'
            )
            appended.append(array.text)
            offset += len(array.text)
        body.append(f"</{group}>")
    byte_order = "LittleEndian" if sys.byteorder == "little" else "BigEndian"
    head = (
        f'<?xml version="1.0"?>\n<VTKFile type="PolyData" version="1.0" byte_order="{byte_order}" '
        'header_type="UInt64" compressor="vtkZLibDataCompressor">\n<PolyData>\n'
        f'<Piece NumberOfPoints="{_length(points) // 3}" NumberOfVerts="0" NumberOfLines="0" '
        f'NumberOfStrips="0" NumberOfPolys="{triangle_count}">\n'
    )
    tail = '\n</Piece>\n</PolyData>\n<AppendedData encoding="base64">\n_'
    # Under its own name only when whole: an interrupted run leaves no torn file.
    unfinished = path.with_suffix(".part")
    with open(unfinished, "wb") as file:
        file.write((head + "\n".join(body) + tail).encode())
        file.writelines(appended)
        file.write(b"\n</AppendedData>\n</VTKFile>\n")
    unfinished.replace(path)


def read_vtp(path):
    """Reads a file of `write_vtp` back: name -> array, points and triangles among them."""
    root = ElementTree.parse(path).getroot()
    text = root.find("AppendedData").text.strip()[1:]
    numpy_types = {vtk: name for name, vtk in VTK_TYPES.items()}
    arrays = {}
    for element in root.iter("DataArray"):
        start = int(element.get("offset"))
        header = np.frombuffer(base64.b64decode(text[start : start + 44]), np.uint64)
        blocks, size, _, packed_size = (int(number) for number in header)
        if blocks != 1:
            raise ValueError(f"{path}: array {element.get('Name')} has {blocks} blocks, expected 1")
        width = 4 * ((packed_size + 2) // 3)
        raw = zlib.decompress(base64.b64decode(text[start + 44 : start + 44 + width]))
        if len(raw) != size:
            raise ValueError(f"{path}: array {element.get('Name')} has {len(raw)} bytes, not {size}")
        array = np.frombuffer(raw, numpy_types[element.get("type")])
        components = int(element.get("NumberOfComponents"))
        arrays[element.get("Name")] = array.reshape(-1, components) if components > 1 else array
    piece = root.find("PolyData/Piece")
    arrays["connectivity"] = arrays["connectivity"].reshape(-1, 3)
    for name, attribute in (("Points", "NumberOfPoints"), ("connectivity", "NumberOfPolys")):
        if len(arrays[name]) != int(piece.get(attribute)):
            raise ValueError(f"{path}: {attribute} does not match the array {name}")
    return arrays


class VtpSeries:
    """Bodies that share one mesh, written frame by frame as <name>.<step>.vtp and <name>.pvd."""

    def __init__(self, folder, name, mesh, cell_data_of_bodies):
        """mesh: points, normals, triangles in the local frame; data: name -> one value a body."""
        self.folder, self.name = folder, name
        self.points, self.normals, triangles = mesh
        self.frames = []
        count = len(next(iter(cell_data_of_bodies.values())))
        shift = len(self.points) * np.arange(count, dtype=np.int32)
        self.triangles_per_body = len(triangles)
        self._triangles = Encoded((triangles[None] + shift[:, None, None]).reshape(-1, 3))
        self._fixed = {name: Encoded(self._per_cell(v)) for name, v in cell_data_of_bodies.items()}

    def write(self, step, time, positions, rotations, cell_data_of_bodies):
        """positions (n, 3) and rotations (n, 3, 3), local to world; time in s."""
        turned = np.einsum("bij,pj->bpi", rotations, self.points) + positions[:, None]
        # Rounded to 1/256: for shading no eye sees it, and the files shrink.
        normals = np.round(256.0 * np.einsum("bij,pj->bpi", rotations, self.normals)) / 256.0
        cells = {name: self._per_cell(v) for name, v in cell_data_of_bodies.items()}
        path = self.folder / f"{self.name}.{step:06d}.vtp"
        write_vtp(
            path,
            turned.reshape(-1, 3).astype(np.float32),
            self._triangles,
            {"normal": normals.reshape(-1, 3).astype(np.float32)},
            {**self._fixed, **cells},
        )
        self.frames.append((time, path.name))
        self._write_index()

    def _per_cell(self, values):
        return np.repeat(np.asarray(values), self.triangles_per_body)

    def _write_index(self):
        """Rewritten with every frame, so that an interrupted run leaves a readable series."""
        rows = [f'<DataSet timestep="{time:.9g}" part="0" file="{file}"/>' for time, file in self.frames]
        text = (
            '<?xml version="1.0"?>\n<VTKFile type="Collection" version="0.1">\n<Collection>\n'
            + "\n".join(rows)
            + "\n</Collection>\n</VTKFile>\n"
        )
        (self.folder / f"{self.name}.pvd").write_text(text)


def _encoded(array):
    return array if isinstance(array, Encoded) else Encoded(array)


def _length(encoded):
    """Number of values in an encoded array, from its own header."""
    header = np.frombuffer(base64.b64decode(encoded.text[:44]), np.uint64)
    return int(header[1]) // np.dtype(encoded.vtk_type.lower()).itemsize
