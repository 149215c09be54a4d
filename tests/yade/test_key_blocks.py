# SPDX-License-Identifier: GPL-3.0-or-later
# Key blocks against linear programs, closed forms, limit analysis and the simulation.
import numpy as np
import slope_cuts
from harness import *
from potential_particles import rock
from scipy.optimize import linprog, nnls

check = Checks()
Domain = rock.Domain
cube = Domain.box((-1, -1, -1), (1, 1, 1))

# Key blocks: closed forms. A block on a plane: tan(phi)/tan(dip) + c A/(W sin(dip)).
bench = Domain.box((0, 0, 0), (4, 2, 3)).below((3.9, 0, 0), 75, 90)
plane = rock.slice(bench, [rock.joint((3, 0, 1), 35, 90), rock.joint((1, 1, 1), 90, 90)], progress=False)
free = (Domain.TOP, Domain.NORTH, Domain.SOUTH, 6)
found = rock.key_blocks(plane, free, degrees={0: 30, None: 5}, cohesion={0: 2e3, None: 0})
slid, = [one for one in found if one.mode == "sliding"]
area = plane.faces["area"][slid.faces[0]]
weight = 2600 * 9.81 * slid.volume
exact = math.tan(math.radians(30)) / math.tan(math.radians(35)) + 2e3 * area / (weight * math.sin(math.radians(35)))
check.close(slid.factor, exact, 1e-12, "a block on a plane")
check.close(
    np.abs(np.array(slid.direction) - (math.cos(math.radians(35)), 0, -math.sin(math.radians(35)))).max(), 0.0, 1e-12,
    "slides down its dip")
check.true(slid.removable and slid.color == rock.COLOURS["held" if exact > 1 else "sliding"], "its colour")
# The wedge of Hoek & Bray: by the closed form of the wedge study, for one friction angle.
first, second = (50, 140), (60, 230)
normals = [np.array(rock.joint((0, 0, 0), *one).normal) for one in (first, second)]
line = np.cross(*normals)
line *= -np.sign(line[2]) / np.linalg.norm(line)
trend = math.degrees(math.atan2(line[0], line[1]))
block = Domain.box((-9, -9, -9), (9, 9, 1)).below((0, 0, 0), 80, trend)
wedge = rock.slice(block, [rock.joint((0, 0, 0), *one) for one in (first, second)], progress=False)
found = [one for one in rock.key_blocks(wedge, (Domain.TOP, 6), degrees=33) if one.mode == "wedge"]
check.equal(len(found), 1, "one wedge")
cosine = normals[0] @ normals[1]
forces = np.linalg.solve([[1, cosine], [cosine, 1]], [normals[0][2], normals[1][2]])
check.close(found[0].factor,
            math.tan(math.radians(33)) * forces.sum() / -line[2], 1e-9, "factor of safety of the wedge")
check.close(np.abs(np.array(found[0].direction) - line).max(), 0.0, 1e-9, "along the line of both")
# Undermined: what rests on an excavated block falls. Water behind a block drives it.
hung = rock.slice(cube, [rock.joint((0, 0, 0), 0, 0)], regions=[Domain.box((-2, -2, -2), (2, 2, -0.5))], progress=False)
modes = [one.mode for one in rock.key_blocks(hung, (), removed=hung.inside(0))]
check.equal(sorted(modes), ["falling", "inner"], "walls hold, and what they do not hold falls")
dry, = [one for one in rock.key_blocks(plane, free, degrees=40) if one.mode == "sliding"]
behind = plane.faces_of(1)
wet, = [
    one for one in rock.key_blocks(plane, free, degrees=40, loads=rock.water_pressure(plane, behind, level=3.0))
    if one.blocks == dry.blocks
]
check.true(wet.factor < dry.factor, f"water in the crack behind: {wet.factor} < {dry.factor}")
print(rock.summary(found))

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
mass, friction, _ = slope_cuts.cut(0)
check.raises(ValueError, lambda: rock.limit_analysis(mass, range(len(mass))), "all blocks held", "hold fewer blocks")
check.raises(ValueError, lambda: rock.limit_analysis(mass, [0], "?"), "an unknown question", "question='?' is unknown")
check.raises(ValueError, lambda: rock.limit_analysis(mass, [0], degrees=90), "a vertical cone", "degrees=90")
check.raises(ValueError, lambda: rock.key_blocks(mass, (), friction=35), "an angle as a coefficient", "give degrees=35")
check.equal([one.factor for one in rock.key_blocks(mass, (), friction=math.tan(math.radians(25)))],
            [one.factor for one in rock.key_blocks(mass, (), degrees=25)], "coefficient or angle")

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
