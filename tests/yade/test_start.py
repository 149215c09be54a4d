# SPDX-License-Identifier: GPL-3.0-or-later
# A start from the forces of limit analysis: what is left on a body in the first step, what moves in 1,000, what has no
# start; and the picture of an answer.
import math
import tempfile

import numpy as np
import potential_particles
from harness import *
from potential_particles import limit_analysis, plot_equilibrium, shapes, start_from

check = Checks()
ROUNDING, OVERLAP = 1e-3, 1e-6
# Of the wall of 52 blocks below, by limit_analysis("load", push=(1, 0, 0)), which takes seconds.
WALL_FACTOR = 0.54207


def joints(gravity=(0, 0, -9.81), **material):
    O.reset()
    given = dict(young=2e10, poisson=0.3, density=2000, frictionAngle=math.atan(0.65), restitution=0.3)
    joint_scene(yade.ConicInteractionLoop, yade.ConicJointMat(**{**given, **material}), 0.0, gravity, False, 1e-7)


def tilted(angle):
    return 9.81 * Vector3(math.sin(angle), 0, -math.cos(angle))


def cuboid(size, position, fixed=False, **more):
    shape = shapes.cuboid(tuple(one + OVERLAP for one in size), r=ROUNDING, k=0)
    return O.bodies.append(potential_particles.body(shape, position=position, fixed=fixed, **more))


def floor(kind="particle"):
    if kind == "wall":
        O.bodies.append(utils.wall(0.0, axis=2, sense=1))
    elif kind == "facet":
        O.bodies.append(utils.facet([(-9, -9, 0), (9, -9, 0), (0, 18, 0)], fixed=True))
    else:
        cuboid((16, 4, 1), (6, 0, -0.5), fixed=True)


def slope(kind="particle", **material):
    joints(tilted(0.3), **material)
    floor(kind)
    cuboid((1, 1, 1), (0, 0, 0.5 - 0.5 * OVERLAP))
    find_contacts()


def stack():
    joints(tilted(0.1))
    floor()
    cuboid((1, 1, 1), (0, 0, 0.5))
    cuboid((1, 0.5, 1), (0.1, 0.1, 1.5))
    find_contacts()


def wall(rows, columns, push):
    """A wall in bond, pushed sideways by a share of its weight."""
    joints()
    floor()
    for row in range(rows):
        edges = [0, *range(1, 2 * columns, 2), 2 * columns] if row % 2 else list(range(0, 2 * columns + 1, 2))
        for left, right in zip(edges, edges[1:]):
            block = cuboid((right - left, 1, 1), (0.5 * (left + right), 0, row + 0.5))
            O.forces.setPermF(block, (push * 9.81 * O.bodies[block].state.mass, 0, 0))
    find_contacts()


def arch(stones=15, thickness=0.18):
    joints(young=2e9, frictionAngle=0.7)
    angles = np.pi / stones * np.arange(-1, stones + 2)
    for number, ends in enumerate(zip(angles, angles[1:])):
        corners = np.array([(radius * np.cos(angle), y, radius * np.sin(angle)) for angle in ends
                            for radius in (1 - thickness / 2, 1 + thickness / 2) for y in (-0.225, 0.225)])
        corners += OVERLAP * (corners - corners.mean(axis=0))
        shape = shapes.from_vertices(corners, rounding=2 * ROUNDING, k=0)
        O.bodies.append(potential_particles.body(shape, fixed=number in (0, stones + 1)))
    find_contacts()


def clump():
    joints(tilted(0.3))
    floor()
    potential_particles.clump([cuboid((1, 1, 1), (0, 0, 0.5)), cuboid((1, 1, 1), (0.9, 0, 0.5))])
    find_contacts()


def cantilever():
    """Blocks that bonds alone hold."""
    joints(cohesion=1e7, tensileStrength=1e7)
    for place in range(5):
        cuboid((1, 1, 1), (place, 0, 0), fixed=place == 0)
    find_contacts()
    potential_particles.bond_contacts()


def wall_with_bonds(every):
    wall(4, 4, 0.0)
    for contact in list(O.interactions)[::every]:
        contact.phys.tensileStrength = contact.phys.cohesion = 1e7
        contact.phys.bonded = True


def find_contacts():
    O.step()
    for body in O.bodies:
        body.state.vel = body.state.angVel = body.state.angMom = (0, 0, 0)


def free():
    return [body for body in O.bodies if body.state.blockedDOFs == "" and not body.isClumpMember]


def stays(what, most_changed):
    """What is left in the first step, and the way in 1,000."""
    before = O.iter, O.time, O.dt
    start = start_from(limit_analysis())
    check.equal((O.iter, O.time, O.dt), before, f"{what}: no step is made")
    O.dt = potential_particles.critical_time_step()
    weight = 9.81 * np.mean([body.state.mass for body in free()])
    places = [Vector3(body.state.pos) for body in free()]
    O.step()
    left = max(body.state.mass * body.state.vel.norm() / O.dt for body in free()) / weight
    check.true(max(left, start.unbalanced) <= 1e-6, f"{what}: {left:.1e} of the weight in the first step, {start}")
    check.true(start.changed <= most_changed, f"{what}: forces of contacts differ by {start.changed:.2g} of the weight")
    run(1000)
    moved = max((body.state.pos - place).norm() for body, place in zip(free(), places))
    check.true(moved < 1e-9, f"{what}: moved by {moved:.1e} in 1,000 steps")


# Forces are those of the answer, exactly where statics alone gives them, and nearly where patches share them.
for make, most_changed in ((slope, 1e-8), (lambda: slope("wall"), 1e-8), (lambda: slope("facet"), 1e-8), (stack, 1e-8),
                           (cantilever, 1e-6), (lambda: wall_with_bonds(1), 1e-6), (lambda: wall_with_bonds(2), 1.0),
                           (clump, 1e-3), (arch, 0.05), (lambda: wall(3, 3, 0.3), 0.1),
                           (lambda: wall(8, 6, 0.5 * WALL_FACTOR), 0.2)):
    make()
    stays(f"{len(O.bodies)} bodies", most_changed)

# Joints that hold by cohesion alone are whole afterwards.
slope(frictionAngle=0.1, cohesion=1e5)
O.interactions[0, 1].phys.broken = False
stays("cohesion", 1e-6)
check.true(not O.interactions[0, 1].phys.broken, "the joint is whole")

# What has no start is refused by name.
slope()
answer = limit_analysis("load", push=(1, 0, 0))
check.raises(ValueError, lambda: start_from(answer), "a load factor", 'this answers "load"')
slope(frictionAngle=0.2)
check.raises(ValueError, lambda: start_from(limit_analysis()), "a scene that falls", "the scene falls")
stack()
answer = limit_analysis()
slope()
check.raises(ValueError, lambda: start_from(answer), "another scene", "other contacts")
slope()
O.bodies[0].state.vel = (1, 0, 0)
answer = limit_analysis()
check.raises(ValueError, lambda: start_from(answer), "a floor that moves", "body 0 is held and moves")
# A contact of another law.
O.reset()
O.materials.append(yade.FrictMat(young=1e9, poisson=0.3, density=2000, frictionAngle=0.5))
O.engines = [
    yade.ForceResetter(),
    yade.InsertionSortCollider([yade.PotentialParticle2AABB()]),
    yade.InteractionLoop([yade.Ig2_ConicPP_ConicPP_ScGeom()], [yade.Ip2_FrictMat_FrictMat_FrictPhys()],
                         [yade.Law2_ScGeom_FrictPhys_CundallStrack(sphericalBodies=False)]),
    yade.NewtonIntegrator(gravity=(0, 0, -9.81)),
]
O.dt = 1e-7
floor()
cuboid((1, 1, 1), (0, 0, 0.5))
find_contacts()
answer = limit_analysis()
check.raises(ValueError, lambda: start_from(answer), "points", "FrictPhys has no springs against tilt")
# A block hangs off the middle of its bond, which tears at one side below a strength of 2.2 times the weight over 1 m^2,
# if it is rigid below 1.6.
joints(cohesion=1e7, tensileStrength=1.9 * 2000 * 9.81)
cuboid((1, 1, 1), (0, 0, 2), fixed=True)
hanging = cuboid((1, 1, 1), (0.2, 0, 1))
find_contacts()
potential_particles.bond_contacts()
O.step()
O.bodies[hanging].state.vel = O.bodies[hanging].state.angVel = (0, 0, 0)
answer = limit_analysis()
check.raises(RuntimeError, lambda: start_from(answer), "a bond that tears", "no rest was found")
check.true(O.interactions[0, hanging].phys.bonded, "the bond is as it was")
# Within a hair of the edge, a bed of springs tilts where rigid blocks stand.
joints()
floor()
block = cuboid((1, 1, 4), (0, 0, 2))
find_contacts()
O.forces.setPermF(block, (0.2495 * 9.81 * O.bodies[block].state.mass, 0, 0))
place, answer = Vector3(O.bodies[block].state.pos), limit_analysis()
check.raises(RuntimeError, lambda: start_from(answer), "on the edge", "no rest was found")
check.equal(O.bodies[block].state.pos, place, "a start that fails leaves bodies in their places")

# Pictures: from the side of a wall and oblique, of an answer that stands, and of a mechanism alone.
with tempfile.TemporaryDirectory() as folder:
    wall(2, 2, 0.3)
    answer = limit_analysis("load", push=(1, 0, 0))
    check.true((answer.used <= 1.0 + 1e-3).all() and answer.used.max() > 0.9, f"friction used: {answer.used}")
    plot_equilibrium(answer, f"{folder}/wall.png")
    slope("wall", frictionAngle=0.2)
    plot_equilibrium(limit_analysis(), f"{folder}/falls.png", towards=(0.5, -0.8, 0.3))
    for name in ("wall", "falls"):
        from matplotlib.image import imread
        picture = imread(f"{folder}/{name}.png")
        check.true(picture.shape[0] > 100 and np.ptp(picture[..., :3]) > 0.5, f"{name}: {picture.shape}")
    O.reset()
    check.raises(ValueError, lambda: plot_equilibrium(answer, f"{folder}/none.png"), "no scene", "is not in the scene")

check.finish()
