# SPDX-License-Identifier: GPL-3.0-or-later
# Key blocks against linear programs, limit analysis and the simulation; closed forms: python/tests/test_rock.py.
import numpy as np
import slope_cuts
from harness import *
from potential_particles import rock
from scipy.optimize import linprog, nnls

check = Checks()

# Against linear programs and non-negative least squares, on slopes cut at random: the same removable blocks, the same
# way.
for seed in range(15):
    mass, friction, _ = slope_cuts.cut(1000 + seed)
    for one in rock.key_blocks(mass, slope_cuts.FREE, degrees=friction):
        if one.mode == "inner":
            continue
        faces = mass[one.blocks[0]].faces
        holding = faces[~(
            (mass.faces["of"][faces] == 0) & np.isin(mass.faces["index"][faces].astype(int), slope_cuts.FREE))]
        inward = -mass.faces["plane"][holding, :3]
        reach = max(-linprog(-sign * np.eye(3)[axis], -inward, np.zeros(len(inward)), bounds=[(-1, 1)] * 3).fun
                    for axis in range(3) for sign in (1, -1))
        check.equal(one.removable, reach > 1e-7, f"seed {seed}: removable, {one.mode}, {reach}")
        # The projection of the pull on the cone.
        pull = np.array([0.0, 0.0, -1.0])
        pressing, _ = nnls(inward.T, -pull)
        along = pull + inward.T @ pressing
        check.equal(one.direction is not None,
                    np.linalg.norm(along) > 1e-6, f"seed {seed}: moves without friction, {one.mode}")
        if one.direction is not None:
            check.close(
                np.abs(along / np.linalg.norm(along) - one.direction).max(), 0.0, 1e-6, f"seed {seed}: direction")
            held = math.tan(math.radians(friction)) * pressing.sum() / np.linalg.norm(along)
            check.close(one.factor, held, 1e-6 * (1 + held), f"seed {seed}: factor of safety")

# Against limit analysis of the same block among its neighbours, which may find more: that it turns over.
said = []
for seed in range(80):
    mass, friction, random = slope_cuts.cut(seed)
    one = slope_cuts.chosen(mass, friction, random)
    if one is not None:
        said.append((one.mode, *slope_cuts.limit_analysis(mass, one, friction), one.factor))
check.true(sum(one[1] == "same" for one in said) >= 0.9 * len(said) > 50, f"{said}")
check.true(not any(one[2] == np.inf > one[3] for one in said), f"no cut stands by the shape of its faces alone: {said}")
# Against the simulation: what block theory frees moves by a millimetre, and nothing else does.
tried, moving = 0, 0
for seed in range(40):
    mass, friction, random = slope_cuts.cut(seed)
    one = slope_cuts.chosen(mass, friction, random)
    if one is None or tried == 20:
        continue
    tried, moving = tried + 1, moving + one.moves
    distance, direction, _ = slope_cuts.judged(mass, one, friction)
    check.true(
        slope_cuts.agrees(one, distance, direction),
        f"seed {seed}: {one.mode}, factor {one.factor:.3f}, moved by {distance:.2e} m along {direction}, not {one.direction}"
    )
check.true(tried == 20 and 5 <= moving <= 15, f"{tried} cuts, {moving} that move")
check.finish()
