# SPDX-License-Identifier: MIT OR Apache-2.0
"""Packings: many bodies without overlap in a region, among what is there, as the start of a scene.

    from potential_particles import packing, shapes
    rocks = [shapes.random_rock(seed) for seed in range(20)]
    placements = packing.pack(packing.Box((0, 0, 0), (2, 2, 4)), rocks, sizes=[(0.1, 0.0), (0.2, 0.4), (0.4, 1.0)],
                              shares="passing", dense=True)

In YADE add_packing(placements, material) makes bodies of them.

The library decides what overlaps (docs/packing.md).
"""
import os
import sys
import time
import typing

import numpy as np

from ._core import Particle, Pose, Triangle, Wall, _packing
from .arguments import number as finite
from .arguments import LARGE, MANY, positive, rows, vector, whole
from .polyhedron import rotation
from .progress import Bar, Interrupts

__all__ = ["Box", "Cylinder", "Placement", "Prism", "Region", "pack", "volume_between"]


class Box(typing.NamedTuple):
    """A box with sides along the axes, between two corners."""

    lower: tuple
    upper: tuple


class Cylinder(typing.NamedTuple):
    """An upright cylinder on a disc about `base`."""

    base: tuple
    radius: float
    height: float


class Prism(typing.NamedTuple):
    """An upright prism between two heights over a polygon: its corners (x, y) in order, convex or not."""

    corners: tuple
    low: float
    high: float


class Region(typing.NamedTuple):
    """The points of a box between two corners of which inside(x, y, z) is true. A body is held if its centre and the
    corners of the polyhedron about it are: that is all of it, where the region is convex.
    """

    lower: tuple
    upper: tuple
    inside: typing.Callable


class Placement(typing.NamedTuple):
    """One body of a packing: particle and pose are for detect(); in YADE body(shape.scaled(scale), material, position,
    orientation) makes a body of it.
    """

    shape: object
    scale: float
    position: tuple
    orientation: tuple  #: w, x, y, z

    @property
    def particle(self):
        """The Particle, for detect() and its like."""
        return self.shape.scaled(self.scale).particle

    @property
    def pose(self):
        """The Pose of the particle."""
        return Pose(_centroid(self), product(self.orientation, self.shape.orientation))


def pack(container, shapes, sizes=None, number=None, dense=False, seed=0, margin=0.0, shares="number", threads=None,
         progress=True, trials=5_000, obstacles=()):
    """Places bodies of random orientation in a container, which overlap neither each other nor obstacles; a list of
    Placement.

    container: a Box, Cylinder, Prism or Region. shapes: one Shape or several, each as likely as the others.
    sizes: None for the shapes as they are; one size for all; or rows (size, share). A size is the diameter of a ball of
    the body's volume. shares says what a share is: "number" or "mass", of bodies of that size, with a sum of 1; or
    "passing", a grading
    curve: of the mass, in bodies below that size, growing from 0 to 1 and linear between rows.
    dense: False scatters bodies in the container, of a `number` the largest first; True lays each as low as it gets,
    from the bottom upwards. number: None for as many as fit.
    margin: least distance between two bodies, length; that to the container and to obstacles is half of it.
    trials: random poses tried for each scattered body; with more the container gets fuller.
    obstacles: what is there: Placements, pairs (Particle, Pose), Triangles or their three corners, Walls; in YADE
    bodies, as in obstacles=O.bodies.
    seed: the same one gives the same packing, whatever `threads` (by default the number of cores) is.
    progress: a bar if standard error is a terminal, else a line at the end.

    Fewer than `number` are returned, and reported, if no more fit; Ctrl-C ends the packing and keeps the placed bodies.
    ValueError for what cannot be packed.
    """
    shapes = shapes_of(shapes)
    wanted = None if number is None else whole(number, 1, 10 * MANY, "number")
    space, there = space_of(container), obstacles_of(obstacles)
    how = {
        "arrangement": "settled" if dense else "scattered",
        "number": wanted,
        "first": 0,
        "trials": whole(trials, 1, LARGE, "trials"),
        "seed": whole(seed, 0, LARGE, "seed"),
        "threads": len(os.sched_getaffinity(0)) if threads is None else whole(threads, 1, 1024, "threads"),
    }
    report = _Report(wanted, progress)
    placements = []

    def placed(new):
        placements.extend(placement(shapes[index], *where) for index, *where in new)
        report.bar.reached(len(placements))
        return not interrupted

    with Interrupts() as interrupted:
        try:
            _packing.pack(supply_of(shapes, sizes, shares, margin), *space, there, placed, **how)
        finally:
            report.close(len(placements), interrupted, volume_between(placements), _volume(*space), bool(there))
    return placements


def volume_between(placements, lower=-float("inf"), upper=float("inf")):
    """Volume of the bodies whose centroids lie between two heights, length^3."""
    return sum(one.shape.volume * one.scale**3 for one in placements if lower <= _centroid(one)[2] <= upper)


def shapes_of(shapes):
    """The Shapes that a script gave, one or several."""
    from .shape import Shape
    given = [shapes] if isinstance(shapes, Shape) else list(shapes)
    for one in given:
        if not isinstance(one, Shape):
            raise ValueError(f"a shape is {type(one).__name__}, not a Shape: make one by potential_particles.shapes")
    if not given:
        raise ValueError("shapes is empty: give at least one")
    return given


def supply_of(shapes, sizes, shares, margin):
    """The bodies that Shapes give in these sizes, as the library has them."""
    if shares not in ("number", "mass", "passing"):
        raise ValueError(f"shares={shares!r} must be 'number', 'mass' or 'passing'")
    return _packing.Supply([shape.particle for shape in shapes], _size_rows(sizes), shares, finite(margin, "margin"))


def obstacles_of(given):
    """What the library takes as obstacles."""
    found = []
    for one in given:
        if isinstance(one, Placement):
            found.append((one.particle, one.pose))
        elif isinstance(one, (Triangle, Wall)) or isinstance(one, tuple) and isinstance(one[0], (Particle, Wall)):
            found.append(one)
        elif hasattr(one, "state"):
            from .scene_obstacles import of_body
            found.extend(of_body(one))
        else:
            found.append(Triangle(*rows(one, 3, "obstacles", "the three coordinates of a corner of a triangle")))
    return found


def space_of(container):
    """(kind, lower corner, upper corner, outline)."""
    if isinstance(container, (Box, Region)):
        kind, outline = ("box", None) if isinstance(container, Box) else ("points", container.inside)
        return kind, tuple(vector(container.lower, "lower")), tuple(vector(container.upper, "upper")), outline
    if isinstance(container, Prism):
        corners = [tuple(map(float, corner)) for corner in rows(container.corners, 2, "corners", "the two numbers x, y")]
        low, high = finite(container.low, "low"), finite(container.high, "high")
        if not corners:
            raise ValueError("corners is empty: give three or more")
        return "prism", (*map(min, zip(*corners)), low), (*map(max, zip(*corners)), high), corners
    if isinstance(container, Cylinder):
        x, y, z = vector(container.base, "base")
        radius, height = positive(container.radius, "radius"), positive(container.height, "height")
        return "cylinder", (x - radius, y - radius, z), (x + radius, y + radius, z + height), None
    raise ValueError(f"container is {type(container).__name__}, not a packing.Box, Cylinder, Prism or Region")


def _volume(kind, lower, upper, outline):
    x, y, z = (high - low for low, high in zip(lower, upper))
    if kind == "prism":
        along, across = np.array(outline).T
        return 0.5 * z * abs(along @ np.roll(across, -1) - across @ np.roll(along, -1))
    # pi/4 of the box about it.
    return x * y * z * (0.7853981633974483 if kind == "cylinder" else 1.0)


def _size_rows(sizes):
    if sizes is None:
        return []
    if not hasattr(sizes, "__len__"):
        sizes = [(positive(sizes, "sizes"), 1.0)]
    found = [tuple(map(float, row)) for row in rows(sizes, 2, "sizes", "the two numbers size, share")]
    if not found:
        raise ValueError("sizes is empty: give rows (size, share), or None for the shapes as they are")
    return found


def placement(shape, scale, position, orientation):
    """In the frame in which the shape was built, from the pose of its centroid and principal axes."""
    w, x, y, z = shape.orientation
    to_frame = product(orientation, (w, -x, -y, -z))
    origin = position - rotation(to_frame) @ shape.centroid * scale
    return Placement(shape, scale, tuple(origin.tolist()), to_frame)


def _centroid(placement):
    return placement.position + rotation(placement.orientation) @ placement.shape.centroid * placement.scale


def product(first, second):
    """Of two quaternions w, x, y, z."""
    (a, *u), (b, *v) = first, second
    u, v = np.array(u), np.array(v)
    return (float(a * b - u @ v), *(a * v + b * u + np.cross(u, v)).tolist())


class _Report:
    """A bar on a terminal, and a line at the end."""

    def __init__(self, wanted, shown):
        self.wanted, self.shown, self.begin = wanted, shown, time.monotonic()
        self.bar = Bar(wanted, shown, "bodies", "packing")

    def close(self, count, interrupted, solid, volume, among):
        self.bar.close()
        if self.shown and (count or among):
            of, why = "", ""
            if self.wanted is not None and count < self.wanted:
                of = f" of {self.wanted:,}"
                why = "; stopped by Ctrl-C" if interrupted else "; no more fit"
            elif interrupted:
                why = "; stopped by Ctrl-C"
            seconds = time.monotonic() - self.begin
            print(f"packed {count:,}{of} bodies in {seconds:.1f} s, {100 * solid / volume:.1f} % of the container{why}",
                  file=sys.stderr)
