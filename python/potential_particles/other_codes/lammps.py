# SPDX-License-Identifier: MIT OR Apache-2.0
"""Rounded polyhedra from the data files of LAMMPS."""
from ..mesh_text import numbers
from .bodies import Bodies
from .sphero_polyhedron import WHY, sphero_polyhedron
from .words import Words

POLYHEDRON, MOMENTS = 3, 6


def read_lammps_bodies(file, hull=False):
    """The bodies of a data file of LAMMPS (atom_style body, body style rounded/polyhedron) as Bodies, where their atoms
    stand; their ids are those of the atoms.

    Faces lie where LAMMPS's pair style has them, half the rounded diameter outside the polygons of the file; r is that
    half, and k = 0. Bodies of one point are spheres, of two capsules. Masses and velocities are not taken. hull=True:
    a body that is not convex becomes its convex hull. ValueError with file, line and value for what is no such file.
    """
    words, bodies = Words(file), Bodies(file)
    places = _places(words)
    made = {}
    if not words.find("Bodies"):
        raise ValueError(f"{words.file} has no section Bodies: it is no data file of atom_style body")
    while words.next.isdigit():
        line, atom = words.line, words.count("atom")
        if atom not in places:
            raise ValueError(f"{words.file}, line {line}: body {atom} has no atom whose bodyflag is 1")
        points, faces, diameter = _body(words, line)
        with words.told(line):
            key = points.tobytes(), diameter, str(faces)
            if key not in made:
                made[key] = sphero_polyhedron(points, 0.5 * diameter, f"body {atom}", faces)
            one = made[key]
            bodies.put(atom, one.shape, one.volume, one.excess, hull, places[atom])
    if not bodies:
        raise ValueError(f"{words.file}, line {words.line}: the section Bodies is empty")
    return bodies.told(WHY)


def _places(words):
    """{atom: (x, y, z)} of the atoms that are bodies."""
    # The first line is a title.
    words.row()
    if not words.find("Atoms"):
        raise ValueError(f"{words.file} has no section Atoms: it is no data file of LAMMPS")
    found = {}
    while words.next.isdigit():
        line, row = words.line, words.row()
        with words.told(line):
            if len(row) not in (7, 10):
                raise ValueError(f"an atom has {len(row)} numbers, and atom_style body has 7, id type bodyflag mass "
                                 "x y z, or 10 with image flags")
            atom, _, is_body = numbers(row[:3], int, 3, "an atom")
            x, y, z = numbers(row[4:7], float, 3, "the place of an atom")
            if is_body:
                found[atom] = x, y, z
    return found


def _body(words, line):
    """Points, faces and rounded diameter of one body, of whose first line the atom has been taken."""
    whole, many = words.count("ninteger"), words.count("ndouble")
    if whole != POLYHEDRON:
        raise ValueError(
            f"{words.file}, line {line}: ninteger={whole}, and only style rounded/polyhedron, which has 3, is read: "
            "make bodies of rounded/polygon by Particle.polygon(points, r), and those of nparticle as clumps of "
            "shapes.sphere")
    points, edges, faces = words.count("vertices", 1), words.count("edges"), words.count("faces")
    if points < 3:
        edges = faces = 0
    needed = MOMENTS + 3 * points + 2 * edges + 4 * faces + 1
    if many != needed:
        raise ValueError(f"{words.file}, line {line}: ndouble={many}, and {points} vertices, {edges} edges and {faces} "
                         f"faces have {needed}")
    words.numbers(MOMENTS, "moments of inertia")
    found = words.rows(points, 3, "vertices")
    words.numbers(2 * edges, "edges")
    polygons = []
    for _ in range(faces):
        at = words.line
        corners = [int(one) for one in words.numbers(4, "a face")]
        corners = corners[:3] if corners[3] == -1 else corners
        if not all(0 <= one < points for one in corners):
            raise ValueError(f"{words.file}, line {at}: a face names the vertices {corners}, and there are 0 to "
                             f"{points - 1}")
        polygons.append(corners)
    return found, polygons, float(words.numbers(1, "rounded diameter")[0])
