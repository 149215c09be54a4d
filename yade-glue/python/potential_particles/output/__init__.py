# SPDX-License-Identifier: GPL-3.0-or-later
"""What comes out of a scene: meshes, pictures, and files for ParaView.

    mesh.py        a closed mesh of a shape, and its file .stl or .vtp
    vtk_files.py   files for ParaView, through VTK's Python modules
    drawn.py       YADE's bodies as triangles
    patches.py     contact patches as triangles with their pressure
    view.py        a pinhole camera
    graphics.py    OpenGL without a display
    light.py       sun and sky
    picture.py     the picture of a scene
    recorder.py    frames for ParaView, while the scene runs
    limit_picture.py   forces and mechanism of limit analysis
"""
from .limit_picture import plot_equilibrium
from .mesh import Mesh, mesh, save_mesh
from .picture import plot
from .recorder import Recorder

__all__ = ["Mesh", "Recorder", "mesh", "plot", "plot_equilibrium", "save_mesh"]
