# SPDX-License-Identifier: GPL-3.0-or-later
# A packing becomes bodies that do not touch; boundaries are watertight meshes of facets; bad input is refused.
import contextlib
import io
import math
import os
import signal
from collections import Counter

import numpy as np
import potential_particles
from potential_particles import add_packing, boundaries, pack, packing, progress, shapes
from harness import *

check = Checks()


def touching():
    """After one step of the scene: how many pairs the functor looked at, and how many of them overlap."""
    run(1)
    return functor().calls, functor().overlapping


def scene():
    fresh_scene(yade.Ig2_ConicPP_ConicPP_ScGeom())


def quiet(*arguments, **keywords):
    """The packing, and what it said."""
    said = io.StringIO()
    with contextlib.redirect_stderr(said):
        found = pack(*arguments, **keywords)
    return found, said.getvalue()


rocks = [shapes.random_rock(seed, elongation=0.8, flatness=0.7) for seed in range(5)]
# Off its own centre, so that the frame in which it was built is another than that of the body.
corner = shapes.from_planes([(1, 0, 0, 1.2), (-1, 0, 0, -0.2), (0, 1, 0, 0.8), (0, -1, 0, 0), (1, 1, 1, 2.2),
                             (0, 0, -1, 0.1)])
box, cylinder = packing.Box((0, 0, 0), (5, 5, 12)), packing.Cylinder((1, 1, -2), 3.0, 8.0)

# Bodies of a packing do not touch each other, though many are close.
for container, how in [(box, dict(dense=True)), (cylinder, dict(dense=True)), (box, {})]:
    scene()
    placements, said = quiet(container, [*rocks, corner], sizes=[(0.8, 0.5), (1.2, 0.5)], number=60, seed=3, **how)
    check.equal(len(placements), 60, "all find a place")
    check.true(said.startswith("packed 60 bodies in "), f"a line at the end: {said}")
    ids = add_packing(placements, material=0, color=(1, 0, 0))
    check.equal(len(ids), 60, "all are added")
    calls, overlapping = touching()
    check.equal(overlapping, 0, f"no pair of {calls} overlaps")
    check.true(calls > 30, f"{calls} pairs are near each other")
    for body, placement in zip(O.bodies, placements):
        size = (6 / math.pi * body.state.mass / 2000.0) ** (1 / 3)
        check.true(min(abs(size - 0.8), abs(size - 1.2)) < 1e-5, f"a body of size {size}")
        # Each point of a body lies in the container.
        for direction in np.random.default_rng(body.id).normal(size=(20, 3)):
            unit = Vector3(*direction).normalized()
            point = body.state.pos + body.state.ori * (unit * body.shape.surfaceDistance([tuple(unit)])[0])
            if container is box:
                check.true(all(-1e-9 <= x <= high + 1e-9 for x, high in zip(point, box.upper)), f"{point} in the box")
            else:
                inside = math.hypot(point[0] - 1, point[1] - 1) <= 3 + 1e-9 and -2 - 1e-9 <= point[2] <= 6 + 1e-9
                check.true(inside, f"{point} in the cylinder")

# Laid low, the bodies are close to each other: moved down by a hundredth of their size, most touch something.
scene()
placements, _ = quiet(box, rocks, sizes=1.0, number=50, dense=True)
add_packing([one._replace(position=(one.position[0], one.position[1], one.position[2] * 0.97)) for one in placements],
            0)
check.true(touching()[1] > 25, "squeezed, they touch")

# The same seed, the same packing; another seed, another.
same = [
    quiet(box, rocks, number=30, dense=True, seed=seed, threads=threads)[0]
    for seed, threads in [(1, 1), (1, 2), (2, 1)]
]
check.equal(same[0], same[1], "threads make no difference")
check.true(same[0] != same[2], "seeds do")

# Too many are asked for: what fits comes back, and is said.
few, said = quiet(packing.Box((0, 0, 0), (2, 2, 2)), shapes.sphere(0.5), number=100)
check.true(0 < len(few) < 8, f"{len(few)} balls")
check.true(f"packed {len(few)} of 100 bodies" in said and "no more fit" in said, said)
quiet_one, said = quiet(box, rocks, number=3, progress=False)
check.equal((len(quiet_one), said), (3, ""), "without progress nothing is printed")

# Ctrl-C keeps what has its place, and is Python's own again afterwards.
before = signal.getsignal(signal.SIGINT)
original = progress.Bar.reached


def interrupt(self, count):
    if count >= 20:
        os.kill(os.getpid(), signal.SIGINT)


progress.Bar.reached = interrupt
some, said = quiet(box, rocks, number=500, dense=True)
progress.Bar.reached = original
check.true(20 <= len(some) < 100 and "stopped by Ctrl-C" in said, f"{len(some)} bodies; {said}")
check.equal(signal.getsignal(signal.SIGINT), before, "the handler of Ctrl-C")

# What is raised while bodies are handed over comes out.
progress.Bar.reached = lambda self, count: 1 / 0
check.raises(ZeroDivisionError, lambda: quiet(box, rocks, number=5), "an error in between")
progress.Bar.reached = original

wrong = packing.Region((0, 0, 0), (9, 9, 9), lambda x, y, z: 1 / 0)
check.raises(ZeroDivisionError, lambda: quiet(wrong, rocks, number=5), "an error in the function of a region")

O.reset()
for arguments, keywords, says in [
    ((box, []), dict(number=5), "shapes is empty"),
    ((box, [yade.Sphere(radius=1)]), dict(number=5), "not a Shape"),
    (((1, 2, 3), rocks), dict(number=5), "not a packing.Box"),
    ((box, rocks), dict(number=5, trials=0), "trials=0"),
    ((box, rocks), dict(number=5, obstacles=[(1, 2, 3)]), "obstacles"),
    ((packing.Prism([(0, 0), (1, 0)], 0, 1), rocks), dict(number=5), "a prism of 2 corners"),
    ((box, rocks), dict(number=0), "number=0"),
    ((box, rocks), dict(number=5, seed=-1), "seed=-1"),
    ((box, rocks), dict(number=5, margin=-1), "margin=-1"),
    ((box, rocks), dict(number=5, sizes=-1), "sizes=-1"),
    ((box, rocks), dict(number=5, sizes=[]), "sizes is empty"),
    ((box, rocks), dict(number=5, sizes=[(1, 0.5), (2, 0.4)]), "add up to 0.9"),
    ((box, rocks), dict(number=5, sizes=[(1, 0.5), (-2, 0.5)]), "size -2.0 (entry 1)"),
    ((box, rocks), dict(number=5, sizes=[(1, 0), (2, 0.4)], shares="passing"), "grading curve"),
    ((box, rocks), dict(number=5, sizes=[(1, 1)], shares="weight"), "shares='weight'"),
    ((packing.Box((0, 0, 0), (1, 0, 1)), rocks), dict(number=5), "no volume"),
    ((packing.Box((0, 0, 0), (0.1, 1, 1)), rocks), dict(number=5), "no body fits"),
    ((packing.Cylinder((0, 0, 0), -1, 1), rocks), dict(number=5), "radius=-1"),
]:
    check.raises(ValueError, lambda: quiet(*arguments, **keywords), f"{keywords}", says)
check.equal(len(O.bodies), 0, "nothing is added by what is refused")


def mesh(bodies):
    """Corners of each triangle, world frame."""
    return [[body.state.pos + body.state.ori * vertex for vertex in body.shape.vertices] for body in bodies]


def area_normals(triangles):
    return [0.5 * (b - a).cross(c - a) for a, b, c in triangles]


def open_edges(triangles):
    """Edges that no second triangle has in the opposite direction."""
    edges = Counter((tuple(round(x, 9) for x in one[i]), tuple(round(x, 9) for x in one[(i + 1) % 3]))
                    for one in triangles for i in range(3))
    return [edge for edge, count in edges.items() if edges[edge[::-1]] != count]


# A closed box: watertight, all of it seen from inside, and of the right area and volume.
for facets in (12, 100, 1000):
    walls = mesh(boundaries.box_walls((-1, 0, 2), (1, 3, 3), lid=True, facets=facets, material=utils.defaultMaterial()))
    normals = area_normals(walls)
    check.true(facets <= len(walls) <= 1.5 * facets + 10, f"{len(walls)} facets for {facets}")
    check.equal(open_edges(walls), [], "edges of a closed box")
    check.close(sum(n.norm() for n in normals), 22.0, 1e-9, "its area")
    # The divergence theorem, with normals inwards.
    check.close(sum(-n.dot(one[0]) for n, one in zip(normals, walls)) / 3, 6.0, 1e-9, "its volume")
check.equal(len(boundaries.box_walls((0, 0, 0), (1, 1, 1), material=utils.defaultMaterial())), 10,
            "facets of an open box")

cone = mesh(boundaries.funnel(0.5, 2.0, 3.0, position=(1, 1, 1), sides=64, facets=500,
                              material=utils.defaultMaterial()))
check.close(sum(n.norm() for n in area_normals(cone)), math.pi * 2.5 * math.hypot(1.5, 3), 0.05, "area of a cone")
check.true(len(cone) >= 500, f"{len(cone)} facets")
# Open at the outlet and at the mouth alone, where each of the sides has its edges.
heights = {round(z, 9) for edge in open_edges(cone) for (_, _, z) in edge}
check.equal(heights, {1.0, 4.0}, "heights of the open edges of a funnel")
check.true(all(n.dot(Vector3(1, 1, one[0][2]) - one[0]) > 0 for n, one in zip(area_normals(cone), cone)),
           "normals point inwards")
wedge = mesh(boundaries.funnel((0.0, 1.0), (2.0, 1.0), 1.0, facets=50, material=utils.defaultMaterial()))
check.close(sum(n.norm() for n in area_normals(wedge)), 2 * math.sqrt(2) + 2 * 1.0, 1e-9,
            "area of a wedge that is closed below")
sheet = mesh(boundaries.plate((0, 0, 1), (2, 0, 0), (1, 3, 0), facets=20, material=utils.defaultMaterial()))
check.close(sum(area_normals(sheet), Vector3.Zero), Vector3(0, 0, 6), 1e-9, "area and normal of a plate")
fixed = boundaries.plate((0, 0, 0), (1, 0, 0), (0, 1, 0), material=utils.defaultMaterial())
check.true(all(body.state.blockedDOFs == "xyzXYZ" and not body.dynamic for body in fixed), "facets are fixed")
for action, says in [
    (lambda: boundaries.box_walls((0, 0, 0), (1, 0, 1)), "must lie below"),
    (lambda: boundaries.plate((0, 0, 0), (1, 0, 0), (2, 0, 0)), "span no plate"),
    (lambda: boundaries.funnel(0.5, (1, 1), 1), "must both be"),
    (lambda: boundaries.funnel(-0.5, 1, 1), "outlet=-0.5"),
    (lambda: boundaries.funnel(0.5, 0, 1), "mouth=0"),
    (lambda: boundaries.funnel(0.5, 1, 0), "height=0"),
    (lambda: boundaries.funnel(0.5, 1, 1, sides=2), "sides=2"),
    (lambda: boundaries.plate((0, 0, 0), (1, 0, 0), (0, float("nan"), 0)), "finite"),
]:
    check.raises(ValueError, action, says, says)

check.finish()
