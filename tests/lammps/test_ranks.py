# SPDX-License-Identifier: GPL-2.0-or-later
"""Several ranks, migration, periodic boxes and restarts."""
import os
import signal
import subprocess
import time

import numpy as np
import pytest
from scene import (DEFAULTS, FRICTION, LAMMPS, SCRIPT, SHEAR, STIFFNESS, lammps, random_bodies, run, shapes,
                   state, thermo, write)

from potential_particles.lammps.pictures import frames
from potential_particles.lammps.shapes import principal

FLOOR = f"fix floor all wall/potential/particle {STIFFNESS} {SHEAR} {FRICTION} 0.3 plane 0 0 0 0 0 1"


def heap(seed=11):
    """24 bodies that slide over x = 0 and y = 0, where two and four ranks have their borders."""
    return [(b[0], b[1], b[2] + np.array([3.0, 1.2, 0]), b[3], b[4])
            for b in random_bodies(24, 0.115, seed=seed, low=(-0.25, -0.2, 0.1))]


def test_ranks_agree(folder):
    """One and two ranks, with bodies and sliding contacts that cross the border."""
    ends = []
    for ranks in (1, 2):
        dumped, said = run(folder, heap(), ranks=ranks, processors="processors * 1 1", walls=FLOOR,
                           coefficients=f"pair_coeff * * {STIFFNESS} {SHEAR} {FRICTION} 0.3", run="thermo 10\nrun 300")
        ends.append((state(dumped[-1][1]), thermo(said)))
        start = state(dumped[0][1])
    crossed = (np.sign(start[:, 0]) != np.sign(ends[0][0][:, 0])).sum()
    assert crossed > 3 and ends[0][1]["c_pp[1]"].max() > 8, (crossed, ends[0][1]["c_pp[1]"])
    for end, table in ends[1:]:
        assert np.abs(end[:, :3] - ends[0][0][:, :3]).max() < 1e-8, np.abs(end - ends[0][0]).max()
        for column in ("PotEng", "f_move", "c_pp[1]", "c_pp[4]", "c_pp[5]"):
            assert np.allclose(table[column], ends[0][1][column], rtol=1e-6,
                               atol=1e-10), (column, table[column], ends[0][1][column])


@pytest.mark.long
def test_four_ranks(folder):
    """Few steps, since four ranks wait for each other where there are two cores: forces over edges between ranks."""
    bodies = [(b[0], np.asarray(b[1]) * 0.8, *b[2:])
              for b in random_bodies(8, 0.1, seed=6, low=(-0.05, -0.05, -0.05), across=2)]
    ends = [
        state(run(folder, bodies, ranks=ranks, processors="processors * * 1", run="run 12")[0][-1][1])
        for ranks in (1, 4)
    ]
    assert np.abs(ends[0] - ends[1])[:, :3].max() < 1e-9 and np.abs(ends[0][:, 3:6] - [b[2]
                                                                                       for b in bodies]).max() > 0.05


def test_periodic(folder):
    """A heap in the middle of a periodic box and the same over its faces."""
    ends = []
    for shift in (0.0, 0.5):
        bodies = [(b[0], [*((np.asarray(b[1])[:2] + shift + 0.5) % 1 - 0.5), b[1][2]], *b[2:]) for b in heap()]
        dumped, _ = run(folder, bodies, box="-0.5 0.5 -0.5 0.5 -1 1", boundary="p p f", walls=FLOOR, run="run 600")
        s = state(dumped[-1][1])
        s[:, :2] = (s[:, :2] - shift + 0.5) % 1 - 0.5
        ends.append(s)
    assert np.abs(ends[0] - ends[1])[:, :3].max() < 1e-7, np.abs(ends[0] - ends[1]).max()


AGAIN = """read_restart half.restart
{shapes}
{style}
{coefficients}
{neighbor}
comm_modify vel yes
fix move all nve/potential/particle
{gravity}
{walls}
compute pp all pair potential/particle
thermo_style custom step ke pe f_move c_pp[1] c_pp[2] c_pp[3] c_pp[4] c_pp[5] f_floor[3] f_floor[4]
thermo_modify format float %.17g
dump all all custom 1 again.dump id type x y z vx vy vz omegax omegay omegaz d2_orientation[1] d2_orientation[2] d2_orientation[3] d2_orientation[4]
dump_modify all sort id format float %.17g
run 150
"""


def test_restart_in_the_middle(folder):
    """A run that goes on from a file, on as many ranks or more, is the run that was not interrupted: friction,
    dashpots, energies.
    """
    parts = {"walls": FLOOR, "coefficients": f"pair_coeff * * {STIFFNESS} {SHEAR} {FRICTION} 0.3", "boundary": "f f f"}
    whole, said = run(
        folder, heap(), run="thermo 10\nrun 300", before="restart 150 half.restart other.restart\n"
        "thermo_style custom step ke pe f_move c_pp[1] c_pp[2] c_pp[3] c_pp[4] c_pp[5] f_floor[3] f_floor[4]", **parts)
    (folder / "half.restart").exists() or (folder / "other.restart").rename(folder / "half.restart")
    wanted, table = state(whole[-1][1]), thermo(said)
    assert table["c_pp[4]"][0] == 0 and table["c_pp[1]"].max() > 8, table["c_pp[1]"]
    for ranks in (1, 2):
        status, said = lammps(folder, "newton off\nprocessors * * 1\n" + AGAIN.format(**{**DEFAULTS, **parts}), ranks)
        assert status == 0
        again = list(frames(folder / "again.dump"))
        assert again[0][0] == 150 and again[-1][0] == 300
        error = np.abs(state(again[-1][1]) - wanted)[:, :3].max()
        assert error < 1e-9, (ranks, error)
        first = np.abs(state(again[0][1]) - state(whole[150][1])).max()
        assert first == 0, first
        for column in ("c_pp[4]", "c_pp[5]", "f_floor[3]", "f_floor[4]"):
            assert np.isclose(thermo(said)[column][-1], table[column][-1],
                              rtol=1e-8), (column, thermo(said)[column][-1], table[column][-1])


def test_runs_in_parts(folder):
    """Two runs one after the other are one, also with a restart written by command between and atoms that balance."""
    parts = {"walls": FLOOR, "coefficients": f"pair_coeff * * {STIFFNESS} {SHEAR} {FRICTION} 0.3"}
    whole, _ = run(folder, heap(), run="run 300", **parts)
    split, _ = run(folder, heap(), ranks=2,
                   run="run 150\nwrite_restart x.restart\nbalance 1.0 shift x 5 1.05\nrun 75\nrun 75 pre no", **parts)
    steps = {step: state(columns) for step, columns in split}
    error = np.abs(steps[300] - state(whole[-1][1]))[:, :3].max()
    assert error < 1e-8, error


def test_killed_rank(folder):
    """A rank that is killed ends the run."""
    write(folder, heap(), DEFAULTS["box"])
    (folder / "in.scene").write_text(
        SCRIPT.format(**{**DEFAULTS, "walls": FLOOR, "run": "run 100000000", "before": "undump all"}))
    run_ = subprocess.Popen([LAMMPS, "2", "-in", "in.scene", "-log", "none"], cwd=folder, stdin=subprocess.DEVNULL,
                            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True)
    try:
        ranks, until = [], time.time() + 30
        while len(ranks) < 2 and time.time() < until:
            time.sleep(0.3)
            for process in os.listdir("/proc"):
                if process.isdigit() and process not in ranks:
                    try:
                        words = open(f"/proc/{process}/cmdline").read().split("\0")
                        inside = os.readlink(f"/proc/{process}/cwd")
                    except OSError:
                        continue
                    if words[0].endswith("/lmp"):  # and not the wheel's script that starts it
                        if inside == str(folder.resolve()) and "hydra" not in words[0] and "mpiexec" not in words[0]:
                            ranks.append(process)
        assert len(ranks) >= 2, ranks
        os.kill(int(ranks[-1]), signal.SIGKILL)
        assert run_.wait(timeout=30) != 0
    finally:
        if run_.poll() is None:
            os.killpg(run_.pid, signal.SIGKILL)


DEPOSIT = """units si
atom_style sphere
newton off
comm_modify vel yes
boundary p p f
region box block -0.4 0.4 -0.4 0.4 -0.1 2
create_box 2 box
fix shapes all potential/particle/shapes shapes.txt type 1 pyramid 2600 type 2 cuboid 2600 orient random 4
pair_style potential/particle
pair_coeff * * 1e5 6e4 0.4 0.3
fix floor all wall/potential/particle 1e5 6e4 0.4 0.3 plane 0 0 0 0 0 1
region fill block -0.35 0.35 -0.35 0.35 1.0 1.5
fix pour all deposit 30 1 60 12345 region fill near 0.18 vz -1 -1
neighbor 0.02 bin
fix move all nve/potential/particle
fix weight all gravity 9.81 vector 0 0 -1
timestep 2e-4
thermo 1000
run 3000
group gone id 3
delete_atoms group gone compress no
dump all all custom 1 all.dump id type x y z mass radius d2_orientation[1] d2_orientation[2] d2_orientation[3] d2_orientation[4]
run 500
clear
"""


def test_atoms_that_come_during_a_run(folder):
    """fix deposit: bodies get shape, mass and a random orientation when they come, on one rank and on two; `clear` ends
    the scene.
    """
    write(folder, heap(), DEFAULTS["box"])  # for its file of shapes
    shape = principal(shapes()["pyramid"])[0]
    for ranks in (1, 2):
        status, said = lammps(folder, DEPOSIT, ranks)
        assert status == 0
        last = list(frames(folder / "all.dump"))[-1][1]
        assert len(last["id"]) == 29 and (last["z"] > 0).all()
        assert np.allclose(last["mass"], 2600 * shape.mass_properties(1e-9).volume, rtol=1e-5) and np.allclose(
            last["radius"], shape.bounding_radius, rtol=1e-5)
        q = np.column_stack([last[f"d2_orientation[{n}]"] for n in (1, 2, 3, 4)])
        assert np.abs(np.linalg.norm(q, axis=1) - 1).max() < 1e-5 and np.std(q, axis=0).min() > 0.1
