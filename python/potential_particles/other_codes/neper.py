# SPDX-License-Identifier: MIT OR Apache-2.0
"""Cells of Neper's tessellations."""
import numpy as np

from .. import fitting, mesh_text
from ..arguments import positive
from ..polyhedron import Polyhedron
from ..rounding import SPHERICITY, Rounding
from .bodies import Bodies
from .sphero_polyhedron import area_vector, cone_volume
from .words import Words

WHY = "edges are rounded; rounding=0.01 loses less"
REMEDY = "without regularisation (-reg 0) and cuts of the domain Neper makes convex cells"


def read_tess(file, rounding=None, k=SPHERICITY, hull=False, scale=1.0):
    """The cells of a tessellation of Neper (.tess) as Bodies, in place, all lengths multiplied by `scale`; their ids
    are those of the cells.

    rounding, k: as of shapes.from_mesh; without rounding a cell loses no more than 1 % of its volume. Cells that
    regularisation has left with faces that are not plane become their convex hulls where that adds no more than 2 %;
    hull=True: in any case. ValueError with file, line and value for what is no such file.
    """
    scale = positive(scale, "scale")
    words, bodies = Words(file, ()), Bodies(file, REMEDY)
    if words.next != "***tess":
        raise ValueError(f"{words.file}, line {words.line}: a tessellation of Neper begins with ***tess")
    ids = _ids(words)
    _find(words, "**vertex")
    points = words.rows(words.count("vertices", 1), 5, "vertices, each as id x y z state")[:, 1:4]
    known = mesh_text.known_to(points)
    _find(words, "**face")
    faces = [_face(words, len(points)) for _ in range(words.count("faces", 1))]
    _find(words, "**polyhedron")
    for number in range(words.count("polyhedra", 1)):
        line = words.line
        words.take(int, 1, "a polyhedron")
        signed = words.take(int, words.count("faces of a polyhedron"), "faces of a polyhedron")
        wrong = next((one for one in signed if not 1 <= abs(one) <= len(faces)), None)
        with words.told(line):
            if wrong is not None:
                raise ValueError(f"face {wrong} is named, and there are 1 to {len(faces)}")
            # Cells that a tessellation of given sizes or a cut has left empty have no face.
            if signed:
                name = ids[number] if number < len(ids) else number + 1
                _add(bodies, name, points, [(faces[abs(one) - 1], one) for one in signed], known, scale,
                     Rounding(rounding, k), hull)
    if not bodies:
        raise ValueError(f"{words.file} holds no polyhedron with faces")
    return bodies.told(WHY)


def _ids(words):
    """Numbers of the cells, [] where they count from 1."""
    _find(words, "**general")
    line, dimension = words.line, words.count("dimension")
    if dimension != 3:
        raise ValueError(f"{words.file}, line {line}: the tessellation has {dimension} dimensions, and particles have "
                         "3: let Neper make it with -dim 3")
    _find(words, "**cell")
    cells = words.count("cells", 1)
    if words.find("*id", "**vertex") == "*id":
        return words.take(int, cells, "*id")
    words.back()
    return []


def _find(words, section):
    if not words.find(section):
        raise ValueError(f"{words.file} has no {section}: it is no whole tessellation of Neper")


def _face(words, of):
    """Numbers of its points, and its normal."""
    words.take(int, 1, "a face")
    corners = words.named(words.count("vertices of a face", 3), of, "vertex", 1)
    words.take(int, words.count("edges of a face"), "edges of a face")
    plane = words.numbers(4, "the plane of a face, d a b c")
    words.numbers(5, "the state of a face")
    return corners, plane[1:]


def _add(bodies, name, points, faces, known, scale, rounding, accepted):
    own = points[sorted({corner for (corners, _), _ in faces for corner in corners})] * scale
    hull = Polyhedron.of_points(own, known * scale)
    middle, volume = own.mean(0), 0.0
    for (corners, normal), sign in faces:
        polygon = points[corners] * scale - middle
        # Neper's sign is that of the normal; the corners may go round it either way.
        volume += cone_volume(polygon) * (1.0 if (area_vector(polygon) @ normal) * sign > 0.0 else -1.0)
    excess = hull.volume / volume - 1.0 if volume > 0.0 else None
    shape = fitting.of_surface(hull, own, hull.volume, rounding, f"cell {name}", "all")
    bodies.put(name, shape, hull.volume, excess, accepted)
