# SPDX-License-Identifier: MIT OR Apache-2.0
"""Bodies from files of other codes, in place.

    from potential_particles.other_codes import read_shp
    bodies = read_shp("rocks.shp")
    bodies.shapes["rock"]                                                     # a Shape
    add_packing(bodies)                                                       # in YADE

read_shp reads the shapes of Rockable and exaDEM, read_tess the tessellations of Neper, read_lammps_bodies the rounded
polyhedra of LAMMPS. Each returns Bodies; what a body loses or gains is said in one SceneWarning for the file. Bodies
that are not convex are a ValueError, or, with hull=True, their convex hulls.
"""
from .bodies import Bodies
from .lammps import read_lammps_bodies
from .neper import read_tess
from .rockable import read_shp

__all__ = ["Bodies", "read_lammps_bodies", "read_shp", "read_tess"]
