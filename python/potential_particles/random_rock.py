# SPDX-License-Identifier: MIT OR Apache-2.0
"""Rocks at random: convex polyhedra about an ellipsoid."""
import numpy as np

from .arguments import LARGE, positive, whole, within
from .polyhedron import Polyhedron, rounded
from .rounding import SPHERICITY, Rounding


def random_rock(seed, size=1.0, elongation=1.0, flatness=1.0, faces=24, roughness=0.15, rounding=None, k=SPHERICITY,
                R=None, name=None, *, r=None):
    """A rock of extents L >= I >= S along x, y, z of its builder's frame, the same for the same arguments.

    size: I, the intermediate extent, by which a sieve sorts. elongation = I/L and flatness = S/I, both of (0, 1] (Zingg
    1935). Its `faces` planes are tangent to the ellipsoid with these axes, or by up to `roughness` of its radius (0 to
    1) further out: the more faces, the rounder. Six of them, across the axes, set the extents: flat there for at least
    r, they reach them to within r k.
    """
    seed, faces = whole(seed, 0, LARGE, "seed"), whole(faces, 6, 10_000, "faces")
    size, roughness = positive(size, "size"), within(roughness, 0.0, 1.0, "roughness")
    for value, label in ((elongation, "elongation"), (flatness, "flatness")):
        if within(value, 0.0, 1.0, label) == 0.0:
            raise ValueError(f"{label}=0 must be above 0")
    half = 0.5 * size * np.array([1.0 / elongation, 1.0, flatness])
    normals, offsets = _planes(np.random.default_rng(seed), half, faces, roughness)
    # The ball is at most as wide as the rock is thick, so that this is more than any rounding radius asked for.
    feet = half * np.vstack([np.eye(3), -np.eye(3)])
    wanted = Rounding(rounding, k, r, R)
    clear = wanted.lengths(2.0 * half.min())[0]
    offsets[6:] = np.maximum(offsets[6:], (normals[6:] @ feet.T).max(1) + clear)
    polyhedron = Polyhedron.of_planes(normals, offsets)
    return rounded(polyhedron, *wanted.lengths(polyhedron.size), name or f"rock {seed}")


def _planes(random, half, faces, roughness):
    """Normals and offsets of planes about the ellipsoid with half axes `half`: first those across the axes."""
    # Normals of the unit sphere, spread by taking the farthest of a few candidates, then of the ellipsoid.
    chosen = [*np.eye(3), *-np.eye(3)]
    while len(chosen) < faces:
        candidates = random.normal(size=(10, 3))
        candidates /= np.linalg.norm(candidates, axis=1)[:, None]
        chosen.append(candidates[np.argmin((candidates @ np.array(chosen).T).max(1))])
    normals = np.array(chosen) / half
    offsets = 1.0 / np.linalg.norm(normals, axis=1)
    offsets[6:] *= 1.0 + roughness * random.uniform(size=faces - 6)
    return normals / np.linalg.norm(normals, axis=1)[:, None], offsets
