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


ROWS = {row.__name__: row for row in (face, spin, tiles, lintels, stack)}
