# SPDX-License-Identifier: MIT OR Apache-2.0
"""The figures of the sliding wedge: blocks and bracket; contact points and error against curvature."""

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

from potential_particles.output.drawn import floor
from potential_particles.output.picture import render
from potential_particles.output.view import framing_view

from friction_reduction import HOLDS, RUN_IN_STAGE, SLIDES
from wedge_cases import PAPER_ANGLE, THREE_DEC_ANGLE

PIXELS = (760, 560)  # width, height of one view
DOTS_PER_INCH = 150
VIEW_ANGLE = 0.35  # full height, radians
# Wedge, block A, block B, base: the wedge stands out, the rock is two greys and a brown.
COLOURS = np.array([(0.80, 0.34, 0.10), (0.52, 0.56, 0.60), (0.62, 0.63, 0.58), (0.45, 0.40, 0.36)])
LEAST_SHOWN = 1e-4  # displacement in W/k_n; what moved less is drawn there
CLOSED_FORM, HELD, SLID, OTHER = "#1a1a1a", "#2a6f97", "#c8553d", "#8a8a8a"


def save_overview(path, states, blocks, trials, note):
    """Two views of the blocks, and displacement against friction angle.

    states: (caption, Triangles of the blocks) twice; trials: those of the paper's wedge.
    """
    figure = plt.figure(figsize=(10.4, 8.3), dpi=DOTS_PER_INCH)
    grid = figure.add_gridspec(2, 2, height_ratios=(1.12, 1.0), left=0.075, right=0.985, top=0.97, bottom=0.1)
    grid.update(hspace=0.2, wspace=0.14)
    view = _view(states, blocks)
    for column, (caption, triangles) in enumerate(states):
        axis = figure.add_subplot(grid[0, column])
        axis.imshow(_render(triangles, blocks, view), interpolation="antialiased")
        axis.set_axis_off()
        axis.set_title(f"({'ab'[column]}) {caption}", fontsize=10, y=-0.06)
    analytic = blocks.limit.friction_angle
    high = max(trial.friction_angle for trial in trials)
    _displacement(figure.add_subplot(grid[1, 0]), trials, analytic, (analytic - 0.9, high + 0.4), False)
    _displacement(figure.add_subplot(grid[1, 1]), trials, analytic, (33.14, 33.54), True)
    figure.text(0.5, 0.012, note, ha="center", va="bottom", fontsize=7.5, color="0.35")
    figure.savefig(path)
    plt.close(figure)


def save_study(path, blocks, rests, slide, sweep, note):
    """Contact points on faces A and B, and the error of the angle against curvature.

    rests: {label: (points on A, points on B)}; slide: Path; sweep: (k, r, error,
    error that the contact normals explain, half the bracket) rows.
    """
    figure, axes = plt.subplots(1, 3, figsize=(11.4, 4.3), dpi=DOTS_PER_INCH)
    for joint, (axis, name) in enumerate(zip(axes, "AB")):
        _face(axis, blocks, joint, rests, slide)
        axis.set_title(f"({'ab'[joint]}) contact point on face {name}", fontsize=9.5)
    axes[0].legend(fontsize=7, loc="upper right", framealpha=0.9)
    _sweep(axes[2], sweep)
    figure.subplots_adjust(left=0.055, right=0.985, top=0.92, bottom=0.19, wspace=0.27)
    figure.text(0.5, 0.012, note, ha="center", va="bottom", fontsize=7.5, color="0.35")
    figure.savefig(path)
    plt.close(figure)


# --- blocks ----------------------------------------------------------------------------------


def _view(states, blocks):
    corners = [p.corners for p in (blocks.wedge, blocks.block_a, blocks.block_b, blocks.base)]
    start, end = (state.corners[state.bodies == 0].mean((0, 1)) for _, state in (states[0], states[-1]))
    points = np.vstack([*corners, corners[0] + end - start])
    along = blocks.limit.line * [1.0, 1.0, 0.0]
    along /= np.linalg.norm(along)
    side = np.cross([0.0, 0.0, 1.0], along)
    towards = along + 0.42 * side + 0.62 * np.array([0.0, 0.0, 1.0])
    return framing_view(points, towards, VIEW_ANGLE, PIXELS[0] / PIXELS[1])


def _render(triangles, blocks, view):
    triangles.colours = COLOURS[triangles.bodies]
    middle, lowest = blocks.base.corners.mean(0), blocks.base.corners.min(0)[2]
    return render(triangles, floor(lowest, 6.0 * blocks.size, middle[:2]), view, *PIXELS)


# --- displacement against friction angle -----------------------------------------------------


def _displacement(axis, trials, analytic, limits, close):
    """Displacement along the line since friction was lowered, in elastic displacements W/k_n."""
    for verdict, marker, colour, label in (
        (HOLDS, "o", HELD, "came to rest"),
        (SLIDES, "^", SLID, "kept sliding"),
    ):
        some = [
            (trial.friction_angle, max(trial.moved_overlaps, LEAST_SHOWN))
            for trial in trials
            if trial.verdict == verdict and trial.stage != RUN_IN_STAGE
        ]
        axis.plot(*zip(*some), marker, ms=5, color=colour, label=label)
        if verdict == SLIDES:
            for angle, moved in some:
                arrow = {"arrowstyle": "->", "color": colour}
                axis.annotate("", (angle, 5.0 * moved), (angle, moved), arrowprops=arrow)
    axis.axvline(analytic, color=CLOSED_FORM, lw=1.2)
    if close:
        for angle, name in ((PAPER_ANGLE, "paper"), (THREE_DEC_ANGLE, "3DEC")):
            axis.axvline(angle, color=OTHER, lw=1.0, ls="--")
            axis.text(angle - 0.004, 1e-2, f"{name} {angle:g}°", rotation=90, fontsize=8, color="0.35",
                      ha="right", va="center")  # fmt: skip
        axis.text(analytic - 0.004, 1e-2, f"closed form {analytic:.3f}°", rotation=90, fontsize=8,
                  color=CLOSED_FORM, ha="right", va="center")  # fmt: skip
    axis.set_yscale("log")
    axis.set_ylim(0.6 * LEAST_SHOWN, 60)
    axis.set_xlim(*limits)
    axis.set_xlabel("friction angle (degrees)", fontsize=9)
    axis.set_ylabel("moved along the line (W/k$_n$)" if not close else "", fontsize=9)
    axis.set_title("(d) close to the limit" if close else "(c) friction lowered, then halved", fontsize=10)
    axis.tick_params(labelsize=8)
    axis.grid(alpha=0.25)
    if not close:
        axis.legend(fontsize=8, loc="upper right")


# --- contact points --------------------------------------------------------------------------


def _face(axis, blocks, joint, rests, slide):
    """A face of the wedge seen along its normal; the line of intersection lies on the left."""
    normal = (blocks.plane_a, blocks.plane_b)[joint].normal
    line = blocks.limit.line
    across = np.cross(line, normal)
    corners = np.array([c for c in _corners(blocks.wedge) if abs(c @ normal) < 1e-9 * blocks.size])
    across *= np.sign(across @ corners.mean(0))
    flat = np.stack([across, -line], axis=1)
    outline = corners @ flat
    outline = outline[np.argsort(np.arctan2(*(outline - outline.mean(0)).T[::-1]))]
    axis.fill(*outline.T / blocks.size, facecolor="0.95", edgecolor="0.5", lw=1)
    for (label, points), (colour, marker, size) in zip(
        rests.items(), ((OTHER, ".", 3.0), (HELD, "o", 6.0))
    ):
        axis.plot(*(points[joint] @ flat).T / blocks.size, marker, ms=size, color=colour, label=label, ls="none")
    way = slide.points[joint] @ flat / blocks.size
    axis.plot(*way.T, "-", lw=1.6, color=SLID, label=f"sliding out by {slide.moved[-1] / blocks.size:.2f}")
    axis.plot(*way[-1], ">", ms=5, color=SLID)
    axis.set_aspect("equal")
    axis.set_xlabel("from the line of intersection (size)", fontsize=8.5)
    axis.set_ylabel("up the line (size)", fontsize=8.5)
    axis.tick_params(labelsize=7.5)


def _corners(polyhedron):
    return np.unique(np.round(polyhedron.corners, 12), axis=0)


# --- sweep -----------------------------------------------------------------------------------


def _sweep(axis, rows):
    for r, colour in zip(sorted({row[1] for row in rows}), ("#8ecae6", "#2a9d8f", "#2a6f97", "#1d3557")):
        some = sorted((k * r, abs(error), abs(shape)) for k, radius, error, shape, _ in rows if radius == r)
        bulge, error, shape = zip(*some)
        axis.plot(bulge, error, "o", ms=5, color=colour, label=f"r = {r:g}")
        axis.plot(bulge, shape, "_", ms=11, color=colour)
    resolution = max(row[-1] for row in rows)
    axis.axhspan(1e-9, resolution, color="0.92", lw=0)
    axis.text(0.98, 0.03, "less than half a bracket", fontsize=7.5, color="0.4", ha="right", transform=axis.transAxes)
    axis.plot([], [], "_", ms=11, color="0.4", label="by the contact normals")
    for error, name, above in (
        (0.05, "target", True),
        (PAPER_ANGLE - 33.357, "paper", False),
        (33.357 - THREE_DEC_ANGLE, "3DEC", True),
    ):
        axis.axhline(error, color=OTHER, lw=1, ls=":" if name == "target" else "--")
        axis.text(3.3e-6, error, f"{name} {error:.2f}°", fontsize=7.5, color="0.35", va="bottom" if above else "top")
    axis.set_xscale("log")
    axis.set_yscale("log")
    axis.set_ylim(1e-6, 0.5)
    axis.set_xlim(3e-6, 1e-2)
    axis.set_xlabel("k r (r relative to size)", fontsize=8.5)
    axis.set_ylabel("error of the critical angle (degrees)", fontsize=8.5)
    axis.set_title("(c) rounded blocks", fontsize=9.5)
    axis.tick_params(labelsize=7.5)
    axis.grid(alpha=0.25)
    axis.legend(fontsize=7, loc="upper left", bbox_to_anchor=(0.0, 0.78))
