# SPDX-License-Identifier: GPL-2.0-or-later
"""Scenes for LAMMPS as text, run in a process of their own, and what they dump."""
import os
import subprocess
from pathlib import Path

import numpy as np
from potential_particles_lammps import Particle, polyhedron, write_shapes
from potential_particles_lammps.pictures import QUATERNION, frames

TOP = Path(__file__).resolve().parents[2]
SECONDS = 120
DENSITY, STIFFNESS, SHEAR, FRICTION, DT = 2600.0, 1e5, 6e4, 0.4, 1e-4

# What stands in a script in the place of {name}.
DEFAULTS = {
    "units": "units si", "atom": "atom_style sphere", "newton": "newton off", "velocities": "comm_modify vel yes", "boundary": "f f f",
    "shapes": "fix shapes all potential/particle/shapes shapes.txt type 1 pyramid 2600 type 2 cuboid 2600",
    "style": "pair_style potential/particle carry 0", "coefficients": f"pair_coeff * * {STIFFNESS} {SHEAR} {FRICTION} 1", "neighbor": "neighbor 0.02 bin",
    "modify": "", "walls": "", "gravity": "fix weight all gravity 9.81 vector 0 0 -1", "timestep": f"timestep {DT}", "before": "", "run": "run 200", "after": "",
    "box": "-1 1 -1 1 -1 1", "processors": "",
}
SCRIPT = """{units}
{atom}
{newton}
{velocities}
boundary {boundary}
{processors}
fix orientation all property/atom d2_orientation 4 writedata yes
read_data scene.data fix orientation NULL orientation
{shapes}
{style}
{coefficients}
{neighbor}
{modify}
fix move all nve/potential/particle
{gravity}
{walls}
{timestep}
compute pp all pair potential/particle
thermo_style custom step ke pe f_move c_pp[1] c_pp[2] c_pp[3] c_pp[4] c_pp[5]
thermo_modify format float %.17g
dump all all custom 1 all.dump id type x y z vx vy vz omegax omegay omegaz d2_orientation[1] d2_orientation[2] d2_orientation[3] d2_orientation[4]
dump_modify all sort id format float %.17g first yes
{before}
{run}
{after}
"""


def shapes():
    slope, size, below = np.hypot(1.0, 0.5), 0.1, 0.25
    across, up = 1 / slope, 0.5 / slope
    normals = [(across, 0, up), (-across, 0, up), (0, across, up), (0, -across, up), (0, 0, -1)]
    offsets = np.array([0.5 * across - below * up] * 4 + [below]) - 0.05
    pyramid = Particle(np.column_stack([normals, offsets * size]), 0.05 * size, 0.02, size * np.hypot(np.sqrt(0.5), below))
    sides = [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)]
    return {"pyramid": pyramid, "cuboid": polyhedron(sides, [0.06, 0.06, 0.05, 0.05, 0.03, 0.03], 0.004)}


def write(folder, bodies, box):
    """bodies: rows (type, position, velocity, angular velocity, quaternion)."""
    write_shapes(folder / "shapes.txt", shapes())
    low = box.split()
    with open(folder / "scene.data", "w") as file:
        file.write(f"bodies\n\n{len(bodies)} atoms\n2 atom types\n{low[0]} {low[1]} xlo xhi\n{low[2]} {low[3]} ylo yhi\n{low[4]} {low[5]} zlo zhi\n")
        file.write("\nAtoms # sphere\n\n" + "".join(f"{i + 1} {b[0]} 0.1 2600 {numbers(b[1])}\n" for i, b in enumerate(bodies)))
        file.write("\nVelocities\n\n" + "".join(f"{i + 1} {numbers(b[2])} {numbers(b[3])}\n" for i, b in enumerate(bodies)))
        file.write("\norientation\n\n" + "".join(f"{i + 1} {numbers(b[4])}\n" for i, b in enumerate(bodies)))


def numbers(values):
    return " ".join(repr(float(x)) for x in values)


def lammps(folder, script, ranks=1, **environment):
    """(exit status, output) of LAMMPS with a script's text, in its folder."""
    (folder / "in.scene").write_text(script)
    done = subprocess.run([str(TOP / "scripts" / "lammps.sh"), str(ranks), "-in", "in.scene", "-log", "none"], cwd=folder, text=True, timeout=SECONDS,
                          env={**os.environ, **environment}, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    return done.returncode, done.stdout


def run(folder, bodies, ranks=1, script=SCRIPT, **parts):
    """Frames [(step, columns)] of the dump of a scene, and what LAMMPS said."""
    filled = {**DEFAULTS, **parts}
    write(folder, bodies, filled["box"])
    status, said = lammps(folder, script.format(**filled), ranks)
    if status:
        raise AssertionError(f"LAMMPS ended with {status}:\n{said[-3000:]}")
    return list(frames(folder / "all.dump")), said


def refused(folder, bodies, ranks=1, environment=None, script=SCRIPT, **parts):
    """What LAMMPS says of a scene that it must refuse, in one line of words."""
    filled = {**DEFAULTS, **parts}
    write(folder, bodies, filled["box"])
    status, said = lammps(folder, script.format(**filled), ranks, **(environment or {}))
    if not status:
        raise AssertionError(f"LAMMPS took it:\n{said[-2000:]}")
    return " ".join(said.split())


def state(columns):
    """Positions, velocities, angular velocities and quaternions, (n, 13)."""
    return np.column_stack([columns[c] for c in ["x", "y", "z", "vx", "vy", "vz", "omegax", "omegay", "omegaz"] + QUATERNION])


def thermo(said):
    """{column: array} of the last table that LAMMPS printed."""
    lines = said.splitlines()
    start = max(i for i, line in enumerate(lines) if line.split()[:1] == ["Step"])
    rows = []
    for line in lines[start + 1:]:
        if line.startswith("Loop time"):
            break
        if line.split() and not line.startswith("WARNING"):
            rows.append([float(x) for x in line.split()])
    return dict(zip(lines[start].split(), np.array(rows).T))


def random_bodies(count, spacing, seed, low=(0, 0, 0), across=3, speed=0.5):
    """Bodies of both types on a grid, with random orientations and velocities."""
    random = np.random.default_rng(seed)
    bodies = []
    for n in range(count):
        place = np.array([n % across, n // across % across, n // across**2]) * spacing + np.array(low)
        q = random.normal(size=4)
        bodies.append((1 + n % 2, place + random.uniform(-0.005, 0.005, 3), random.uniform(-speed, speed, 3), random.uniform(-3, 3, 3), q / np.linalg.norm(q)))
    return bodies
