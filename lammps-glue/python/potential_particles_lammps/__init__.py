# SPDX-License-Identifier: MIT OR Apache-2.0
"""What goes with the LAMMPS plugin and needs no YADE, beside potential_particles: files of shapes, and pictures of
dumps. Needs numpy; pictures need vtk.

    from potential_particles_lammps import Particle, write_shapes, write_vtk, write_picture
"""
from potential_particles import Particle, detect

from .pictures import write_picture, write_vtk
from .shapes import polyhedron, read_shapes, write_drum, write_shapes

__all__ = [
    "Particle", "detect", "polyhedron", "read_shapes", "write_drum", "write_picture", "write_shapes", "write_vtk"
]
