# SPDX-License-Identifier: GPL-2.0-or-later
"""Planes, meshes and walls that move."""
import shutil
import struct

import numpy as np
from scene import (DENSITY, DT, FRICTION, SCRIPT, SHEAR, STIFFNESS, TOP, random_bodies, refused, run, shapes, state,
                   thermo)
from test_motion import compare


def write_stl(path, triangles, binary=True):
    triangles = np.asarray(triangles, float)
    if binary:
        path.write_bytes(b"solid binary".ljust(80) + struct.pack("<I", len(triangles))
                         + b"".join(struct.pack("<12fH", 0, 0, 0, *t.ravel(), 0) for t in triangles))
    else:
        path.write_text("solid t\n"
                        + "".join("facet normal 0 0 0\nouter loop\n" + "".join("vertex %.9g %.9g %.9g\n" % tuple(v)
                                                                               for v in t) + "endloop\nendfacet\n"
                                  for t in triangles) + "endsolid\n")


def floor(cells, size, scale=1.0):
    """Triangles of a square floor at z = 0, some turned over."""
    at = np.linspace(-size, size, cells + 1) / scale
    return [t for x0, x1 in zip(at, at[1:]) for y0, y1 in zip(at, at[1:])
            for t in ([(x0, y0, 0), (x1, y0, 0), (x1, y1, 0)], [(x0, y0, 0), (x0, y1, 0), (x1, y1, 0)])]


def test_planes(folder):
    """Two planes that meet, one of them inclined."""
    _, loop = compare(folder, [(*b[:2], b[2] + np.array([1.0, 0, -2.0]), *b[3:])
                               for b in random_bodies(4, 0.14, seed=2, low=(-0.14, -0.1, 0.12))], 500,
                      planes=[((0, 0, 0), (0, 0, 1)), ((0.1, 0, 0), (-1, 0, 0.3))], tolerance=1e-8)
    assert {key[1] for key in loop.ever} >= {-1, -2}, loop.ever


def test_mesh_is_the_plane(folder):
    """Bodies that fall, roll and slide on a floor of triangles move as on the plane, over all seams: forces of one
    contact each.
    """
    bodies = random_bodies(6, 0.2, seed=4, low=(-0.25, -0.2, 0.13), speed=1.5)
    ends = {}
    write_stl(folder / "floor.stl", floor(9, 0.9))
    write_stl(folder / "text.stl", floor(9, 0.9, scale=0.001), binary=False)
    for name, what in (("plane", "plane 0 0 0 0 0 1"), ("mesh", "stl floor.stl"), ("text", "stl text.stl scale 0.001")):
        dumped, said = run(folder, bodies,
                           walls=f"fix floor all wall/potential/particle {STIFFNESS} {SHEAR} {FRICTION} 0.2 {what}",
                           run="run 2500",
                           before="thermo_style custom step f_floor[1] f_floor[2] f_floor[3] f_floor[7]\nthermo 1")
        ends[name] = state(dumped[-1][1]), thermo(said)
    assert ends["plane"][1]["f_floor[1]"].max() >= 4 and ends["plane"][1]["f_floor[3]"][-1] > 0
    for name in ("mesh", "text"):
        assert (ends[name][1]["f_floor[1]"] == ends["plane"][1]["f_floor[1]"]).all()
        error = np.abs(ends[name][0] - ends["plane"][0])[:, :3].max()
        assert error < 1e-9, (name, error)


def test_belt(folder):
    """A plane that moves along itself takes a block along: friction first, then its velocity."""
    block = [(2, (0, 0, 0.0295), (0, 0, 0), (0, 0, 0), (1, 0, 0, 0))]
    mass = DENSITY * shapes()["cuboid"].mass_properties(1e-9).volume
    dumped, _ = run(
        folder, block, walls="fix belt all wall/potential/particle %g %g %g 0.3 plane 0 0 0 0 0 1 linear 0.2 0 0" %
        (STIFFNESS, SHEAR, FRICTION), run="run 3000")
    early, late = state(dumped[400][1])[0], state(dumped[-1][1])[0]
    assert abs(early[3] / (FRICTION * 9.81 * 400 * DT) - 1) < 0.15, early[3]
    assert abs(late[3] - 0.2) < 0.01 and abs(late[2] - (0.03 - mass * 9.81 / STIFFNESS)) < 2e-5, late


def test_wall_has_its_own_time(folder):
    """A wall that moves begins where the command says, whatever the time is then, and a time that is set anew does not
    move it: the block on it goes as with neither.
    """
    block = [(2, (0, 0, 0.0295), (0, 0, 0), (0, 0, 0), (1, 0, 0, 0))]
    wall = "fix wall all wall/potential/particle %g %g %g 0.3 plane 0 0 0 0 0 1 linear 0 0 0.1" % (STIFFNESS, SHEAR,
                                                                                                   FRICTION)
    frames = {}
    set_to = "undump all\nreset_timestep {}\n" + "\n".join(line
                                                           for line in SCRIPT.splitlines() if line.startswith("dump"))
    for name, parts in {
            "once": dict(run="run 200"), "set back": dict(run=f"run 100\n{set_to.format(0)}\nrun 100"),
            "set on": dict(run=f"run 100\n{set_to.format(700)}\nrun 100"),
            "later": dict(before=f"{set_to.format(300)}\n{wall}", run="run 200", walls="")
    }.items():
        dumped, _ = run(folder, block, **{"walls": wall, **parts})
        frames[name] = state(dumped[-1][1])[0]
    for name, end in frames.items():
        assert np.abs(end - frames["once"]).max() < 1e-12, (name, end, frames["once"])
    _, said = run(
        folder,
        block,
        walls=wall,
        run="undump all\ncompute height all reduce sum z\nthermo_style custom step c_height\nthermo_modify format float %.17g\n"
        "run 100\nreset_timestep 0\nrun 100 pre no",
    )
    assert abs(thermo(said)["c_height"][-1] - frames["once"][2]) < 1e-12


def test_wall_goes_on_from_a_restart(folder):
    """A moving wall that began after some steps is, in a run from a restart file, where it was."""
    block = [(2, (0, 0, 0.0295), (0, 0, 0), (0, 0, 0), (1, 0, 0, 0))]
    wall = "fix wall all wall/potential/particle %g %g %g 0.3 plane 0 0 0 0 0 1 linear 0 0 0.1" % (STIFFNESS, SHEAR,
                                                                                                   FRICTION)
    dumped, _ = run(folder, block, walls="", run=f"run 30\n{wall}\nrun 100\nwrite_restart half.restart\nrun 100")
    again = SCRIPT.replace("read_data scene.data fix orientation NULL orientation",
                           "read_restart half.restart").replace(
                               "fix orientation all property/atom d2_orientation 4 writedata yes\n", "")
    later, _ = run(folder, block, script=again.replace("boundary {boundary}\n", ""), walls=wall, run="run 100")
    assert (state(later[-1][1]) == state(dumped[-1][1])).all(), (later[-1][1], dumped[-1][1])


def test_periodic_border_of_a_wall(folder):
    """A floor of triangles that ends at a periodic border is told; one that goes on beyond it, or a plane across that
    border, is not.
    """
    block = [(2, (0, 0, 0.0295), (0, 0, 0), (0, 0, 0), (1, 0, 0, 0))]
    for size, told in ((1.0, True), (1.5, False)):
        write_stl(folder / "floor.stl", floor(4, size))
        _, said = run(
            folder, block, boundary="p f f", run="run 1",
            walls="fix floor all wall/potential/particle %g %g %g 0.3 stl floor.stl plane 0 0 -0.5 0 0 1" %
            (STIFFNESS, SHEAR, FRICTION))
        assert ("the box is periodic in x, the wall is not" in " ".join(said.split())) == told


def test_rotating_mesh(folder):
    """A wall that turns with the body's own angular velocity about its axis holds it as one at rest holds a body at
    rest.
    """
    write_stl(folder / "floor.stl", floor(5, 0.5))
    at = (0.1, 0.0, 0.02995)
    turn = 2 * np.pi
    body = [(2, at, np.cross((0, 0, turn), at), (0, 0, turn), (1, 0, 0, 0))]
    # It is held on its circle by friction: r w^2 < mu g.
    dumped, _ = run(
        folder, body,
        walls="fix table all wall/potential/particle %g %g 3.0 0.3 stl floor.stl flat 1e-4 rotate 0 0 0 0 0 1 1.0" %
        (STIFFNESS, SHEAR), run="run 5000")
    end = state(dumped[-1][1])[0]
    angle = turn * 5000 * DT
    assert np.abs(end[:2] - 0.1 * np.array([np.cos(angle), np.sin(angle)])).max() < 2e-3, end
    assert abs(end[8] - turn) < 0.05, end


def test_shipped_hopper_holds(folder):
    """Bodies in the hopper of the examples: nobody passes its walls of triangles."""
    bodies = [(1 + n % 2, (0.16 * (n % 3 - 1), 0.16 * (n // 3 % 3 - 1), 0.6 + 0.16 *
                           (n // 9)), (0, 0, -1), (1, 2, 3), (1, 0.2 * n, 0, 0.3)) for n in range(18)]
    shutil.copy(TOP / "examples" / "data" / "hopper.stl", folder)
    dumped, _ = run(
        folder, bodies, box="-2 2 -2 2 -3 3", timestep="timestep 2e-4",
        coefficients=f"pair_coeff * * {STIFFNESS} {SHEAR} 0.4 0.4",
        walls=f"fix hopper all wall/potential/particle {STIFFNESS} {SHEAR} 0.4 0.4 stl hopper.stl\n"
        f"fix below all wall/potential/particle {STIFFNESS} {SHEAR} 0.4 0.4 plane 0 0 -1.5 0 0 1",
        run="dump_modify all every 1000\nrun 3000")
    x = state(dumped[-1][1])[:, :3]
    assert np.isfinite(x).all() and (np.abs(x[:, :2]) < 1.5).all() and (x[:, 2] > -1.5).all(), x


def test_what_is_given_twice_pushes_once(folder):
    """Triangles that a mesh has twice, flipped or within rounding, are left out with a warning; planes are refused."""
    once = np.array(floor(3, 0.9), float)
    write_stl(folder / "once.stl", once)
    doubled = [np.concatenate([once, once[:5]]), np.concatenate([once, once[:5, ::-1]]),
               np.concatenate([once, once[:5, [1, 2, 0]]])]
    ball = [(2, (0.1, 0.05, 0.0298), (0.3, 0, -0.1), (0, 0, 0), (1, 0, 0, 0))]
    wall = f"fix floor all wall/potential/particle {STIFFNESS} {SHEAR} 0.4 0.5 "
    expected, _ = run(folder, ball, walls=wall + "stl once.stl", run="run 100")
    for mesh in doubled:
        write_stl(folder / "twice.stl", mesh)
        found, said = run(folder, ball, walls=wall + "stl twice.stl", run="run 100")
        assert (state(found[-1][1]) == state(expected[-1][1])).all()
        assert "5 of the triangles of twice.stl have the corners of another one" in said
    for again in ("0 0 0 0 0 1", "1 2 0 0 0 -1", "0 0 1e-9 0 0 2"):
        said = refused(folder, ball, walls=wall + f"plane 0 0 0 0 0 1 plane 1 0 0 1 0 0 plane {again}")
        assert "planes 1 and 3 are one" in said
