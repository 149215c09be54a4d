# SPDX-License-Identifier: GPL-2.0-or-later
"""Motion and contacts of bodies against the loop in Python, and against closed forms."""

import numpy as np
import pytest
from loop import Loop, matrix
from potential_particles.lammps.pictures import frames
from potential_particles.lammps.shapes import principal
from scene import (DENSITY, DT, FRICTION, SHEAR, STIFFNESS, TOP, lammps, process, random_bodies, run, shapes,
                   state, thermo)


def loop_of(bodies, **more):
    return Loop(list(shapes().values()), bodies, DENSITY, STIFFNESS, SHEAR, FRICTION, DT, **more)


def compare(folder, bodies, steps, planes=(), tolerance=1e-9, **parts):
    """Every step of LAMMPS is that of the loop: lengths to `tolerance` m, velocities to that over the time of ten
    steps.
    """
    walls = "".join(f"fix wall{n} all wall/potential/particle {STIFFNESS} {SHEAR} {FRICTION} 1 plane "
                    + " ".join(map(str, [*p, *n_])) + "\n" for n, (p, n_) in enumerate(planes))
    dumped, _ = run(folder, bodies, run=f"run {steps}", walls=walls, **parts)
    loop, contacts = loop_of(bodies, planes=planes), 0
    for step, columns in dumped:
        if step:
            loop.step()
        got = state(columns)
        contacts = max(contacts, loop.contacts)
        for what, wanted, mine, most in (("x", loop.x, got[:, :3], tolerance), ("v", loop.v, got[:, 3:6], tolerance /
                                                                                (10 * DT)),
                                         ("w", loop.w, got[:, 6:9], 20 * tolerance / (10 * DT)), ("R", np.array(
                                             loop.R), np.array([matrix(q) for q in got[:, 9:]]), 20 * tolerance)):
            error = np.abs(wanted - mine).max()
            assert error < most, f"step {step}: {what} differs by {error}"
    assert step == steps
    return contacts, loop


def test_block_slides_on_block(folder):
    """A contact that first sticks, then slides, and turns."""
    bodies = [(2, (0, 0, 0), (0, 0, 0), (0, 0, 0), (1, 0, 0, 0)),
              (2, (0.013, 0.007, 0.0605), (0.8, 0.1, -0.3), (0.2, 0.1, 1.0), (0.96, 0.0, 0.0, 0.28))]
    contacts, loop = compare(folder, bodies, 200)
    assert contacts == 1
    assert np.linalg.norm(loop.w[0]) > 1e-3  # it was turned by friction


@pytest.mark.long
def test_pile_of_36(folder):
    """36 bodies of two shapes fall into each other and on a floor."""
    bodies = random_bodies(36, 0.115, seed=3, low=(-0.12, -0.12, 0.12))
    contacts, _ = compare(folder, bodies, 450, planes=[((0, 0, 0), (0, 0, 1))], tolerance=1e-8)
    assert contacts > 25, contacts


def test_order_of_atoms_does_not_matter(folder):
    """Sorting of atoms, rebuilds in every step, carried contacts and threads change nothing beyond rounding and the
    tolerance of carrying.
    """
    bodies = random_bodies(18, 0.11, seed=5, low=(-0.1, -0.1, 0.1))
    floor = f"fix floor all wall/potential/particle {STIFFNESS} {SHEAR} {FRICTION} 1 plane 0 0 0 0 0 1"
    ends = []
    for more in ({}, {"modify": "atom_modify sort 3 0.15\nneigh_modify every 1 check no"},
                 {"style": "pair_style potential/particle carry 1e-9 threads 2"}):
        dumped, said = run(folder, bodies, walls=floor, run="run 500\nprint 'contacts $(c_pp[1])'", **more)
        ends.append(state(dumped[-1][1]))
    assert np.abs(ends[0] - ends[1]).max() < 1e-8, np.abs(ends[0] - ends[1]).max()
    assert np.abs(ends[0] - ends[2]).max() < 1e-4, np.abs(ends[0] - ends[2]).max()


def test_free_rotation(folder):
    """Without torque angular momentum stays to rounding; energy and orientation err with the square of the step."""
    w0 = np.array([2.0, 5.0, 40.0])
    body = [(2, (0, 0, 0), (0, 0, 0), w0, (1, 0, 0, 0))]
    moments = np.diag(shapes()["cuboid"].mass_properties(1e-9).inertia) * DENSITY
    ends = []
    for halvings in range(3):
        dt, steps = 4e-4 / 2**halvings, 500 * 2**halvings
        dumped, said = run(folder, body, gravity="", timestep=f"timestep {dt}", run=f"run {steps}")
        momenta = [
            matrix(q) @ (moments * (matrix(q).T @ w))
            for q, w in ((s[0, 9:], s[0, 6:9]) for s in (state(c) for _, c in dumped))
        ]
        drift = np.abs(np.array(momenta) - momenta[0]).max() / np.linalg.norm(momenta[0])
        assert drift < 1e-12, drift
        ends.append((state(dumped[-1][1])[0, 9:], thermo(said)["f_move"][-1]))
    exact = 0.5 * moments @ w0**2
    ratio = np.abs(ends[0][0] - ends[1][0]).max() / np.abs(ends[1][0] - ends[2][0]).max()
    assert 3.5 < ratio < 4.5, ratio
    assert abs(ends[2][1] / exact - 1) < 1e-4, ends[2][1] / exact - 1


def test_energy_without_friction(folder):
    """Elastic, without friction: momentum stays to rounding. Energy stays to the square of the step for balls, whose
    force is the gradient of the energy of the spring; for other bodies to a share of the overlap over the size, since
    the line of the overlap turns with the bodies.
    """
    bodies = [(1, (0, 0, 0), (0.5, 0, 0), (0, 0, 2), (0.9, 0.1, 0.3, -0.2)),
              (2, (0.16, 0.01, 0.005), (-0.6, 0, 0), (1, 0, 0), (0.8, -0.3, 0.1, 0.4))]
    (folder / "balls.txt").write_text("shape ball\nr 1\nk 1\nR 0.07\nend\n")
    rises = []
    for more, steps in (({}, 1), ({"shapes": "fix shapes all potential/particle/shapes balls.txt type * ball 2600"}, 1),
                        ({"shapes": "fix shapes all potential/particle/shapes balls.txt type * ball 2600"}, 2)):
        dumped, said = run(folder, bodies, gravity="", coefficients=f"pair_coeff * * {STIFFNESS} 0 0 1",
                           timestep=f"timestep {DT / steps}", run=f"thermo 1\nrun {1500 * steps}", **more)
        table = thermo(said)
        assert table["c_pp[1]"].max() == 1 and table["c_pp[1]"][-1] == 0
        energy = table["KinEng"] + table["PotEng"] + table["f_move"]
        rises.append(np.abs(energy / energy[0] - 1).max())
        if more:
            momentum = np.array([state(columns)[:, 3:6].sum(axis=0) for _, columns in dumped])
        else:
            masses = [DENSITY * principal(shapes()[name])[0].mass_properties(1e-9).volume for name in ("pyramid", "cuboid")]
            momentum = np.array([masses @ state(columns)[:, 3:6] for _, columns in dumped])
        error = np.abs(momentum - momentum[0]).max() / np.abs(momentum[0]).max()
        assert error < 1e-10, error
    assert rises[0] < 0.01 and rises[1] < 0.01 and rises[2] < 0.4 * rises[1], rises


def test_energy_balance_with_dissipation(folder):
    """What friction and dashpots take is what is missing, to the order of the step: of balls, whose overlap has the
    normal force as its gradient exactly.
    """
    bodies = random_bodies(9, 0.11, seed=9, low=(-0.1, -0.1, 0), speed=1.0)
    (folder / "balls.txt").write_text("shape ball\nr 1\nk 1\nR 0.05\nend\n")
    balls = "fix shapes all potential/particle/shapes balls.txt type * ball 2600"
    errors = []
    for halvings in range(2):
        _, said = run(folder, bodies, gravity="", shapes=balls,
                      coefficients=f"pair_coeff * * {STIFFNESS} {SHEAR} 0.4 0.6",
                      timestep=f"timestep {0.5 * DT / 2**halvings}", run=f"thermo 100\nrun {1500 * 2**halvings}")
        table = thermo(said)
        sums = table["KinEng"] + table["PotEng"] + table["f_move"] + table["c_pp[4]"] + table["c_pp[5]"]
        lost = table["c_pp[4]"][-1] + table["c_pp[5]"][-1]
        assert lost > 0.1 * sums[0]
        errors.append(abs(sums[-1] - sums[0]) / lost)
    assert errors[0] < 0.05 and errors[1] < 0.7 * errors[0], errors


def test_restitution(folder):
    """Two cubes that meet face to face leave with the share of their velocity that was asked for."""
    for e in (0.3, 0.8):
        bodies = [(2, (0, 0, 0), (0, 0, 0.2), (0, 0, 0), (1, 0, 0, 0)),
                  (2, (0, 0, 0.0605), (0, 0, -0.2), (0, 0, 0), (1, 0, 0, 0))]
        dumped, _ = run(folder, bodies, gravity="", coefficients=f"pair_coeff * * {STIFFNESS} {SHEAR} 0 {e}",
                        timestep="timestep 2e-5", run="run 2500")
        v = state(dumped[-1][1])[:, 5]
        assert abs((v[1] - v[0]) / 0.4 - e) < 0.01, (v, e)


def test_restitution_against_held_bodies(folder):
    """A body that nothing moves counts as one without end of mass: the dashpots are those of the other one."""
    speed = 1.0
    bodies = [(2, (0, 0, 0), (0, 0, 0), (0, 0, 0), (1, 0, 0, 0)),
              (2, (0, 0, 0.0601), (0, 0, -speed), (0, 0, 0), (1, 0, 0, 0))]
    dumped, _ = run(folder, bodies, gravity="group free id 2\nunfix move\nfix move free nve/potential/particle",
                    coefficients=f"pair_coeff * * {STIFFNESS} {SHEAR} 0 0.5", timestep="timestep 1e-5",
                    run="dump_modify all every 1000\nrun 4000")
    after = state(dumped[-1][1])
    assert abs(after[1, 5] / speed - 0.5) < 0.01 and not after[0, 3:9].any(), after


def test_deleted_atoms_take_only_their_contacts(folder):
    """A fix that deletes atoms during a run moves others into their place: the springs of friction stay with their
    bodies.
    """
    corner = [(2, (-0.8, -0.8, -0.8), (0, 0, 0), (0, 0, 0), (1, 0, 0, 0))]
    slide = [(2, (0, 0, 0), (0, 0, 0), (0, 0, 0), (1, 0, 0, 0)),
             (2, (0, 0, 0.0595), (0.05, 0, 0), (0, 0, 0), (1, 0, 0, 0)),
             (2, (0, 0.4, 0), (0, 0, 0), (0, 0, 0), (1, 0, 0, 0)),
             (2, (0, 0.4, 0.0597), (0.3, 0, 0), (0, 0, 0), (1, 0, 0, 0))]
    ends = {}
    for name, bodies, more in (
        ("deleted", corner + slide,
         "region corner block -0.9 -0.7 -0.9 -0.7 -0.9 -0.7\nfix gone all evaporate 20 1 corner 7\nthermo_modify lost ignore"
         ), ("never there", slide, "")):
        dumped, _ = run(folder, bodies, gravity="", before=more, run="run 200")
        ends[name] = state(dumped[-1][1])
    assert len(ends["deleted"]) == 4
    error = np.abs(ends["deleted"] - ends["never there"]).max()
    assert error < 1e-9, error


def test_stress_of_two(folder):
    """compute stress/atom gives the branch vector times the force."""
    bodies = [(2, (0, 0, 0), (0, 0, 0), (0, 0, 0), (1, 0, 0, 0)),
              (2, (0, 0, 0.0595), (0, 0, 0), (0, 0, 0), (1, 0, 0, 0))]
    _, said = run(
        folder, bodies, gravity="", before="compute s all stress/atom NULL virial\ncompute sum all reduce sum c_s[3]\n"
        "thermo_style custom step pe c_sum c_pp[1] c_pp[3]", run="run 0")
    table = thermo(said)
    overlap = 0.06 - 0.0595
    assert abs(table["c_sum"][0] / (-0.0595 * STIFFNESS * overlap) - 1) < 1e-6, table
    assert abs(table["PotEng"][0] / (0.5 * STIFFNESS * overlap**2) - 1) < 1e-6, table


YADE = TOP / "yade-glue" / "build" / "python" / "potential_particles"


def test_same_scene_in_yade(folder):
    """Two bricks that hit, slide and rotate on a wall: a scene of YADE, carried over by to_lammps, moves as in YADE, to
    the order of the time step.
    """
    if not YADE.exists():
        print("not tried: the YADE plugin is not built (make build)")
        return
    errors = []
    for halvings in range(2):
        _, told = process(
            folder, [TOP / "scripts" / "yade.sh", "-j1", TOP / "tests" / "lammps" / "yade_scene.py", folder, halvings])
        assert (folder / "yade.npy").exists()
        wanted, every = np.load(folder / "yade.npy"), 2**halvings
        status, said = lammps(
            folder, f"include scene.lmp\ndump 1 all custom {every} all.dump id type x y z "
            "d2_orientation[1] d2_orientation[2] d2_orientation[3] d2_orientation[4]\ndump_modify 1 sort id format float %.17g\n"
            f"run {len(wanted) - 1}")
        assert status == 0
        mine = [np.column_stack([columns[c] for c in "xyz"]) for _, columns in frames(folder / "all.dump")]
        errors.append(np.abs(np.array(mine) - wanted[::every, :, :3]).max())
        moved = np.abs(wanted[-1] - wanted[0]).max(axis=0)
    assert moved[3:].max() > 0.01, moved  # they have turned
    assert errors[0] < 1e-7 and errors[1] < 0.6 * errors[0], errors
