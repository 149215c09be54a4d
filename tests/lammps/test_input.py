# SPDX-License-Identifier: GPL-2.0-or-later
"""What is refused, and that each refusal names the value and the remedy."""
import os
from pathlib import Path

from scene import DEFAULTS, SCRIPT, TOP, lammps, process, random_bodies, refused, run, thermo, write

BODIES = random_bodies(8, 0.1, seed=1, across=2, speed=0.2)
SHAPES = "fix shapes all potential/particle/shapes {} type 1 pyramid 2600 type 2 cuboid 2600"


def says(folder, *wanted, **parts):
    said = refused(folder, BODIES, rounded=False, **parts)
    for text in wanted:
        assert text in said
    assert "ERROR" in said


def test_commands(folder):
    says(
        folder, "atom_style sphere", atom="atom_style atomic",
        script=SCRIPT.replace("read_data scene.data fix orientation NULL orientation",
                              "region r block 0 1 0 1 0 1\ncreate_box 2 r"))
    says(folder, "units si", units="units metal")
    says(folder, "newton off", newton="newton on")
    says(folder, "comm_modify vel yes", velocities="")
    says(folder, "no shapes are known", shapes="")
    says(folder, "restitution = 2", "[0.01, 1]", coefficients="pair_coeff * * 1e5 1e5 0.5 2")
    says(folder, "normal stiffness = -1", coefficients="pair_coeff * * -1 1e5 0.5 0.5")
    says(folder, "expected I J KN KS FRICTION RESTITUTION", coefficients="pair_coeff * * 1e5 1e5 0.5")
    says(folder, "carry = 0.5", "[0, 0.1]", style="pair_style potential/particle carry 0.5")
    says(folder, "'carrry 1'", style="pair_style potential/particle carrry 1")
    says(folder, "threads = 0", style="pair_style potential/particle threads 0")
    says(folder, "timestep = 0.1", "unstable above", timestep="timestep 0.1")
    says(folder, "a contact of atom", "unstable above",
         walls="fix floor all wall/potential/particle 1e11 1e5 0.5 0.5 plane 0 0 -0.9 0 0 1")
    says(folder, "run_style verlet", before="run_style respa 2 2")
    says(folder, "there is no wall", walls="fix floor all wall/potential/particle 1e5 1e5 0.5 0.5")
    says(folder, "'plan'", walls="fix floor all wall/potential/particle 1e5 1e5 0.5 0.5 plan 0 0 0 0 0 1")
    says(folder, "plane has a direction of length 0",
         walls="fix floor all wall/potential/particle 1e5 1e5 0.5 0.5 plane 0 0 0 0 0 0")
    says(folder, "none.stl", "cannot be read",
         walls="fix floor all wall/potential/particle 1e5 1e5 0.5 0.5 stl none.stl", ranks=2)


def test_bodies_that_others_turn(folder):
    """A fix that turns bodies, but not their orientations, is told; one that only shifts them is not."""
    for move, told in (("rotate 0 0 0 0 0 1 1.0", True), ("linear 0.1 0 0", False)):
        _, said = run(folder, [(*b[:3], (0, 0, 0), b[4]) for b in BODIES],
                      before=f"unfix move\nfix move all move {move}\nthermo_style custom step", run="run 5")
        assert ("its orientation stays as it is" in " ".join(said.split())) == told


def test_ids_stay(folder):
    """Contacts know their bodies by IDs: a new numbering is refused where there are contacts."""
    column = [(2, (0.5, 0, 0.1), (0, 0, 0), (0, 0, 0),
               (1, 0, 0, 0))] + [(2, (0, 0, 0.0595 * n), (0, 0, 0), (0, 0, 0), (1, 0, 0, 0)) for n in range(3)]
    says_of = dict(run="run 10\ngroup gone id 1\ndelete_atoms group gone {}\nrun 10", gravity="")
    refusal = refused(folder, column, **{**says_of, "run": says_of["run"].format("compress yes")})
    assert "has the ID" in refusal and "compress no" in refusal
    run(folder, column, **{**says_of, "run": says_of["run"].format("compress no")})
    again = SCRIPT.replace("read_data scene.data fix orientation NULL orientation",
                           "read_restart all.restart").replace("boundary {boundary}\n", "")
    run(folder, column, gravity="", run="run 10\nwrite_restart all.restart")
    refusal = refused(folder, column,
                      script=again.replace("fix orientation all property/atom d2_orientation 4 writedata yes\n",
                                           ""), **{**says_of, "run": says_of["run"].format("compress yes")})
    assert "has the ID" in refusal
    run(folder, column[:1] + [(*column[1][:1], (0, 0, 0.5 * n), *column[1][2:]) for n in range(-1, 2)],
        **{**says_of, "run": says_of["run"].format("compress yes")})


def test_shape_files(folder):
    says(folder, "none.txt", "cannot be read", shapes=SHAPES.format("none.txt"), ranks=2)
    says(folder, "no shape rock", "pyramid cuboid",
         shapes="fix shapes all potential/particle/shapes shapes.txt type * rock 2600")
    says(folder, "type 2 has no shape",
         shapes="fix shapes all potential/particle/shapes shapes.txt type 1 pyramid 2600")
    says(folder, "density = -2", shapes="fix shapes all potential/particle/shapes shapes.txt type * pyramid -2")
    for text, wanted in {
            "shape a\nr 0.01\nk 0\nR 0.1\nplane 1 0 x 0.1\nend": "bad.txt:5: c = x",
            "shape a\nr 0.01\nk 0\nR 0.1\nplane 1 0 0 0.1\nend": "bad.txt:6: shape a:",
            "shape a\nr 0.01\nq 0": "bad.txt:3: 'q'",
            "\ufeffshape a\nr 0.01\nq 0": "bad.txt:3: 'q'",
            "shape a\nr 0.01\nk 1\nR 0.1": "has no end",
            "# nothing": "no shape in the file",
            "r 1": "outside a shape",
            "shape a\nr 0.01 5": "one word too many",
            "shape a\nk 1\nR 0.1\nend\nshape a\n": "stands here twice",
            # A cube about a point that is not its centre; a brick out of its axes.
            "shape a\nr 0.01\nk 0\nR 0.1\n" + "".join(f"plane {n} {d}\n" for n, d in (("1 0 0", 0.06), ("-1 0 0", 0.04), ("0 1 0", 0.05), ("0 -1 0", 0.05), ("0 0 1", 0.05), ("0 0 -1", 0.05))) + "end": "its centre of mass is at 0.01",
            "shape a\nr 0.01\nk 0\nR 0.1\n" + "".join(f"plane {n} {d}\n" for n, d in (("0.8 0.6 0", 0.09), ("-0.8 -0.6 0", 0.09), ("-0.6 0.8 0", 0.05), ("0.6 -0.8 0", 0.05), ("0 0 1", 0.05), ("0 0 -1", 0.05))) + "end": "not principal",
    }.items():
        (folder / "bad.txt").write_text(text)
        says(folder, wanted, shapes=SHAPES.format("bad.txt"))


DRIVER = """import sys
from lammps import lammps
scene = lammps(cmdargs=["-log", "none"])
scene.file("in.scene")
scene.numpy.extract_atom({!r})[list(scene.numpy.extract_atom("id")).index(3), 1] = float("nan")
scene.command("run 10")
"""


def test_nan_pose(folder):
    """A body without a position or orientation ends the run, with its name."""
    for array, wanted in (("v", ("atom 3 has the pose position", "nan", "smaller timestep")),
                          ("d2_orientation", ("atom 3 has the orientation", "quaternion w x y z"))):
        write(folder, BODIES, DEFAULTS["box"])
        (folder / "in.scene").write_text(SCRIPT.format(**DEFAULTS))
        (folder / "driver.py").write_text(DRIVER.format(array))
        lammps_folder = Path(os.environ.get("LAMMPS_FOLDER", TOP / "out" / "lammps"))
        status, said = process(folder, [lammps_folder / "venv" / "bin" / "python", "driver.py"],
                               LAMMPS_PLUGIN_PATH=str(lammps_folder / "build"), OMP_NUM_THREADS="1",
                               LD_LIBRARY_PATH=str(lammps_folder / "venv" / "lib"))
        assert status and all(text in " ".join(said.split()) for text in wanted)


def test_small_skin(folder):
    """A list of neighbours that is too old is an error, and not a contact that is missed."""
    fast = [(1, (0, 0, 0), (0, 0, 0), (0, 0, 0), (1, 0, 0, 0)), (2, (0.4, 0, 0), (-20, 0, 0), (0, 0, 0), (1, 0, 0, 0))]
    for modify in ("neigh_modify every 100 delay 100 check yes", "neigh_modify once yes",
                   "neigh_modify every 500 check no"):
        said = refused(folder, fast, gravity="", neighbor="neighbor 0.02 bin", modify=modify)
        assert "atom 2 has moved by" in said and "neigh_modify delay 0 every 1 check yes" in said
    run(folder, fast, gravity="", neighbor="neighbor 0.02 bin")  # LAMMPS's own default watches it


FAILING = r"""
#define _GNU_SOURCE
#include <dlfcn.h>
#include <potential_particles.h>
/* The library, but for one contact of each tenth step, which fails. */
pp_status pp_contact_detect_batch(const struct pp_particle *const *particles, const pp_pose *poses, size_t bodies, const uint32_t *pairs, size_t count,
                                  const pp_settings *settings, uint32_t threads, pp_pair_state *states, pp_contact *contacts, pp_status *statuses) {
    pp_status (*real)(const struct pp_particle *const *, const pp_pose *, size_t, const uint32_t *, size_t, const pp_settings *, uint32_t, pp_pair_state *,
                      pp_contact *, pp_status *) = dlsym(RTLD_NEXT, "pp_contact_detect_batch");
    static int step = 0;
    if (++step % 10 || !count) return real(particles, poses, bodies, pairs, count, settings, threads, states, contacts, statuses);
    pp_contact kept = contacts[0];
    pp_status done = real(particles, poses, bodies, pairs, count, settings, threads, states, contacts, statuses);
    contacts[0] = kept;
    statuses[0] = PP_SOLVER_FAILED;
    return done;
}
"""


def test_failed_contact(folder):
    """A contact that the library cannot solve stops the run with both poses; or it keeps its last answer and is
    counted.
    """
    (folder / "failing.c").write_text(FAILING)
    assert process(folder,
                   ["cc", "-shared", "-fPIC", "-o", "failing.so", "failing.c", f"-I{TOP / 'include'}", "-ldl"])[0] == 0
    bodies = [(2, (0, 0, 0), (0, 0, 0), (0, 0, 0), (1, 0, 0, 0)),
              (2, (0.01, 0, 0.0598), (0, 0, 0), (0, 0, 0), (1, 0, 0, 0))]
    preload = {"LD_PRELOAD": str(folder / "failing.so")}
    said = refused(folder, bodies, environment=preload, gravity="")
    for text in ("the contact of atoms 1 and 2 failed", "no solver reached an answer".lower(),
                 "Shapes cuboid and cuboid", "A: position", "B: position", "failures count"):
        assert text.lower() in said.lower()
    write(folder, bodies, DEFAULTS["box"])
    filled = {**DEFAULTS, "gravity": "", "style": "pair_style potential/particle failures count", "run": "run 50"}
    status, said = lammps(folder, SCRIPT.format(**filled), **preload)
    assert status == 0 and "WARNING" in said
    table = thermo(said)
    assert table["c_pp[2]"][-1] == 5, table["c_pp[2]"]
