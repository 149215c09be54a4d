# SPDX-License-Identifier: GPL-3.0-or-later
# One law of joints however a boundary is cut: restitution, spin, energy, and what other bodies side by side change.
import math
import random

from harness import *
import potential_particles
from potential_particles import shapes
import yade

check = Checks()
STIFFNESS, HALF, RADIUS = 1e9, 0.5, 0.01


def scene(loop=yade.ConicInteractionLoop, periodic=False, **material):
    O.reset()
    O.periodic = periodic
    given = dict(normalStiffness=STIFFNESS, shearStiffness=STIFFNESS / 2, frictionAngle=math.atan(0.5), density=2000.0)
    O.materials.append(yade.ConicJointMat(**{**given, **material}))
    kinds = ("ConicPP_ConicPP", "Wall_ConicPP", "Facet_ConicPP", "Box_ConicPP")
    O.engines = [
        yade.ForceResetter(),
        yade.InsertionSortCollider(
            [yade.PotentialParticle2AABB(), yade.Bo1_Wall_Aabb(), yade.Bo1_Facet_Aabb(), yade.Bo1_Box_Aabb()],
            verletDist=0.01),
        loop([getattr(yade, f"Ig2_{kind}_ScGeom")(patch=True) for kind in kinds],
             [yade.Ip2_ConicJointMat_ConicJointMat_ConicJointPhys()], [yade.Law2_ScGeomConicPP_ConicJointPhys()]),
        yade.NewtonIntegrator(damping=0.0, exactAsphericalRot=True),
    ]


def grid(count, width=1.3):
    """Triangles of a square with so many squares along each side."""
    at = [(i / count - 0.5) * width for i in range(count + 1)]
    return [triangle for i in range(count) for j in range(count)
            for a, b, c, d in [[(at[i], at[j]), (at[i + 1], at[j]), (at[i + 1], at[j + 1]), (at[i], at[j + 1])]]
            for triangle in ((a, b, c), (a, c, d))]


def fan(count, width=1.4):
    """4 or 8 triangles about the middle of a square."""
    corners = [(1, 0), (1, 1), (0, 1), (-1, 1), (-1, 0), (-1, -1), (0, -1), (1, -1)]
    rim = [(0.5 * width * x, 0.5 * width * y) for x, y in (corners if count == 8 else corners[1::2])]
    return [((0, 0), rim[i], rim[(i + 1) % count]) for i in range(count)]


def floor(kind, turn=Quaternion.Identity):
    if kind == "wall":
        O.bodies.append(utils.wall((0, 0, 0), axis=2, sense=1))
    elif kind == "box":
        O.bodies.append(utils.box(turn * Vector3(0, 0, -0.5), (2, 2, 0.5), fixed=True, orientation=turn))
    elif isinstance(kind, int):
        # So many blocks along each side, face beside face.
        width = 1.2 / kind
        block = shapes.from_vertices([(x * width / 2, y * width / 2, 0.2 * z) for x in (-1, 1) for y in (-1, 1)
                                      for z in (-1, 1)], rounding=1e-4, k=0.0)
        for i in range(kind):
            for j in range(kind):
                place = Vector3((i + 0.5) * width - 0.6, (j + 0.5) * width - 0.6, -0.2)
                O.bodies.append(potential_particles.body(block, position=turn * place, orientation=turn, fixed=True))
    else:
        for triangle in kind:
            O.bodies.append(utils.facet([turn * Vector3(*corner, 0) for corner in triangle], fixed=True))


def block(height=0.0, turn=Quaternion.Identity, place=(0, 0), shape=None, radius=RADIUS):
    shape = shape or cube(r=radius, k=0.0, half=HALF)
    return O.bodies[add(shape, turn * Vector3(*place, HALF + height), turn)]


def rebound(kind, restitution, step=0.01, turn=Quaternion.Identity, loop=yade.ConicInteractionLoop, shape=None,
            lower=0.0, own=Quaternion.Identity, place=(0, 0)):
    """Speed after over speed before of a block that lands; step: times the circular frequency of the block on its
    springs.
    """
    scene(loop, restitution=restitution)
    floor(kind, turn)
    body = block(1e-6 - lower, turn, place, shape)
    body.state.ori = turn * own
    up = turn * Vector3(0, 0, 1)
    body.state.vel = -0.1 * up
    O.dt = step / math.sqrt(STIFFNESS * (2 * (HALF - RADIUS))**2 / body.state.mass)
    while (body.state.vel.dot(up) < 0 or O.interactions.countReal()) and O.iter < 40 / step:
        run(20)
    return body.state.vel.dot(up) / 0.1


# --- a block that lands flat ------------------------------------------------------------------------------------------

FLOORS = {"wall": "wall", "box": "box", "2 triangles": grid(1), "8 triangles": fan(8), "200 triangles": grid(10),
          "4 blocks": 2, "9 blocks": 3}
for name, kind in FLOORS.items():
    check.close(rebound(kind, 0.5), 0.5, 0.005, f"restitution 0.5 on {name}")
for name in ("8 triangles", "4 blocks"):
    check.close(rebound(FLOORS[name], 0.05, step=0.003), 0.05, 5e-4, f"restitution 0.05 on {name}")
    check.close(rebound(FLOORS[name], 0.95), 0.95, 5e-3, f"restitution 0.95 on {name}")
tilt = turned((1, 2, 0.5), 0.9)
for name in ("box", "8 triangles", "9 blocks"):
    check.close(rebound(FLOORS[name], 0.3, turn=tilt), 0.3, 0.003, f"restitution 0.3 on {name}, tilted")
check.close(rebound(grid(3), 0.5, loop=yade.InteractionLoop), rebound(grid(3), 0.5), 1e-9, "YADE's own loop")

# --- a rounded corner on a seam: the area grows with the overlap -------------------------------------------------

corner = Quaternion(Vector3(1, -1, 0).normalized(), math.atan(math.sqrt(2)))
ball = cube(r=0.45, k=0.0, half=0.5)
lower = 0.5 - (0.05 * math.sqrt(3) + 0.45)
whole = rebound(grid(1, 4.0), 0.5, shape=ball, lower=lower, own=corner, place=(0.5, -0.5), step=0.005)
for name, kind in (("a seam", grid(1, 4.0)), ("a vertex of six", grid(2, 4.0)), ("many", grid(9, 0.3))):
    found = rebound(kind, 0.5, shape=ball, lower=lower, own=corner, step=0.005)
    check.close(found, whole, 0.01 * whole, f"a rounded corner on {name}")

# --- Housner's impact is that of the whole face ---------------------------------------------------------------------


def rocked(kind):
    scene(restitution=0.1, frictionAngle=0.0)  # springs along a tile begin when it is touched
    floor(kind)
    body = block(-1e-9, radius=1e-4)
    body.state.vel, body.state.angVel = Vector3(0.005, 0, -0.005), Vector3(0, 0.01, 0)
    body.state.angMom = Vector3(0, 0.01 * body.state.inertia[1], 0)
    O.dt = 1e-5
    run(2000)
    return body.state.vel[0], body.state.vel[2], body.state.angVel[1]


on_wall = Vector3(*rocked("wall"))
for name, kind in (("8 triangles", fan(8)), ("72 triangles", grid(6)), ("9 blocks", 3)):
    check.close(Vector3(*rocked(kind)), on_wall, 0.01 * on_wall.norm(), f"a block that rocks on {name}")

# --- a spin is braked by mu N times the mean distance from its centre -----------------------------------------------


def brake(kind, place=(0, 0)):
    scene()
    floor(kind)
    body = block(-1e-5, place=place, radius=1e-3)
    body.state.blockedDOFs, body.state.angVel = "xyzXYZ", Vector3(0, 0, 1)
    O.dt = 1e-5
    run(2000)
    return -O.forces.t(body.id)[2] / (0.5 * O.forces.f(body.id)[2] * 0.998 * 0.382598)


# (What a tile that is a triangle bears beside its centre is not known better from its moments.)
for name, kind, allowed in (("a wall", "wall", 2e-3), ("2 triangles", grid(1), 0.02), ("4 triangles", fan(4), 0.03),
                            ("8 triangles", fan(8), 0.01), ("200 triangles", grid(10), 2e-3), ("4 blocks", 2, 0.01)):
    for place in ((0, 0), (0.05, 0.02)):
        check.close(brake(kind, place), 1.0, allowed, f"a spin on {name} at {place}")

# --- other bodies beside it, of other materials -----------------------------------------------------------------

# A block between two walls swings on both: its dashpots are those of that motion.
scene(restitution=0.5)
O.bodies.append(utils.wall((0, 0, 0), axis=2, sense=1))
body = block(-1e-4)
O.bodies.append(utils.wall((0, 0, 2 * HALF - 2e-4), axis=2, sense=-1))
for one in O.bodies:
    one.state.blockedDOFs = one.state.blockedDOFs or "xyXYZ"
O.dt = 1e-5
run(2)
check.equal(O.interactions.countReal(), 2, "between two walls")
check.close(O.forces.f(body.id), Vector3.Zero, 1e-3 * STIFFNESS * 1e-4, "at rest")

# --- a run goes on from a save as without, and in periodic cells ----------------------------------------------------


def landed(saved, periodic=False):
    scene(restitution=0.2, periodic=periodic)
    if periodic:
        O.cell.setBox(6, 6, 6)
    floor([[(x + 0.1, y + 0.1) for x, y in one] for one in grid(4)])
    body = block(1e-4, turned((1, 2, 0), 0.01), (0.1, 0.1))
    body.state.vel = Vector3(0.05, 0, -0.3)
    O.dt = 2e-5
    run(100)
    if saved:
        O.saveTmp("tiles")
        O.loadTmp("tiles")
        potential_particles.prepare()
    run(300)
    return state_numbers()


straight = landed(False)
check.true(max(abs(a - b) for a, b in zip(landed(True), straight)) < 1e-6, "from a save")
check.true(max(abs(a - b) for a, b in zip(landed(False, True), straight)) < 1e-9, "in a periodic cell")

# --- energy at the advised step -------------------------------------------------------------------------------------

seed = random.SystemRandom().randrange(10**6)
draw = random.Random(seed)
for number in range(4):
    restitution = draw.choice((0.01, 0.05, 1.0, draw.uniform(0.01, 1)))
    scene(restitution=restitution, frictionAngle=draw.choice((0.0, 0.5)))
    turn = Quaternion(Vector3(*(draw.gauss(0, 1) for _ in range(3))).normalized(), draw.uniform(0, 3))
    count = draw.choice((1, 2, 4))
    floor(grid(count, 2.2), turn)
    body = block(draw.uniform(0, 1e-4) + 0.012, turn)
    body.state.ori = turn * Quaternion(Vector3(draw.gauss(0, 1), draw.gauss(0, 1), 0.1).normalized(),
                                       draw.choice((0.0, draw.uniform(0, 0.02))))
    body.state.vel = turn * Vector3(draw.uniform(-0.2, 0.2), draw.uniform(-0.2, 0.2), draw.uniform(-0.5, -0.1))

    def energy():
        local = body.state.ori.conjugate() * body.state.angMom
        return 0.5 * body.state.mass * body.state.vel.squaredNorm() + 0.5 * sum(local[i]**2 / body.state.inertia[i]
                                                                                for i in range(3))

    O.dt = potential_particles.critical_time_step()
    start, met = energy(), False
    while O.iter < 40000 and not (met and not O.interactions.countReal()):
        run(5)
        met = met or O.interactions.countReal() > 0
    check.true(met, f"it lands (seed {seed}, number {number})")
    check.true(energy() < start * (1 + 1e-4),
               f"energy {energy() / start} on {2 * count**2} triangles, restitution {restitution}, seed {seed}")

check.finish()
