# SPDX-License-Identifier: GPL-3.0-or-later
# to_lammps: what the files hold, and what is refused. That LAMMPS goes on from them as YADE does is in tests/lammps.
import math
import tempfile
from pathlib import Path

import potential_particles
import yade
from harness import *
from potential_particles import shapes

check = Checks()
folder = Path(tempfile.mkdtemp())
law = dict(normal_stiffness=1e5, shear_stiffness=5e4, friction=0.4)

O.reset()
check.raises(ValueError, lambda: potential_particles.to_lammps(folder / "none", **law), "no bodies", "no potential particle")
O.materials.append(yade.FrictMat(density=2600))
brick, ball = shapes.cuboid((0.1, 0.08, 0.06)), shapes.sphere(0.05)
O.bodies.append(potential_particles.body(brick, position=(0.1, 0.2, 0.3), velocity=(1, 2, 3), angular_velocity=(4, 5, 6)))
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
rows = {title: data[data.index(title) + 2:data.index(title) + 6] for title in ("Atoms # sphere", "Velocities", "orientation")}
check.equal(rows["Atoms # sphere"][0].split()[1:2] + rows["Atoms # sphere"][0].split()[4:], ["1", "0.1", "0.2", "0.3"], "type and position")
check.equal([row.split()[1] for row in rows["Atoms # sphere"]], ["1", "2", "3", "1"], "types")
check.equal(rows["Velocities"][0], "1 1.0 2.0 3.0 4.0 5.0 6.0", "velocities")
check.equal([round(float(x), 12) for x in rows["orientation"][3].split()[1:]], [0.5] * 4, "orientation")
commands = paths[2].read_text()
for text in ("plane 0.0 0.0 -0.5 0 0 1", "stl scene.stl", "group free type 1 2\n", "gravity 9.81 vector 0.0 0.0 -9.81", "timestep 2e-05", "pair_coeff * * 100000.0 50000.0 0.4 0.5"):
    check.true(text in commands, f"{text!r} in {commands}")

check.raises(ValueError, lambda: potential_particles.to_lammps(folder / "x", 1e5, 1e5, -1), "friction", "friction=-1")
check.raises(ValueError, lambda: potential_particles.to_lammps(folder / "x", 0, 1e5, 1), "stiffness", "normal_stiffness")
check.raises(ValueError, lambda: potential_particles.to_lammps(folder / "x", 1e5, 1e5, 1, restitution=2), "restitution", "restitution=2")
check.raises(ValueError, lambda: potential_particles.to_lammps(folder / "x"), "no law", "normal_stiffness, shear_stiffness and friction are needed")

# The law of joints comes from the materials: harmonic means, smaller values, no bonds of walls.
stone = O.materials[O.materials.append(yade.ConicJointMat(normalStiffness=1e9, shearStiffness=4e8, frictionAngle=0.5, restitution=0.5, cohesion=2e4, tensileStrength=1e4, softening=1e-5, density=2600))]
other = O.materials[O.materials.append(yade.ConicJointMat(normalStiffness=3e9, shearStiffness=4e8, frictionAngle=0.4, restitution=0.7, cohesion=1e4, residualCohesion=5, density=2600))]
for body in O.bodies:
    body.mat = other if body.id == 1 else stone
O.engines = [yade.InteractionLoop([yade.Ig2_ConicPP_ConicPP_ScGeom(patch=True, patchTolerance=1e-5)], [yade.Ip2_ConicJointMat_ConicJointMat_ConicJointPhys(bonds=True)],
                                  [yade.Law2_ScGeomConicPP_ConicJointPhys()])]
commands = potential_particles.to_lammps(folder / "joints")[2].read_text()
for text in ("pair_style potential/particle patch 1e-05 whole 1 bonds yes", f"pair_coeff 1 2 1500000000.0 400000000.0 {math.tan(0.4)!r} 0.5 cohesion 10000.0\n",
             f"pair_coeff 1 1 1000000000.0 400000000.0 {math.tan(0.5)!r} 0.5 cohesion 20000.0 tension 10000.0 softening 1e-05\n",
             "group at_walls1 type 1 3\n", "group at_walls2 type 2\n", f"{math.tan(0.4)!r} 0.5 cohesion 10000.0 plane 0.0 0.0 -0.5 0 0 1 patch 1e-05 whole 1"):
    check.true(text in commands, f"{text!r} in {commands}")
check.raises(ValueError, lambda: potential_particles.to_lammps(folder / "x", **law), "stiffness of joints", "leave normal_stiffness")
O.bodies.append(yade.utils.sphere((3, 0, 0), 0.1))
check.raises(ValueError, lambda: potential_particles.to_lammps(folder / "x"), "a sphere", "body 6 is a Sphere")
check.finish()
