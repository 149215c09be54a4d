# SPDX-License-Identifier: GPL-2.0-or-later
"""Numbers and files that no run can bear end it where they are read, on all ranks, with a sentence; and inputs with
something changed in them.
"""
import os

import fuzz
import numpy as np
from scene import random_bodies, refused, run
from test_walls import floor, write_stl

BODIES = random_bodies(4, 0.1, seed=1, low=(0, 0, 0.1), across=2, speed=0.2)
WALL = "fix floor all wall/potential/particle {}"
SHAPES = "fix shapes all potential/particle/shapes {} type 1 pyramid 2600 type 2 cuboid 2600"


def says(folder, *wanted, **parts):
    said = refused(folder, BODIES, rounded=False, **parts)
    for text in wanted:
        assert text in said
    assert "ERROR" in said and "std::" not in said


def test_files_that_are_none(folder):
    """What one rank cannot read ends all of them."""
    (folder / "a folder").mkdir()
    (folder / "empty").write_text("")
    os.mkfifo(folder / "pipe")
    for name, words in (("'a folder'", "it is a folder"), ("/dev/zero", "it is a device or a pipe"),
                        ("pipe", "it is a device or a pipe"), ("none", "the file cannot be read"),
                        ("shapes.txt/none", "the file cannot be read")):
        says(folder, words, shapes=SHAPES.format(name), ranks=2)
        says(folder, words, walls=WALL.format(f"1e5 6e4 0.4 0.3 stl {name}"), ranks=1)
    says(folder, "no shape in the file", shapes=SHAPES.format("empty"))
    says(folder, "no whole STL file", walls=WALL.format("1e5 6e4 0.4 0.3 stl empty"))


def test_meshes_that_are_none(folder):
    """A mesh of a point, triangles without area, what does not end, and coordinates that nothing can be near."""
    a_floor = np.array(floor(2, 0.5))
    needle = a_floor.copy()
    needle[1, 2] = 0.5 * (needle[1, 0] + needle[1, 1])
    lost = a_floor.copy()
    lost[2, 1, 0] = np.nan
    for name, triangles, more, words in (("point", 0 * a_floor, "", "triangle 1 has no area"),
                                         ("needle", needle, "", "triangle 2 has no area"), ("lost", lost, "", "vertex"),
                                         ("good", a_floor, "scale 1e308",
                                          "scale = 1e308: it must lie in"), ("good", a_floor, "scale 0", "scale = 0"),
                                         ("good", 1e30 * a_floor, "scale 1e99",
                                          "triangle 1 has a vertex that is not finite, or beyond 1e100"),
                                         ("good", a_floor, "scale 1e20", "put it nearer to the origin")):
        for binary in (True, False):
            write_stl(folder / f"{name}.stl", triangles, binary)
            says(folder, words, walls=WALL.format(f"1e5 6e4 0.4 0.3 stl {name}.stl {more}"))
    for binary in (True, False):
        write_stl(folder / "cut.stl", a_floor, binary)
        (folder / "cut.stl").write_bytes((folder / "cut.stl").read_bytes()[:-20 if binary else -15])
        says(folder, "no whole STL file", walls=WALL.format("1e5 6e4 0.4 0.3 stl cut.stl"))


def test_few_large_triangles_among_many(folder):
    """A fine mesh with some triangles that span all of it takes no more memory than its triangles do."""
    across = [np.array([(-40, -40, -40), (40, 40, 40), (40, 40, 41 + n)]) for n in range(20)]
    fine = np.array(floor(120, 0.5)) - [0, 0, 0.5]
    write_stl(folder / "floor.stl", np.concatenate([fine, fine + [20, 20, 20], across]))
    _, said = run(folder, BODIES, walls=WALL.format("1e5 6e4 0.4 0.3 stl floor.stl"), run="run 0\ninfo memory")
    held = next(float(line.split()[-2]) for line in said.splitlines() if "Maximum resident" in line)
    assert held < 600


def test_numbers(folder):
    """Each number of a command is judged where the command stands, and not in the first contact."""
    pair, wall = "pair_coeff * * 1e5 6e4 0.4 0.5".split(
    ), "1e5 6e4 0.4 0.5 plane 0 0 -1 0 0 1 linear 0 0 0 rotate 0 0 0 0 0 1 5".split()
    for at, text, words in ((3, "0", "normal stiffness = 0"), (3, "1e308", "normal stiffness = 1e308"),
                            (4, "1e-320", "shear stiffness = 1e-320: it must be 0 or lie in"),
                            (5, "-1", "friction = -1"), (6, "0", "restitution = 0: it must lie in [0.01, 1]"),
                            (6, "nan", "'nan'"), (5, "1e400", "1e400")):
        says(folder, words, coefficients=" ".join(pair[:at] + [text] + pair[at + 1:]))
    for at, text, words in ((5, "1e308", "plane = 1e308"), (10, "0", "plane has a direction of length 0"),
                            (12, "1e200", "linear = 1e200"), (21, "0", "rotate has a direction of length 0"),
                            (22, "1e-320", "period = 1e-320"), (22, "0", "period = 0")):
        says(folder, words, walls=WALL.format(" ".join(wall[:at] + [text] + wall[at + 1:])))
    for words, more in (("'linear' is given twice", "linear 1 0 0"), ("scale is for a mesh", "scale 2")):
        says(folder, words, walls=WALL.format(" ".join(wall + more.split())))
    for density in ("0", "-2", "1e308", "1e-320"):
        says(folder, f"density = {density}: it must lie in",
             shapes=f"fix shapes all potential/particle/shapes shapes.txt type * pyramid {density}")
    says(folder, "type 1 has the mass",
         shapes="fix shapes all potential/particle/shapes shapes.txt type * pyramid 1e-99")
    # The lengths of directions do not matter.
    run(folder, BODIES, walls=WALL.format("1e5 6e4 0.4 0.5 plane 0 0 -1 0 0 1e-200 rotate 0 0 0 0 0 1e90 5"),
        run="run 1")


def test_changed_inputs(folder):
    """Cases of a fixed seed; `make fuzz` has fresh ones."""
    for number in range(20):
        inside = folder / str(number)
        inside.mkdir()
        assert fuzz.tried(49, number, inside) is None
