# SPDX-License-Identifier: MIT OR Apache-2.0
"""Pictures of the comparison: the course of each scene, bouncing, and where the time of a step goes."""

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.ticker import MaxNLocator

OURS, THEIRS, FLOOR = "#1f6fb4", "#d95f02", "0.55"
DOTS_PER_INCH = 130
MOST_UNBALANCED = 30.0


def draw_cases(path, trials, machine):
    """trials: (case, area, built-in Trial, library Trial); a row of panels each."""
    figure, axes = plt.subplots(len(trials), 4, figsize=(15, 2.75 * len(trials) + 1.0), squeeze=False)
    for row, (case, area, builtin, library) in zip(axes, trials):
        for trial, colour, label, style in (
            (library, OURS, "this library", {"linewidth": 1.5}),
            (builtin, THEIRS, "YADE's built-in", {"linewidth": 2.6, "alpha": 0.75, "linestyle": (0, (3, 1.2))}),
        ):
            record = trial.record
            style = {"color": colour, "label": label, **style}
            row[0].plot(record.step, np.array(record.height) / case.size, **style)
            row[1].semilogy(record.step, _positive(record.kinetic), **style)
            row[2].semilogy(record.step, _positive(record.unbalanced), **style)
            row[3].semilogy(record.step[1:], _loop_times(record), **style)
            for axis in row[:3]:
                axis.axvline(builtin.steps, color="0.8", linewidth=0.8, zorder=0)
        row[0].ticklabel_format(axis="y", useOffset=False)
        # A contact that has just begun carries no force yet, and would stretch the scale by ten powers.
        row[2].set_ylim(top=min(row[2].get_ylim()[1], MOST_UNBALANCED))
        row[0].set_ylabel(f"{case.name}\nsprings {'per area' if area else 'fixed'}", fontsize=11)
        row[3].yaxis.tick_right()
        for axis in row:
            axis.xaxis.set_major_locator(MaxNLocator(5))
            axis.tick_params(labelsize=8)
            axis.grid(True, color="0.92", linewidth=0.7)
    titles = (
        "mean height / size",
        "kinetic energy, J",
        "unbalanced force",
        "contacts and law, µs a step",
    )
    for axis, title in zip(axes[0], titles):
        axis.set_title(title, fontsize=11)
    for axis in axes[-1]:
        axis.set_xlabel("step", fontsize=9)
    axes[0][0].legend(fontsize=9, loc="upper right")
    figure.text(
        0.5,
        0.008,
        "Identical initial states; the grey line is where the built-in's run was ended for want of time. Impacts are "
        f"chaotic: after some of them two exact runs differ, too.  {machine}",
        ha="center",
        fontsize=8,
        color="0.35",
    )
    figure.tight_layout(rect=(0, 0.03, 1, 1))
    _save(figure, path)


def draw_bounce(path, bounces, paths):
    """Energy after each bounce, a panel for each step length; paths: the library's, YADE's and that of exact springs."""
    across = min(len(bounces), 2)
    down = -(-len(bounces) // across)
    figure, axes = plt.subplots(down, across, figsize=(5.6 * across, 3.9 * down), squeeze=False)
    for axis, row, (library, builtin, exact) in zip(axes.flat, bounces, paths):
        for bounce, label, style in (
            (exact, "exact springs, same integrator", {"color": FLOOR, "linewidth": 5, "alpha": 0.5}),
            (library, f"this library, spin {library.spin:.0e} rad/s", {"color": OURS, "linewidth": 1.5}),
            (builtin, f"built-in, spin {builtin.spin:.0e} rad/s",
             {"color": THEIRS, "marker": ".", "linewidth": 1}),
        ):
            if bounce is None:
                continue
            change = np.array(bounce.energies) / bounce.energies[0] - 1.0
            axis.plot(np.arange(len(change)), change, label=label, **style)
        axis.axhline(0.0, color="0.3", linewidth=0.6)
        title = f"{row['steps_per_contact']} steps a contact, springs {row['springs']}"
        axis.set_title(title + (", contacts kept" if row["law_keeps_contacts"] else ""), fontsize=10)
        axis.set_xlabel("bounce", fontsize=9)
        axis.ticklabel_format(axis="y", scilimits=(-2, 2))
        axis.tick_params(labelsize=8)
        axis.grid(True, color="0.92", linewidth=0.7)
        axis.legend(fontsize=8)
    for row in axes:
        row[0].set_ylabel("relative change of the energy", fontsize=10)
    figure.tight_layout()
    _save(figure, path)


def draw_costs(path, stages, bodies):
    """Stacked bars of a step, on a scale for the library and the floor; the built-in's as a number."""
    figure, axis = plt.subplots(figsize=(8.6, 4.6))
    colours = {"integrator": "#8da0cb", "collider": "#66c2a5", "law": "#e5c494", "functor": OURS}
    for number, stage in enumerate(stages):
        for shift, who, name in ((-0.2, "idle", "functor\nreturns at once"), (0.2, "library", "this library")):
            cost, bottom = stage[f"{who}_microseconds"], 0.0
            for part, colour in colours.items():
                label = None if number or who == "library" else part
                axis.bar(number + shift, cost[part], 0.36, bottom, color=colour, edgecolor="white", lw=0.5, label=label)
                bottom += cost[part]
            axis.text(number + shift, bottom, f"{name}\n{bottom:,.0f} µs", ha="center", va="bottom", fontsize=8)
    axis.set_xticks(range(len(stages)), [
        f"{stage['name']}, step {stage['step']:,}\nbuilt-in: {stage['built_in_microseconds']['step']:,.0f} µs"
        for stage in stages
    ], fontsize=10)
    axis.set_ylabel("one step, µs")
    axis.set_title(f"{bodies} pyramids: where the time of a step goes", fontsize=11)
    axis.margins(y=0.18)
    axis.legend(fontsize=9, loc="upper left")
    figure.tight_layout()
    _save(figure, path)


def _loop_times(record):
    steps = np.maximum(np.diff(record.step), 1)
    return 1e6 * np.diff(record.loop_seconds) / steps


def _positive(values):
    """For a logarithmic axis: what is zero or missing leaves a gap."""
    return np.array([value if value and value > 0.0 else np.nan for value in values], float)


def _save(figure, path):
    figure.savefig(path, dpi=DOTS_PER_INCH)
    plt.close(figure)
