# SPDX-License-Identifier: GPL-3.0-or-later
# Porosity along lines and grading curves, against closed forms and what a packing was asked for.
import potential_particles
import yade
from harness import *
from potential_particles import body, packing, sampled_porosity, shapes
from yade import Matrix3

check = Checks()


def start(periodic=False):
    O.reset()
    O.materials.append(yade.FrictMat(young=1e7, poisson=0.3, frictionAngle=0.5, density=1000.0))
    O.periodic = periodic


def holds(found, exact, text, most=1e-3):
    """The value within twice its error, which is small."""
    value, error = found
    check.true(error < most and abs(value - exact) <= 2 * error + 1e-12, f"{text}: {value} +- {error}, exactly {exact}")


# Two balls that overlap count once where they do.
start()
R, D = 0.4, 0.5
for x in 0, D:
    O.bodies.append(utils.sphere((x, 0, 0), R, material=0))
lens = math.pi * (4 * R + D) * (2 * R - D)**2 / 12
balls = 2 * 4 / 3 * math.pi * R**3 - lens
holds(sampled_porosity((-1, -1, -1), (1, 1, 1)), 1 - balls / 8, "two balls")
many = [sampled_porosity((-1, -1, -1), (1, 1, 1), lines=500, seed=seed) for seed in range(60)]
held = sum(abs(value - (1 - balls / 8)) <= error for value, error in many)
check.true(51 <= held, f"the error holds in 95 % of cases: {held} of {len(many)}")
check.true(sum(error for _, error in many) / len(many) < 3e-3, "and is small with few lines, too")
check.equal(sampled_porosity((-1, -1, -1), (1, 1, 1), seed=3), sampled_porosity((-1, -1, -1), (1, 1, 1), seed=3),
            "the same seed")
check.true(
    potential_particles.porosity((-1, -1, -1), (1, 1, 1)) < 1 - balls / 8 - 0.5 * lens / 8,
    "porosity() counts the overlap twice")
# What lies outside of the box does not count: an eighth of a ball.
start()
O.bodies.append(utils.sphere((0, 0, 0), R, material=0))
holds(sampled_porosity((0, 0, 0), (0.5, 0.5, 0.5)), 1 - math.pi / 6 * R**3 / 0.125, "an eighth of a ball", 6e-3)
check.equal(sampled_porosity((7, 7, 7), (8, 8, 8)), (1.0, 0.0), "a box in which nothing lies")
# The volumes of particles, turned anyhow, ours and plain, of k = 0.02 and of 1.
for shape in shapes.cuboid((0.5, 0.4, 0.3)), shapes.random_rock(3, size=0.6), shapes.sphere(0.3):
    start()
    O.bodies.append(body(shape, orientation=(0.9, 0.3, 0.1, 0.2)))
    holds(sampled_porosity((-0.5, -0.5, -0.5), (0.5, 0.5, 0.5)), 1 - shape.volume, shape.name)
    plain_one = plain(shape.planes or [(1, 0, 0, 10)], r=shape.r, k=shape.k, R=shape.R)
    O.bodies[0].shape = plain_one
    holds(sampled_porosity((-0.5, -0.5, -0.5), (0.5, 0.5, 0.5)), 1 - shape.volume, f"plain {shape.name}")
# Boundaries and fixed bodies are no grains.
O.bodies[0].state.blockedDOFs = "xyzXYZ"
check.raises(ValueError, lambda: sampled_porosity((-1, -1, -1), (1, 1, 1)), "no grain", "no porosity")
# A sheared periodic cell: bodies that reach out of it come in at the other side.
start(periodic=True)
O.cell.hSize = Matrix3(1, 0.3, 0.1, 0, 1.2, -0.2, 0, 0, 0.9)
volume = 0.0
for i in range(3):
    shape = shapes.random_rock(i, size=0.35)
    volume += shape.volume
    O.bodies.append(body(shape, position=O.cell.hSize * Vector3(0.4 * i + 0.02, 0.35 * i - 0.01, 3.33 * i + 0.99)))
holds(sampled_porosity(), 1 - volume / O.cell.volume, "a sheared cell")
start()
check.raises(ValueError, sampled_porosity, "no box", "give the box")
check.raises(ValueError, lambda: sampled_porosity((1, 0, 0), (0, 1, 1)), "no volume", "volume of the box")

# A packing of a grading curve has it: each row within the share of the largest body.
start()
wanted = [(0.04, 0.0), (0.06, 0.3), (0.09, 0.7), (0.13, 1.0)]
bodies = potential_particles.pack(packing.Box((0, 0, 0), (0.8, 0.8, 1.0)), [shapes.random_rock(i) for i in range(5)],
                                  sizes=wanted, shares="passing", number=400, progress=False)
potential_particles.add_packing(bodies)
curve = potential_particles.grading_curve()
largest = max(b.state.mass for b in O.bodies) / sum(b.state.mass for b in O.bodies)
check.equal(len(curve), len(bodies), "a row for each grain")
check.close(curve[-1][1], 1.0, 1e-12, "all passes the largest size")
for size, share in wanted:
    passing = max((row[1] for row in curve if row[0] <= size * (1 + 1e-9)), default=0.0)
    check.close(passing, share, 2.5 * largest, f"mass up to {size} m")
check.equal(potential_particles.grading_curve([0, 1])[-1][1], 1.0, "of some bodies alone")
# A clump is one grain, of the volume of its union.
start()
pair = [O.bodies.append(body(shapes.cuboid((0.3, 0.1, 0.1)), position=(0.2 * i, 0, 0))) for i in range(2)]
number = potential_particles.clump(pair)
(size, passing), = potential_particles.grading_curve()
check.close(math.pi / 6 * size**3 * 1000, O.bodies[number].state.mass, 1e-9, "size of a clump")
check.close(potential_particles.solid_volume() * 1000, O.bodies[number].state.mass, 1e-9, "solid volume of a clump")
holds(sampled_porosity((-0.5, -0.5, -0.5), (0.7, 0.7, 0.7)), 1 - O.bodies[number].state.mass / 1000 / 1.2**3,
      "porosity about a clump")
start()
check.raises(ValueError, potential_particles.grading_curve, "no grain", "no grading curve")

check.finish()
