# SPDX-License-Identifier: GPL-3.0-or-later
# Bodies of shapes: they stand where the script says, turn as they should, and nothing is left behind by bad input.
import math

import numpy as np

import potential_particles
import yade
from harness import *
from potential_particles import body, critical_time_step, extrema, porosity, rolling, shapes, solid_volume
from yade import utils

check = Checks()
steel = yade.FrictMat(young=1e9, poisson=0.3, frictionAngle=0.5, density=7800.0, label="steel")

# A skew wedge built far from the origin stands, by default, where it was built: f = 0 at points of its faces.
planes = [(0, 0, -1, -9.0), (0, 1, 0, 6.0), (0, -1, 0, -4.5), (2, 0, 1, 21), (-1, 0, 1, 6.5)]
wedge = shapes.from_planes(planes, rounding=0.1, k=0.0)


def f_in_world(made, point):
    return made.shape.potential(made.state.ori.conjugate() * (point - made.state.pos))


for position, orientation in [((0, 0, 0), (1, 0, 0, 0)), ((1, -2, 3), (0.3, 0.5, -0.2, 0.9)),
                              ((0, 0, 1e3), turned((1, 1, 0), 2.0))]:
    made = body(wedge, steel, position, orientation)
    turn = orientation if isinstance(orientation, Quaternion) else Quaternion(*orientation)
    turn.normalize()
    for a, b, c, h in planes[:3]:
        foot = Vector3(*wedge.centroid)
        foot += Vector3(a, b, c) * (h - Vector3(a, b, c).dot(foot))
        check.close(f_in_world(made, turn * foot + Vector3(*position)), 0.0, 1e-8,
                    f"a face stands where it was built, {position}")
    check.close(made.state.pos,
                turn * Vector3(*wedge.centroid) + Vector3(*position), 1e-9, "the state is that of the centroid")
    check.close(made.state.mass / (7800 * wedge.volume), 1.0, 1e-12, "mass")
    check.close(made.state.inertia, 7800 * Vector3(*wedge.inertia), 1e-9 * made.state.mass, "inertia")
    check.true(made.aspherical and made.state.blockedDOFs == "", "free and no sphere")
    check.true(made.shape.AabbMinMax and len(made.shape.vertices) >= 4, "its box is set")

# Inertia in world axes is what the definition says, by points of a grid: independent of principal axes.
made = body(wedge, steel, (0, 0, 0), (0.3, 0.5, -0.2, 0.9))
reach, cells = made.shape.boundingRadius, 60
places = [(i + 0.5) * 2 * reach / cells - reach for i in range(cells)]
inside = np.array([(x, y, z) for x in places for y in places for z in places
                   if made.shape.potential(made.state.ori.conjugate() * Vector3(x, y, z)) <= 0])
second = inside.T @ inside / len(inside)
turn = made.state.ori.toRotationMatrix()
turn = np.array([[turn[i, j] for j in range(3)] for i in range(3)])
expected = turn @ np.diag(made.state.inertia) @ turn.T / made.state.mass
check.true(
    np.abs(np.trace(second) * np.eye(3) - second - expected).max() < 4e-3 * expected.max(), "inertia in world axes")

# Materials: one given, by label, by number, the last one.
O.materials.append(steel)
O.materials.append(yade.FrictMat(density=1000.0, label="ice"))
cube = shapes.cuboid((1, 1, 1))
for material, density in [(None, 1000), ("steel", 7800), (0, 7800), (yade.FrictMat(density=5.0), 5)]:
    check.close(body(cube, material).state.mass / cube.volume, density, 1e-6 * density, f"material {material}")

# Free rotation without forces: angular momentum and energy stay, and the kinetic energy is what YADE says.
fresh_scene(yade.Ig2_ConicPP_ConicPP_ScGeom(), dt=1e-4)
spun = body(wedge, steel, velocity=(1, 2, 3), angular_velocity=(5, 1, -2))
O.bodies.append(spun)
energy, momentum_before = utils.kineticEnergy(), utils.angularMomentum()
local = spun.state.ori.conjugate() * spun.state.angVel
own = 0.5 * spun.state.mass * 14 + 0.5 * sum(i * w * w for i, w in zip(spun.state.inertia, local))
check.close(energy / own, 1.0, 1e-12, "kinetic energy before the first step")
run(500)
check.close(utils.kineticEnergy() / energy, 1.0, 1e-5, "kinetic energy of a free body")
# YADE 2025 has it of a velocity and an orientation half a step apart.
check.close(utils.angularMomentum(), momentum_before,
            spun.state.angVel.norm() * O.dt * momentum_before.norm(), "its angular momentum")
check.close(spun.state.vel, Vector3(1, 2, 3), 1e-12, "velocity of its centroid")

# Fixed, masked and coloured bodies, and further attributes of the shape.
O.reset()
held = body(cube, steel, fixed=True, color=(1, 0, 0), mask=6, isBoundary=True, wire=True)
check.equal((held.state.blockedDOFs, held.mask, held.shape.isBoundary, held.shape.wire), ("xyzXYZ", 6, True, True),
            "attributes")
check.equal(held.shape.color, Vector3(1, 0, 0), "colour")

# Two at rest on a fixed one, by the step that is advised.
fresh_scene(yade.Ig2_ConicPP_ConicPP_ScGeom(), gravity=(0, 0, -9.81), damping=0.3, stiffness=1e6)
floor = O.bodies.append(body(shapes.cuboid((10, 10, 1)), steel, (0, 0, -0.5), fixed=True))
ids = [O.bodies.append(body(cube, steel, (3 * i, 0, 0.5 + 0.1 * i))) for i in range(2)]
O.dt = critical_time_step()
run(3000)
for i, one in enumerate(ids):
    check.close(O.bodies[one].state.pos[2], 0.5, 0.08, f"cube {i} rests with the critical time step")
check.true(utils.kineticEnergy() < 1e-2 * 7800 * 9.81, "and does not shake")

# Two bodies joined by one spring through their centres: omega^2 = 2 k/m. The limit is below that of leapfrog, and not
# by far more than it says.
fresh_scene(yade.Ig2_ConicPP_ConicPP_ScGeom(), stiffness=1e5)
O.materials.append(steel)
ball = shapes.sphere(1.0)
for x in (0.0, 1.99):
    O.bodies.append(body(ball, steel, (x, 0, 0)))
run(2)
mass, k = O.bodies[0].state.mass, O.interactions.all()[0].phys.kn
exact = 2.0 / math.sqrt(2 * k / mass)
advised = critical_time_step(stiffness=1e-9, safety=1.0)
# ks = kn there: the turn of a ball about a contact at the arm 0.995 adds 5/2 of its square to 1.
check.close(advised, 2.0 / math.sqrt(2 * k / mass * (1 + 2.5 * 0.995**2)), 1e-4 * advised,
            "largest eigenvalue of a ball at a contact")
check.true(advised <= exact, "it is below the limit of the translation")
check.close(
    critical_time_step(stiffness=4e5) / critical_time_step(stiffness=1e5), 0.5, 1e-9,
    "a stiffer contact: half the step")
check.true(critical_time_step() <= advised, "new contacts count as well")

# A plate on a wall: as it tilts, its contact point moves on its face, of which springs at the point know nothing.
# Against the torque after a small tilt.
for shape in shapes.cuboid((0.2, 0.2, 0.03)), shapes.cuboid((0.2, 0.2, 0.03), k=0.5), shapes.random_rock(1, size=0.1):
    fresh_scene(yade.Ig2_Wall_ConicPP_ScGeom(carryTolerance=0.0), yade.Ip2_FrictMat_FrictMat_FrictPhys(),
                yade.Law2_ScGeom_FrictPhys_CundallStrack(sphericalBodies=False), dt=1e-12)
    O.engines[1].boundDispatcher.functors = [yade.PotentialParticle2AABB(), yade.Bo1_Wall_Aabb()]
    O.engines[-1].dead, O.engines[1].verletDist = True, 0.0
    O.bodies.append(utils.wall(0, axis=2))
    plate = O.bodies[O.bodies.append(body(shape, steel, (0, 0, 0.2)))]
    heights = potential_particles.mesh(plate.shape, 1e-4).points @ np.array(plate.state.ori.toRotationMatrix())[2]
    plate.state.pos = Vector3(0, 0, -heights.min() - 1e-5)

    def torque(angle, axis):
        plate.state.ori = Quaternion(axis, angle) * upright
        run(1)
        contact = next(one for one in O.interactions if one.isReal)
        return (contact.geom.contactPoint - plate.state.pos).cross(contact.phys.normalForce), contact
    upright, exact = Quaternion(plate.state.ori), []
    for axis in Vector3(1, 0, 0), Vector3(0, 1, 0):
        turn = 1e-7
        exact.append((torque(-turn, axis)[0] - torque(turn, axis)[0]) / (2 * turn))
    contact = torque(0.0, Vector3(1, 0, 0))[1]
    normal, point = (np.array([list(one)]) for one in (contact.geom.normal, contact.geom.contactPoint))
    jitter, rolling.JITTER = rolling.JITTER, 0.0
    found = rolling.turning_stiffness([contact], normal, point, np.array([contact.phys.normalForce.norm()]),
                                      np.array([contact.phys.kn]))[0, 1]
    rolling.JITTER = jitter
    # What the spring itself does, at an arm from the centre.
    arm = contact.geom.contactPoint - plate.state.pos
    spring = [
        contact.phys.kn * arm.cross(Vector3(0, 0, 1)).dot(axis) * arm.cross(Vector3(0, 0, 1))
        for axis in (Vector3(1, 0, 0), Vector3(0, 1, 0))
    ]
    for i in 0, 1:
        expected = exact[i][i] - spring[i][i]
        check.close(found[i, i], max(expected, 0.0), 0.03 * abs(expected) + 1e-3 * abs(exact[i][i]),
                    f"stiffness against turning of {shape.name}")
    check.true(shape.name != "cuboid" or shape.k > 0.1 or found[0, 0] > 100 * contact.phys.normalForce.norm() * 0.1,
               "large on a flat face")
O.engines = []
check.raises(ValueError, critical_time_step, "no engines", "no physics functor")
O.bodies.clear()
check.raises(ValueError, lambda: critical_time_step(1e5), "no bodies", "no body")
check.raises(ValueError, lambda: critical_time_step(-1), "a stiffness below 0", "stiffness=-1")

# Extrema and porosity.
O.reset()
check.raises(ValueError, extrema, "an empty scene", "no potential particle")
check.raises(ValueError, porosity, "an empty scene", "no porosity")
sharp = shapes.cuboid((1, 2, 3), rounding=1e-4, k=0.0)
O.bodies.append(body(sharp, steel, (1, 1, 1.5)))
O.bodies.append(body(sharp, steel, (3, 1, 1.5), turned((0, 0, 1), math.pi / 2)))
low, high = extrema()
check.close(low, Vector3(0.5, 0, 0), 1e-3, "lower corner")
check.close(high, Vector3(4, 2, 3), 1e-3, "upper corner")
check.close(solid_volume(), 12.0, 1e-4, "solid volume")
check.close(porosity(), 1 - 12 / (3.5 * 2 * 3), 1e-3, "porosity")
check.close(porosity((0, 0, 0), (10, 10, 10)), 1 - 12 / 1000, 1e-6, "porosity of a box")
O.bodies.append(body(shapes.cuboid((50, 50, 1)), steel, fixed=True))
check.close(porosity(), 1 - 12 / (3.5 * 2 * 3), 1e-3, "a fixed body is no grain")
O.bodies.append(utils.sphere((0, 0, 0), 5.0, material=steel))
check.close(extrema([3])[1], Vector3(5, 5, 5), 1e-9, "spheres count, too")
check.raises(ValueError, lambda: porosity((0, 0, 0), (1, 1, 0)), "a box without volume", "must be above 0")

# Bad input: one sentence, and nothing in the scene.
O.reset()
nan = float("nan")
check.raises(ValueError, lambda: body(cube), "no material", "there is no material")
for action, words in [(lambda: body("cube", steel), "not a Shape"), (lambda: body(cube, "wood"), "material='wood'"),
                      (lambda: body(cube, 7), "material=7"),
                      (lambda: body(cube, yade.FrictMat(density=0)), "density=0"),
                      (lambda: body(cube, steel, (0, nan, 0)), "position"),
                      (lambda: body(cube, steel, (0, 0)), "position"),
                      (lambda: body(cube, steel, orientation=(0, 0, 0, 0)), "orientation"),
                      (lambda: body(cube, steel, orientation=(1, 0, 0)), "orientation"),
                      (lambda: body(cube, steel, velocity=(0, 0, nan)), "velocity"),
                      (lambda: body(cube, steel, color="red"), "color")]:
    check.raises(ValueError, action, f"bad input: {words}", words)
check.equal((len(O.bodies), len(O.materials)), (0, 0), "nothing was put into the scene")
check.finish()
