# SPDX-License-Identifier: MIT OR Apache-2.0
"""What goes with the LAMMPS plugin: files of shapes, and pictures of dumps, which need vtk.

    from potential_particles.lammps import write_shapes, write_vtk, write_picture
"""
from .pictures import write_picture, write_vtk
from .shapes import polyhedron, read_shapes, write_drum, write_shapes

__all__ = [
    "polyhedron", "read_shapes", "write_drum", "write_picture", "write_shapes", "write_vtk"
]
