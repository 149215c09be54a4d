# SPDX-License-Identifier: MIT OR Apache-2.0
"""What mpi_pile.py says and shows of a run: targets, table and picture."""

import os
import sys

import matplotlib
import numpy as np

from potential_particles.output.drawn import ShapeMeshes, copies
from potential_particles.output.view import framing_view

import pyramids
from bodies import reach
from panels import PANEL_PIXELS, save_panels
from summary import print_table, write_summary

MOST_DRAWN = 20_000  # bodies


def rotations(orientations):
    """Matrices (n, 3, 3), local to world, of unit quaternions (n, 4) w, x, y, z."""
    w, x, y, z = orientations.T
    rows = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
    ]
    return np.moveaxis(np.array(rows), 2, 0)


def kinetic(pile, states):
    """Kinetic energy of all bodies, J."""
    mass = pile.shape.volume * pyramids.DENSITY
    inertia = np.array(pile.shape.inertia) * pyramids.DENSITY
    turning = np.einsum("bji,bj->bi", rotations(states["orientation"]), states["angular_velocity"])
    return float(0.5 * mass * (states["velocity"] ** 2).sum() + 0.5 * (inertia * turning**2).sum())


def progress(kind, steps):
    """A progress bar where the launcher has a terminal: mpirun makes every rank believe that it has one."""
    bar = kind(steps)
    bar.on_terminal = os.environ.get("PP_TERMINAL") == "1"
    return bar


def targets(result):
    """What a sound run keeps: name, sense, target, measured, met."""
    lost = result["bodies_below_floor"] + result["bodies_outside_walls"]
    moved = abs(sum(result["bodies_of_ranks"]) - 5 - result["bodies"])
    shares = result["bodies_of_ranks"][1:]
    uneven = max(shares) * len(shares) / sum(shares) if shares else 1.0
    rows = [
        ("failed contacts", "at most", 0, result["failures"]),
        ("bodies lost", "at most", 0, lost),
        ("bodies of no worker, or of two", "at most", 0, moved),
        ("bodies of the largest worker over their mean", "at most", 1.2, uneven),
        ("largest overlap over size", "at most", 0.05, result["largest_overlap_over_size_in_run"]),
    ]
    return [
        {"name": name, "sense": sense, "target": target, "measured": measured, "met": measured <= target}
        for name, sense, target, measured in rows
    ]


def write(out, pile, result, pictures):
    """summary.json, pile.png and the table; ends with a failure status when a target was missed."""
    final = result.pop("final")
    if not pictures or pictures[-1][0] != result["steps"]:
        pictures.append((result["steps"], result["steps"] * pyramids.TIME_STEP, final))
    if pile.count <= MOST_DRAWN:
        _draw(out / "pile.png", pile, pictures, result["ranks"])
    result["targets"] = targets(result)
    write_summary(out / "summary.json", result)
    _print(out, result)
    missed = [row["name"] for row in result["targets"] if not row["met"]]
    if missed:
        raise SystemExit(f"The run is not sound: {', '.join(missed)}; see above.")


def _draw(path, pile, pictures, ranks):
    """The first and the last state; colour tells the worker."""
    table = matplotlib.colormaps["tab10"](np.arange(10))[:, :3]
    mesh = ShapeMeshes(0.01).of(pile.shape.particle())
    ends = [
        states["position"] + side * axis
        for _, _, states in pictures
        for side in (-1, 1)
        for axis in reach(pile.shape) * np.eye(3)
    ]
    view = framing_view(np.vstack(ends), pyramids.VIEW_FROM, pyramids.VIEW_ANGLE, PANEL_PIXELS[0] / PANEL_PIXELS[1])
    panels = [
        (
            f"step {step:,}:  t = {time:.2f} s",
            copies(
                mesh,
                states["position"],
                rotations(states["orientation"]),
                table[states["rank"] % len(table)],
                np.arange(pile.count),
            ),
        )
        for step, time, states in pictures
    ]
    workers = "one process" if ranks == 1 else f"{ranks - 1} workers"
    title, note = f"{pile.count:,} pyramids on {workers}", "Colour: the worker that moves a body."
    save_panels(path, panels, 2.0 * pile.grid.height, view, title, note)


def _print(out, result):
    counters = result["counters"]
    rate = (result["steps"] - result["first_step"]) / result["stepping_seconds"] if result["stepping_seconds"] else 0.0
    shares = ", ".join(f"{count:,}" for count in result["bodies_of_ranks"][1:]) or "all on one"
    rows = [
        ("bodies", f"{result['bodies']:,} pyramids; of the workers: {shares}"),
        ("steps", f"{result['steps']:,} of {result['steps_asked_for']:,}" +
         (" (interrupted)" if result["interrupted"] else "")),
        ("time",
         f"{result['stepping_seconds']:.1f} s stepping, {rate:,.0f} steps/s; {result['total_seconds']:.1f} s in all"),
        ("contacts",
         f"{result['contacts']:,}; the functors were asked {counters['calls']:,} times and solved {counters['solved']:,} pairs"
         ),
        ("mean height", f"{result['mean_height_m']:.4f} m"),
        ("kinetic energy", f"{result['kinetic_energy_J']:.2e} J"),
        ("box carries", f"{result['support_over_weight']:.2%} of the weight"),
        *[(row["name"], f"{row['measured']:.4g}, {row['sense']} {row['target']:g}: {'met' if row['met'] else 'MISSED'}")
          for row in result["targets"]],
        ("versions", ", ".join(f"{name} {version}" for name, version in result["versions"].items())),
        ("machine", result["machine"]),
        ("results", f"{out}: pile.png, pile.bodies.pvd (ParaView), summary.json, pile.yade.gz"),
    ]
    print_table(rows)
    sys.stdout.flush()
