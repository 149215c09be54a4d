# SPDX-License-Identifier: GPL-2.0-or-later
"""Contacts by patch, with the law of joints: closed forms, YADE, several ranks, restarts, bonds, and what is refused.
"""
import numpy as np
import pytest
from potential_particles.lammps import polyhedron, write_shapes
from potential_particles.lammps.pictures import frames
from test_walls import floor as tiles, write_stl
from scene import DEFAULTS, SCRIPT, TOP, lammps, process, random_bodies, refused, run, shapes, state, thermo
from test_motion import YADE
from test_ranks import AGAIN

KN, KS, STIFF, MU, G, DENSITY = 1e9, 5e8, 1e10, 0.4, 9.81, 2600.0
PATCH = "pair_style potential/particle carry 0 patch 1e-6"
SUMS = "thermo_style custom step ke pe f_move " + " ".join(f"c_pp[{n}]" for n in range(1, 10)) + " "
DIGITS = "\nthermo_modify format float %.17g\n"
# A block with sharp edges: half sizes, and what they make.
HALF = np.array([0.06, 0.05, 0.03])
AREA, MASS = 4 * HALF[0] * HALF[1], DENSITY * 8 * HALF.prod()
SPIN_INERTIA = MASS / 3 * (HALF[0] ** 2 + HALF[1] ** 2)


def block(folder, sharp=1e-5):
    sides = [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)]
    write_shapes(folder / "block.txt", {"block": polyhedron(sides, np.repeat(HALF, 2), sharp)})
    return "fix shapes all potential/particle/shapes block.txt type * block 2600"


def still(at, q=(1, 0, 0, 0), v=(0, 0, 0), w=(0, 0, 0)):
    return (1, at, v, w, q)


def about(axis, angle):
    q = np.zeros(4)
    q[0], q[1 + axis] = np.cos(angle / 2), np.sin(angle / 2)
    return q


def floor(more="", restitution=1, friction=MU):
    return f"fix floor all wall/potential/particle {KN} {KS} {friction} {restitution} plane 0 0 0 0 0 1 patch 1e-6 {more}"


def wrench(folder, bodies, **parts):
    """Forces and torques of the first step, without weight."""
    dumped, said = run(
        folder, bodies, script=SCRIPT.replace("d2_orientation[4]\ndump_modify",
                                              "d2_orientation[4] fx fy fz tqx tqy tqz\ndump_modify"),
        **{
            "shapes": block(folder), "style": PATCH, "coefficients": f"pair_coeff * * {KN} {KS} {MU} 1", "gravity": "",
            "run": "run 0", "timestep": "timestep 1e-5", **parts
        })
    return np.column_stack([dumped[0][1][c] for c in ("fx", "fy", "fz", "tqx", "tqy", "tqz")]), said


def test_face_that_tilts(folder):
    """Force and moment of a face under pressure that is tilted about either axis: KN A d and KN I tilt; on a plane, on
    triangles, and of two blocks.
    """
    from test_walls import floor as triangles, write_stl
    write_stl(folder / "floor.stl", triangles(4, 0.11))
    depth, tilt = 2e-6, 2e-5
    for axis, second in ((0, AREA * HALF[1] ** 2 / 3), (1, AREA * HALF[0] ** 2 / 3)):
        body = still((0.003, 0.001, HALF[2] - depth), about(axis, tilt))
        mesh = floor().replace("plane 0 0 0 0 0 1", "stl floor.stl")
        lower = still((0.003, 0.001, -HALF[2]))
        for bodies, walls in (([body], floor()), ([body], mesh), ([lower, body], "")):
            found, _ = wrench(folder, bodies, walls=walls)
            f, t = found[-1, :3], found[-1, 3:]
            # Two bodies share the depth, and are twice as deep in each other as in a plane.
            assert abs(f[2] / (KN * AREA * depth) - 1) < 2e-3, (axis, walls, f)
            assert abs(t[axis] / (-KN * second * tilt) - 1) < 3e-3, (axis, walls, t, KN * second * tilt)
            if len(bodies) == 2:
                about_second = found[0, 3:] + np.cross(np.subtract(bodies[0][1], bodies[1][1]), found[0, :3])
                assert np.abs(found[0, :3]
                              + f).max() < 1e-9 * np.abs(f).max() and np.abs(about_second
                                                                             + t).max() < 1e-6 * np.abs(t).max()


def resting(**more):
    return still((0, 0, HALF[2] - MASS * G / (KN * AREA)), **more)


def test_block_that_turns_on_the_spot_stops(folder):
    """Its angle is w^2 I / (2 mu N lever), the lever being the mean distance from the middle of its face."""
    w = 2.0
    x, y = np.meshgrid(*(h * (np.arange(2000) + 0.5) / 2000 for h in HALF[:2]))
    lever = np.hypot(x, y).mean()
    wanted = w**2 * SPIN_INERTIA / (2 * MU * MASS * G * lever)
    dumped, said = run(folder, [resting(w=(0, 0, w))], shapes=block(folder), style=PATCH,
                       coefficients=f"pair_coeff * * {KN} {KS} {MU} 1", walls=floor(restitution=0.1),
                       timestep="timestep 2e-5", run="dump_modify all every 1000\nthermo 1000\nrun 6000")
    end = state(dumped[-1][1])[0]
    angle = 2 * np.arctan2(end[12], end[9])
    assert abs(angle / wanted - 1) < 2e-3, (angle, wanted)
    assert np.abs(end[:2]).max() < 1e-6 and np.abs(end[6:9]).max() < 1e-4, end


def test_cohesion_and_residual_friction(folder):
    """A block that is pushed along a plane holds up to c A + mu N; once it slips, the residual friction slows it."""
    cohesion = 500.0
    limit = (cohesion * AREA / MASS + MU * G)
    for share, slips in ((0.97, False), (1.03, True)):
        pushed = share * limit
        dumped, _ = run(
            folder, [resting()], shapes=block(folder), style=PATCH, coefficients=f"pair_coeff * * {KN} {KS} {MU} 1",
            walls=floor(f"cohesion {cohesion} residual 0.2 0", restitution=0.01),
            gravity=f"fix weight all gravity 9.81 vector 0 0 -1\nfix along all addforce {MASS * pushed} 0 0",
            timestep="timestep 1e-5", run="dump_modify all every 1000\nrun 10000")
        end = state(dumped[-1][1])[0]
        # The force acts in the centre and friction at the face: the block tilts, but its weight holds it down.
        wanted = (pushed - 0.2 * G) * 0.1 if slips else 0
        assert abs(end[3] - wanted) < (0.03 * wanted if slips else 1e-3), (share, end[3], wanted)


RAMP = "variable g equal 9.81*ternary(step<3000,step/3000.0,1.0)\nfix weight all gravity v_g vector 0 0 -1"


def hung(folder, lower, strength, steps=4000, **parts):
    """How far a block falls that is bonded to one that is held, under a weight that grows from 0; and the table of
    LAMMPS.
    """
    bodies = [still((0, 0, 0)), still(lower)]
    dumped, said = run(folder, bodies, script=SCRIPT.replace("fix move all", "fix move free"), shapes=block(folder),
                       style=PATCH + " bonds yes", coefficients=f"pair_coeff * * {STIFF} {STIFF} {MU} 0.01 {strength}",
                       modify="group free id 2", gravity=RAMP, timestep="timestep 1e-5", before=SUMS + DIGITS,
                       run=f"thermo {steps}\ndump_modify all every {steps}\nrun {steps}", **parts)
    ends = [state(columns)[1] for _, columns in dumped]
    return ends[-1] - ends[0], thermo(said)


def test_bonds_hold_up_to_their_strength(folder):
    """A block that hangs from another stretches the bond by m g / (KN A), and falls where the strength is less than m g
    / A; one that sticks out breaks it at the bending stress 6 m g L / (b h^2).
    """
    overlap = 1e-9
    below, beside = (0, 0, -2 * HALF[2] + overlap), (2 * HALF[0] - overlap, 0, 0)
    bending = 6 * MASS * G * HALF[0] / (2 * HALF[1] * (2 * HALF[2]) ** 2)
    for place, stress in ((below, MASS * G / AREA), (beside, bending)):
        way, table = hung(folder, place, f"cohesion 1e6 tension {1.01 * stress}")
        assert table["c_pp[8]"][-1] == 1 and table["c_pp[7]"][-1] == 0, table
        stretch = MASS * G / (STIFF * AREA)
        if place is below:
            assert abs(way[2] / -(stretch + overlap) - 1) < 0.01, (way, stretch)
        way, table = hung(folder, place, f"cohesion 1e6 tension {0.99 * stress}")
        assert table["c_pp[8]"][-1] == 0 and table["c_pp[7]"][-1] > 0 and way[5] < -1e-3, (way, table)


def test_energy_is_kept_or_counted(folder):
    """What bodies, springs, friction, dashpots, patches and cohesion have adds up, to the order of the step."""
    bodies = [(b[0], b[1], -4 * np.asarray(b[1]) + b[2], *b[3:])
              for b in random_bodies(6, 0.14, seed=9, low=(-0.07, -0.07, -0.07), across=2)]
    errors = []
    for halvings in range(2):
        _, said = run(folder, bodies, gravity="", style="pair_style potential/particle patch 1e-4 whole 100000000",
                      coefficients="pair_coeff * * 1e10 5e9 0.4 0.6 cohesion 2e6 residual 0.3 1e5",
                      timestep=f"timestep {2e-5 / 2**halvings}", before=SUMS + DIGITS,
                      run=f"thermo {50 * 2**halvings}\nrun {1500 * 2**halvings}")
        table = thermo(said)
        parts = [table[f"c_pp[{n}]"][-1] for n in (4, 5, 6, 7)]
        total = table["KinEng"] + table["PotEng"] + table["f_move"] + sum(table[f"c_pp[{n}]"] for n in (4, 5, 6, 7))
        assert parts[0] > 0.01 * total[0] and parts[1] > 0.01 * total[0] and parts[3] > 0, parts
        errors.append(np.abs(total - total[0]).max() / (sum(parts)))
    assert errors[0] < 0.02 and errors[1] < 0.7 * errors[0], errors


def train():
    """Two blocks that will be bonded end to end, one that slides over their joint the other way, one that spins beside:
    over x = 0 and y = 0.
    """
    x, z = -0.07, HALF[2] - 2e-5
    pair = [still((x + side * (HALF[0] - 1e-7), -0.02, z), v=(1.2, 0.3, 0)) for side in (-1, 1)]
    above = still((x + 0.066, -0.001, z + 2 * HALF[2] + 1e-6), about(2, 0.3), v=(0.2, 0.3, 0))
    beside = still((-0.01, 0.14, z), about(2, 0.5), v=(0.8, -0.3, 0), w=(0, 0, 4))
    return pair + [above, beside]


TRAIN = {
    "style": "pair_style potential/particle patch 1e-4 bonds yes",
    "coefficients": "pair_coeff * * 1e8 5e7 0.4 0.5 cohesion 5e4 tension 1e5 residual 0.3 0",
    "walls": "fix floor all wall/potential/particle 1e8 5e7 0.4 0.5 plane 0 0 0 0 0 1 patch 1e-4",
    "timestep": "timestep 5e-5"
}
TRAIN_SUMS = SUMS + "f_floor[2] f_floor[3] f_floor[4] f_floor[8]"


def on_ranks(folder, *all_ranks):
    ends = []
    for ranks, processors in all_ranks:
        steps = 100 if ranks == 4 else 500  # four ranks wait for each other where there are two cores
        dumped, said = run(folder, train(), ranks=ranks, shapes=block(folder, 2e-3),
                           processors=f"processors {processors}", before=TRAIN_SUMS + DIGITS,
                           run=f"thermo 100\ndump_modify all every 100\nrun {steps}", **TRAIN)
        ends.append(({step: state(columns) for step, columns in dumped}, thermo(said)))
    start, end = ends[0][0][0], ends[0][0][500]
    assert (np.sign(start[:, 0]) != np.sign(
        end[:, 0])).sum() >= 3 and ends[0][1]["c_pp[8]"][-1] >= 1 and ends[0][1]["c_pp[4]"][-1] > 0.05, (start, end,
                                                                                                         ends[0][1])
    for states, table in ends[1:]:
        for step in states:
            assert np.abs(states[step] - ends[0][0][step])[:, :3].max() < 1e-9, (len(table["Step"]), step,
                                                                                 states[step] - ends[0][0][step])
        for column in table:
            assert np.allclose(table[column], ends[0][1][column][:len(table[column])], rtol=1e-6,
                               atol=1e-12), (column, table[column], ends[0][1][column])


def test_patches_on_ranks(folder):
    """One and two ranks, with bonds and patches that slide across their border."""
    on_ranks(folder, (1, "1 1 1"), (2, "2 1 1"))


@pytest.mark.long
def test_patches_on_four_ranks(folder):
    on_ranks(folder, (1, "1 1 1"), (4, "2 2 1"))


def test_restart_of_patches(folder):
    """A run that goes on from a file begins with the forces of the run that was not interrupted, to rounding, and stays
    with it to the tolerance of patches, which rounding can make one way or another; springs, bonds, dashpots and sums
    go along. The file says what its contacts are.
    """
    parts = {**TRAIN, "shapes": block(folder, 2e-3)}
    forces = "d2_orientation[4] fx fy fz tqx tqy tqz\ndump_modify"
    whole, said = run(folder, train(), before=TRAIN_SUMS + DIGITS + "restart 250 half.restart other.restart\n",
                      run="thermo 50\nrun 350", script=SCRIPT.replace("d2_orientation[4]\ndump_modify",
                                                                      forces), **parts)
    wanted, table = state(whole[-1][1]), thermo(said)
    again = AGAIN.replace("f_floor[3] f_floor[4]", "c_pp[6] c_pp[7] c_pp[8] f_floor[3] f_floor[4] f_floor[8]").replace(
        "run 150", "run 100").replace("d2_orientation[4]\ndump_modify", forces)
    for ranks in (1, 2):
        status, said = lammps(folder, "newton off\nprocessors * 1 1\n" + again.format(**{**DEFAULTS, **parts}), ranks)
        assert status == 0
        dumped = list(frames(folder / "again.dump"))
        assert dumped[0][0] == 250 and np.abs(state(dumped[0][1]) - state(whole[250][1])).max() == 0
        for column in forces.split()[1:-1]:
            assert np.abs(dumped[0][1][column] - whole[250][1][column]).max() < 1e-12, (column, dumped[0][1][column],
                                                                                        whole[250][1][column])
        error = np.abs(state(dumped[-1][1]) - wanted)[:, :3].max()
        assert error < 1e-8, (ranks, error)
        for column, values in thermo(said).items():
            if column in table:
                assert np.isclose(values[-1], table[column][-1], rtol=1e-4,
                                  atol=1e-6), (column, values[-1], table[column][-1])
    for part, wanted in (("style", "pair_style potential/particle: the contacts of the restart file act on patches"),
                         ("walls", "wall/potential/particle: the contacts of the restart file act on patches")):
        changed = {**DEFAULTS, **parts, part: parts[part].replace("patch 1e-4", "").replace("bonds yes", "")}
        changed["coefficients"] = "pair_coeff * * 1e8 5e7 0.4 0.5" if part == "style" else changed["coefficients"]
        status, said = lammps(folder, "newton off\n" + again.replace(" c_pp[6] c_pp[7] c_pp[8]", "").format(**changed))
        assert status and wanted in " ".join(said.split())


def errors_of_blocks(folder, steps):
    """Of bonded blocks that slide, one that slides on them, and one that hits them: how far they are from where YADE
    has them, by to_lammps, and that the bond ends in the same step.
    """
    if not YADE.exists():
        print("not tried: the YADE plugin is not built (make build)")
        return [0, 0]
    errors = []
    for halvings in range(steps):
        _, told = process(
            folder,
            [TOP / "scripts" / "yade.sh", "-j1", TOP / "tests" / "lammps" / "yade_patch_scene.py", folder, halvings])
        assert (folder / "yade.npz").exists()
        yade = np.load(folder / "yade.npz")
        wanted, every = yade["rows"], 2**halvings
        status, said = lammps(
            folder,
            "include scene.lmp\ncompute pp all pair potential/particle\nthermo_style custom step c_pp[8] c_pp[9]\nthermo 1\n"
            f"dump 1 all custom {every} all.dump id type x y z d2_orientation[1] d2_orientation[2] d2_orientation[3] d2_orientation[4]\n"
            f"dump_modify 1 sort id format float %.17g\nrun {len(wanted) - 1}")
        assert status == 0
        mine = np.array([np.column_stack([columns[c] for c in "xyz"]) for _, columns in frames(folder / "all.dump")])
        errors.append(np.abs(mine - wanted[::every, :, :3]).max())
        moved = np.abs(wanted[-1] - wanted[0]).max(axis=0)
        bonds = thermo(said)["c_pp[8]"]
        (folder / "yade.npz").unlink()
        # YADE counts joints that shall be bonded, LAMMPS those that hold: in the step in which it breaks a bond holds
        # still.
        assert bonds[0] == 1 and list(np.nonzero(
            np.diff(bonds))[0]) == [n + 1 for n in np.nonzero(np.diff(yade["bonds"]))[0]], (bonds, yade["bonds"])
    assert bonds[-1] == 0 and moved[:3].min() > 5e-4 and moved[3:].max() > 5e-4, moved
    return errors


def test_same_blocks_in_yade(folder):
    assert errors_of_blocks(folder, 1)[0] < 1e-7


@pytest.mark.long
def test_same_blocks_in_yade_to_the_order_of_the_step(folder):
    errors = errors_of_blocks(folder, 2)
    assert errors[1] <= 0.6 * errors[0]


def test_blocks_of_yade_after_some_steps(folder):
    """Bonds that have made steps are there in LAMMPS; a lasting force, a held block that moves and a wall that moves
    act as in YADE, to the order of the time step.
    """
    if not YADE.exists():
        print("not tried: the YADE plugin is not built (make build)")
        return
    _, told = process(folder,
                      [TOP / "scripts" / "yade.sh", "-j1", TOP / "tests" / "lammps" / "yade_later_scene.py", folder])
    assert (folder / "yade.npz").exists() and "SceneWarning" not in told
    yade = np.load(folder / "yade.npz")
    wanted = yade["rows"]
    status, said = lammps(
        folder,
        "include scene.lmp\ncompute pp all pair potential/particle\nthermo_style custom step c_pp[8]\nthermo 1\n"
        f"dump 1 all custom 1 all.dump id type x y z d2_orientation[1] d2_orientation[2] d2_orientation[3] d2_orientation[4]\ndump_modify 1 sort id format float %.17g\nrun {len(wanted) - 1}"
    )
    assert status == 0
    mine = np.array([np.column_stack([columns[c] for c in "xyz"]) for _, columns in frames(folder / "all.dump")])
    assert set(thermo(said)["c_pp[8]"]) == {3} and yade["bonds"] == 3
    moved, off = np.abs(wanted - wanted[0]).max(axis=(0, 2)), np.abs(mine - wanted).max(axis=(0, 2))
    assert moved[0] == 0 and moved[1:].min() > 2e-8, moved
    assert off[0] == 0 and (off[1:] < 0.02 * moved[1:]).all(), (off, moved)


def test_bad_input(folder):
    """What is refused of patches, with value and remedy."""
    bodies = [still((0, 0, 0)), still((0, 0, 2 * HALF[2] - 1e-6))]

    def says(*wanted, **parts):
        said = refused(
            folder, bodies, **{
                "shapes": block(folder), "style": PATCH, "coefficients": f"pair_coeff * * {KN} {KS} {MU} 1",
                "timestep": "timestep 1e-5", **parts
            })
        for text in wanted:
            assert text in said

    strength = f"pair_coeff * * {KN} {KS} {MU} 1 "
    says("patch = 0.5", "[1e-12, 0.1]", style="pair_style potential/particle patch 0.5")
    says("'bonds maybe'", "bonds yes or no", style=PATCH + " bonds maybe")
    says("whole and bonds are for contacts by patch", style="pair_style potential/particle bonds yes")
    says("'tension'", "pair_style potential/particle patch 1e-4", style="pair_style potential/particle",
         coefficients=strength + "tension 1e5")
    says("cohesion = -1", "be 0 or lie in [1e-100, 1e+100]", coefficients=strength + "cohesion -1")
    says("residual:", "are expected after it", coefficients=strength + "residual 0.3")
    says("'glue'", "cohesion C, tension T, residual FRICTION COHESION, softening W", coefficients=strength + "glue 1")
    says("cohesion = 5", "give a shear stiffness", coefficients=f"pair_coeff * * {KN} 0 0 1 cohesion 5")
    says("timestep = 0.01", "the joint of atoms 1 and 2", "unstable above", timestep="timestep 0.01")
    says(
        "timestep = 0.01", "the joint of atom 1 with the wall", timestep="timestep 0.01",
        walls=f"fix floor all wall/potential/particle {KN} {KS} {MU} 1 plane 0 0 "
        f"{-HALF[2] + 1e-6} 0 0 1 patch 1e-4", coefficients="pair_coeff * * 1 1 0.5 1")
    says("walls make no bonds", walls=floor("tension 1e5"))
    says("strength is for contacts by patch", walls=floor("cohesion 1e5").replace("patch 1e-6", ""))
    says("cannot change between point and patch", run="run 1\npair_style potential/particle\nrun 1")


def test_bonds_that_are_stretched_out_of_reach(folder):
    """A bond whose bodies leave each other's list of neighbours is an error, and not a bond that is lost."""
    bodies = [still((0, 0, 0)), still((2 * HALF[0] - 1e-9, 0, 0), v=(2, 0, 0))]
    said = refused(folder, bodies, shapes=block(folder), style=PATCH + " bonds yes",
                   coefficients="pair_coeff * * 1e3 1e3 0.4 1 cohesion 1e9 tension 1e9", gravity="",
                   timestep="timestep 1e-4", neighbor="neighbor 0.01 bin", run="run 2000")
    assert "2 bonded atoms have lost their partner" in said and "larger stiffness" in said


def test_restitution_whatever_the_floor_is_cut_into(folder):
    """A block that lands flat leaves with its restitution from a plane, from 2, 8 and 200 triangles, and from four
    blocks side by side that do not move.
    """
    for cells in (1, 2, 10):
        write_stl(folder / f"floor{cells}.stl", tiles(cells, 1.3 * HALF[0] + HALF[1]))
    landing = still((0.001, 0.002, HALF[2] + 1e-7), v=(0, 0, -0.01))
    beside = [still((x * HALF[0], y * HALF[1], -HALF[2])) for x in (-1, 1) for y in (-1, 1)]
    for wanted, share in ((0.05, 0.001), (0.5, 0.004), (0.9, 0.004)):
        step = share / np.sqrt(KN * AREA / MASS)
        for name in ("plane 0 0 0 0 0 1", "stl floor1.stl", "stl floor2.stl", "stl floor10.stl", "blocks"):
            with_blocks = name == "blocks"
            dumped, _ = run(
                folder, [landing] + (beside if with_blocks else []), shapes=block(folder), style=PATCH, gravity="",
                coefficients=f"pair_coeff * * {KN} {KS} {MU} {wanted}", timestep=f"timestep {step:.17g}",
                walls="group held id 2:5\nunfix move\ngroup free id 1\nfix move free nve/potential/particle" if with_blocks
                else f"fix floor all wall/potential/particle {KN} {KS} {MU} {wanted} {name} patch 1e-6",
                run=f"run {int(12 / share)}")
            found = dumped[-1][1]["vz"][0] / 0.01
            assert abs(found - wanted) < 0.01 * wanted, (name, wanted, found)
