# SPDX-License-Identifier: GPL-3.0-or-later
# The law of joints on a contact patch: stiffness of a face, friction against twist and slip, energy, restitution.
import math

from harness import *
import potential_particles
from potential_particles import shapes
import yade

check = Checks()

STIFFNESS = 1e9  # per area, N/m^3
HALF, RADIUS, DENSITY = 0.5, 0.01, 2000.0
AREA = (2 * (HALF - RADIUS))**2  # of the flat part of a face


def scene(gravity=(0, 0, 0), damping=0.0, track=False, loop=yade.InteractionLoop, **material):
    O.reset()
    given = dict(normalStiffness=STIFFNESS, shearStiffness=STIFFNESS / 2, frictionAngle=math.atan(0.5), density=DENSITY)
    joint_scene(loop, yade.ConicJointMat(**{**given, **material}), damping, gravity, track, 1e-5)


def block(position, orientation=Quaternion.Identity, fixed=False, half=HALF, r=RADIUS, k=0.0):
    return O.bodies[add(cube(r=r, k=k, half=half), Vector3(position), orientation, fixed)]


def wall():
    return O.bodies[O.bodies.append(utils.wall((0, 0, 0), axis=2, sense=1))]


def force_on(body):
    return O.forces.f(body.id), O.forces.t(body.id)


# --- a face on a wall: N = K A overlap, M = K I tilt ---------------------------------------------------------

for overlap in (1e-5, 1e-6):
    scene()
    floor = wall()
    body = block((0, 0, HALF - overlap), fixed=True)
    O.step()
    force, torque = force_on(body)
    # The rounding adds to the face: a rim of the width sqrt(2 overlap r) whose depth falls to 0.
    check.true(0 <= force[2] / (STIFFNESS * AREA * overlap) - 1 < 10 * math.sqrt(overlap * RADIUS),
               f"N = K A overlap: {force}")
    check.close(torque, Vector3.Zero, 1e-9 * force[2], "no moment")
    check.close(Vector3(force[0], force[1], 0), Vector3.Zero, 1e-9 * force[2], "no force along the wall")
    contact = O.interactions[0, 1]
    check.close(contact.phys.normalForce, force, 1e-9 * force[2], "normalForce acts on body 2")

    straight = force[2]
    tilt = 0.1 * overlap / HALF
    body.state.ori = turned((0, 1, 0), tilt)
    O.step()
    force, torque = force_on(body)
    side = 2 * (HALF - RADIUS)
    check.true(
        abs(torque[1] / (-STIFFNESS * side**4 / 12 * tilt) - 1) < 20 * math.sqrt(overlap * RADIUS),
        f"M = K I tilt: {torque}")
    check.close(force[2], straight, 1e-4 * straight, "tilting does not change N")



# --- a block spun on its base: M = 0.382598 mu N a, until it stops ---------------------------------------------

scene(gravity=(0, 0, -9.81), track=True)
wall()
body = block((0, 0, HALF), r=1e-3)
side = 2 * (HALF - 1e-3)
weight = body.state.mass * 9.81
body.state.pos = Vector3(0, 0, HALF - weight / (STIFFNESS * side**2))
body.state.angVel = Vector3(0, 0, 1)
body.state.angMom = Vector3(0, 0, body.state.inertia[2])
run(10)
speed, work = body.state.angVel[2], O.energy["plastDissip"]
run(4000)
moment = (speed - body.state.angVel[2]) * body.state.inertia[2] / (4000 * O.dt)
check.true(O.interactions[0, 1].phys.isSliding, "it slips")
check.true(abs(moment / (0.382598 * 0.5 * weight * side) - 1) < 2e-3, f"moment {moment / (0.5 * weight * side)} mu N a")
lost = 0.5 * body.state.inertia[2] * (speed**2 - body.state.angVel[2]**2)
check.close(O.energy["plastDissip"] - work, lost, 1e-3 * lost, "friction takes the energy of the spin")
run(8000)
check.true(
    abs(body.state.angVel[2]) < 0.02 and not O.interactions[0, 1].phys.isSliding, f"it stops: {body.state.angVel}")

# --- slip and twist together: Coulomb's friction at each point of the face, summed up here ------------------------

side = 2 * (HALF - RADIUS)
middles = [(i + 0.5) / 60 - 0.5 for i in range(60)]
for slip in (0.1, 0.3, 0.6):
    scene()
    wall()
    body = block((0, 0, HALF - 1e-5))
    body.state.blockedDOFs = "xyzXYZ"
    body.state.vel, body.state.angVel = Vector3(slip, 0, 0), Vector3(0, 0, 0.8)
    run(1500)
    joint = O.interactions[0, 1].phys
    most = 0.5 * joint.normalForce.norm()
    velocities = [(slip - 0.8 * side * y, 0.8 * side * x, side * x, side * y) for x in middles for y in middles]
    force = sum(vx / math.hypot(vx, vy) for vx, vy, _, _ in velocities) / len(velocities)
    moment = sum((x * vy - y * vx) / math.hypot(vx, vy) for vx, vy, x, y in velocities) / len(velocities)
    check.close(-joint.shearForce[0] / most, force, 0.03, f"force of slip {slip} and turn 0.8")
    check.close(-joint.twistMoment / most, moment, 0.01, "its moment")
    check.close(-joint.shearForce[0] * slip - joint.twistMoment * 0.8, most * (force * slip + moment * 0.8),
                5e-3 * most * (force * slip + moment * 0.8), "its work")

# --- tiles and one slab give the same force -------------------------------------------------------------------


def dragged(triangles):
    scene()
    for one in O.engines[2].geomDispatcher.functors:
        one.patchTolerance = 1e-10
    for corners in triangles:
        O.bodies.append(utils.facet([Vector3(*corner, 0) for corner in corners], fixed=True))
    body = block((0.013, 0.021, HALF - 1e-4))
    body.state.blockedDOFs = "xyzXYZ"
    body.state.vel = Vector3(1, 0.3, 0)
    O.dt = 5e-3
    forces = []
    for _ in range(60):
        O.step()
        forces.append(force_on(body))
    return forces


TILE = 0.37
tiles = [triangle for i in range(-3, 4) for j in range(-3, 3)
         for a, b, c, d in [[((i + x) * TILE, (j + y) * TILE) for x, y in ((0, 0), (1, 0), (1, 1), (0, 1))]]
         for triangle in ((a, b, c), (a, c, d))]
slab = [((-9, -9), (9, -9), (9, 9)), ((-9, -9), (9, 9), (-9, 9))]
one, many = dragged(slab), dragged(tiles)
check.true(max(abs(a[0][2] / b[0][2] - 1) for a, b in zip(one, many)) < 1e-9, "tiles press as one slab")
check.true(max(abs(a[0][2] / one[0][0][2] - 1) for a in many) < 1e-9, "at all places")
# (Each tile begins with a spring of its own: the drag is that of sliding once all have slipped.)
check.true(all(abs(math.hypot(a[0][0], a[0][1]) / a[0][2] - 0.5) < 1e-3 for a in many[5:]), "friction 0.5")

# --- elastic impacts keep the energy ---------------------------------------------------------------------------


def energy(bodies):
    total = 0
    for one in bodies:
        spin = one.state.ori.conjugate() * one.state.angVel
        total += 0.5 * one.state.mass * one.state.vel.squaredNorm() + 0.5 * sum(one.state.inertia[i] * spin[i]**2
                                                                                for i in range(3))
    return total


for k in (0.0, 0.05):
    scene(frictionAngle=0.0)
    left = block((0, 0, 0), turned((1, 2, 3), 0.7), r=0.05, k=k)
    right = block((1.35, 0.2, 0.1), turned((3, 1, 2), 1.1), r=0.05, k=k)
    left.state.vel, right.state.vel = Vector3(2, 0, 0), Vector3(-2, 0, 0)
    O.dt = 1e-4
    before = energy([left, right])
    deepest = met = 0
    while not met or any(i.isReal for i in O.interactions):
        O.step()
        for contact in O.interactions:
            if contact.isReal:
                met, deepest = 1, max(deepest, contact.geom.largestDepth)
    check.true(deepest > 0.01 and right.state.angVel.norm() > 0.1, f"a firm impact off centre, {deepest} deep")
    check.close(energy([left, right]) / before, 1.0, 1e-4, f"energy after an elastic impact, k = {k}")
    check.equal(O.interactions.countReal(), 0, "they leave each other")

# --- restitution ------------------------------------------------------------------------------------------------

for wanted in (0.9, 0.5, 0.1):
    scene(restitution=wanted, track=True)
    wall()
    body = block((0, 0, HALF + 1e-4))
    body.state.vel = Vector3(0, 0, -0.1)
    O.dt = 2e-6
    run(20)
    before = energy([body])
    while O.time < 0.02 and body.state.vel[2] < 0 or O.interactions.countReal():
        O.step()
    check.close(body.state.vel[2] / 0.1, wanted, 0.01, "restitution")
    check.close(O.energy["viscDissip"], before - energy([body]), 5e-3 * before, "what the dashpot took")

# --- a block that lands on its face is pushed at the edge that comes down: Housner's impact
# ------------------------------

for ratio, restitution in ((0.5, 0.1), (0.7, 0.03)):
    scene(restitution=restitution, frictionAngle=1.5, track=True)
    wall()
    half, height, spin, radius = 0.5, 1 / ratio, 0.01, 1e-4
    planes = [(*(sign * (i == axis) for i in range(3)), (half, half, height / 2)[axis] - radius) for axis in range(3)
              for sign in (1, -1)]
    body = O.bodies[add(yade.ConicPotentialParticle(planes=planes, r=radius, k=0, R=2 * height),
                        Vector3(0, 0, height / 2 - 1e-9))]
    body.state.mass, body.state.inertia = height * DENSITY, height * DENSITY / 12 * Vector3(
        1 + height**2, 1 + height**2, 2)
    # It turns about its edge at x = -half.
    body.state.vel, body.state.angVel = Vector3(spin * height / 2, 0, -spin * half), Vector3(0, spin, 0)
    body.state.angMom = Vector3(0, spin * body.state.inertia[1], 0)
    O.dt = 1e-5
    before = energy([body])
    run(10)
    while O.interactions.countReal() and O.iter < 40000:
        run(10)
    check.equal(O.interactions.countReal(), 0, "it leaves the floor, as there is no weight")
    # What it has once the other edge rests, however often that bounces: its angular momentum about that edge stays.
    inertia, velocity = body.state.inertia[1], body.state.vel
    momentum = inertia * body.state.angVel[1] + body.state.mass * (height / 2 * velocity[0] + half * velocity[2])
    kept = momentum / (inertia + body.state.mass * (half**2 + height**2 / 4)) / spin
    check.close(kept, 1 - 1.5 * math.sin(math.atan(ratio))**2, 2.5e-3,
                f"Housner's impact, width over height {ratio}, restitution {restitution}")
    lost = before - energy([body])
    check.close(O.energy["viscDissip"] + O.energy["plastDissip"] + O.energy["patchChange"], lost, 3e-2 * lost,
                "what the dashpots took")

# --- patches of bodies at rest are carried on ---------------------------------------------------------------------

scene(gravity=(0, 0, -9.81), restitution=0.3, damping=0.3)
wall()
sinking = 9.81 * DENSITY / (STIFFNESS * AREA)
lower, upper = block((0, 0, HALF - 2 * sinking)), block((0.05, 0.02, 3 * HALF - 3 * sinking), turned((0, 0, 1), 0.2))
O.dt = 2e-5
run(4000)
functors = O.engines[2].geomDispatcher.functors
for functor in functors:
    functor.resetCounters()
run(100)
for functor in functors[:2]:
    check.equal((functor.patches, functor.doubtfulPatches), (100, 0), f"{functor}: a patch a step")
    check.true(functor.patchesCarried >= 80, f"{functor}: {functor.patchesCarried} carried on")
O.step()
weight = 9.81 * upper.state.mass
check.close(O.interactions[1, 2].phys.normalForce[2] / weight, 1.0, 2e-4, "the joint carries the upper block")
check.close(O.interactions[0, 1].phys.normalForce[2] / weight, 2.0, 4e-4, "the floor carries both")
carried = functors[0].patchesCarried
O.saveTmp("rest")
run(1)
check.equal(functors[0].patchesCarried, carried, "what is kept of patches is not saved, and dropped by a save")

# --- what is refused ---------------------------------------------------------------------------------------------

check.raises(ValueError, lambda: yade.ConicJointMat(restitution=0), "restitution",
             "restitution = 0: it must lie in [0.01, 1]")
check.raises(ValueError, lambda: yade.ConicJointMat(normalStiffness=-1), "stiffness",
             "normalStiffness = -1: give a stiffness per area")
check.raises(ValueError, lambda: yade.Ig2_ConicPP_ConicPP_ScGeom(patchTolerance=0.2), "tolerance",
             "patchTolerance = 0.2")
check.raises(ValueError, lambda: yade.Ig2_ConicPP_ConicPP_ScGeom(patch=True, twoDimension=True), "two dimensions",
             "choose one of them")
scene()
O.engines[2].geomDispatcher.functors[1].patch = False
check.raises(ValueError, O.step, "a functor without patch", "give Ig2_Wall_ConicPP_ScGeom the keyword patch=True")
# A normal that a boundary prescribes is none of a patch.
for normal, contacts in ((Vector3(0, 0, 1), 0), (Vector3.Zero, 1)):
    scene()
    floor = block((0, 0, 0), fixed=True)
    block((0, 0, 2 * HALF - 1e-5))
    floor.shape.isBoundary, floor.shape.fixedNormal, floor.shape.boundaryNormal = True, True, normal
    functor = O.engines[2].geomDispatcher.functors[0]
    O.step()
    check.equal((O.interactions.countReal(), functor.failures), (contacts, 1 - contacts),
                f"fixedNormal, normal {normal}")
    for found in functor.failureReport:
        check.true(all(part in str(found) for part in ("fixedNormal = True", "patch = False")), f"what failed: {found}")
    told = [str(one) for one in potential_particles.check() if "fixedNormal" in str(one)]
    check.true(
        len(told) == 1 - contacts and all("Ig2_ConicPP_ConicPP_ScGeom(patch=True)" in one for one in told),
        f"check() says so: {told}")

# --- the same with ConicInteractionLoop and after a save ----------------------------------------------------------


def falling(loop, saved=False):
    scene(gravity=(0, 0, -9.81), loop=loop, restitution=0.5, damping=0.1)
    wall()
    for number in range(3):
        block((0.03 * number, 0.02 * number, HALF + 1.01 * number), turned((1, 2, 0.5), 0.02 * number), r=0.02)
    O.dt = 5e-5
    run(600)
    if saved:
        O.saveTmp("joint")
        O.loadTmp("joint")
        potential_particles.prepare()
    run(600)
    return state_numbers()


plain_loop = falling(yade.InteractionLoop)
check.equal(falling(yade.ConicInteractionLoop), plain_loop, "ConicInteractionLoop")
check.equal(falling(yade.ConicInteractionLoop, saved=True), falling(yade.ConicInteractionLoop, saved=True),
            "saved runs repeat")
check.true(
    max(abs(a - b) for a, b in zip(falling(yade.ConicInteractionLoop, saved=True), plain_loop)) < 1e-6,
    "a saved run goes on")

# --- bodies that touch, and overlap by nothing but rounding -----------------------------------------------------------

for patch, physics, law in ((True, yade.Ip2_ConicJointMat_ConicJointMat_ConicJointPhys(),
                             yade.Law2_ScGeomConicPP_ConicJointPhys()),
                            (False, yade.Ip2_FrictMat_FrictMat_KnKsPhys(kn_i=1e9, ks_i=1e9, Knormal=1e9,
                                                                        Kshear=1e9), yade.Law2_SCG_KnKsPhys_KnKsLaw())):
    touching = yade.Ig2_ConicPP_ConicPP_ScGeom(patch=patch, calContactArea=True, flatRegularisation=1e-3)
    fresh_scene(touching, physics, law, dt=1e-6)
    if patch:
        O.materials.append(yade.ConicJointMat(normalStiffness=1e9, density=2000.0))
    for size, height in (((40, 4, 1), -0.5), ((1, 1, 1), 0.5)):
        corners = [(0.5 * x * size[0], 0.5 * y * size[1], 0.5 * z * size[2]) for x in (-1, 1) for y in (-1, 1)
                   for z in (-1, 1)]
        O.bodies.append(
            potential_particles.body(shapes.from_vertices(corners, rounding=1e-3, k=0.0), position=(0, 0, height),
                                     fixed=True))
    run(3)
    check.equal(touching.failures, 0, f"no failure where bodies just touch, patch={patch}: {touching.failureReport}")
    check.close(O.forces.f(1), Vector3.Zero, 1e-6, "and no force")

# --- in the place of another law --------------------------------------------------------------------------------------

fresh_scene(yade.Ig2_ConicPP_ConicPP_ScGeom(), yade.Ip2_FrictMat_FrictMat_FrictPhys(),
            yade.Law2_ScGeom_FrictPhys_CundallStrack(sphericalBodies=False), dt=1e-6)
lower, upper = (O.bodies[add(cube(r=1e-3, k=0.0), Vector3(0, 0, height), fixed=True)] for height in (0, 1 - 1e-5))
potential_particles.use_joints(normalStiffness=1e9, restitution=0.5)
O.step()
found = O.interactions[0, 1]
check.true(
    isinstance(found.phys, yade.ConicJointPhys) and isinstance(lower.mat, yade.ConicJointMat),
    "use_joints gives bodies and contacts joints")
check.close(found.phys.normalForce[2], 1e9 * 0.998**2 * 1e-5, 10, "with the stiffness that it is given")
check.equal((lower.mat.density, lower.mat.young, lower.mat.frictionAngle, lower.mat.restitution),
            (2000.0, 1e7, 0.0, 0.5), "and what the material had")
check.raises(ValueError, potential_particles.use_joints, "contacts of another law", "before the first step")
O.reset()
check.raises(ValueError, potential_particles.use_joints, "no engines", "set O.engines first")
fresh_scene(yade.Ig2_ConicPP_ConicPP_ScGeom())
O.materials.append(yade.ElastMat())
O.bodies.append(utils.sphere((0, 0, 0), 1, material=O.materials[1]))
check.raises(ValueError, potential_particles.use_joints, "another material", "ElastMat")


# What is not finite is refused where it enters, from scripts and from files.
nan = float("nan")
for name, value in [("twist", nan), ("shearDisplacement", (nan, 0, 0)), ("bondPoint1", (0, nan, 0)),
                    ("bondTurn1", Quaternion(nan, 0, 0, 0)), ("bondRim", [1.0, float("inf")]),
                    ("normalStiffness", float("inf"))]:
    check.raises(ValueError, lambda: yade.ConicJointPhys(**{name: value}), name, f"ConicJointPhys: {name} = ")
    check.raises(ValueError, lambda: setattr(yade.ConicJointPhys(), name, value), name, "it must be finite")
check.finish()
