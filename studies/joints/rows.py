# SPDX-License-Identifier: GPL-3.0-or-later
"""What is measured of joints: each row returns {"value", "target", ...}; it is met where value <= target."""
import math

import potential_particles
from scene import O, add, block_shape, fastest, fresh, run, spun, wall
from yade import Quaternion, Vector3, utils

K = 1e9  # stiffness per area, N/m^3


def face():
    """N = K A d and M = K I tilt of a cube on a wall: the larger relative error, at an overlap of 1e-6 of the size."""
    fresh(gravity=(0, 0, 0), normalStiffness=K, frictionAngle=0.5)
    O.dt, side, overlap = 1e-6, 2 * (0.5 - 1e-4), 1e-6
    wall((0, 0, 0), 2, 1)
    cube = add(block_shape((1, 1, 1), r=1e-4), (0, 0, 0.5 - overlap), fixed=True)
    tilt = 0.2 * overlap
    cube.state.ori = Quaternion((0, 1, 0), tilt)
    O.step()
    force, moment = O.forces.f(cube.id)[2], O.forces.t(cube.id)[1]
    return {"value": max(abs(force / (K * side**2 * overlap) - 1), abs(moment / (K * side**4 / 12 * tilt) + 1)), "target": 1e-3}


def spin():
    """The moment on a block that spins on its base, against 0.382598 mu N a."""
    fresh(normalStiffness=K, shearStiffness=K / 2, frictionAngle=math.atan(0.5))
    O.dt, side = 1e-5, 2 * (0.5 - 1e-3)
    wall((0, 0, 0), 2, 1)
    cube = add(block_shape((1, 1, 1), r=1e-3), (0, 0, 0.5))
    weight = cube.state.mass * 9.81
    cube.state.pos = Vector3(0, 0, 0.5 - weight / (K * side**2))
    spun(cube, Vector3(0, 0, 1))
    run(1e-4)
    before = cube.state.angVel[2]
    run(0.05)
    moment = (before - cube.state.angVel[2]) * cube.state.inertia[2] / 0.05
    run(0.1)
    return {"value": abs(moment / (0.382598 * 0.5 * weight * side) - 1), "target": 2e-3, "spin_after": cube.state.angVel[2]}


def tiles():
    """N/W of a cube dragged over tiles of two triangles each, against one slab."""
    forces = {}
    for width in (0.37, 9.0):
        fresh(gravity=(0, 0, 0), tolerance=1e-10, normalStiffness=K, shearStiffness=K / 2, frictionAngle=math.atan(0.5))
        O.dt = 5e-3
        count = 1 if width > 1 else 4
        for i in range(-count, count):
            for j in range(-count, count):
                a, b, c, d = (Vector3((i + x) * width, (j + y) * width, 0) for x, y in ((0, 0), (1, 0), (1, 1), (0, 1)))
                O.bodies.append([utils.facet(corners, fixed=True) for corners in ((a, b, c), (a, c, d))])
        cube = add(block_shape((1, 1, 1), r=0.01), (0.013, 0.021, 0.5 - 1e-4))
        cube.state.blockedDOFs = "xyzXYZ"
        cube.state.vel = Vector3(1, 0.3, 0)
        forces[width] = []
        for _ in range(60):
            O.step()
            forces[width].append(O.forces.f(cube.id)[2])
    return {"value": max(abs(a / b - 1) for a, b in zip(*forces.values())), "target": 1e-9}


def lintel(share=1.05, seconds=1.5):
    """A flat arch of 6 stones, held by `share` of the thrust W/(2 mu) that its outer joints need against sliding."""
    friction = 0.7
    fresh(damping=0.2, normalStiffness=K, shearStiffness=K / 2, frictionAngle=math.atan(friction), restitution=0.5)
    size = (0.2, 0.2, 0.3)
    stones = [add(block_shape(size), (0.2 * (i + 0.5), 0, 0)) for i in range(6)]
    add(block_shape(size), (-0.1, 0, 0), fixed=True)
    abutment = add(block_shape(size), (1.3, 0, 0))
    abutment.state.blockedDOFs = "yzXYZ"
    weight = sum(stone.state.mass for stone in stones) * 9.81
    thrust = share * weight / (2 * friction)
    O.forces.setPermF(abutment.id, Vector3(-thrust, 0, 0))
    O.engines[-1].gravity = (0, 0, 0)
    O.dt = 1e-4
    run(0.1)  # the thrust comes before the weight, and that by and by: a sudden weight would count twice
    begin = [Vector3(stone.state.pos) for stone in stones]
    for part in range(1, 51):
        O.engines[-1].gravity = (0, 0, -9.81 * part / 50)
        run(0.01)
    run(seconds)
    drop = max((stone.state.pos - place).norm() for stone, place in zip(stones, begin))
    return drop, fastest()


def lintels():
    """Thrust 2 % above and below what the joints need: the one stands (speed at the end, m/s), the other falls."""
    stands, falls = lintel(1.02), lintel(0.98)
    return {"value": stands[1], "target": 1e-6, "moved_standing": stands[0], "moved_falling": falls[0], "falls": stands[0] < 1e-3 and falls[0] > 0.05}


def stack():
    """Two cubes on each other that hardly load their joint: speed after 1 s, m/s."""
    fresh(normalStiffness=1e11, shearStiffness=5e10, frictionAngle=0.5, restitution=0.3)
    wall((0, 0, 0), 2, 1)
    for i in range(2):
        add(block_shape((0.1, 0.1, 0.1), r=0.001), (0, 0, 0.05 + 0.1 * i))
    O.dt = potential_particles.critical_time_step(safety=0.5)
    run(1.0)
    return {"value": fastest(), "target": 1e-6, "step": O.dt}


def rocking_impact(ratio, restitution, start=0.3):
    """Part of its angular velocity that a block of width over height `ratio` keeps as it lands, let go at `start` of the largest tilt."""
    fresh(normalStiffness=2.5e11, shearStiffness=1.25e11, frictionAngle=math.atan(2.0), restitution=restitution)
    wall((0, 0, 0), 2, 1)
    block = add(block_shape((1, 1, 1 / ratio), r=1e-3), (0, 0, 0.5 / ratio))
    slope, O.dt = math.atan(ratio), 4e-6
    # It falls about an edge through x = 0.5; a turn about y by t lowers what lies at x > 0.
    turn = Quaternion((0, 1, 0), start * slope)
    block.state.pos, block.state.ori = Vector3(0.5, 0, 0) + turn * Vector3(-0.5, 0, 0.5 / ratio), turn
    # What is kept is seen from how far it rises on its other edge.
    tilt, farthest = -start * slope, 0.0
    while O.time < 10 and tilt >= farthest or tilt < 0:
        farthest = max(farthest, tilt)
        run(2e-3)
        axis, angle = block.state.ori.toAxisAngle()
        tilt = -angle * axis[1]
    risen = math.cos(slope - farthest) - math.cos(slope)
    return math.sqrt(risen / (math.cos(slope * (1 - start)) - math.cos(slope)))


def housner():
    """What stout blocks keep in rocking, against Housner's 1 - 3/2 sin^2 a, by the restitution that comes nearest; relative error.

    bed: the limit of a bed of dashpots that never pull, with horizontal sticking: ln kept = -int q (1 - y)/(3 - q (1 - y) y) dy for y from -1/2 to 1/2,
    q = 1/(1/12 + 1/(3 ratio^2)).
    """
    found, worst = {}, 0.0
    for ratio in (0.5, 0.7):
        wanted = 1 - 1.5 * math.sin(math.atan(ratio))**2
        q, steps = 1 / (1 / 12 + 1 / (3 * ratio**2)), [(i + 0.5) / 200 - 0.5 for i in range(200)]
        kept = {restitution: rocking_impact(ratio, restitution) for restitution in (0.5, 0.1, 0.03, 0.01)}
        worst = max(worst, min(abs(one / wanted - 1) for one in kept.values()))
        found[f"ratio_{ratio}"] = {"housner": wanted, "bed": math.exp(-sum(q * (1 - y) / (3 - q * (1 - y) * y) for y in steps) / 200), "kept": kept}
    return {"value": worst, "target": 5e-3, **found}


ROWS = {row.__name__: row for row in (face, spin, tiles, lintels, stack, housner)}
