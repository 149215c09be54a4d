# SPDX-License-Identifier: GPL-3.0-or-later
"""A surface that is not convex as a clump of convex parts, cut by coacd or V-HACD where one of them is installed."""
import importlib
import os
import typing

import numpy as np

from .arguments import positive, whole
from .mesh_file import read, scaled, volume_within
from .polyhedron import refuse_open
from .rounding import SPHERICITY

MISSING = (
    "cutting a surface into convex parts needs the Python package coacd (pip install --target DIR coacd, DIR on PYTHONPATH), or vhacdx: neither can "
    "be imported")


class Parts(typing.NamedTuple):
    """Convex parts of a surface, each a Shape that stands in the frame of the file."""

    shapes: tuple
    volume: float  #: of the surface, length^3
    error: float  #: volume of the union of the parts over that of the surface, less 1
    name: str

    def __repr__(self):
        planes = sum(len(one.planes) for one in self.shapes)
        return f"<Parts {self.name}: {len(self.shapes)} parts of {planes} planes in all, volume {self.volume:.4g}, of their union {self.error:+.2g} off>"


def clump_from_mesh(file, parts=16, planes=24, concavity=0.05, rounding=None, k=SPHERICITY, scale=1.0, name=None, *,
                    r=None):
    """Parts of a closed surface in a file (.stl, .obj, .gts): at most `parts` convex ones of at most `planes` planes
    each.

    potential_particles.add_clump makes a clump of them. concavity: how far the hull of a part may lie from the surface,
    as coacd counts it (0.01 to 1). rounding: a share of the size of each part, or r: a length; without both, r is
    chosen so that each part keeps its volume. Parts share their cuts, so that the union has no gaps but those of their
    rounding; `error` says what its volume is off, measured along 20,000 lines. ImportError with the package to install
    where there is neither coacd nor vhacdx, ValueError for a surface that is open.
    """
    parts, concavity, scale = whole(parts, 1, 65_536, "parts"), positive(concavity,
                                                                         "concavity"), positive(scale, "scale")
    name = name or os.path.splitext(os.path.basename(file))[0]
    cut = _cutter()
    points, triangles = read(file)
    try:
        refuse_open(points, triangles)
    except ValueError as error:
        raise ValueError(f"{file}: {error}") from None
    points = scaled(points, scale, file)
    volume = volume_within(points, triangles)
    # The cutters' own tolerances are absolute.
    middle, size = 0.5 * (points.max(0) + points.min(0)), np.ptp(points, axis=0).max()
    pieces = [
        np.asarray(piece, float) * size + middle for piece in cut((points - middle) / size, triangles, parts, concavity)
    ]
    made = tuple(_part(piece, planes, rounding, k, r, f"{name}, part {number}") for number, piece in enumerate(pieces))
    return Parts(made, volume, _union(made) / volume - 1.0, name)


def _part(points, planes, rounding, k, r, name):
    from .shapes import from_vertices
    return from_vertices(points, rounding, k, name=name, planes=planes, r=r)


def _union(made):
    """Volume of the union of shapes that stand in their builders' frames."""
    if len(made) == 1:
        return made[0].volume
    import yade
    from .bodies import body
    from .clumps import union
    material = yade.FrictMat(density=1.0)
    return union([body(one, material) for one in made])[0]


def _cutter():
    """A function of points, triangles, the largest number of parts and the concavity, which returns the points of each
    part.
    """
    for name, cut in (("coacd", _by_coacd), ("vhacdx", _by_vhacd)):
        try:
            module = importlib.import_module(name)
        except ImportError:
            continue
        return lambda *surface: cut(module, *surface)
    raise ImportError(MISSING)


def _by_coacd(coacd, points, triangles, parts, concavity):
    coacd.set_log_level("error")
    found = coacd.run_coacd(coacd.Mesh(points, triangles), threshold=concavity, max_convex_hull=parts)
    return [vertices for vertices, _ in found]


def _by_vhacd(vhacdx, points, triangles, parts, concavity):
    # Faces as VTK has them: the number of corners before each. The error is a share of the volume in percent, where
    # coacd has a length.
    faces = np.column_stack([np.full(len(triangles), 3), triangles]).ravel().astype(np.uint32)
    found = vhacdx.compute_vhacd(points, faces, maxConvexHulls=parts,
                                 minimumVolumePercentErrorAllowed=100.0 * concavity)
    return [vertices for vertices, _ in found]
