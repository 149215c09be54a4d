# SPDX-License-Identifier: GPL-3.0-or-later
# to_lammps: what the files hold, and what is refused. That LAMMPS goes on from them as YADE does is in tests/lammps.
import math
import tempfile
import warnings
from pathlib import Path

import potential_particles
import yade
from harness import *
from potential_particles import rock, shapes

check = Checks()
folder = Path(tempfile.mkdtemp())
law = dict(normal_stiffness=1e5, shear_stiffness=5e4, friction=0.4)

O.reset()
check.raises(ValueError, lambda: potential_particles.to_lammps(folder / "none", **law), "no bodies",
             "no potential particle")
O.materials.append(yade.FrictMat(density=2600))
brick, ball = shapes.cuboid((0.1, 0.08, 0.06)), shapes.sphere(0.05)
O.bodies.append(
    potential_particles.body(brick, position=(0.1, 0.2, 0.3), velocity=(1, 2, 3), angular_velocity=(4, 5, 6)))
O.bodies.append(potential_particles.body(ball, position=(0.4, 0, 0)))
O.bodies.append(potential_particles.body(brick, position=(0.8, 0, 0), fixed=True))
O.bodies.append(potential_particles.body(brick, position=(1.2, 0, 0), orientation=(0.5, 0.5, 0.5, 0.5)))
O.bodies.append(yade.utils.wall(-0.5, axis=2))
O.bodies.append(yade.utils.facet([(0, 0, -0.2), (1, 0, -0.2), (0, 1, -0.2)]))
O.engines = [yade.NewtonIntegrator(gravity=(0, 0, -9.81))]
O.dt = 2e-5
paths = potential_particles.to_lammps(folder / "scene", **law, restitution=0.5)
check.equal([path.name for path in paths], ["scene.shapes", "scene.data", "scene.lmp", "scene.stl"], "files")
names = [line for line in paths[0].read_text().splitlines() if line.startswith("shape")]
check.equal(len(names), 3, "a brick that moves, a ball, and a brick that does not")
data = paths[1].read_text().splitlines()
rows = {
    title: data[data.index(title) + 2:data.index(title) + 6]
    for title in ("Atoms # sphere", "Velocities", "orientation")
}
check.equal(rows["Atoms # sphere"][0].split()[1:2] + rows["Atoms # sphere"][0].split()[4:], ["1", "0.1", "0.2", "0.3"],
            "type and position")
check.equal([row.split()[1] for row in rows["Atoms # sphere"]], ["1", "2", "3", "1"], "types")
check.equal(rows["Velocities"][0], "1 1.0 2.0 3.0 4.0 5.0 6.0", "velocities")
check.equal([round(float(x), 12) for x in rows["orientation"][3].split()[1:]], [0.5] * 4, "orientation")
commands = paths[2].read_text()
for text in ("plane 0.0 0.0 -0.5 0 0 1", "stl scene.stl", "group free type 1 2\n", "gravity 9.81 vector 0.0 0.0 -9.81",
             "timestep 2e-05", "pair_coeff * * 100000.0 50000.0 0.4 0.5"):
    check.true(text in commands, f"{text!r} in {commands}")

check.raises(ValueError, lambda: potential_particles.to_lammps(folder / "x", 1e5, 1e5, -1), "friction", "friction=-1")
check.raises(ValueError, lambda: potential_particles.to_lammps(folder / "x", 0, 1e5, 1), "stiffness",
             "normal_stiffness")
check.raises(ValueError, lambda: potential_particles.to_lammps(folder / "x", 1e5, 1e5, 1, restitution=2), "restitution",
             "restitution=2")
check.raises(ValueError, lambda: potential_particles.to_lammps(folder / "x"), "no law",
             "normal_stiffness, shear_stiffness and friction are needed")

# The law of joints comes from the materials: harmonic means, smaller values, no bonds of walls.
stone = O.materials[O.materials.append(
    yade.ConicJointMat(normalStiffness=1e9, shearStiffness=4e8, frictionAngle=0.5, restitution=0.5, cohesion=2e4,
                       tensileStrength=1e4, softening=1e-5, density=2600))]
other = O.materials[O.materials.append(
    yade.ConicJointMat(normalStiffness=3e9, shearStiffness=4e8, frictionAngle=0.4, restitution=0.7, cohesion=1e4,
                       residualCohesion=5, density=2600))]
for body in O.bodies:
    body.mat = other if body.id == 1 else stone
O.engines = [
    yade.InteractionLoop([yade.Ig2_ConicPP_ConicPP_ScGeom(patch=True, patchTolerance=1e-5)],
                         [yade.Ip2_ConicJointMat_ConicJointMat_ConicJointPhys(bonds=True)],
                         [yade.Law2_ScGeomConicPP_ConicJointPhys()])
]
commands = potential_particles.to_lammps(folder / "joints")[2].read_text()
for text in (
        "pair_style potential/particle patch 1e-05 whole 1 bonds yes",
        f"pair_coeff 1 2 1500000000.0 400000000.0 {math.tan(0.4)!r} 0.5 cohesion 10000.0\n",
        f"pair_coeff 1 1 1000000000.0 400000000.0 {math.tan(0.5)!r} 0.5 cohesion 20000.0 tension 10000.0 softening 1e-05\n",
        "group at_walls1 type 1 3\n", "group at_walls2 type 2\n",
        f"{math.tan(0.4)!r} 0.5 cohesion 10000.0 plane 0.0 0.0 -0.5 0 0 1 patch 1e-05 whole 1"):
    check.true(text in commands, f"{text!r} in {commands}")
check.raises(ValueError, lambda: potential_particles.to_lammps(folder / "x", **law), "stiffness of joints",
             "leave normal_stiffness")
O.bodies.append(yade.utils.sphere((3, 0, 0), 0.1))
check.raises(ValueError, lambda: potential_particles.to_lammps(folder / "x"), "a sphere", "body 6 is a Sphere")

# --- bonds of a scene that has stepped --------------------------------------------------------------------------------

def column(number=3, bonds=True, gravity=0.0, **material):
    """Blocks on each other, the lowest held."""
    O.reset()
    joint_scene(
        yade.InteractionLoop,
        yade.ConicJointMat(
            **{
                **dict(normalStiffness=1e9, shearStiffness=4e8, frictionAngle=0.5, density=2600, cohesion=1e6,
           tensileStrength=1e6),
                **material
            }), 0.0, (0, 0, -gravity), False, 1e-5, bonds=bonds)
    for i in range(number):
        O.bodies.append(
            potential_particles.body(shapes.cuboid((0.2, 0.2, 0.2), rounding=0.01, k=0),
                                     position=(0, 0, (0.2 - 1e-6) * i), fixed=i == 0))


def written(*lines):
    """Lines of the script that begin so, and what was warned of."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        text = potential_particles.to_lammps(folder / "later")[2].read_text()
    return [line for line in text.splitlines() if line.startswith(lines)], [str(one.message) for one in caught]


def refused(containing, text):
    check.raises(ValueError, lambda: potential_particles.to_lammps(folder / "later"), text, containing)


style = lambda: (written("pair_style")[0], written("pair_style")[1])
new = "pair_style potential/particle patch 0.0001 "
column()
check.equal(style(), ([new + "whole 1 bonds yes"], []), "before the first step")
O.run(10, True)
check.equal(style(), ([new + "whole 1 bonds yes"], []), "bonds as they were made")
joint = O.interactions[1, 2].phys
joint.damage = 0.25
refused(
    "the scene has 2 bonds in 2 joints, and LAMMPS begins with new ones, all alike: 1 bond is damaged, and would not be (1 and 2). Convert",
    "damage")
joint.damage = 0.0
O.bodies[2].state.pos += Vector3(0, 0, 2e-6)
refused("1 bond has opened at an edge", "a bond in tension")
O.bodies[2].state.pos -= Vector3(0, 0, 2e-6)
O.bodies[2].state.ori = turned((1, 0, 0), 1.5e-5)
refused("1 bond has opened at an edge", "a bond that bends: 1.5e-6 at 0.1 from its middle, and 1e-6 overlap")
O.bodies[2].state.ori = turned((1, 0, 0), 0.5e-5)
check.equal(style()[0], [new + "whole 1 bonds yes"], "a bond that bends less")
O.bodies[2].state.ori = Quaternion.Identity
joint.bonded, joint.broken = False, True
refused(
    "the scene has 1 bond in 2 joints, and LAMMPS begins with new ones, all alike: 1 joint has broken, and would be whole (1 and 2)",
    "a broken joint")
O.interactions[0, 1].phys.bonded, O.interactions[0, 1].phys.broken = False, True
check.equal(style(), ([new + "whole 0 bonds yes"], []), "all joints have broken")
column(gravity=9.81)
for body in O.bodies:
    body.state.pos, body.state.ori = Vector3(body.state.pos[2], 0, 0), turned((0, 1, 0), math.pi / 2)
O.run(40, True)
found, told = style()
check.true(
    found == [new + "whole 1 bonds yes"] and len(told) == 1
    and "2 bonds hold shear or twist (0 and 1, 1 and 2), up to" in told[0], f"shear of a beam: {found}, {told}")
column(bonds=False)
O.run(2, True)
check.equal(style(), ([new + "whole 1"], []), "joints with cohesion stay whole")
potential_particles.bond_contacts([1, 2])
refused("1 joint has no bond, and would have one (0 and 1)", "some bonds")
potential_particles.bond_contacts()
check.equal(style(), ([new + "whole 1 bonds yes"], []), "bonds by bond_contacts()")
O.run(2, True)
check.equal(style(), ([new + "whole 1 bonds yes"], []), "and once they are made")
column(bonds=False, cohesion=0.0, tensileStrength=0.0)
O.run(2, True)
check.equal(style(), ([new + "whole 0"], []), "whole and broken are the same without strength")
O.interactions[0, 1].phys.tangensOfFrictionAngle = 0.2
refused(
    "1 joint has other numbers than materials and joint_engine give (tangensOfFrictionAngle of 0 and 1 is 0.2, and 0.546302 by their materials)",
    "what a script changed")

# --- what LAMMPS takes from rock.joint_engine, and of motions and forces
# ------------------------------------------------

column()
mass = rock.slice(rock.Domain.box((0, 0, 0), (1, 1, 3)), [rock.joint(
    (0, 0, 1), 0, 0), rock.joint((0, 0, 2), 0, 0)], progress=False)
given = yade.ConicJointMat(normalStiffness=3e9, frictionAngle=0.3, cohesion=5e3, tensileStrength=2e3,
                           residualFrictionAngle=0.1)
O.engines = [*O.engines[:3], rock.joint_engine(mass, [0, 1, 2], {1: given}), *O.engines[3:]]
above = mass.blocks["centroid"][:, 2].argsort().tolist()
pair = {above[1], above[2]}
own, its = f"{math.tan(0.5)!r} 1.0 cohesion 1000000.0 tension 1000000.0 softening 0.0", f"3000000000.0 400000000.0 {math.tan(0.3)!r} 1.0 cohesion 5000.0 residual {math.tan(0.1)!r} 0.0 tension 2000.0 softening 0.0"
for steps in (0, 2):
    O.run(steps, True) if steps else None
    lines, told = written("pair_coeff")
    kinds = {tuple(sorted(map(int, line.split()[1:3]))): line.split(maxsplit=3)[3] for line in lines}
    check.equal(told, [], "nothing is lost")
    check.equal([of for of, words in kinds.items() if words == its], [tuple(sorted(one + 1 for one in pair))],
                f"the joint of a set after {steps} steps: {kinds}")
    check.true(all(words == "1000000000.0 400000000.0 " + own for of, words in kinds.items() if words != its),
               f"and the others: {kinds}")
column()
O.bodies[0].state.vel = (0, 0.5, 0)
O.bodies.append(yade.utils.wall(-0.3, axis=2))
O.bodies.append(yade.utils.wall(0.4, axis=1))
O.bodies[4].state.vel = (0, -0.1, 0)
O.forces.setPermF(2, (1, 2, 3))
lines, told = written("group held", "fix held", "fix walls", "fix loads", "fix push", "read_data")
check.equal(told, [], "nothing is lost")
for text in ("group held1 type 1", "fix held1 held1 move linear 0.0 0.5 0.0",
             "fix loads all property/atom d2_load 3 writedata yes", "fix pushing free addforce v_load1 v_load2 v_load3",
             "read_data later.data fix orientation NULL orientation fix loads NULL loads"):
    check.true(text in lines, f"{text!r} in {lines}")
check.true(
    any(line.startswith("fix walls1 ") and "linear" not in line for line in lines)
    and any(line.startswith("fix walls_moving_a1 ") and "linear 0.0 -0.1 0.0" in line for line in lines),
    f"walls: {lines}")
check.true("\nloads\n\n1 0.0 0.0 0.0\n2 0.0 0.0 0.0\n3 1.0 2.0 3.0\n" in (folder / "later.data").read_text(), "forces")
O.forces.setPermT(2, (0, 0, 1))
refused("body 2 has a lasting torque", "torques")
O.forces.reset(resetAll=True)
O.bodies[0].state.angVel = (0, 0, 1)
refused("body 0 is held and turns with angVel=", "a platen that turns")
O.bodies[0].state.angVel, O.bodies[2].state.blockedDOFs = (0, 0, 0), "xyXYZ"
refused("body 2 has blockedDOFs='xyXYZ': LAMMPS moves a body in all directions or in none", "some directions")
O.bodies[2].state.blockedDOFs = ""
O.engines[-1].damping = 0.3
O.engines = [*O.engines, yade.TranslationEngine(translationAxis=(0, 1, 0), velocity=-0.1, ids=[4])]
told = written()[1]
check.true(
    len(told) == 2 and "NewtonIntegrator(damping=0.3)" in told[0] and "TranslationEngine is not written" in told[1],
    f"damping and engines: {told}")
column()
O.periodic = True
O.cell.setBox(2, 2, 2)
O.cell.velGrad = yade.Matrix3(0, 0.1, 0, 0, 0, 0, 0, 0, 0)
told = written()[1]
check.true(len(told) == 1 and "the periodic cell deforms" in told[0], f"a cell that deforms: {told}")

check.finish()
