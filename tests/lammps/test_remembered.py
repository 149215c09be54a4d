# SPDX-License-Identifier: GPL-2.0-or-later
"""What is remembered belongs to a shape and a wall: where either is another one, it begins anew or is refused."""
import struct

import numpy as np
from scene import DEFAULTS, FRICTION, SCRIPT, SHEAR, STIFFNESS, lammps, refused, run, shapes, state, thermo, write
from test_walls import floor, write_stl

from potential_particles.lammps import write_shapes
from potential_particles.lammps.pictures import frames

WALL = f"{STIFFNESS} {SHEAR} {FRICTION} 0.3"
PLANE = f"fix floor all wall/potential/particle {WALL} plane 0 0 0 0 0 1"
AT_REST = (0, 0, 0), (0, 0, 0), (1, 0, 0, 0)
# Reads what `write_restart half.restart` wrote.
AGAIN = SCRIPT.replace("read_data scene.data fix orientation NULL orientation", "read_restart half.restart").replace(
    "fix orientation all property/atom d2_orientation 4 writedata yes\n", "").replace("boundary {boundary}\n", "")


def resting(kind, x=0.0, depth=2e-4):
    """A body of a type that lies on the floor; a pyramid's base is a quarter of its size 0.1 below its centre."""
    return (kind, (x, 0, {1: 0.025, 2: 0.03}[kind] - depth), *AT_REST)


def test_other_type_on_a_wall(folder):
    """A body that hovers over a wall and becomes larger between runs touches it at once, as one that had that type from
    the start; with a type that is smaller it falls on.
    """
    body = [(1, (0, 0, 0.0295), *AT_REST)]
    kind = 2
    before = "thermo_style custom step f_floor[1] f_floor[7]\n"
    whole, told = run(folder, [(kind, *body[0][1:])], walls=PLANE, gravity="", before=before, run="run 200")
    for between in ("run 5\nset atom 1 type 2\nundump all\nreset_timestep 0\n"
                    + "\n".join(line for line in SCRIPT.splitlines() if line.startswith("dump")) + "\nrun 200", ):
        dumped, said = run(folder, body, walls=PLANE, gravity="", before=before, run=between)
        assert thermo(said)["f_floor[1]"][0] == 1 == thermo(told)["f_floor[1]"][0]
        assert np.abs(state(dumped[-1][1]) - state(whole[-1][1])).max() < 1e-9, (state(dumped[-1][1]),
                                                                                 state(whole[-1][1]))


def test_other_shapes_between_runs(folder):
    """Other shapes for the same types, by a new fix: what lay on the floor has a contact of its new shape."""
    larger = {name: shape for name, shape in zip(("pyramid", "cuboid"), reversed(list(shapes().values())))}
    write_shapes(folder / "other.txt", larger)
    again = "unfix shapes\nfix shapes all potential/particle/shapes other.txt type 1 pyramid 2600 type 2 cuboid 2600\nrun 0 {}"
    for after in ("", "pre no"):
        _, said = run(folder, [(1, (0, 0, 0.0295), *AT_REST)], walls=PLANE, gravity="",
                      before="thermo_style custom step f_floor[1]\n", run="run 5\n" + again.format(after))
        assert thermo(said)["f_floor[1]"][-1] == 1


def test_type_during_a_run(folder):
    """A type that changes where a run goes on without a look at it is refused."""
    said = refused(folder, [resting(1)], walls=PLANE, run="run 5\nset atom 1 type 2\nrun 5 pre no")
    assert "atom 1 of type 2 has the radius" in said and "leave out 'pre no'" in said


def test_other_shape_of_a_pair(folder):
    """The spring of friction of a pair is not that of another shape: two bodies begin anew where one becomes another,
    and in a run from a file with other shapes; with the same shape under another type they go on.
    """
    bodies = [(2, (0, 0, 0), *AT_REST), (2, (0.001, 0, 0.0595), (0.01, 0, 0), *AT_REST[1:])]
    held = "group held id 1\nunfix move\ngroup free id 2\nfix move free nve/potential/particle"
    script = SCRIPT.replace("{shapes}", "{shapes}").replace("d2_orientation[4]\ndump_modify",
                                                            "d2_orientation[4] fx fy fz\ndump_modify")
    parts = dict(gravity=held, script=script,
                 shapes="fix shapes all potential/particle/shapes shapes.txt type 1 {} 2600 type 2 cuboid 2600")

    def across(name):
        dumped, said = run(folder, bodies, **{**parts, "shapes": parts["shapes"].format(name)},
                           run="run 20\nset atom 2 type 1\nrun 1")
        return dumped[-1][1]["fx"][1], dumped[20][1]["fx"][1], "begins anew" in " ".join(said.split())

    same, before, told = across("cuboid")
    assert abs(same) > 0.5 * abs(before) > 0 and not told, (same, before, told)
    write_shapes(folder / "other.txt", {"brick": shapes()["cuboid"]})
    other, before, told = across("pyramid")
    assert told and abs(other) < 0.2 * abs(before), (other, before, told)


def test_id_of_an_atom_before(folder):
    """An atom that gets the ID of one that was deleted between runs has no spring of friction from that one."""
    bodies = [(2, (0, 0, 0), *AT_REST), (2, (0.001, 0, 0.0595), (0.05, 0, 0), *AT_REST[1:])]
    script = SCRIPT.replace("d2_orientation[4]\ndump_modify", "d2_orientation[4] fx fy fz\ndump_modify")
    for ranks in (1, 2):
        dumped, _ = run(
            folder,
            bodies,
            ranks=ranks,
            gravity="",
            script=script,
            run="run 30\ngroup gone id 2\ndelete_atoms group gone compress no\ncreate_atoms 2 single 0.001 0 0.0595\nvelocity all set 0 0 0\nrun 1",
        )
        assert (dumped[-1][1]["id"] == [1, 2]).all() and abs(
            dumped[-1][1]["fx"][0]) < 0.05 * abs(dumped[30][1]["fx"][0])


def saved(folder, walls, bodies=None, steps=50, **parts):
    run(folder, bodies or [resting(2, 0.01)], walls=walls, run=f"run {steps}\nwrite_restart half.restart", **parts)


def test_restart_with_another_wall(folder):
    """Contacts of a restart file are those of its wall: other planes, another mesh, another order, another motion are
    refused on all ranks; a wall that was at rest may begin to move.
    """
    write_stl(folder / "many.stl", floor(8, 0.5))
    write_stl(folder / "few.stl", floor(1, 0.5))
    write_stl(folder / "turned.stl", floor(8, 0.5)[::-1])
    wall = f"fix floor all wall/potential/particle {WALL} "
    other = "the restart file has a fix of this ID with other planes or triangles"
    saved(folder, wall + "stl many.stl")
    for now, says in (("stl few.stl", other), ("stl turned.stl", other), ("stl many.stl scale 1.5", other),
                      ("plane 0 0 0 0 0 1", other), ("stl many.stl plane 0 0 -1 0 0 1",
                                                     other), ("stl many.stl patch 1e-4", "patch")):
        said = refused(folder, [resting(2)], ranks=2 if now == "stl few.stl" else 1, script=AGAIN, walls=wall + now)
        assert says in said, now
    run(folder, [resting(2)], script=AGAIN, walls=wall.replace("fix floor", "fix other") + "stl few.stl")
    run(folder, [resting(2)], script=AGAIN, walls=wall + "stl many.stl linear 0.1 0 0")
    saved(folder, wall + "stl many.stl linear 0.1 0 0")
    for now in ("", "linear 0.2 0 0", "linear 0.1 0 0 rotate 0 0 0 0 0 1 5"):
        said = refused(folder, [resting(2)], script=AGAIN, walls=f"{wall}stl many.stl {now}")
        assert "another linear or rotate" in said and "another ID" in said, now


def test_restart_of_another_version(folder):
    """A file whose numbers have another order is refused, and not read."""
    saved(folder, PLANE)
    whole = (folder / "half.restart").read_bytes()
    for numbers, who in ((20, "fix floor wall/potential/particle"), (8, "pair_style potential/particle")):
        begin = struct.pack("<id", 8 * numbers, -3.0)
        assert whole.count(begin) == 1
        (folder / "half.restart").write_bytes(whole.replace(begin, struct.pack("<id", 8 * numbers, 0.5)))
        said = refused(folder, [resting(2)], script=AGAIN, walls=PLANE)
        assert who in said and "of another version of the plugin" in said


def test_restart_with_other_shapes(folder):
    """Contacts with a wall begin anew where the file of shapes is another one; with the same they go on, to the last
    bit.
    """
    slide = [(2, (0, 0, 0.0298), (0.3, 0, 0), *AT_REST[1:])]
    saved(folder, PLANE, slide)
    whole, _ = run(folder, slide, walls=PLANE, run="run 100")
    again, _ = run(folder, slide, walls=PLANE, script=AGAIN, run="run 50")
    assert (state(again[-1][1]) == state(whole[-1][1])).all()
    write(folder, slide, DEFAULTS["box"])
    write_shapes(folder / "other.txt", {"cuboid": shapes()["pyramid"], "pyramid": shapes()["cuboid"]})
    parts = {
        **DEFAULTS, "walls": PLANE, "shapes": DEFAULTS["shapes"].replace("shapes.txt", "other.txt"), "run": "run 50"
    }
    status, said = lammps(folder, AGAIN.format(**parts))
    assert status == 0


def test_atom_that_leaves_the_group_of_a_wall(folder):
    """An atom that leaves the group of a wall and comes back begins anew there."""
    slide = [(2, (0, 0, 0.0295), (0.05, 0, 0), *AT_REST[1:])]
    on = "group on id 1\nfix floor on wall/potential/particle " + WALL + " plane 0 0 0 0 0 1"
    script = SCRIPT.replace("d2_orientation[4]\ndump_modify", "d2_orientation[4] fx fy fz\ndump_modify")
    dumped, _ = run(folder, slide, walls=on, script=script, gravity="",
                    run="run 20\ngroup on clear\nrun 1\ngroup on id 1\nvelocity all set 0 0 0\nrun 0")
    assert abs(dumped[20][1]["fx"][0]) > 1e-2 and abs(dumped[-1][1]["fx"][0]) < 1e-9, (dumped[20][1]["fx"],
                                                                                       dumped[-1][1]["fx"])


def test_time_step_that_grows(folder):
    """A time step that becomes too long for a contact is refused, whether before a run or by a fix during it."""
    for run_, parts in (("run 5\ntimestep 1\nrun 5", {}), ("run 5\ntimestep 1\nrun 5 pre no", {}),
                        ("velocity all set 1e-3 0 0\nfix grow all dt/reset 1 1e-6 1 1 units box\nrun 500",
                         {}), ("run 5\ntimestep 1\nrun 5 pre no", {"walls": ""})):
        said = refused(folder, [resting(2)], **{"walls": PLANE, "run": run_, **parts})
        assert "unstable above" in said, run_
    run(folder, [resting(2)], walls=PLANE.replace("1e5", "1"), coefficients="pair_coeff * * 1 1 0.5 0.5", gravity="",
        run="unfix floor\ntimestep 0.1\nrun 1")


def test_runs_that_are_refused(folder):
    """rerun, which reads no orientations, and minimize, which turns no bodies."""
    for command, words in (("rerun all.dump dump x y z",
                            "rerun reads no orientations"), ("minimize 0 0 10 10", "minimize does not turn bodies"),
                           ("timestep -1e-4\nrun 1", "timestep = -0.0001"), ("run_style respa 2 2\nrun 1",
                                                                             "run_style verlet")):
        said = refused(folder, [resting(2)], walls=PLANE, run=f"run 5\n{command}")
        assert words in said, command


# What changes between runs; how many steps follow.
CHANGES = (
    "",
    "set atom 1 type 2",
    "displace_atoms all move 0.003 -0.002 -0.004",
    "\n".join(f"set atom 3 d2_orientation[{i}] {q}" for i, q in enumerate((0.5, -0.5, 0.1, 0.7), 1)),
    "unfix shapes\nfix shapes all potential/particle/shapes other.txt type 1 pyramid 2600 type 2 cuboid 2600",
    "change_box all x final -1.3 1.2 z scale 1.05 remap units box",
    "reset_timestep 0",
    "timestep 5e-5",
    "neighbor 0.003 bin",
    "group on id 1 3 5",
    "group on id 2 4 6",
    "set atom 2 type 1\nset atom 5 type 2",
    "neighbor 0.03 bin\nreset_timestep 1000",
    "displace_atoms all move 0.3 0.2 0.001 units box",
    "group off id 2\ngroup on subtract all off",
    "group on id 2 3",
)
STEPS = 6


def test_what_wakes_at_a_wall(folder):
    """Whatever changes between runs (type, shape, place, orientation, box, time, time step, skin, group), a wall of
    planes and triangles that moves pushes each body as one that meets the bodies there for the first time.
    """
    random, speed = np.random.default_rng(5), 0.4
    bodies = []
    for n in range(6):
        q = random.normal(size=4)
        place = 0.3 * (n % 3) - 0.4, 0.3 * (n // 3) - 0.2, random.uniform(0.035, 0.05)
        bodies.append((1 + n % 2, place, random.uniform(-0.5, 0.5, 3), random.uniform(-20, 20,
                                                                                      3), q / np.linalg.norm(q)))
    write_stl(folder / "floor.stl", floor(14, 1.1))
    write_shapes(folder / "other.txt", {"pyramid": shapes()["cuboid"], "cuboid": shapes()["pyramid"]})
    wall = f"fix wall on wall/potential/particle {STIFFNESS} {SHEAR} 0 1 stl floor.stl plane -0.45 0 0 1 0 0.1 flat 1e-4"
    columns = ("x", "y", "z", *(f"d2_orientation[{i}]" for i in (1, 2, 3, 4)), "fx", "fy", "fz", "tqx", "tqy", "tqz")
    written = f"write_dump all custom {{}}.dump id type {' '.join(columns)} modify sort id format float %.17g\n"
    script = SCRIPT[:SCRIPT.index("dump all")] + "{before}\n{run}\n"
    text = "".join(change + "\nrun 0\n" + written.format(f"{n}a") + f"run {STEPS}\n" + written.format(f"{n}b")
                   for n, change in enumerate(CHANGES))
    write(folder, bodies, DEFAULTS["box"])
    parts = {**DEFAULTS, "gravity": "group on id 1 2 3 4 6", "before": "thermo_style one", "timestep": "timestep 1e-4"}
    status, said = lammps(folder, script.format(**{**parts, "walls": f"{wall} linear 0 0 {speed}", "run": text}))
    assert status == 0
    on, time, dt, pushed, named = {1, 2, 3, 4, 6}, 0.0, 1e-4, 0, "shapes.txt"
    for n, change in enumerate(CHANGES):
        dt = 5e-5 if "timestep 5e-5" in change else dt
        if change.startswith("group on id"):
            on = on | {int(i) for i in change.split()[3:]}
        elif "subtract" in change:
            on = on - {2}
        named = "other.txt" if "other.txt" in change else named
        for part, steps in (("a", 0), ("b", STEPS)):
            time += steps * dt
            [(_, found)] = frames(folder / f"{n}{part}.dump")
            rows = np.column_stack([found[name] for name in columns])
            # In the frame of the floor as it was at first.
            there = [(int(kind), row[:3] - (0, 0, speed * time), (0, 0, 0), (0, 0, 0), row[3:7])
                     for kind, row in zip(found["type"], rows)]
            write(folder, there, "-2 2 -2 2 -2 2")
            once = {**parts, "gravity": "group on id " + " ".join(map(str, sorted(on))), "walls": wall,
                    "run": "run 0\n" + written.format("once"), "shapes": parts["shapes"].replace("shapes.txt", named)}
            status, said = lammps(folder, script.format(**once))
            assert status == 0
            [(_, fresh)] = frames(folder / "once.dump")
            expected = np.column_stack([fresh[name] for name in columns])[:, 7:]
            pushed += (np.abs(expected[:, :3]).max(axis=1) > 0.1).sum()
            error = np.abs(rows[:, 7:] - expected).max(axis=1)
            assert error.max() < 1e-9 * STIFFNESS * 0.01, (n, change, part, error)
    assert pushed > 40, pushed
