# SPDX-License-Identifier: GPL-2.0-or-later
"""The examples with few steps, and the files that pictures are made of."""
import shutil

import numpy as np
from scene import LAMMPS, TOP, process

from potential_particles.lammps import read_shapes, write_vtk
from potential_particles.lammps.pictures import frames, polydata


def example(name, folder, *variables):
    # Beside each other as there, by relative paths: in scripts LAMMPS splits others at spaces, and knows ASCII alone.
    shutil.copytree(TOP / "examples" / "lammps", folder / "lammps")
    shutil.copytree(TOP / "examples" / "data", folder / "data")
    status, _ = process(folder, [
        LAMMPS, 1, "-in", f"lammps/{name}.lmp", "-log", "none", "-var", "here", "lammps", "-var", "out", ".", *variables
    ])
    assert status == 0
    return list(frames(folder / f"{name}.dump"))


def test_pile_and_its_files(folder):
    dumped = example("pile", folder, "-var", "bodies", "20", "-var", "steps", "3000")
    assert len(dumped) == 4 and dumped[-1][1]["z"].max() < 2.4 and dumped[-1][1]["z"].min() > 0
    shapes = read_shapes(TOP / "examples" / "lammps" / "bodies.shapes")
    data = polydata(dumped[-1][1], [shapes["pyramid"]])
    import vtk
    mass = vtk.vtkMassProperties()
    mass.SetInputData(data)
    mass.Update()
    assert abs(mass.GetVolume() / (20 * shapes["pyramid"].mass_properties().volume) - 1) < 0.02, mass.GetVolume()
    assert write_vtk(folder / "pile.dump", [shapes["pyramid"]], str(folder / "pile")) == 4
    assert "pile.0000003000.vtp" in (folder / "pile.pvd").read_text() and (
        folder / "pile.0000003000.vtp").stat().st_size > 10_000


def test_hopper(folder):
    dumped = example("hopper", folder, "-var", "bodies", "15", "-var", "filling", "3000", "-var", "steps", "1000")
    assert len(dumped) == 2 and np.abs(dumped[-1][1]["x"]).max() < 1.0


def test_drum(folder):
    dumped = example("drum", folder, "-var", "steps", "2000")
    assert (np.hypot(dumped[-1][1]["x"], dumped[-1][1]["z"]) < 0.5).all() and np.abs(dumped[-1][1]["y"]).max() < 0.4


def test_wall(folder):
    """The ball breaks bonds of the wall that were all whole, and the wall stays."""
    dumped = example("wall", folder, "-var", "steps", "120", "-log", "wall.log")
    table = [
        line.split() for line in (folder / "wall.log").read_text().splitlines() if line.split()[:1] in (["0"], ["120"])
    ]
    assert len(dumped) == 1 and table[0][4] == "117" and int(table[1][4]) < 117 and float(table[1][8]) > 0, table
