# SPDX-License-Identifier: GPL-3.0-or-later
# Scripts of YADE's potential blocks: shapes against closed forms, YADE's potential_utils, stacks that stand,
# boundaries, and BlockGen against sums.
import math
import os
import tempfile

import numpy as np
import potential_particles.potential_blocks
import yade
from harness import *
from pathlib import Path
from potential_particles import rock

check = Checks()
# Files are written here, also where the script is run by hand.
os.chdir(tempfile.mkdtemp())
CUBE = dict(a=[1, -1, 0, 0, 0, 0], b=[0, 0, 1, -1, 0, 0], c=[0, 0, 0, 0, 1, -1])


def block(edges, r=0.01, centre=(0, 0, 0), fixed=False, **more):
    """As scripts of YADE make one, without anything of this package's own."""
    b = Body()
    b.aspherical = True
    b.shape = PotentialBlock(k=0.0, r=r, R=0.0, **CUBE, d=[0.5 * edge - r for edge in edges for _ in range(2)],
                             id=len(O.bodies), AabbMinMax=True, minAabb=Vector3(1, 1, 1), maxAabb=Vector3(1, 1, 1),
                             **{"isBoundary": False, "fixedNormal": False, **more})
    utils._commonBodySetup(b, b.shape.volume, b.shape.inertia, material="stone", pos=[0, 0, 0], fixed=fixed)
    b.state.pos, b.state.ori = Vector3(centre), b.shape.orientation
    return b


def scene(friction=0.6, gravity=(0, 0, -9.81), damping=0.3, **physics):
    O.reset()
    O.materials.append(FrictMat(young=-1, poisson=-1, frictionAngle=friction, density=2000, label="stone"))
    O.engines = [
        ForceResetter(),
        InsertionSortCollider([PotentialBlock2AABB()], verletDist=0),
        InteractionLoop([Ig2_PB_PB_ScGeom(twoDimension=False, unitWidth2D=1.0, calContactArea=True)], [
            Ip2_FrictMat_FrictMat_KnKsPBPhys(
                **{**dict(Knormal=1e8, Kshear=5e7, kn_i=1e8, ks_i=5e7, viscousDamping=0.2), **physics})
        ], [Law2_SCG_KnKsPBPhys_KnKsPBLaw(neverErase=False, allowViscousAttraction=False, traceEnergy=False)]),
        NewtonIntegrator(damping=damping, exactAsphericalRot=True, gravity=gravity)
    ]
    O.dt = 1e-4


# The shape: a cuboid away from its origin and turned, by planes whose normals have no unit length; one of them points
# inwards, one makes no face.
scene()
edges, place, turn = np.array([1.0, 2.0,
                               3.0]), np.array([0.2, -0.3,
                                                0.1]), np.array(Quaternion((1, 2, 3), 0.7).toRotationMatrix())
rows = [(2.0 * sign * turn[:, axis], 0.5 * edges[axis] + sign * turn[:, axis] @ place) for axis in range(3)
        for sign in (1, -1)] + [(turn[:, 0], 50.0)]
normals, heights = np.array([n
                             for n, _ in rows]), np.array([2.0 * h if np.linalg.norm(n) > 1.5 else h for n, h in rows])
normals[1], heights[1] = -normals[1], -heights[1]
shape = PotentialBlock(a=normals[:, 0], b=normals[:, 1], c=normals[:, 2], d=heights - 0.1, r=0.1)
check.close(shape.volume, 6.0, 1e-12, "volume of a cuboid")
check.close(Vector3(*sorted(shape.inertia)), Vector3(6 * 5, 6 * 10, 6 * 13) / 12, 1e-9, "its principal moments")
check.close(shape.position, Vector3(0.2, -0.3, 0.1), 1e-9, "its place")
inertia = np.array(shape.orientation.toRotationMatrix()) @ np.diag(shape.inertia) @ np.array(
    shape.orientation.toRotationMatrix()).T
check.close(np.abs(inertia - turn @ np.diag([6.5, 5.0, 2.5]) @ turn.T).max(), 0.0, 1e-9, "and its axes")
check.equal((len(shape.vertices), len(shape.a), sorted(map(len, shape.connectivity))), (8, 6, [4] * 6),
            "vertices and faces")
outline = np.array(shape.vertices)[shape.connectivity[0]]
check.true(
    np.cross(outline[1] - outline[0], outline[2] - outline[1]) @ [shape.a[0], shape.b[0], shape.c[0]] > 0,
    "counter-clockwise from outside")
cuboid = block((1, 1, 1)).shape
check.true(all(Vector3(x, y, z) in cuboid.vertices for x in (-.5, .5) for y in (-.5, .5) for z in (-.5, .5)),
           "vertices of a cube, to the last digit")
check.equal(cuboid.orientation, Quaternion.Identity, "a cube keeps its axes")
for text, action in (("isBolt=True", lambda: PotentialBlock(isBolt=True)), ("r=0",
                                                                            lambda: PotentialBlock(**CUBE, d=[1] * 6)),
                     ("a, b, c, d have 6, 6, 6, 5", lambda: PotentialBlock(**CUBE, d=[1] * 5, r=1)),
                     ("enclose no volume", lambda: PotentialBlock(a=[1], b=[0], c=[0], d=[1], r=1)),
                     ("useFaceProperties", lambda: Ip2_FrictMat_FrictMat_KnKsPBPhys(useFaceProperties=True))):
    check.raises(ValueError, action, text, text)
check.raises(AttributeError, lambda: PotentialBlock(colour=1), "a name that is none", "colour")

# YADE's own helpers find the class.
from yade import potential_utils as theirs
made = theirs.prism(material=O.materials[0], radius1=1.0, radius2=0.0, thickness=2.0, numFaces=4, r=0.01)
check.true(
    type(made.shape) is PotentialBlock and abs(made.shape.volume - 4 * 2 / 3) < 1e-9, "a prism of potential_utils")
# With a color: without one YADE 2025.2.0 draws a random number from a range of floats, which Python 3.12 and newer
# refuse.
check.equal(len(theirs.aabbPlates(material=O.materials[0], extrema=((0, 0, 0), (1, 1, 1)), r=0.01, color=(1, 0, 0))), 6,
            "its plates")

# A stack stands, with the weight of what is above in each contact: that of the sharp blocks.
O.bodies.append(
    block((4, 4, 1), centre=(0, 0, -0.5), fixed=True, isBoundary=True, fixedNormal=True,
          boundaryNormal=Vector3(0, 0, 1)))
for i in range(4):
    O.bodies.append(block((1, 1, 0.5), centre=(0.05 * (-1)**i, 0, 0.25 + 0.5 * i)))
start = [b.state.pos for b in O.bodies]
run(12000)
for i in range(4):
    check.close(O.interactions[i, i + 1].phys.normalForce.norm() / ((4 - i) * 1000 * 9.81), 1.0, 0.01,
                f"weight above contact {i}")
moved = max((b.state.pos - place).norm() for b, place in zip(O.bodies, start))
check.true(moved < 2e-3 and utils.kineticEnergy() < 1e-5, f"the stack stands: {moved}, {utils.kineticEnergy()}")
check.true(
    isinstance(O.bodies[2].shape, PotentialBlock) and isinstance(O.interactions[1, 2].phys, KnKsPBPhys),
    "classes of the scene")

# kn_i at boundaries alone: the block sinks by m g/(k A) into the plate, and the next one into it by Knormal.
scene(kn_i=4e8, ks_i=1e8, viscousDamping=0.3)
O.bodies.append(block((4, 4, 1), centre=(0, 0, -0.5), fixed=True, isBoundary=True))
for i in range(2):
    O.bodies.append(block((1, 1, 0.5), centre=(0, 0, 0.25 + 0.5 * i)))
run(6000)
first, second = O.interactions[0, 1], O.interactions[1, 2]
check.equal((first.phys.knVol, first.phys.ksVol, second.phys.knVol, second.phys.ksVol), (4e8, 1e8, 1e8, 5e7),
            "stiffnesses")
check.close(first.phys.normalForce.norm() / (4e8 * first.phys.contactArea * first.geom.penetrationDepth), 1.0, 1e-3,
            "force at the boundary")
check.close(first.phys.normalForce.norm() / (2 * 1000 * 9.81), 1.0, 0.01, "is the weight")
check.close(first.phys.phi_b, math.degrees(0.6), 1e-9, "friction angle in degrees")

# Slides down a plane as friction says: g (sin 30 - mu cos 30), and rests with more.
for angle, expected in ((15, 9.81 * (0.5 - math.tan(math.radians(15)) * math.sqrt(0.75))), (35, 0.0)):
    scene(friction=math.radians(angle), gravity=(9.81 * 0.5, 0, -9.81 * math.sqrt(0.75)), damping=0.0)
    O.bodies.append(block((20, 4, 1), centre=(0, 0, -0.5), fixed=True, isBoundary=True))
    O.bodies.append(block((1, 1, 0.5), centre=(-5, 0, 0.25 - 1e-4)))
    run(2000)
    speed = O.bodies[1].state.vel[0]
    run(2000)
    check.close((O.bodies[1].state.vel[0] - speed) / 0.2, expected, 0.05,
                f"acceleration with friction of {angle} degrees")

# BlockGen. Two sets and a table of joints that end; y north, x east have no meaning here.
Path("joints.csv").write_text("dip;dipDir;x;y;z;half;half;phi_b;phi_r;JRC;JCS;asperity;sigmaC;cohesion;tension;type;\n"
                              "90;0;0;0;5;50;50;20;18;0;0;0;0;1000;0;1;joint;\n"
                              "0;0;3;0;5;50;1;30;25;0;0;0;0;0;0;1;joint;\n")
Path("bench.csv").write_text("dip;dipDir;x;y;z\n0;0;0;0;8\n")


def generator(**more):
    p = BlockGen(minSize=0.5, maxRatio=1000.0, density=2500, rForPP=0.05, frictionDeg=40.0, gravity=[0, 0, 9.81],
                 Kn=1e9, Ks=1e8, defaultDt=1e-5)
    p.boundarySizeXmin = p.boundarySizeXmax = 5.0
    p.boundarySizeYmin = p.boundarySizeYmax = 2.0
    p.boundarySizeZmin, p.boundarySizeZmax = 0.0, 10.0
    p.jointProbabilistic, p.filenameProbabilistic = True, "joints.csv"
    for name, value in more.items():
        setattr(p, name, value)
    return p


generator(saveBlockGenData=True, outputFile="told.txt").load()
check.true("3 blocks" in Path("told.txt").read_text(), "what was cut is told")
check.equal([type(one).__name__ for one in O.engines],
            ["ForceResetter", "InsertionSortCollider", "InteractionLoop", "NewtonIntegrator"], "four engines")
check.equal(len(O.bodies), 3, "the rectangle cuts the half that it reaches")
check.close(sum(b.shape.volume for b in O.bodies), 400.0, 1e-9, "volumes")
check.close(sum(b.state.mass for b in O.bodies), 1e6, 1e-6, "masses")
centre = sum((b.state.pos * b.state.mass for b in O.bodies), Vector3.Zero) / 1e6
check.close(centre, Vector3(0, 0, 5), 1e-9, "centre")
check.equal((O.engines[2].physDispatcher.functors[0].kn_i, O.dt, O.engines[3].gravity),
            (1e9, 1e-5, Vector3(0, 0, 9.81)), "attributes")
run(1)
# With boundaries: what lies beyond the plane at z = 8 is fixed, and joints do not cut it.
generator(boundaries=True, filenameBoundaries="bench.csv", saveBlockGenData=True).load()
fixed = [b for b in O.bodies if b.shape.isBoundary]
check.true(
    len(fixed) == 1 and not fixed[0].dynamic and abs(fixed[0].shape.volume - 80) < 1e-9 and len(O.bodies) == 4,
    "a boundary")
# With properties of faces: contacts on the first joint have those of its row, and the second one has those of its own.
generator(useFaceProperties=True, initialOverlap=1e-5, saveBlockGenData=True).load()
O.dt = 1e-9
run(3)
found = sorted((round(i.phys.phi_b, 9), i.phys.cohesion, i.phys.intactRock) for i in O.interactions if i.isReal)
check.equal(found, [(20.0, 1000.0, True), (20.0, 1000.0, True), (30.0, 0.0, False)], "strength by joint")
# minSize and maxRatio as in the paper: the largest ball in the half is 4, its extent 10.
for more, count in (({"minSize": 4.1}, 1), ({"minSize": 3.9}, 3), ({"maxRatio": 2.4}, 1), ({"maxRatio": 2.6}, 3)):
    generator(saveBlockGenData=True, **more).load()
    check.equal(len(O.bodies), count, f"blocks with {more}")
p = generator(jointProbabilistic=False, saveBlockGenData=True)
p.joint_a, p.joint_b, p.joint_c, p.joint_d = [0, 0], [0, 0], [2, 1], [8, 6]
p.load()
check.equal(sorted(round(b.shape.volume, 9) for b in O.bodies), [80.0, 160.0, 160.0], "joints given in the script")
# YADE's checkBlockGen expects 6 blocks of 32 faces and 38 corners: those of the three joints that BlockGen reads from a
# table whose rows end without a separator (docs/converting.md).
Path("shifted.csv").write_text(
    "dip;dipDir;x;y;z;half;half\n90;315;0;0;0;10000;10000\n40;40;0;0;0;10000;787000\n40;0;0;0;0;787000;76000\n")
shifted = rock.slice(rock.Domain.box((-20, -20, 0), (20, 20, 40)), rock.read_blockgen("shifted.csv", "probabilistic"),
                     least_width=7.0, progress=False)
# The first joint passes through edges of the box: faces and corners are counted but for rounding.
corners = sum(len(np.unique(np.round(shifted[one].corners, 6) + 0.0, axis=0)) for one in range(len(shifted)))
check.equal((len(shifted), int((shifted.faces["area"] > 1e-6).sum()), corners), (6, 32, 38),
            "the blocks, faces and corners of YADE's checkBlockGen")
check.raises(AttributeError, lambda: BlockGen(minsize=3), "a name that is none", "BlockGen has no attribute minsize")
check.raises(ValueError, lambda: generator(slopeFace=True).load(), "slopeFace", "slopeFace=True is not served")
check.raises(ValueError, lambda: generator(directionA=(1, 1, 0)).load(), "directions", "directionA=(1, 1, 0)")
check.raises(FileNotFoundError, lambda: generator(filenameProbabilistic="none.csv").load(), "a file that is not there",
             "none.csv")

check.finish()
