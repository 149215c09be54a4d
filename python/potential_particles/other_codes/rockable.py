# SPDX-License-Identifier: MIT OR Apache-2.0
"""Sphero-polyhedra from the shape files of Rockable and exaDEM."""
from ..arguments import is_number, unit_quaternion
from .bodies import ORIGIN, UPRIGHT, Bodies
from .sphero_polyhedron import WHY, sphero_polyhedron
from .words import Words

# Their words that are followed by a word.
OF_A_WORD = ("preCompDone", )


def read_shp(file, hull=False):
    """The shapes of a file of Rockable or exaDEM (.shp) as Bodies, each about its origin there, or where `position` and
    `orientation` put it.

    Faces lie where they are, by `radius` outside those of the file; r is that radius, and k = 0. A shape of one
    point is a sphere, of points on a line a capsule, of points in a plane a plate. hull=True: one that is not convex,
    or whose faces are open, becomes its convex hull. ValueError with file, line and value for what is no such file, or
    no such shape.
    """
    words, bodies = Words(file, ("#", "!", "//")), Bodies(file)
    while words.next:
        line = words.line
        if words.word() != "<":
            raise ValueError(f"{words.file}, line {line}: a shape begins with <")
        read = _block(words, line)
        with words.told(line):
            _add(bodies, read, hull)
    if not bodies:
        raise ValueError(f"{words.file} holds no shape: each stands between < and >")
    return bodies.told(WHY)


def _block(words, line):
    """What stands between < and >, by its names."""
    read = {}
    while words.next != ">":
        if not words.next:
            raise ValueError(f"{words.file}, line {line}: the shape that begins here has no end: > is missing")
        at, key = words.line, words.word()
        if key == "name":
            read[key] = words.word()
        elif key in ("radius", "volume"):
            read[key] = words.numbers(1, key)[0]
        elif key == "nv":
            read[key] = words.rows(words.count(key, 1), 3, "points of nv")
        elif key in ("ne", "nf"):
            if "nv" not in read:
                raise ValueError(f"{words.file}, line {at}: {key} must come after nv, whose points it names")
            of = len(read["nv"])
            read[key] = [
                words.named(2 if key == "ne" else words.count("corners of a face", 3), of, "point")
                for _ in range(words.count(key))
            ]
        elif key in ("position", "orientation"):
            read[key] = words.numbers(3 if key == "position" else 4, key)
        elif key in OF_A_WORD:
            words.word()
        else:
            # Of what belongs to its search for contacts nothing is needed.
            while words.next != ">" and is_number(words.next):
                words.word()
    words.word()
    for key in ("name", "radius", "nv"):
        if key not in read:
            raise ValueError(f"{words.file}, line {line}: the shape that begins here has no {key}")
    return read


def _add(bodies, read, accepted):
    name = read["name"]
    if name in bodies.ids:
        raise ValueError(f"name {name} stands for two shapes: give one of them another name")
    made = sphero_polyhedron(read["nv"], read["radius"], name, read.get("nf", []), read.get("volume"))
    bodies.put(name, made.shape, made.volume, made.excess, accepted, read.get("position", ORIGIN),
               unit_quaternion(read.get("orientation", UPRIGHT), "orientation"))
