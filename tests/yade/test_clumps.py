# SPDX-License-Identifier: GPL-3.0-or-later
# Clumps of bodies that overlap: mass, centre and inertia of their union, against closed forms and an independent sum;
# their time step.
import numpy as np
import potential_particles
import yade
from harness import *
from potential_particles import body, shapes

check = Checks()
DENSITY = 1000.0


def start():
    O.reset()
    O.materials.append(yade.FrictMat(young=1e7, poisson=0.3, frictionAngle=0.5, density=DENSITY))


def sphere(place, radius):
    return O.bodies.append(utils.sphere(place, radius, material=0))


# Two balls: the lens that they share counts once. Both halves are caps, whose moments are known.
start()
R, D = 0.4, 0.5
number = potential_particles.clump([sphere((0, 0, 0), R), sphere((D, 0, 0), R)])
state = O.bodies[number].state
volume = 2 * (math.pi * (2 / 3 * R**3 + R**2 * D / 2 - (D / 2)**3 / 3))
check.close(state.mass / (DENSITY * volume), 1.0, 2e-4, "mass of two balls")
check.close(state.pos, Vector3(D / 2, 0, 0), 1e-4, "their centre")
x = np.linspace(D / 2, D + R, 200001)[:-1] + (R + D / 2) / 400000
area = math.pi * np.maximum(R**2 - (x - D)**2, 0)
about_axis, step = DENSITY * 2 * (area**2 / (2 * math.pi)).sum() * (R + D / 2) / 200000, (R + D / 2) / 200000
across = DENSITY * 2 * (area**2 / (4 * math.pi) + area * (x - D / 2)**2).sum() * step
check.close(Vector3(*sorted(state.inertia)), Vector3(about_axis, across, across), 3e-4 * across, "inertia of two balls")
axis = state.ori * Vector3(*[float(i == min(state.inertia)) for i in state.inertia])
check.close(abs(axis[0]), 1.0, 1e-4, "whose axis is the line of centres")
check.equal([O.bodies[i].state.mass for i in (0, 1)], [DENSITY * 4 / 3 * math.pi * R**3] * 2,
            "members keep their masses")
check.equal(len([b for b in O.bodies]), 3, "two members and their clump")


# Rocks: against points on a grid, of which each lies within or without by the definition of a potential particle.
def within(shape, points):
    planes = np.array(shape.planes)
    beyond = np.maximum(points @ planes[:, :3].T - planes[:, 3], 0.0)
    return (1 - shape.k) / shape.r**2 * (beyond**2).sum(1) + shape.k / shape.R**2 * (points**2).sum(1) <= 1.0


def rotation(ori):
    matrix = ori.toRotationMatrix()
    return np.array([[matrix[i, j] for j in range(3)] for i in range(3)])


def tensor(state):
    return rotation(state.ori) @ np.diag(list(state.inertia)) @ rotation(state.ori).T


start()
kinds = [shapes.random_rock(1, size=1.0), shapes.cuboid((1.2, 0.4, 0.3)), shapes.random_rock(4, size=0.8)]
ids = [
    O.bodies.append(body(kind, position=place, orientation=turn))
    for kind, place, turn in zip(kinds, [(0, 0, 0), (0.4, 0.1, 0.2), (0.2, 0.5, -0.1)], [(1, 0, 0,
                                                                                          0), (0.8, 0.4, 0.1,
                                                                                               0.2), (0.5, 0.1, 0.7,
                                                                                                      0.3)])
]
lower, upper = (np.array(list(one)) for one in potential_particles.extrema())
spacing = (upper - lower) / 110
axes = [low + (np.arange(110) + 0.5) * step for low, step in zip(lower, spacing)]
points = np.stack(np.meshgrid(*axes, indexing="ij"), -1).reshape(-1, 3)
inside = np.zeros(len(points), bool)
for one in (O.bodies[i] for i in ids):
    inside |= within(one.shape, (points - np.array(one.state.pos)) @ rotation(one.state.ori))
points, weight = points[inside], DENSITY * spacing.prod()
mass, centre = weight * len(points), points.mean(0)
about = weight * (points - centre).T @ (points - centre)
inertia = np.trace(about) * np.eye(3) - about
places = {i: (Vector3(*O.bodies[i].state.pos), Quaternion(O.bodies[i].state.ori)) for i in ids}
separate = sum(O.bodies[i].state.mass for i in ids)
number = potential_particles.clump(ids)
state = O.bodies[number].state
check.true(separate > 1.15 * mass, f"they overlap: {separate} kg, {mass} kg")
check.close(state.mass / mass, 1.0, 1e-3, "mass of three rocks")
check.close(state.pos, Vector3(*centre), 1e-3, "their centre")
found = tensor(state)
check.close(np.abs(found - inertia).max() / np.abs(inertia).max(), 0.0, 2e-3, "their inertia")
for i, (place, turn) in places.items():
    check.close(O.bodies[i].state.pos, place, 1e-12, "members keep their place")
    check.close(O.bodies[i].state.ori * Vector3(1, 2, 3), turn * Vector3(1, 2, 3), 1e-12, "and their turn")

# Without an overlap the members add up, by Steiner.
def apart():
    start()
    return [O.bodies.append(body(shapes.random_rock(seed, size=1.0), position=(seed, seed, 0))) for seed in (1, 2)]


members = [O.bodies[i].state for i in apart()]
mass = sum(one.mass for one in members)
centre = sum((one.mass * np.array(one.pos) for one in members), np.zeros(3)) / mass
inertia = sum(
    tensor(one) + one.mass * (arm @ arm * np.eye(3) - np.outer(arm, arm)) for one in members
    for arm in [np.array(one.pos) - centre])
state = O.bodies[potential_particles.clump([0, 1])].state
check.close(state.mass / mass, 1.0, 1e-12, "mass of bodies apart")
check.close(state.pos, Vector3(*centre), 1e-9, "their centre")
check.close(np.abs(tensor(state) - inertia).max(), 0.0, 1e-9 * inertia.max(), "their inertia")
apart()
state = O.bodies[O.bodies.clump([0, 1])].state
print(f"YADE's O.bodies.clump: inertia off by {np.abs(tensor(state) - inertia).max() / inertia.max():.2g}")

# What makes no clump.
check.raises(ValueError, lambda: potential_particles.clump([0]), "one body", "two members")
O.materials.append(yade.FrictMat(density=2000.0))
other = O.bodies.append(body(shapes.cuboid((1, 1, 1)), material=1))
check.raises(ValueError, lambda: potential_particles.clump([other, 0]), "two densities", "density")

# A clump falls and turns as the rigid body that it is: no force, so momentum and energy stay; and its time step is
# known.
start()
pair = [
    O.bodies.append(body(shapes.cuboid((0.3, 0.06, 0.06)))),
    O.bodies.append(body(shapes.cuboid((0.06, 0.2, 0.06)), position=(0.1, 0.05, 0)))
]
number = potential_particles.clump(pair)
O.engines = [yade.ForceResetter(), yade.InsertionSortCollider([yade.PotentialParticle2AABB()]),
             yade.InteractionLoop([yade.Ig2_ConicPP_ConicPP_ScGeom()], [yade.Ip2_FrictMat_FrictMat_FrictPhys()],
                                  [yade.Law2_ScGeom_FrictPhys_CundallStrack(sphericalBodies=False)]),
             yade.NewtonIntegrator(damping=0.0, exactAsphericalRot=True)]
O.dt = potential_particles.critical_time_step(safety=1.0)
check.true(0 < O.dt < 0.01, f"time step of a clump: {O.dt}")
state, k = O.bodies[number].state, 1e7 * O.bodies[pair[0]].shape.boundingRadius
known = potential_particles.critical_time_step(stiffness=k, safety=1.0)
check.close(potential_particles.critical_time_step(stiffness=k, safety=1.0, bodies=[pair[1]]), known, 1e-12,
            "a member stands for its clump")
single = 2 / math.sqrt(2 * 3 * k / state.mass)
check.true(0.2 * single < known < single, f"below that without turns: {known}, {single}")

# check() names clumps whose mass or inertia is wrong, and is content with ours.
def two(make, distance, turn=(1, 0, 0, 0), of_inertia=1.0):
    start()
    rods = [
        O.bodies.append(body(shapes.cuboid((0.3, 0.1, 0.1)), position=(distance * i, 0, 0), orientation=turn))
        for i in range(2)
    ]
    O.bodies[make(rods)].state.inertia *= of_inertia
    return [one for one in potential_particles.check() if "clump" in one.remedy]


check.equal(len(two(lambda ids: O.bodies.clump(ids), 0.2)), 1, "a clump that counts an overlap twice")
check.equal(two(potential_particles.clump, 0.2), [], "one that counts it once")
check.equal(two(lambda ids: O.bodies.clump(ids), 0.5), [], "YADE's clump of bodies apart that are not turned")
check.equal(two(potential_particles.clump, 0.5, (0.9, 0, 0, 0.4)), [], "ours of such that are")
check.equal(len(two(potential_particles.clump, 0.5, (0.9, 0, 0, 0.4), of_inertia=1.1)), 1, "another inertia")

check.finish()
