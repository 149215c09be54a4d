# SPDX-License-Identifier: GPL-3.0-or-later
# Bonds: strength against closed forms, force and torque against differences of the energy, energy, what breaks and what
# goes on.
import math
import os
import tempfile

from harness import *
import potential_particles
import yade

check = Checks()

NORMAL, SHEAR = 1e9, 4e8  # stiffness per area, N/m^3
EDGE, OVERLAP, RADIUS = 1.0, 1e-9, 1e-3
FACE = EDGE - 2 * RADIUS  # the rounding adds a rim of sqrt(2 OVERLAP RADIUS), 1e-6
AREA, SECOND, POLAR = FACE**2, FACE**4 / 12, FACE**4 / 6
STRONG = 1e30


def scene(gravity=(0, 0, 0), loop=yade.InteractionLoop, bonds=True, dt=1e-5, track=False, periodic=False, **material):
    O.reset()
    O.periodic = periodic
    given = dict(normalStiffness=NORMAL, shearStiffness=SHEAR, frictionAngle=0.5, density=2000.0, cohesion=STRONG,
                 tensileStrength=STRONG)
    joint_scene(loop, yade.ConicJointMat(**{**given, **material}), 0.0, gravity, track, dt, bonds=bonds)


def block(position, orientation=Quaternion.Identity, fixed=False, r=RADIUS, **more):
    return O.bodies[add(cube(r=r, k=0.0, half=0.5 * EDGE, **more), Vector3(position), orientation, fixed)]


def column(number=2, r=RADIUS, fixed=True, **material):
    """Blocks on each other, bonded."""
    scene(**material)
    bodies = [block((0, 0, (EDGE - OVERLAP) * i), fixed=fixed, r=r) for i in range(number)]
    O.step()
    return bodies


def joint(one=0, other=1):
    return O.interactions[one, other].phys


def on(body):
    return O.forces.f(body.id), O.forces.t(body.id)


def turned_by(vector):
    vector = Vector3(*vector)
    return Quaternion(vector.normalized(), vector.norm()) if vector.norm() > 0 else Quaternion.Identity


def energy_of(phys, one, other):
    """The energy of a bond from its attributes, as docs/joint_law.md says it."""
    axes1, axes2 = one.ori * phys.bondTurn1, other.ori * phys.bondTurn2
    between = axes1.conjugate() * axes2
    axis, angle = between.toAxisAngle()
    midway = axes1 * Quaternion(axis, angle / 2)
    way = (other.pos + other.ori * phys.bondPoint2) - (one.pos + one.ori * phys.bondPoint1)
    u, t = midway.conjugate() * way + phys.bondDisplacement, angle * axis + phys.bondRotation
    polar, y, z = phys.bondMoments
    return 0.5 * (phys.normalStiffness * (phys.bondArea * u[0]**2 + y * t[1]**2 + z * t[2]**2)
                  + phys.shearStiffness * (phys.bondArea * (u[1]**2 + u[2]**2) + polar * t[0]**2))


# --- what is stored ---------------------------------------------------------------------------------------------

lower, upper = column()
phys = joint()
check.true(phys.bonded and not phys.broken and phys.damage == 0, "bonded")
check.true(abs(phys.bondArea / AREA - 1) < 1e-5, f"area {phys.bondArea}")
check.true(
    max(abs(a / b - 1) for a, b in zip(phys.bondMoments, (POLAR, SECOND, SECOND))) < 2e-5,
    f"moments {phys.bondMoments}")
corners = [math.hypot(*phys.bondRim[i:i + 2]) for i in range(0, len(phys.bondRim), 2)]
check.true(abs(max(corners) / (FACE / math.sqrt(2)) - 1) < 1e-5, f"corners at {max(corners)}")
check.close(phys.bondDisplacement[0], -OVERLAP, 1e-5 * OVERLAP, "it begins with the overlap")
before = on(upper)[0]
O.step()
check.close(on(upper)[0], before, 1e-5 * before.norm(), "and with its force")

# --- force and torque are minus the derivatives of the energy ----------------------------------------------------

lower, upper = column()
for turn1, turn2, way in (((0, 0, 0), (1e-3, 2e-3, -1e-3), (1e-3, -2e-3, 3e-3)), ((0.3, 1.2, -0.4), (0.2, -0.9, 1.5),
                                                                                  (0.3, 0.1, 0.4))):
    phys = joint()
    lower.state.ori, upper.state.ori = turned_by(turn1), turned_by(turn2)
    upper.state.pos = Vector3(0, 0, EDGE) + Vector3(*way)
    lower.state.vel = upper.state.vel = Vector3.Zero
    O.step()
    found = [on(lower), on(upper)]
    scale = max(on(upper)[0].norm(), on(upper)[1].norm())
    for (force, torque), body in zip(found, (lower, upper)):
        place, turn, h = Vector3(body.state.pos), Quaternion(body.state.ori), 1e-5
        for axis in range(3):
            step = Vector3(*(h * (i == axis) for i in range(3)))
            ends = []
            for sign in (1, -1):
                body.state.pos = place + sign * step
                ends.append(energy_of(phys, lower.state, upper.state))
            body.state.pos = place
            check.close(force[axis], -(ends[0] - ends[1]) / (2 * h), 1e-7 * scale, f"force {axis} on {body.id}")
            ends = []
            for sign in (1, -1):
                body.state.ori = turned_by(sign * step) * turn
                ends.append(energy_of(phys, lower.state, upper.state))
            body.state.ori = turn
            check.close(torque[axis], -(ends[0] - ends[1]) / (2 * h), 1e-7 * scale, f"torque {axis} on {body.id}")
    check.close(found[0][0] + found[1][0], Vector3.Zero, 1e-12 * scale, "forces are opposite")
    lever = upper.state.pos - lower.state.pos
    check.close(found[0][1] + found[1][1] + lever.cross(found[1][0]), Vector3.Zero, 1e-12 * scale, "and moments")

# A rigid motion of both changes nothing.
lower, upper = column()
phys, turn = joint(), turned_by((0.4, -1.1, 0.7))
for body in (lower, upper):
    body.state.pos, body.state.ori = turn * body.state.pos + Vector3(0.5, 0, -0.2), turn * body.state.ori
O.step()
held = Vector3(0, 0, NORMAL * phys.bondArea * OVERLAP)
check.close(turn.conjugate() * on(upper)[0], held, 1e-3 * held.norm(), "a rigid motion turns the force")

# --- strength ------------------------------------------------------------------------------------------------------

STRENGTH, FRICTION = 1e5, 0.5


def load_at_break(move, load, steps=2000, **material):
    """The largest load before the bond breaks, as move(upper, i) takes the upper block away."""
    lower, upper = column(**material)
    most = 0.0
    for i in range(1, steps):
        move(upper, i)
        O.step()
        if not O.interactions.has(0, 1) or not O.interactions[0, 1].isReal or not joint().bonded:
            return most
        most = load(upper)
    check.true(False, "it does not break")
    return most


def displaced(*way):
    def move(body, i):
        body.state.pos = Vector3(0, 0, EDGE - OVERLAP) + i * Vector3(*way)
    return move


def bent(axis, angle):
    """About an axis of the joint, through its centroid."""
    def move(body, i):
        body.state.ori = Quaternion(Vector3(*axis), i * angle)
        body.state.pos = Vector3(0, 0, 0.5 * EDGE) + body.state.ori * Vector3(0, 0, 0.5 * EDGE - OVERLAP)
    return move


step = STRENGTH / NORMAL / 300
for name, found, expected in (("tension",
                               load_at_break(displaced(0, 0, step), lambda b: -on(b)[0][2], tensileStrength=STRENGTH),
                               STRENGTH * AREA), ("shear",
                                                  load_at_break(displaced(STRENGTH / SHEAR / 300, 0,
                                                                          0), lambda b: -on(b)[0][0],
                                                                cohesion=STRENGTH), STRENGTH * AREA),
                              ("bending",
                               load_at_break(bent((0, 1, 0), 2 * step / FACE), lambda b: -on(b)[1][1],
                                             tensileStrength=STRENGTH), STRENGTH * FACE**3 / 6),
                              ("twist",
                               load_at_break(bent((0, 0, 1),
                                                  math.sqrt(2) * STRENGTH / SHEAR / 300 / FACE), lambda b: -on(b)[1][2],
                                             cohesion=STRENGTH), STRENGTH * POLAR / (FACE / math.sqrt(2)))):
    check.true(abs(found / expected - 1) < 5e-3, f"{name}: {found:.6g} against {expected:.6g}")

# Pressed, it bears more shear: c + mu p, and slips with the residual values after that.
lower, upper = column(cohesion=STRENGTH, frictionAngle=math.atan(FRICTION), residualFrictionAngle=math.atan(0.3),
                      residualCohesion=2e4)
depth, forces = 1e-4, []
for i in range(400):
    upper.state.pos = Vector3(i * 1e-6, 0, EDGE - OVERLAP - depth)
    upper.state.vel = Vector3(1e-6 / O.dt, 0, 0)
    upper.state.blockedDOFs = "xyzXYZ"
    O.step()
    forces.append(-on(upper)[0][0])
pressure = NORMAL * depth
check.true(abs(max(forces) / (AREA * (STRENGTH + FRICTION * pressure)) - 1) < 5e-3, f"peak {max(forces)}")
geom = O.interactions[0, 1].geom
check.true(
    abs(forces[-1] / (2e4 * geom.contactArea + 0.3 * on(upper)[0][2]) - 1) < 5e-3 and joint().broken,
    f"residual {forces[-1]}")

# --- energy ----------------------------------------------------------------------------------------------------------


def total():
    return potential_energy() + sum(O.energy[name] for name in O.energy.keys() if name not in ("kinetic", "gravWork"))


def potential_energy():
    kinetic = 0.0
    for body in O.bodies:
        spin = body.state.ori.conjugate() * body.state.angVel
        kinetic += 0.5 * (body.state.mass * body.state.vel.squaredNorm() + sum(body.state.inertia[i] * spin[i]**2
                                                                               for i in range(3)))
    return kinetic


def set_moving(body, velocity, spin):
    body.state.vel, body.state.angVel = Vector3(*velocity), Vector3(*spin)
    local = body.state.ori.conjugate() * body.state.angVel
    body.state.angMom = body.state.ori * Vector3(*(local[i] * body.state.inertia[i] for i in range(3)))


# Bonded bodies that fly and turn: nothing is lost. (Kinetic energy is that of half a step before.)
changes = []
for dt in (4e-5, 2e-5):
    bodies = column(number=3, fixed=False, dt=dt, track=True)
    for i, body in enumerate(bodies):
        set_moving(body, (0.5 * i, 0.2, -0.3 * i), (2, 1 + i, -3))
    run(2)
    begin, worst = total(), 0.0
    for _ in range(int(0.04 / dt)):
        O.step()
        worst = max(worst, abs(total() / begin - 1))
    changes.append(worst)
    check.true(all(joint(i, i + 1).bonded for i in range(2)), "bonds last")
check.true(changes[1] < 5e-3 and changes[1] < 0.6 * changes[0], f"energy of bonded bodies: {changes}")

# Dashpots take it, and count it.
bodies = column(fixed=False, dt=1e-5, track=True, restitution=0.3)
set_moving(bodies[1], (0.4, 0.1, -0.3), (1, -2, 0.5))
begin = total()
run(1500)
check.true(O.energy["viscDissip"] > 0.2 * begin, f"dashpots of a bond: {O.energy['viscDissip']} of {begin}")
check.close(total(), begin, 5e-3 * begin, f"energy with dashpots: {dict(O.energy.items())}")

# Torn apart, brittle and softening: what the bond held is counted.
for softening in (0.0, 2e-4):
    bodies = column(fixed=False, track=True, tensileStrength=1e5, cohesion=1e5, softening=softening, dt=2e-6)
    set_moving(bodies[1], (0.3, 0.1, 0.5), (0.2, 0.4, 0.1))
    begin = total()
    run(3000)
    check.true(not O.interactions.has(0, 1) or not O.interactions[0, 1].isReal, "it has broken")
    check.close(total(), begin, 2e-3 * begin, f"energy, softening {softening}: {dict(O.energy.items())}")
    check.true(O.energy["bondBreaking"] > 1e-4 * begin, "breaking takes energy")
# Pulled straight, it takes the fracture energy: 1/2 strength (elastic opening + softening) A.
for softening in (0.0, 3e-4):
    lower, upper = column(tensileStrength=1e5, softening=softening, track=True)
    for i in range(1, 4500):
        upper.state.pos = Vector3(0, 0, EDGE - OVERLAP + i * 1e-7)
        O.step()
    expected = 0.5 * 1e5 * (1e5 / NORMAL + softening) * AREA
    check.true(
        abs(O.energy["bondBreaking"] / expected - 1) < 1e-2,
        f"fracture energy {O.energy['bondBreaking']}, expected {expected}")

# --- a bond outlives its overlap, ends with its bodies, and is made when asked for
# -----------------------------------------

lower, upper = column()
upper.state.pos += Vector3(0, 0, 0.5)
for _ in range(20):
    O.step()
check.true(joint().bonded and O.interactions[0, 1].geom.penetrationDepth < 0, "it lasts without overlap")
check.close(on(upper)[0], Vector3(0, 0, -NORMAL * joint().bondArea * (0.5 - OVERLAP)), 1e-6 * NORMAL, "and pulls")
O.bodies.erase(1)
O.step()
check.equal(len(O.interactions), 0, "it ends with its body")

lower, upper = column(bonds=False)
check.true(not joint().bonded and not joint().broken, "not bonded, and whole")
check.equal(potential_particles.bond_contacts([0]), 0, "bodies that are not joined")
check.equal(potential_particles.bond_contacts(), 1, "bonded when asked for")
O.step()
check.true(joint().bondArea > 0, "the bond is there")
joint().bonded = False
O.step()
O.step()
check.true(joint().broken and joint().bondArea == 0, "a script ends it")

scene()
lower = block((0, 0, 0), fixed=True)
O.step()
upper = block((0, 0, EDGE - OVERLAP), fixed=True)
O.step()
check.true(not joint().bonded and joint().broken, "a joint that is made later is not whole")

# Walls and facets.
for boundary in ("wall", "facets"):
    scene()
    if boundary == "wall":
        O.bodies.append(utils.wall((0, 0, 0), axis=2, sense=1))
    else:
        O.bodies.append([utils.facet([Vector3(*corner) for corner in corners], fixed=True)
                         for corners in (((-9, -9, 0), (9, -9, 0), (9, 9, 0)), ((-9, -9, 0), (9, 9, 0), (-9, 9, 0)))])
    body = block((0.1, 0.05, 0.5 * EDGE - OVERLAP), fixed=True)
    O.step()
    body.state.pos += Vector3(0, 0, 1e-4)
    O.step()
    check.true(
        abs(on(body)[0][2] / (-NORMAL * AREA * 1e-4) - 1) < 1e-4, f"{boundary} holds a bonded block: {on(body)[0]}")
    bound = [contact.phys for contact in O.interactions if contact.isReal]
    rims = sum(0.5 * sum(x[i] * x[(i + 3) % len(x)] - x[i + 1] * x[(i + 2) % len(x)] for i in range(0, len(x), 2))
               for x in (one.bondRim for one in bound))
    check.true(abs(rims / AREA - 1) < 1e-4, f"corners of the bonded area enclose it: {rims}")

# A round patch, of two balls: area, corners on a circle, and the moments of a disc.
scene()
balls = [
    O.bodies[add(yade.ConicPotentialParticle(planes=cube_planes(0.9, 0.05), r=0.05, k=1.0, R=0.5),
                 Vector3(0, 0, height), fixed=True)] for height in (0, 0.999)
]
O.step()
phys = joint()
corners = [math.hypot(*phys.bondRim[i:i + 2]) for i in range(0, len(phys.bondRim), 2)]
radius = math.sqrt(0.25 - 0.4995**2)
check.true(
    len(corners) >= 24 and max(abs(corner / radius - 1) for corner in corners) < 1e-3,
    f"corners of a disc of {radius}: {corners}")
check.true(
    abs(phys.bondArea / (math.pi * radius**2) - 1) < 1e-3
    and abs(phys.bondMoments[0] / (math.pi / 2 * radius**4) - 1) < 1e-3,
    f"area and polar moment of a disc: {phys.bondArea}, {phys.bondMoments}")

# Across the boundary of a periodic cell.
scene(periodic=True)
O.engines[1].allowBiggerThanPeriod = True
O.cell.setBox(4, 4, 4)
left, right = block((3.5 + OVERLAP, 2, 2), fixed=True), block((0.5, 2, 2), fixed=True)
O.step()
right.state.pos += Vector3(1e-4, 0, 0)
O.step()
check.true(joint().bonded and abs(on(right)[0][0] / (-NORMAL * AREA * 1e-4) - 1) < 1e-4,
           f"across the cell: {on(right)[0]}")

# A pair that flies and turns across it, with dashpots, moves as one does that is whole within the cell.
ways = []
for start in (1.5, 3.5):
    for loop in (yade.InteractionLoop, yade.ConicInteractionLoop):
        scene(periodic=True, loop=loop, restitution=0.5, tensileStrength=4e5, cohesion=4e5)
        O.engines[1].allowBiggerThanPeriod = True
        O.cell.setBox(4, 4, 4)
        left, right = block((start + OVERLAP, 2, 2)), block((start + 1 - (4 if start > 3 else 0), 2, 2))
        set_moving(left, (0.3, 0.1, 0), (0, 0.5, 0))
        set_moving(right, (-0.3, 0.2, 0.1), (0.3, 0, 0.5))
        run(600)
        whole = joint().bonded
        right.state.vel += Vector3(2, 0, 0)
        run(1500)
        check.true(whole and not (O.interactions.has(0, 1) and joint().bonded), f"it holds, and breaks later: {whole}")
        ways.append([
            left.state.pos - Vector3(start, 0, 0), right.state.pos - Vector3(start + (-4 if start > 3 else 0), 0, 0),
            left.state.vel, right.state.vel, left.state.angVel, right.state.angVel
        ])
for way in ways[1:]:
    check.true(all((one - other).norm() < 1e-9 for one, other in zip(way, ways[0])),
               f"the same motion across the cell: {way} and {ways[0]}")

# Members of a clump: two blocks in one hold as one of twice the length does.
ends = []
for clumped in (False, True):
    scene(gravity=(0, 0, -9.81), restitution=0.5)
    block((0, 0, 0), fixed=True)
    if clumped:
        members = [block((EDGE * (i + 1) - OVERLAP, 0, 0)).id for i in (0, 1)]
        whole = O.bodies[O.bodies.clump(members)]
        whole.state.inertia = long.state.inertia  # YADE counts the rounding of their common face as well
        whole.state.mass = long.state.mass
    else:
        planes = [(*normal, (1.0 if normal[0] else 0.5) * EDGE - RADIUS)
                  for normal in ((1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1))]
        whole = long = O.bodies[add(yade.ConicPotentialParticle(planes=planes, r=RADIUS, k=0.0, R=2.0),
                                    Vector3(1.5 * EDGE - OVERLAP, 0, 0))]
    run(1)
    set_moving(whole, (0, 0.05, 0), (0.2, 0, 0))
    run(1500)
    check.true(joint().bonded, "it holds")
    ends.append([whole.state.pos, whole.state.vel, whole.state.angVel])
for one, other in zip(*ends):
    # The members of a clump have the velocity that the script gave it after a step only, and dashpots with them.
    check.close(other, one, 2e-3 * max(one.norm(), 1e-2), "a clump of two blocks moves as one block")

# --- cohesion of a patch that is not bonded
# -------------------------------------------------------------------------------

scene(bonds=False, cohesion=STRENGTH, residualCohesion=0.0, frictionAngle=math.atan(FRICTION),
      residualFrictionAngle=math.atan(0.2))
lower, upper = block((0, 0, 0), fixed=True), block((0, 0, EDGE - 1e-4))
upper.state.blockedDOFs = "xyzXYZ"
upper.state.vel = Vector3(5e-2, 0, 0)
forces = []
for _ in range(900):
    O.step()
    forces.append(-on(upper)[0][0])
check.true(abs(max(forces) / (AREA * STRENGTH + FRICTION * on(upper)[0][2]) - 1) < 5e-3, f"peak {max(forces)}")
check.true(abs(forces[-1] / (0.2 * on(upper)[0][2]) - 1) < 5e-3, f"residual {forces[-1]}")

# Slip and twist share it: F_max = c A + mu N, M_max = c 2 sqrt(2)/3 sqrt(A J) + mu N lever.
scene(bonds=False, cohesion=STRENGTH, residualCohesion=STRENGTH, frictionAngle=math.atan(FRICTION))
lower, upper = block((0, 0, 0), fixed=True), block((0, 0, EDGE - 1e-4))
upper.state.blockedDOFs = "xyzXYZ"
upper.state.vel, upper.state.angVel = Vector3(0.3, 0, 0), Vector3(0, 0, 0.8)
run(200)
phys, geom = joint(), O.interactions[0, 1].geom
friction = FRICTION * phys.normalForce.norm()
most = STRENGTH * geom.contactArea + friction
turning = STRENGTH * 2 * math.sqrt(2) / 3 * math.sqrt(geom.contactArea * geom.polarMoment) + friction * geom.twistLever
# At each point alike: of a square whose sides move by +-0.3 and +-0.4 m/s along them.
middles = [(i + 0.5) / 60 - 0.5 for i in range(60)]
velocities = [(0.3 - 0.8 * EDGE * y, 0.8 * EDGE * x, x, y) for x in middles for y in middles]
slip = sum(vx / math.hypot(vx, vy) for vx, vy, _, _ in velocities) / len(velocities)
turn = sum((x * vy - y * vx) / math.hypot(vx, vy) for vx, vy, x, y in velocities) / len(velocities) / 0.382598
check.close(phys.shearForce.norm() / most, slip, 0.03, "force of slip and twist")
check.close(abs(phys.twistMoment) / turning, abs(turn), 0.03, "moment of slip and twist")

# --- time step, loop, threads, saves
# ----------------------------------------------------------------------------------------

bodies = column(number=2, fixed=False)
bodies[0].state.blockedDOFs = "xyzXYZ"
step = potential_particles.critical_time_step(contacts=1, stiffness=1.0, safety=1.0)
mass, inertia = bodies[1].state.mass, bodies[1].state.inertia[0]
# A block on a fixed one: shear with bending, the stiffest mode of the two.
arm = 0.5 * EDGE
stiff = [[SHEAR * AREA, SHEAR * AREA * arm], [SHEAR * AREA * arm, SHEAR * AREA * arm**2 + NORMAL * SECOND]]
trace, product = stiff[0][0] / mass + stiff[1][1] / inertia, (stiff[0][0] * stiff[1][1] - stiff[0][1]**2) / (mass
                                                                                                             * inertia)
highest = max(0.5 * trace + math.sqrt(0.25 * trace**2 - product), NORMAL * AREA / mass)
check.true(0.5 < step / (2 / math.sqrt(highest)) < 1, f"time step {step} against {2 / math.sqrt(highest)}")


def swinging(loop, saved=False):
    scene(gravity=(0, 0, -9.81), loop=loop, restitution=0.5, tensileStrength=2e5, cohesion=2e5)
    for i in range(4):
        body = block(((EDGE - OVERLAP) * i, 0, 0), fixed=i == 0)
    O.dt = 5e-5
    run(100)
    if saved:
        O.saveTmp("bonds")
        O.loadTmp("bonds")
        potential_particles.prepare()
    count = sum(contact.isReal and contact.phys.bonded for contact in O.interactions)
    run(1500)
    left = sum(contact.isReal and contact.phys.bonded for contact in O.interactions)
    check.true(count == 3 and left < 3, f"some of three bonds break: {count}, {left}")
    return state_numbers()


bodies = column(softening=1e-3, tensileStrength=1e5)
bodies[1].state.pos += Vector3(0, 0, 3e-4)
O.step()
kept = joint().dict()
check.true(0.1 < kept["damage"] < 1 and len(kept["bondRim"]) >= 8, "a damaged bond")
for ending in ("xml", "yade.gz"):
    path = os.path.join(tempfile.mkdtemp(), f"bond.{ending}")
    O.save(path)
    O.load(path)
    check.equal(joint().dict(), kept, f"saved to {ending}")

plain_loop = swinging(yade.InteractionLoop)
check.equal(swinging(yade.ConicInteractionLoop), plain_loop, "ConicInteractionLoop")
check.equal(swinging(yade.ConicInteractionLoop, saved=True), plain_loop, "a run goes on from a save as without")

# --- what is refused
# -----------------------------------------------------------------------------------------------------------

for name, value in (("cohesion", -1), ("tensileStrength", math.inf), ("residualFrictionAngle", 2), ("softening", -1),
                    ("frictionAngle", 30), ("frictionAngle", -0.1)):
    check.raises(ValueError, lambda: yade.ConicJointMat(**{name: value}), name,
                 f"{name} = {'inf: it must be finite' if value == math.inf else f'{value}: give'}")
# Set later it is YADE's attribute, which takes any number: the run is refused.
column()
O.materials[0].frictionAngle = 30
check.raises(ValueError, O.step, "degrees",
             "frictionAngle of ConicJointMat 0 in O.materials = 30: give radians in [0, pi/2)")
O.reset()
O.materials.append(yade.FrictMat(frictionAngle=30))
block((0, 0, 0))
check.true(any("frictionAngle=30" in one.what and "radians" in one.remedy for one in potential_particles.check()),
           "check() finds it in FrictMat, too")
O.engines = [
    yade.InteractionLoop([yade.Ig2_ConicPP_ConicPP_ScGeom()], [yade.Ip2_FrictMat_FrictMat_FrictPhys()],
                         [yade.Law2_ScGeom_FrictPhys_CundallStrack(sphericalBodies=False)])
]
check.raises(ValueError, potential_particles.use_joints, "use_joints in degrees",
             "frictionAngle = 30: give radians in [0, pi/2)")

check.finish()
