# SPDX-License-Identifier: GPL-3.0-or-later
# Rock masses in YADE: blocks as bodies, joints as surfaces, loads, excavation. Key blocks: test_key_blocks.py; slicing,
# files, water: python/tests/test_rock.py.
import os
import tempfile

import numpy as np
import potential_particles
import yade
from harness import *
from potential_particles import rock
from pathlib import Path

check = Checks()
# Files are written here, also where the script is run by hand.
os.chdir(tempfile.mkdtemp())
Domain = rock.Domain
cube = Domain.box((-1, -1, -1), (1, 1, 1))


def start(**material):
    O.reset()
    O.materials.append(
        yade.ConicJointMat(**{**dict(young=1e9, poisson=0.3, frictionAngle=0.5, density=2000.0), **material}))
    O.engines = [
        yade.ForceResetter(),
        yade.InsertionSortCollider([yade.PotentialParticle2AABB()], verletDist=0, avoidSelfInteractionMask=2),
        yade.ConicInteractionLoop([yade.Ig2_ConicPP_ConicPP_ScGeom(patch=True)],
                                  [yade.Ip2_ConicJointMat_ConicJointMat_ConicJointPhys()],
                                  [yade.Law2_ScGeomConicPP_ConicJointPhys()]),
        yade.NewtonIntegrator(damping=0.3, gravity=(0, 0, -9.81), exactAsphericalRot=True)
    ]


# A slope, a box less the prism before its face.
slope = Domain.box((0, 0, 0), (20, 10, 8)).below((18, 0, 0), 60, 90)
sets = [
    rock.JointSet(35, 90, 2.0, seed=1),
    rock.JointSet(80, 265, 3.0, exponential=True, fisher=100, seed=2),
    rock.JointSet(85, 0, 2.5, seed=3),
    rock.JointSet(50, 20, 4.0, radius=2.0, seed=4)
]
mass = rock.slice(slope, sets, progress=False)
volume = 10 * (20 * 8 - 2 * 8 - 0.5 * 8 * 8 / math.tan(math.radians(60)))
few = rock.slice(slope, sets[:3], least_volume=2.0, least_thickness=0.1, progress=False)
# Joints as surfaces: one block is lifted by a millimetre, shifted by two across its base, and turned about the normal
# there.
start()
two = rock.slice(cube, [rock.joint((0, 0, 0), 0, 0)], progress=False)
ids = rock.bodies(two, rounding=0.01)
upper = O.bodies[int(ids[int(two[1].centroid[2] > 0)])]
upper.state.pos += Vector3(0.002, 0, 0.001)
upper.state.ori = Quaternion((0, 0, 1), 0.3) * upper.state.ori
table = rock.joint_table(two, ids)
check.equal((len(table), int(table["joint"][0]), int(table["set"][0])), (1, 0, 0), "one joint")
check.close(table["opening"][0], 0.001, 1e-12, "its opening")
check.close(table["slip"][0], 0.002, 1e-12, "its slip")
check.close(table["area"][0], 4.0, 1e-12, "its area")
record = rock.JointRecorder(two, ids, "out/cube")
record()
from potential_particles.output import vtk_files
frame = vtk_files.read(f"out/cube.joints.{O.iter:07d}.vtp")
check.true(
    len(frame["triangles"]) == 2 and Path("out/cube.joints.pvd").exists() and abs(frame["opening"][0] - 0.001) < 1e-12,
    "its surface for ParaView")
O.bodies.erase(int(ids[0]))
check.equal(len(rock.joint_table(two, ids)), 0, "a block that is gone")
notched = rock.slice(cube.without(Domain.box((-0.2, -2, 0), (0.2, 2, 2))), [], progress=False)

for text, action in (("rounding=0.7", lambda: rock.bodies(mass, rounding=0.7)),
                     ("fixed must be numbers from 0", lambda: rock.bodies(mass, fixed=[99999])),
                     ("loads must be (2, 6)", lambda: rock.apply_loads([0, 1], [[0] * 6])),
                     ("array of bool", lambda: rock.excavate(mass.on_domain(0))),
                     ("slow=-1", lambda: rock.excavate([], slow=-1))):
    check.raises(ValueError, action, text, text)

# Bodies: where the blocks are, with their mass, and the inertia that the library finds for the shape by itself.
start()
ids = rock.bodies(few, rounding=0.01, fixed=few.on_domain(Domain.BOTTOM))
check.close(
    sum(O.bodies[int(i)].state.mass for i in ids) / (2000 * volume), 1.0, 1e-12, "masses sum to that of the domain")
for number in (0, 5, 11):
    body, block = O.bodies[int(ids[number])], few[number]
    found, _, inertia, _ = body.shape.massProperties(1e-5)
    check.true(0.98 < found / block.volume <= 1.0,
               f"the particle is the block but for its edges: {found / block.volume}")
    check.close(
        np.abs(np.array([inertia[i, i] for i in range(3)]) * 2000 / np.array(body.state.inertia) - 1).max(), 0.0, 0.04,
        "inertia")
    turn = np.array(body.state.ori.toRotationMatrix())
    check.close(
        np.abs(turn @ np.diag(np.array(body.state.inertia)) @ turn.T / 2000 - block.inertia).max()
        / block.inertia.max(), 0.0, 1e-9, "in its axes")
    planes = np.array(body.shape.planes)
    moved = planes[:, :3] @ turn.T
    check.close(np.abs(moved - block.planes[:, :3]).max(), 0.0, 1e-12, "its faces")
    check.close(
        np.abs(planes[:, 3] + body.shape.r + moved @ np.array(body.state.pos) - block.planes[:, 3]).max(), 0.0, 1e-9,
        "lie where they were cut")
check.equal([set(O.bodies[int(i)].state.blockedDOFs) == set("xyzXYZ") for i in ids],
            few.on_domain(Domain.BOTTOM).tolist(), "fixed ones")
# Neighbours touch, and nothing overlaps by more than that.
O.dt = 1e-9
run(1)
depths = [i.geom.penetrationDepth for i in O.interactions if i.isReal]
check.true(0 < min(depths) and max(depths) < 1e-9, f"blocks touch and do not overlap: {max(depths)}")
owners = few.faces["block"].astype(int)[few.partners["faces"].astype(int)]
still = few.on_domain(Domain.BOTTOM)
pairs = [(tuple(sorted((int(ids[a]), int(ids[b])))), area) for (a, b), area in zip(owners, few.partners["area"])
         if not (still[a] and still[b])]
found = {tuple(sorted((i.id1, i.id2))) for i in O.interactions if i.isReal}
# Of faces that share little, rounded edges may be apart.
check.true({pair for pair, area in pairs if area > 0.05} <= found, "partners are contacts")
check.equal(found - {pair for pair, _ in pairs}, set(), "and no others")
# Pieces of a block are a clump of its mass and inertia.
start()
ids = rock.bodies(notched, rounding=0.01)
clumps = [body for body in O.bodies if body.isClump]
check.equal(len(clumps), 1, "one clump")
removed = 2000 * 0.4 * 2 * 1
check.close(clumps[0].state.mass, 16000 - removed, 1e-4, "its mass")
centre = -removed * 0.5 / (16000 - removed)
check.close(clumps[0].state.pos, Vector3(0, 0, centre), 1e-9, "its centre")
about_y = 16000 * (8 / 12 + centre**2) - removed * ((0.16 + 1) / 12 + (0.5 - centre)**2)
turn = np.array(clumps[0].state.ori.toRotationMatrix())
moments = turn @ np.diag(np.array(clumps[0].state.inertia)) @ turn.T
check.close(moments[1, 1] / about_y, 1.0, 1e-9, "its inertia, by Steiner")
start()
rock.bodies(notched, fixed=[0])
check.equal([body.isClumpMember for body in O.bodies], [False] * 3, "where one piece is fixed all are")

# Joints by set: of two blocks on fixed ones, on planes of 35 degrees, the one whose set has less friction slides.
ramp = Domain.box((0, 0, 0), (4, 4, 4))
two = rock.slice(ramp, [rock.joint((2, 2, 1.9), 35, 90), rock.joint((2, 2, 2), 90, 0)], progress=False)
start(normalStiffness=1e9, shearStiffness=1e9, frictionAngle=1.2, restitution=0.1)
O.engines[-1].damping = 0.0
upper = two.blocks["centroid"][:, 2] > 1.9
ids = rock.bodies(two, rounding=0.01, fixed=~upper)
O.engines = O.engines[:3] + [
    rock.joint_engine(
        two, ids, {
            0: yade.ConicJointMat(frictionAngle=0.35, cohesion=7.0, residualCohesion=7.0),
            1: yade.ConicJointMat(frictionAngle=0.0)
        })
] + O.engines[3:]
O.dt = potential_particles.critical_time_step()
# The stiffness that it gives counts for contacts that are not there yet: against twice that of the bodies, which a
# rigid neighbour would give.
for stiffness, ratio in ((dict(normalStiffness=1.0), 1.0), (dict(normalStiffness=8e11), 20.0),
                         (dict(shearStiffness=8e11), 20.0)):
    O.engines = [
        *O.engines[:3],
        rock.joint_engine(two, ids, {0: yade.ConicJointMat(**stiffness), 1: yade.ConicJointMat()}), O.engines[-1]
    ]
    check.close(O.dt / potential_particles.critical_time_step() / ratio, 1.0, 1e-9, f"a joint with {stiffness}")
O.materials[0].shearStiffness = 100e9
O.engines = [*O.engines[:3], O.engines[-1]]
check.close(O.dt / potential_particles.critical_time_step(), 10.0, 1e-9, "a joint that is stiffer in shear")
O.materials[0].shearStiffness = 1e9
O.engines = [
    *O.engines[:3],
    rock.joint_engine(
        two, ids, {
            0: yade.ConicJointMat(frictionAngle=0.35, cohesion=7.0, residualCohesion=7.0),
            1: yade.ConicJointMat(frictionAngle=0.0)
        }), O.engines[-1]
]
run(2)
physics = [i.phys for i in O.interactions if i.isReal]
check.true({
    round(p.tangensOfFrictionAngle, 9)
    for p in physics
} == {round(math.tan(0.35), 9), 0.0} and {
    p.cohesion
    for p in physics
} >= {
    7.0
}, f"each contact has its set's: {[(i.id1, i.id2, i.phys.tangensOfFrictionAngle, i.phys.cohesion, i.iterMadeReal) for i in O.interactions if i.isReal]}"
           )
run(int(0.3 / O.dt))
slides = [O.bodies[int(i)].state.pos[0] - c[0] for i, c in zip(ids[upper], two.blocks["centroid"][upper])]
acceleration = 9.81 * (math.sin(math.radians(35)) - math.tan(0.35) * math.cos(math.radians(35)))
way = 0.5 * acceleration * math.cos(math.radians(35)) * O.time**2
check.true(all(abs(one / way - 1) < 0.02 for one in slides), f"they slide as their friction says: {slides}, {way}")
check.raises(ValueError, lambda: rock.joint_engine(two, ids, {0: 3}), "no material", "give a ConicJointMat")
degrees = yade.ConicJointMat()
degrees.frictionAngle = 30
for material in (degrees, yade.FrictMat(frictionAngle=30)):
    check.raises(ValueError, lambda: rock.joint_engine(two, ids, {0: material}), "degrees",
                 "frictionAngle of materials[0] = 30: give radians in [0, pi/2)")
check.true(
    type(ids[0]) is int and all(type(one) is int for one in ids) and O.bodies[ids[0]].id == ids[0]
    and ids[upper].tolist() == [one for one, is_upper in zip(ids, upper) if is_upper],
    "one id is an int, which O.bodies takes")
check.close(np.arange(len(ids))[ids].sum(), len(ids) * (len(ids) - 1) // 2, 0, "many are an array of numbers")
# What a script has made of the joints that there are stays, in this run and in one that loads it.
run(1)
for contact in O.interactions:
    if contact.isReal:
        contact.phys.tangensOfFrictionAngle *= 0.5
frictions = lambda: {(i.id1, i.id2): (i.phys.tangensOfFrictionAngle, i.phys.cohesion)
                     for i in O.interactions if i.isReal}
reduced = frictions()
# Nothing presses the two that slide on each other: their own joint, without friction, may have opened.
on_ramp = {(int(ids[0]), int(ids[2])), (int(ids[1]), int(ids[3]))}
check.true(on_ramp <= set(reduced), f"joints: {reduced}")
O.save("reduced.yade.gz")
run(1)
check.equal(frictions(), reduced, "joints keep what a script gave them")
O.load("reduced.yade.gz")
run(1)
check.equal(frictions(), reduced, "and do so after loading")
# Saved and loaded, as in another process, the engine goes on: contacts that are made anew have the friction of their
# set.
O.save("joints.yade.gz")
O.load("joints.yade.gz")
potential_particles.joints._tables.clear()
O.interactions.clear()
for number in ids[upper]:
    O.bodies[int(number)].state.vel = Vector3.Zero
    O.bodies[int(number)].state.pos -= Vector3(0, 0, 1e-4)
run(3)
north = two.blocks["centroid"][:, 1] > 2
columns = [set(ids[north].tolist()), set(ids[~north].tolist())]
check.equal({round(i.phys.tangensOfFrictionAngle, 9)
             for i in O.interactions if i.isReal and {i.id1, i.id2} in columns}, {round(math.tan(0.35), 9)},
            "after loading")

# Loads on a clump of pieces.
start()
ids = rock.bodies(notched, rounding=0.01)
rock.apply_loads(ids, rock.face_pressure(notched, notched.faces_on(Domain.EAST), 100.0))
clump = next(body for body in O.bodies if body.isClump)
O.engines[-1].gravity, O.engines[-1].damping, O.dt = (0, 0, 0), 0.0, 1e-6
run(1)
check.close(clump.state.vel * clump.state.mass / O.dt, Vector3(-100 * 4, 0, 0), 1e-6, "on a clump: its force")
check.close(clump.state.angMom / O.dt, Vector3(0, 400 * centre, 0), 1e-6, "and torque")

# Excavation: the lower of two blocks is taken out, the upper one falls.
column = rock.slice(Domain.box((0, 0, 0), (1, 1, 3)), [rock.joint((0, 0, 1), 0, 0)],
                    regions=[Domain.box((-1, -1, 1), (2, 2, 2))], progress=False)
start()
ids = rock.bodies(column, rounding=0.01, fixed=column.on_domain(Domain.BOTTOM))
O.dt = 1e-4
top = O.bodies[int(ids[column.blocks["centroid"][:, 2] > 2][0])]
run(500)
check.close(top.state.pos[2], 2.5, 1e-3, "it rests")
check.equal(rock.excavate(ids[column.inside(0)], settle=1000), 1000, "and is undermined")
check.true(len([body for body in O.bodies if body]) == 2 and top.state.pos[2] < 2.49, f"it falls: {top.state.pos[2]}")
check.equal(rock.excavate(ids[column.inside(0)]), 0, "once more: nothing is left to take out")
for text, given in (("ids holds 999: there is no such body", [ids[0], 999]), ("ids holds -1", -1),
                    ("ids holds 0.5: an id is a whole number", [0.5])):
    check.raises(ValueError, lambda: rock.excavate(given), text, text)
check.equal(len([body for body in O.bodies if body]), 2, "and nothing was taken out")
check.finish()
