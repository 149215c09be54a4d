# SPDX-License-Identifier: GPL-3.0-or-later
# The names and arguments of yade.potential_utils: every call of its manual runs, and makes the solid that it names.
import ast
import inspect
import math
import os

import potential_particles
import yade
from harness import *
from potential_particles import potential_utils

check = Checks()
material = yade.FrictMat(density=1000.0, frictionAngle=0.5)

# Names and arguments, in their order, are those of the file that YADE installs.
with open(os.path.join(os.path.dirname(yade.__file__), "potential_utils.py"), encoding="utf-8") as file:
    theirs = {
        one.name: [argument.arg for argument in one.args.args]
        for one in ast.parse(file.read()).body if isinstance(one, ast.FunctionDef)
    }
for name in ("potentialblock", "cuboid", "aabbPlates", "cylindricalPlates", "prism", "platonic_solid"):
    check.equal(list(inspect.signature(getattr(potential_utils, name)).parameters), theirs[name],
                f"arguments of {name}")


def volume(made):
    return made.state.mass / 1000.0


def sharp_and_bounded(made, expected, text):
    """Sharp volume up to what rounding takes off: a few r^2 times the length of edges; r is given as 1e-4."""
    check.close(volume(made) / expected, 1.0, 1e-3, text)
    check.equal(type(made.shape), yade.ConicPotentialParticle, "class of its shape")


sharp_and_bounded(potential_utils.cuboid(material, (1, 2, 3), r=1e-4), 6.0, "volume of a cuboid")
check.close(
    potential_utils.cuboid(material, Vector3(1, 1, 1), center=Vector3(1, 2, 3)).state.pos, Vector3(1, 2, 3), 1e-9,
    "its centre")
made = potential_utils.cuboid(material, (1, 2, 3), fixed=True, isBoundary=True, mask=5, color=[1, 0, 0])
check.equal((made.state.blockedDOFs, made.shape.isBoundary, made.mask, made.shape.color),
            ("xyzXYZ", True, 5, Vector3(1, 0, 0)), "arguments")
check.close(made.shape.r, 0.25, 1e-12, "r: half of the least distance of a face, unless given")
block = potential_utils.potentialblock(material, [1, -1, 0, 0, 0, 0], [0, 0, 1, -1, 0, 0], [0, 0, 0, 0, 1, -1],
                                       [1.4999, -0.5001, 1, 1, 1, 1], r=1e-4)
sharp_and_bounded(block, 4.0, "volume of a block of planes")
check.close(block.state.pos, Vector3(1, 0, 0), 1e-4, "it stands where its planes are")
for numFaces, factor in ((3, 3 * math.tan(math.pi / 3)), (8, 8 * math.tan(math.pi / 8))):
    sharp_and_bounded(potential_utils.prism(material, 0.5, -1, 2.0, numFaces, r=1e-4), factor * 0.25 * 2,
                      f"volume of a prism of {numFaces} faces")
    sharp_and_bounded(potential_utils.prism(material, 0.5, 0.0, 2.0, numFaces, r=1e-4), factor * 0.25 * 2 / 3,
                      f"volume of a pyramid on {numFaces}")

edges = {
    4: 1 / (6 * math.sqrt(2)), 6: 1.0, 8: math.sqrt(2) / 3, 12: (15 + 7 * math.sqrt(5)) / 4, 20: 5 *
                                                                                                 (3 + math.sqrt(5)) / 12
}
for faces, unit in edges.items():
    sharp_and_bounded(potential_utils.platonic_solid(material, faces, edge=2.0, r=1e-4), 8 * unit,
                      f"{faces} faces by edge")
    sharp_and_bounded(potential_utils.platonic_solid(material, faces, volume=3.0, r=1e-4), 3.0,
                      f"{faces} faces by volume")
# A cube by each of its radii: 1/2, 1/sqrt 2 and sqrt 3/2 of its edge.
for name, radius in (("ri", 0.5), ("rm", 0.5**0.5), ("rc", 0.75**0.5)):
    sharp_and_bounded(potential_utils.platonic_solid(material, 6, r=1e-4, **{name: 2 * radius}), 8.0,
                      f"a cube by {name}")

plates = potential_utils.aabbPlates(material, extrema=[(0, 0, 0), (1, 2, 3)], thickness=0.1, r=0.01)
check.equal(len(plates), 6, "six plates")
for plate, centre in zip(plates, [(-0.05, 1, 1.5), (1.05, 1, 1.5), (0.5, -0.05, 1.5), (0.5, 2.05, 1.5), (0.5, 1, -0.05),
                                  (0.5, 1, 3.05)]):
    check.close(plate.state.pos, Vector3(*centre), 1e-9, "they enclose the box, in the order of the manual")
    check.equal(plate.state.blockedDOFs, "xyzXYZ", "and are fixed")
shell = potential_utils.cylindricalPlates(material, radius=1.0, height=2.0, thickness=0.2, numFaces=10, r=0.01)
check.equal(len(shell), 12, "ten plates and two lids")
for height in (-0.9, 0.0, 0.9):
    for i in range(60):
        angle = 2 * math.pi * i / 60
        for radius, within in ((0.99, False), (1.08 / math.cos(math.pi / 10), True)):
            point = Vector3(radius * math.cos(angle), radius * math.sin(angle), height)
            hit = any(one.shape.potential(one.state.ori.conjugate() * (point - one.state.pos)) < 0 for one in shell)
            if hit != within:
                check.true(False, f"{point} is {'in' if hit else 'out'}side the plates")
check.equal(len(potential_utils.cylindricalPlates(material, 1.0, 2.0, numFaces=5, lid=[False, True])), 6, "one lid")

for action, words in [(lambda: potential_utils.platonic_solid(material, 6), "give one of"),
                      (lambda: potential_utils.platonic_solid(material, 6, 1, 1), "give one of"),
                      (lambda: potential_utils.platonic_solid(material, 7, 1), "faces=7"),
                      (lambda: potential_utils.potentialblock(material, [1], [0], [0], []), "1, 1, 1 and 0"),
                      (lambda: potential_utils.potentialblock(material, [1], [0], [0], [1], r=1), "enclose"),
                      (lambda: potential_utils.prism(material), "radius1"),
                      (lambda: potential_utils.cuboid(material, (1, 1, -1)), "no point lies inside")]:
    check.raises(ValueError, action, f"bad input: {words}", words)
check.finish()
