# SPDX-License-Identifier: GPL-3.0-or-later
"""Where straight lines lie within bodies: chords, by which porosity and unions of bodies are measured.

On a line the function S of a particle (S <= 1 inside) is convex and piecewise quadratic. Newton's method that starts
outside therefore comes to the nearest end of the chord from one side, and where the slope changes its sign before, the
line misses the particle. Chords are exact to rounding; what is estimated is the integral across the lines, by grids of
lines that are shifted at random against each other.
"""
import math

import numpy as np

from .arguments import LARGE, MANY, whole

# Grids that are shifted against each other, whose scatter is the error; 95 % of Student's distribution with one degree
# less.
GRIDS, _STUDENT = 8, 2.36
_NEWTON_STEPS, _CONVERGED = 60, 1e-13


def chords(shape, points, direction, radius):
    """Begin and end (n,) of the chord of each line points + t direction, as t; nan where a line misses.

    shape: a PotentialParticle or Sphere. points: (n, 3), direction: (3,) of any length, both in the frame of the body.
        radius: within which the body lies.
    """
    import yade
    length = np.linalg.norm(direction)
    along = np.asarray(direction, float) / length
    points = np.asarray(points, float)
    middle = -points @ along
    nearest = points + middle[:, None] * along
    half = np.sqrt(np.maximum(radius**2 - (nearest**2).sum(1), 0.0))
    begin, end = np.full(len(points), np.nan), np.full(len(points), np.nan)
    near = half > 0.0
    if isinstance(shape, yade.Sphere):
        begin[near], end[near] = -half[near], half[near]
    elif near.any():
        begin[near] = _first_root(shape, nearest[near], along, -half[near])
        hit = np.flatnonzero(near)[np.isfinite(begin[near])]
        if len(hit):
            end[hit] = -_first_root(shape, nearest[hit], -along, -half[hit])
    return (begin + middle) / length, (end + middle) / length


def _first_root(shape, points, along, start):
    """The least t with S(points + t along) = 1, from t = start where S >= 1; nan where there is none."""
    normals = np.array([shape.a, shape.b, shape.c], float).T
    # Of a ball, k = 1, r has no meaning.
    offsets, weight, round_weight = np.array(
        shape.d, float), (1.0 - shape.k) / shape.r**2 if shape.k < 1.0 else 0.0, shape.k / shape.R**2
    # Distances beyond the planes are c + t s.
    distances, slopes = points @ normals.T - offsets, normals @ along
    constant, linear = (points**2).sum(1), points @ along
    t, missed = start.copy(), np.zeros(len(points), bool)
    for _ in range(_NEWTON_STEPS):
        beyond = np.maximum(distances + t[:, None] * slopes, 0.0)
        value = weight * (beyond**2).sum(1) + round_weight * (constant + 2.0 * t * linear + t * t) - 1.0
        slope = 2.0 * weight * beyond @ slopes + 2.0 * round_weight * (linear + t)
        missed |= (slope >= 0.0) & (value > 0.0)
        step = np.where((slope < 0.0) & (value > 0.0) & ~missed, -value / np.where(slope < 0.0, slope, -1.0), 0.0)
        t += step
        if (step <= _CONVERGED * np.abs(start).max()).all():
            break
    t[missed] = np.nan
    return t


def united(lines, begins, ends):
    """(line, begin, end), each (n,): the disjoint intervals of intervals on the lines of these numbers, in any order,
    that may overlap.
    """
    if not len(begins):
        return lines, begins, ends
    # Each line has a stretch of its own, so that all are united at once.
    stretch = 4.0 * max(np.abs(begins).max(), np.abs(ends).max())
    begins, ends = _united(begins + stretch * lines, ends + stretch * lines)
    lines = np.rint(begins / stretch).astype(int)
    return lines, begins - stretch * lines, ends - stretch * lines


def _united(begins, ends):
    """The same of intervals on one line."""
    order = np.argsort(begins)
    begins, reached = begins[order], np.maximum.accumulate(ends[order])
    first = np.append(True, begins[1:] > reached[:-1])
    return begins[first], reached[np.append(np.flatnonzero(first)[1:] - 1, len(begins) - 1)]


def scatter(values):
    """Mean of the values of the grids (GRIDS, ...), and the bound on its error that holds in 95 % of cases."""
    values = np.asarray(values, float)
    return values.mean(0), _STUDENT * values.std(0, ddof=1) / math.sqrt(len(values))


def grids(lines, seed):
    """(places (GRIDS n, 2) in the unit square of about `lines` lines, n): GRIDS lattices of n points, one after the
    other, shifted at random by `seed`.
    """
    side = max(2, round(math.sqrt(whole(lines, 1, 10 * MANY, "lines") / GRIDS)))
    random = np.random.default_rng(whole(seed, 0, LARGE, "seed"))
    return np.concatenate([_grid(side, random) for _ in range(GRIDS)]), side**2


def _grid(side, random):
    """side^2 points of the unit square in a lattice that is shifted at random."""
    places = np.arange(side) / side
    u, v = np.meshgrid(places, places, indexing="ij")
    return np.column_stack([u.ravel(), v.ravel()]) + random.random(2) / side
