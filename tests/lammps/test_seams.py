# SPDX-License-Identifier: GPL-2.0-or-later
"""Seams of triangles: the same meshes in YADE and LAMMPS, and a mesh as one slab."""
from itertools import combinations

import numpy as np
from scene import SCRIPT, SHEAR, STIFFNESS, TOP, lammps, process, run, shapes, thermo
from test_walls import floor, write_stl

from potential_particles import Particle, Pose, Triangle, contact_with_triangle
from potential_particles.lammps.pictures import frames

YADE = TOP / "yade-glue" / "build" / "python" / "potential_particles"
PUSHES = ("fx", "fy", "fz", "tqx", "tqy", "tqz")


def shapes_in(path):
    """{name: Particle} of a file of shapes."""
    found, planes, numbers = {}, [], {}
    for line in path.read_text().splitlines():
        word, *values = line.split()
        if word == "shape":
            name, planes, numbers = values[0], [], {}
        elif word == "plane":
            planes.append([float(x) for x in values])
        elif word == "end":
            found[name] = Particle(planes, **numbers)
        else:
            numbers[word] = float(values[0])
    return found


def overlaps(particle, its_pose, triangle):
    return contact_with_triangle(particle, its_pose, Triangle(*triangle)).overlapping


def test_same_seams_in_yade(folder):
    """Bodies over 10,000 pairs of triangles that share an edge or a corner: YADE and LAMMPS push each of them alike,
    and each that touches has a contact; on a plane, a ridge and a cone exactly one.
    """
    if not YADE.exists():
        print("not tried: the YADE plugin is not built (make build)")
        return
    process(folder, [TOP / "scripts" / "yade.sh", "-j1", TOP / "tests" / "lammps" / "yade_seams_scene.py", folder, 17])
    yade = np.load(folder / "yade.npz")
    commands = (folder / "scene.lmp").read_text()
    (folder / "scene.lmp").write_text(commands.replace("stl scene.stl", "stl scene.stl flat 1e-4"))
    columns = " ".join(("id", "type", "x", "y", "z", *(f"d2_orientation[{i}]" for i in (1, 2, 3, 4)), *PUSHES))
    status, said = lammps(folder, "include scene.lmp\nthermo_style custom step f_facets[1]\n"
                          f"dump 1 all custom 1 all.dump {columns}\n"
                          "dump_modify 1 sort id format float %.17g\nrun 0")
    assert status == 0
    [(_, bodies)] = frames(folder / "all.dump")
    pushes, particles = np.column_stack([bodies[name] for name in PUSHES]), shapes_in(folder / "scene.shapes")
    ends = np.cumsum(yade["counts"])
    seams = 0
    for n, (end, count) in enumerate(zip(ends, yade["counts"])):
        its_pose = Pose([bodies[c][n] for c in "xyz"], [bodies[f"d2_orientation[{i}]"][n] for i in (1, 2, 3, 4)])
        particle = particles[f"shape{int(bodies['type'][n])}"]
        touched = [t for t in yade["triangles"][end - count:end] if overlaps(particle, its_pose, t)]
        seams += sum(bool({tuple(x) for x in a} & {tuple(x) for x in b}) for a, b in combinations(touched, 2))
        assert (yade["contacts"][n] > 0) == (len(touched) > 0), (n, yade["kinds"][n], yade["contacts"][n])
        if yade["kinds"][n] in ("flat", "cone", "ridge"):
            assert yade["contacts"][n] == (len(touched) > 0), (n, yade["kinds"][n], yade["contacts"][n])
    assert seams > 10_000, seams
    assert thermo(said)["f_facets[1]"][0] == yade["contacts"].sum()
    sizes = np.linalg.norm(yade["pushes"][:, :3], axis=1)
    differ = np.linalg.norm(pushes - yade["pushes"], axis=1) > 1e-9 * np.maximum(sizes, 1e-3 * sizes.max())
    assert not differ.any(), (np.flatnonzero(differ), yade["kinds"][differ][:5], pushes[differ][:3],
                              yade["pushes"][differ][:3])


def test_slides_as_over_one_slab(folder):
    """A body that is pushed over a floor of triangles, at an angle to its seams: it is pressed as by a plane, on
    patches to 1e-9, and in a point without a jump at any seam.
    """
    write_stl(folder / "floor.stl", floor(16, 0.5))
    parts = {
        "gravity": "", "before": "thermo_style one\nunfix move\nfix drive all move linear 1.7 0.9 0", "run": "run 100",
        "script": SCRIPT.replace("omegax omegay omegaz", "omegax omegay omegaz " + " ".join(PUSHES))
    }
    for kind, tilt, height in ((1, 0.0, 0.0248), (2, 0.3, 0.0415), (2, 0.0, 0.0298)):
        body = [(kind, (-0.3, -0.17, height), (1.7, 0.9, 0), (0, 0, 0), (np.cos(tilt / 2), np.sin(tilt / 2), 0, 0))]
        for stiffness, words in ((STIFFNESS, "flat 1e-4"), (1e9, "patch 1e-11")):
            plane, mesh = [], []
            for pushes, what in ((plane, "plane 0 0 0 0 0 1"), (mesh, "stl floor.stl")):
                wall = f"fix floor all wall/potential/particle {stiffness} {SHEAR} 0 1 {what} {words}"
                dumped, _ = run(folder, body, walls=wall, **parts)
                pushes += [[columns[name][0] for name in PUSHES] for _, columns in dumped]
            error = np.abs(np.subtract(mesh, plane)) / np.array(plane)[:, 2:3]
            assert len(error) == 101 and np.array(plane)[:, 2].min() > 10
            assert error[:, :3].max() < 1e-9 and error[:, 3:].max() < 1e-9 * shapes()["cuboid"].bounding_radius, (kind, tilt,
                                                                                                         words)
