#!/usr/bin/python3
# SPDX-License-Identifier: MIT OR Apache-2.0
"""Body-steps a second of the LAMMPS plugin, beside YADE with the plugin, LAMMPS's spheres, and its rounded polyhedra;
and of one and two ranks.

    benches/lammps_scale.py [RUN ...]       (RUN: a name in RUNS; default: all that have no result yet)

Piles of 2,000 at rest are settled by YADE (benches/steps) and put side by side as tiles. Each run writes its result to
out/lammps/scale; then summary.json, lammps_scale.png and a table follow. One rank is timed by the processor time of its
fastest window, two by the clock, for which the machine must be left alone. `make lammps` comes first.
"""

import os
import re
import subprocess
import sys
from pathlib import Path

import matplotlib
import numpy as np

matplotlib.use("Agg")
import matplotlib.pyplot as plt

TOP = Path(__file__).resolve().parent.parent
sys.path[:0] = [str(TOP / "studies"), str(TOP / "out" / "lammps" / "build" / "python"), str(TOP / "benches" / "peers"),
                 str(TOP / "benches" / "steps")]

import timed_run
from potential_particles_lammps import read_shapes
from summary import made, print_table, print_targets, results_of, target, write_summary

OUT = TOP / "out" / "lammps" / "scale"
PYRAMIDS, SPHERES, YADE, POLYHEDRA = "pyramids", "spheres", "yade", "polyhedra"
TILE_BODIES = 2000
SPHERE_RADIUS = 0.045  # as in benches/steps/piles.py
STIFFNESS, SHEAR, FRICTION, RESTITUTION, TIME_STEP = 1.5e6, 0.75e6, 0.577, 0.4, 1.5e-4
# Name: kind, tiles, ranks, steps before the clock starts, windows, steps of each.
RUNS = {
    "yade_2000": (YADE, (1, 1), 1, 60, 8, 60),
    "yade_20000": (YADE, (5, 2), 1, 60, 4, 15),
    "pyramids_2000": (PYRAMIDS, (1, 1), 1, 600, 10, 60),
    "pyramids_20000": (PYRAMIDS, (5, 2), 1, 200, 6, 15),
    "pyramids_20000_2": (PYRAMIDS, (5, 2), 2, 200, 8, 15),
    "pyramids_100000": (PYRAMIDS, (10, 5), 1, 60, 4, 5),
    "pyramids_100000_2": (PYRAMIDS, (10, 5), 2, 60, 5, 5),
    "spheres_2000": (SPHERES, (1, 1), 1, 600, 10, 200),
    "spheres_20000": (SPHERES, (5, 2), 1, 200, 6, 40),
    "polyhedra_2000": (POLYHEDRA, (1, 1), 1, 0, 3, 20),
    "pyramids_1000000": (PYRAMIDS, (25, 20), 1, 6, 2, 2),
    "pyramids_1000000_long": (PYRAMIDS, (25, 20), 1, 0, 1, 1000),
}
SCRIPT = """units si
atom_style sphere
newton off
comm_modify vel yes
boundary f f f
{property}
read_data {data} {columns}
{shapes}
pair_style {style}
pair_coeff * * {coefficients}
{walls}
neighbor 0.01 bin
fix move all {integrate}
fix weight all gravity 9.81 vector 0 0 -1
fix still all viscous 5.0
timestep {dt}
compute pp all pair {name}
thermo_style custom step ke {sums}
thermo {every}
run {warm}
unfix still
{runs}
"""


def pile(kind):
    """The settled pile of YADE, as {pos, ori, ...}."""
    return dict(np.load(timed_run.settled(OUT, timed_run.Run(kind, 60, 1, 1, TILE_BODIES))))


def pyramid():
    return read_shapes(TOP / "examples" / "lammps" / "bodies.shapes")["pyramid"]


def half_width(kind, states):
    """Of the tile: where the outermost bodies touch its walls."""
    if kind == SPHERES:
        return float(np.abs(states["pos"][:, :2]).max() + SPHERE_RADIUS)
    from scipy.spatial.transform import Rotation
    corners = pyramid().mesh(1e-3)[0]
    turned = Rotation.from_quat(states["ori"][:, [1, 2, 3, 0]]).as_matrix() @ corners.T
    return float(np.abs(states["pos"][:, :2, None] + turned[:, :2]).max())


def write_data(kind, across, along):
    states = pile(kind)
    pitch = 2 * half_width(kind, states)
    shift = np.array([(i * pitch, j * pitch, 0.0) for i in range(across) for j in range(along)])
    positions = (shift[:, None] + states["pos"]).reshape(-1, 3)
    low, high = -0.5 * pitch, (np.array([across, along]) - 0.5) * pitch
    path, ids = OUT / "tiles.data", np.arange(1, len(positions) + 1)
    with open(path, "w") as file:
        file.write(
            f"tiles\n\n{len(ids)} atoms\n1 atom types\n{low - 0.5} {high[0] + 0.5} xlo xhi\n{low - 0.5} {high[1] + 0.5} ylo yhi\n"
            f"-0.2 {positions[:, 2].max() + 1.0} zlo zhi\n\nAtoms # sphere\n\n")
        np.savetxt(
            file,
            np.column_stack(
                [ids,
                 np.ones_like(ids),
                 np.full(len(ids), 2 * SPHERE_RADIUS),
                 np.full(len(ids), 2600.0), positions]), fmt="%d %d %.9g %.9g %.17g %.17g %.17g")
        if kind == PYRAMIDS:
            file.write("\norientation\n\n")
            np.savetxt(file, np.column_stack([ids, np.tile(states["ori"], (len(shift), 1))]),
                       fmt="%d %.17g %.17g %.17g %.17g")
    return path, (low, high)


def lammps_script(name):
    kind, (across, along), _, warm, windows, steps = RUNS[name]
    data, (low, high) = write_data(kind, across, along)
    sides = [(0, 0, 0, 0, 0, 1), (low, 0, 0, 1, 0, 0), (high[0], 0, 0, -1, 0, 0), (0, low, 0, 0, 1, 0),
             (0, high[1], 0, 0, -1, 0)]
    spheres = kind == SPHERES
    gran = f"gran/hooke/history {STIFFNESS} {SHEAR} 100.0 0 {FRICTION} 0"
    if spheres:
        walls = "".join(f"fix {axis}wall all wall/gran {gran[5:]} {axis}plane {lo} {hi}\n"
                        for axis, lo, hi in (("x", low, high[0]), ("y", low, high[1]), ("z", 0, "NULL")))
    else:
        walls = f"fix walls all wall/potential/particle {STIFFNESS} {SHEAR} {FRICTION} {RESTITUTION} " + " ".join(
            "plane " + " ".join(map(str, side)) for side in sides)
    script = SCRIPT.format(
        data=data, columns="" if spheres else "fix orientation NULL orientation",
        property="" if spheres else "fix orientation all property/atom d2_orientation 4", shapes="" if spheres else
        f"fix shapes all potential/particle/shapes {TOP}/examples/lammps/bodies.shapes type 1 pyramid 2600",
        style=gran if spheres else "potential/particle",
        coefficients="" if spheres else f"{STIFFNESS} {SHEAR} {FRICTION} {RESTITUTION}",
        integrate="nve/sphere" if spheres else "nve/potential/particle", walls=walls, dt=TIME_STEP, warm=warm,
        every=max(warm, 1), name="gran/hooke/history" if spheres else "potential/particle",
        sums="" if spheres else "c_pp[1] c_pp[2]", runs=f"run {steps}\n" * windows)
    if spheres:
        # Contacts, as pairs of balls that overlap.
        script = script.replace("compute pp all pair gran/hooke/history",
                                "compute touching all contact/atom\ncompute pp all reduce sum c_touching").replace(
                                    "thermo_style custom step ke", "thermo_style custom step ke c_pp")
    return script


def run_lammps(script, log, ranks):
    """Peak bytes of the largest process."""
    (OUT / "in.tiles").write_text(script)
    peak = subprocess.run([
        "/usr/bin/env", "python3", "-c", "import resource, subprocess, sys; subprocess.run(sys.argv[1:], check=True); "
        "print(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss * 1024)", TOP / "scripts" / "lammps.sh",
        str(ranks), "-in", OUT / "in.tiles", "-log", log, "-screen", "none"
    ], text=True, stdout=subprocess.PIPE, check=True)
    return int(peak.stdout.split()[-1])


def lammps(name):
    kind, (across, along), ranks, _, _, steps = RUNS[name]
    log = OUT / f"{name}.log"
    peak = run_lammps(lammps_script(name), log, ranks)
    text = log.read_text()
    loops = [float(x) for x in re.findall(r"Loop time of (\S+) on", text)][1:]
    shares = [float(x) / 100 for x in re.findall(r"(\S+)% CPU use", text)][1:]
    last = [
        line.split() for line in text.splitlines() if re.fullmatch(r"[\d\s.e+-]+", line) and len(line.split()) >= 3
    ][-1]
    bodies = TILE_BODIES * across * along
    clock, processor = min(loops) / steps, min(l * s for l, s in zip(loops, shares)) / steps
    return {
        "bodies": bodies, "ranks": ranks, "clock_ms": 1e3 * clock, "processor_ms": 1e3 * processor,
        "contacts": float(last[2]) /
                    (2 if kind == SPHERES else 1), "failures": 0 if kind == SPHERES else float(last[3]),
        "kinetic_J": float(last[1]), "peak_bytes_a_body": peak / bodies if ranks == 1 else None
    }


LONG_MINUTES = int(os.environ.get("LONG_MINUTES", "40"))
AGAIN = """newton off
comm_modify vel yes
read_restart {out}/long.restart
"""
GOES_ON = "dump end all custom 2 {dump} id x y z vx vy vz\ndump_modify end sort id first yes format float %.17g\nrun 2 post no\n"


def long_run(name):
    """Steps of the pile for LONG_MINUTES at most, a restart file, and two more steps: of the run itself, and of one
    that reads the file.
    """
    _, (across, along), ranks, _, _, steps = RUNS[name]
    bodies = TILE_BODIES * across * along
    text = lammps_script(name).replace("run 0\n", f"timer timeout {LONG_MINUTES}:00 every 10\n", 1)
    text = text.replace(
        f"run {steps}\n", f"thermo 50\nrun {steps}\ntimer timeout off\nwrite_restart {OUT}/long.restart\n"
        + GOES_ON.format(dump=OUT / "long.dump"))
    first = run_lammps(text, OUT / f"{name}.log", ranks)
    known = text[text.index("fix shapes"):text.index("fix still")].replace("thermo 1\n", "")
    second = run_lammps(
        AGAIN.format(out=OUT) + known + f"timestep {TIME_STEP}\n" + GOES_ON.format(dump=OUT / "again.dump"),
        OUT / f"{name}_again.log", ranks)
    log = (OUT / f"{name}.log").read_text()
    loop = re.search(r"Loop time of (\S+) on \d+ procs for (\d+) steps", log)
    share = float(re.search(r"(\S+)% CPU use", log[loop.end():])[1]) / 100
    ends = [np.loadtxt(OUT / dump, skiprows=2 * 9 + bodies) for dump in ("long.dump", "again.dump")]  # the second frame
    done, seconds = int(loop[2]), float(loop[1])
    return {
        "bodies": bodies, "ranks": ranks, "steps": done, "clock_ms": 1e3 * seconds / done,
        "processor_ms": 1e3 * seconds * share / done, "peak_bytes_a_body": max(first, second) / bodies,
        "restart_bytes_a_body": (OUT / "long.restart").stat().st_size / bodies, "restart_error_m": float(
            np.abs(ends[0] - ends[1])[:,
                                      1:4].max()), "restart_error_m_s": float(np.abs(ends[0] - ends[1])[:, 4:].max())
    }


def polyhedra():
    """The same pile as rounded polyhedra of LAMMPS; the walls are its own."""
    from lammps_pile import Pile
    from measure_piles import _faces
    from polyhedron import Polyhedron
    _, _, _, warm, windows, steps = RUNS["polyhedra_2000"]
    shape, states = pyramid(), pile(PYRAMIDS)
    core = Polyhedron(shape.planes[:, :3], shape.planes[:, 3])
    mass = shape.mass_properties()
    heap = Pile(core, _faces(core), shape.r, 2600.0 * mass.volume, 2600.0 * np.diag(mass.inertia),
                (STIFFNESS, 100.0, 0.0, FRICTION, 9.81, TIME_STEP))
    half = half_width(PYRAMIDS, states)
    heap.write(OUT, states, (half + 1e-6, float(states["pos"][:, 2].max())))
    seconds, _ = heap.run(OUT, [str(TOP / "scripts" / "lammps.sh"), "1"], half, steps, windows)
    text = (OUT / "log.pile").read_text()
    shares = [float(x) / 100 for x in re.findall(r"(\S+)% CPU use", text)][1:]
    return {
        "bodies": TILE_BODIES, "ranks": 1, "clock_ms": 1e3 * min(seconds) / steps,
        "processor_ms": 1e3 * min(l * s for l, s in zip(seconds, shares)) / steps
    }


def measure(name):
    kind, (across, along), _, _, windows, steps = RUNS[name]
    if kind == YADE:
        done = timed_run.measured(OUT, timed_run.Run(PYRAMIDS, 60, windows, steps, TILE_BODIES, across * along))
        fastest = min(window["step"] for window in done["windows"])
        return {
            "bodies": done["bodies"], "ranks": 1, "clock_ms": fastest, "processor_ms": fastest,
            "contacts": done["contacts"], "peak_bytes_a_body": done["bytes_a_body"]
        }
    if kind == POLYHEDRA:
        return polyhedra()
    return long_run(name) if name.endswith("_long") else lammps(name)


def targets(runs):
    found = []

    def add(name, sense, limit, over, under, key="processor_ms", share=lambda run: 1.0):
        if over in runs and under in runs:
            found.append(
                target(name, sense, limit, runs[over][key] / share(runs[over]) /
                       (runs[under][key] / share(runs[under]))))

    for count in (2000, 20000):
        add(f"step of YADE with the plugin over that of LAMMPS, {count:,} pyramids", "at least", 1.5, f"yade_{count}",
            f"pyramids_{count}")
        add(f"step a contact over that of LAMMPS's spheres, {count:,} bodies", "at most", 4.0, f"pyramids_{count}",
            f"spheres_{count}", share=lambda run: run["contacts"])
    add("step of body/rounded/polyhedron over ours, 2,000 pyramids", "at least", 15.0, "polyhedra_2000",
        "pyramids_2000")
    for count in (20000, 100000):
        add(f"step of 1 rank over that of 2, {count:,} pyramids, by the clock", "at least", 1.8, f"pyramids_{count}",
            f"pyramids_{count}_2", key="clock_ms")
        add(f"the same by the processor time of a rank, its waiting too, {count:,}", "at least", 1.8,
            f"pyramids_{count}", f"pyramids_{count}_2")
    if "pyramids_1000000" in runs:
        found.append(
            target("peak bytes a body, 1,000,000 pyramids", "at most", 6000.0,
                   runs["pyramids_1000000"]["peak_bytes_a_body"]))
    if "pyramids_1000000_long" in runs:
        long = runs["pyramids_1000000_long"]
        found.append(target("steps of 1,000,000 pyramids", "at least", 1000, long["steps"]))
        found.append(
            target("peak bytes a body of that run, with a restart written and read", "at most", 6000.0,
                   long["peak_bytes_a_body"]))
        found.append(
            target("what a run from the restart file differs by after two steps, m", "at most", 1e-12,
                   long["restart_error_m"]))
        add("step a body of that run over 20,000 pyramids", "at most", 1.3, "pyramids_1000000_long", "pyramids_20000",
            share=lambda run: run["bodies"])
    add("step a body, 1,000,000 over 20,000 pyramids", "at most", 1.3, "pyramids_1000000", "pyramids_20000",
        share=lambda run: run["bodies"])
    return found


def report(runs):
    judged = targets(runs)
    write_summary(
        OUT / "summary.json", {
            "targets": judged, "runs": runs, **made("make lammps-scale")
        })
    table = [(
        name,
        f"{run['bodies']:,} bodies, {run['ranks']} rank(s): {run['clock_ms']:.3g} ms a step, processor {run['processor_ms']:.3g}; "
        f"{run['bodies'] / run['clock_ms'] * 1e3:.2g} body-steps/s; {run.get('contacts', float('nan')):.0f} contacts; "
        f"{run.get('peak_bytes_a_body') or float('nan'):.0f} bytes a body") for name, run in runs.items()]
    print_table(table)
    print_targets(judged)
    figure, axis = plt.subplots(figsize=(7.5, 3.4), dpi=150)
    names = list(runs)[::-1]
    colours = {YADE: "0.6", PYRAMIDS: "#3a6ea5", SPHERES: "#7fa650", POLYHEDRA: "#c07040"}
    axis.barh(
        names,
        [1e3 * runs[n]["clock_ms" if runs[n]["ranks"] > 1 else "processor_ms"] / runs[n]["bodies"]
         for n in names], color=[colours[RUNS[n][0]] for n in names])
    axis.set_xscale("log")
    axis.set_xlabel("step, µs for each body (one rank: processor time; two: clock)")
    axis.tick_params(labelsize=7)
    figure.tight_layout()
    figure.savefig(OUT / "lammps_scale.png")


report(results_of(OUT, RUNS, measure))
