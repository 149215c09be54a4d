# SPDX-License-Identifier: GPL-2.0-or-later
"""Scenes for LAMMPS as text, run in a process of their own, and what they dump."""
import os
import signal
import subprocess
import tempfile
from functools import lru_cache
from pathlib import Path

import numpy as np
from potential_particles import Particle
from potential_particles.lammps import polyhedron, write_shapes
from potential_particles.lammps.pictures import QUATERNION, frames

TOP = Path(__file__).resolve().parents[2]
SECONDS = 300
DENSITY, STIFFNESS, SHEAR, FRICTION, DT = 2600.0, 1e5, 6e4, 0.4, 1e-4

# What stands in a script in the place of {name}.
DEFAULTS = {
    "units": "units si",
    "atom": "atom_style sphere",
    "newton": "newton off",
    "velocities": "comm_modify vel yes",
    "boundary": "f f f",
    "shapes": "fix shapes all potential/particle/shapes shapes.txt type 1 pyramid 2600 type 2 cuboid 2600",
    "style": "pair_style potential/particle carry 0",
    "coefficients": f"pair_coeff * * {STIFFNESS} {SHEAR} {FRICTION} 1",
    "neighbor": "neighbor 0.02 bin",
    "modify": "",
    "walls": "",
    "gravity": "fix weight all gravity 9.81 vector 0 0 -1",
    "timestep": f"timestep {DT}",
    "before": "",
    "run": "run 200",
    "after": "",
    "box": "-1 1 -1 1 -1 1",
    "processors": "",
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


@lru_cache
def shapes(rounded=True):
    """With edges all but sharp where not rounded: LAMMPS has their mass in a tenth of the time."""
    slope, size, below = np.hypot(1.0, 0.5), 0.1, 0.25
    across, up = 1 / slope, 0.5 / slope
    normals = [(across, 0, up), (-across, 0, up), (0, across, up), (0, -across, up), (0, 0, -1)]
    offsets = np.array([0.5 * across - below * up] * 4 + [below]) - 0.05
    pyramid = Particle(np.column_stack([normals, offsets * size]), (0.05 if rounded else 1e-3) * size,
                       0.02 if rounded else 0.0, size * np.hypot(np.sqrt(0.5), below))
    sides = [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)]
    return {
        "pyramid": pyramid, "cuboid": polyhedron(sides, [0.06, 0.06, 0.05, 0.05, 0.03, 0.03],
                                                 0.004 if rounded else 1e-4)
    }


@lru_cache
def shapes_text(rounded=True):
    with tempfile.TemporaryDirectory(prefix="lammps-") as folder:
        write_shapes(Path(folder) / "shapes.txt", shapes(rounded))
        return (Path(folder) / "shapes.txt").read_text()


def write(folder, bodies, box, rounded=True):
    """bodies: rows (type, position, velocity, angular velocity, quaternion)."""
    (folder / "shapes.txt").write_text(shapes_text(rounded))
    low = box.split()
    with open(folder / "scene.data", "w") as file:
        file.write(
            f"bodies\n\n{len(bodies)} atoms\n2 atom types\n{low[0]} {low[1]} xlo xhi\n{low[2]} {low[3]} ylo yhi\n{low[4]} {low[5]} zlo zhi\n"
        )
        file.write("\nAtoms # sphere\n\n" + "".join(f"{i + 1} {b[0]} 0.1 2600 {numbers(b[1])}\n"
                                                    for i, b in enumerate(bodies)))
        file.write("\nVelocities\n\n" + "".join(f"{i + 1} {numbers(b[2])} {numbers(b[3])}\n"
                                                for i, b in enumerate(bodies)))
        file.write("\norientation\n\n" + "".join(f"{i + 1} {numbers(b[4])}\n" for i, b in enumerate(bodies)))


def numbers(values):
    return " ".join(repr(float(x)) for x in values)


LAMMPS = TOP / "scripts" / "lammps.sh"
_said = [""]


def last_words():
    """Of LAMMPS: from its last error on, or the last lines."""
    last = [text.strip() for text in _said[0].splitlines() if text.strip()]
    errors = [n for n, text in enumerate(last) if text.startswith("ERROR")]
    return "\n".join(text[:300] for text in (last[errors[-1]:][:4] if errors else last[-4:]))


def process(folder, command, seconds=SECONDS, **environment):
    """(exit status, output) of a program in a folder; one that has not ended by then is killed with all that it has
    started, and the status is None.
    """
    with open(folder / "said.txt", "w+", errors="replace") as out:
        running = subprocess.Popen(list(map(str, command)), cwd=folder, env={**os.environ,
                                                                             **environment}, stdin=subprocess.DEVNULL,
                                   stdout=out, stderr=subprocess.STDOUT, start_new_session=True)
        try:
            status = running.wait(timeout=seconds)
        except subprocess.TimeoutExpired:
            status = None
        finally:
            for how in (signal.SIGTERM, signal.SIGKILL):
                if running.poll() is None:
                    os.killpg(running.pid, how)
                    try:
                        running.wait(timeout=5)
                    except subprocess.TimeoutExpired:
                        pass
            # What MPICH leaves where a single rank aborts has its process's number, which a process of another user may
            # get, and could not open.
            for left in Path("/dev/shm").glob(f"mpich_shm_{running.pid:x}_*"):
                left.unlink(missing_ok=True)
        out.seek(0)
        _said[0] = out.read()
    return status, _said[0]


def lammps(folder, script, ranks=1, seconds=SECONDS, **environment):
    """(exit status, output) of LAMMPS with a script's text, in its folder."""
    (folder / "in.scene").write_text(script)
    return process(folder, [LAMMPS, ranks, "-in", "in.scene", "-log", "none"], seconds, **environment)


def run(folder, bodies, ranks=1, script=SCRIPT, **parts):
    """Frames [(step, columns)] of the dump of a scene, and what LAMMPS said."""
    filled = {**DEFAULTS, **parts}
    write(folder, bodies, filled["box"])
    status, said = lammps(folder, script.format(**filled), ranks)
    if status:
        raise AssertionError(f"LAMMPS ended with {status}")
    return list(frames(folder / "all.dump")), said


def refused(folder, bodies, ranks=1, environment=None, script=SCRIPT, rounded=True, **parts):
    """What LAMMPS says of a scene that it must refuse, in one line of words."""
    filled = {**DEFAULTS, **parts}
    write(folder, bodies, filled["box"], rounded)
    status, said = lammps(folder, script.format(**filled), ranks, **(environment or {}))
    if not status:
        raise AssertionError("LAMMPS took it, and should not")
    return " ".join(said.split())


def state(columns):
    """Positions, velocities, angular velocities and quaternions, (n, 13)."""
    return np.column_stack(
        [columns[c] for c in ["x", "y", "z", "vx", "vy", "vz", "omegax", "omegay", "omegaz"] + QUATERNION])


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
        bodies.append((1 + n % 2, place + random.uniform(-0.005, 0.005, 3), random.uniform(-speed, speed, 3),
                       random.uniform(-3, 3, 3), q / np.linalg.norm(q)))
    return bodies
