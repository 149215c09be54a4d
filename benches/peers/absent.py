# SPDX-License-Identifier: MIT OR Apache-2.0
"""Figures that others publish, on their machines: of the paper, and of codes that no package registry has."""

# Name, what it is, their figure, their machine as far as it is stated, why it is not measured here.
PUBLISHED = (
    (
        "the paper (Boon, Houlsby & Utili)",
        "the cone programs of potential particles, by MOSEK",
        "a few hundred µs to a few ms a contact; 200 pyramids over 14,000 steps",
        "one core of a Core 2 Duo, 3.1 GHz",
        "MOSEK is a commercial program; its place is taken by clarabel above",
    ),
    (
        "DGD",
        "growth distance between convex bodies, with a bound on the error",
        "medians of 1.1 to 1.35 µs cold, 0.6 to 0.7 µs warm, meshes; gap 1.5e-8",
        "not stated with the figure",
        "in no package registry",
    ),
    (
        "iDCOL (arXiv 2602.03250)",
        "scale at which two smoothed polytopes touch, 6 x 6 Newton's method; derivatives in the pose",
        "tolerance 1e-10; its times could not be read here",
        "not read",
        "in no package registry; the rows chunky above are its kind of bodies (beta = 20)",
    ),
    ("openGJK", "GJK alone: distance", "0.22 µs, on a GPU", "a GPU", "in no package registry"),
    ("Coal, as published", "GJK with Nesterov acceleration", "1.1 to 1.6 µs at 1e-6", "not stated with the figure",
     "measured above"),
    ("DCOL", "growth factor, by cone programs, in Julia", "13 µs a pair at 1e-10", "not stated with the figure",
     "Julia's packages are not at hand"),
    (
        "exaDEM",
        "piles of sphero-polyhedra",
        "7.4e5 body-steps a second a core (5,520 octahedra, 8 cores)",
        "not stated with the figure",
        "in no package registry",
    ),
)
