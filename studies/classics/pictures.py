# SPDX-License-Identifier: MIT OR Apache-2.0
"""A picture of each case, and all of them on one page."""

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.patches import Polygon, Rectangle
from mpl_toolkits.mplot3d.art3d import Poly3DCollection

DOTS_PER_INCH = 120
SIZE = (5.6, 3.4)  # of one picture, inches
CLOSED, FOUND, STONE, EDGE, FAINT = "#1a1a1a", "#c8553d", "#d9cfc1", "#6b5d4d", "#9aa5ad"
COLOURS = ("#2a6f97", "#c8553d", "#6a994e", "#8e5a9b", "#d08c2a", "#5c5c5c")


def draw(path, results):
    """The page at `path`, and beside it one picture a case, classics_NAME.png."""
    columns = 2
    rows = -(-len(results) // columns)
    page = plt.figure(figsize=(SIZE[0] * columns, SIZE[1] * rows), dpi=DOTS_PER_INCH)
    for number, (name, result) in enumerate(results.items()):
        _picture(page, (rows, columns, number + 1), name, result)
        single = plt.figure(figsize=SIZE, dpi=DOTS_PER_INCH)
        _picture(single, (1, 1, 1), name, result)
        single.tight_layout()
        single.savefig(path.with_name(f"{path.stem}_{name}.png"))
        plt.close(single)
    page.tight_layout(h_pad=2.0)
    page.savefig(path)
    plt.close(page)


def _picture(figure, place, name, result):
    solid = {"projection": "3d"} if name == "key_block" else {}
    axis = figure.add_subplot(*place, **solid)
    axis.set_title(result["title"], fontsize=10)
    axis.tick_params(labelsize=8)
    DRAWN[name](axis, result["data"], result["rows"])


def _labels(axis, x, y, **legend):
    axis.set_xlabel(x, fontsize=8.5)
    axis.set_ylabel(y, fontsize=8.5)
    if legend:
        axis.legend(fontsize=7, **legend)


def _incline(axis, data, rows):
    """Slope less friction against aspect less friction: borders of different friction angles then nearly lie on each
    other.
    """
    colours = dict(zip(("stays", "slides", "topples", "slides and topples"), COLOURS))
    marks = {20.0: "o", 30.0: "s", 40.0: "^"}

    def plot(chosen, mark, **style):
        some = [p for p in data["points"] if chosen(p)]
        axis.plot([p["slope"] - p["friction"] for p in some], [p["aspect"] - p["friction"] for p in some], mark,
                  **style)

    for name, colour in colours.items():
        for friction, mark in marks.items():
            plot(lambda p: p["region"] == name and p["friction"] == friction, mark, ms=4, color=colour)
        axis.plot([], [], "o", ms=4, color=colour, label=name)
    plot(lambda p: p["found"] != p["region"], "kx", ms=9)
    plot(lambda p: p["found"] != p["hoek_and_bray"], "o", ms=9, mfc="none", mec=FAINT,
         label="else in Hoek & Bray's chart")
    axis.axvline(0.0, color=CLOSED, lw=0.8)
    axis.plot([-40, 0, 60], [-40, 0, 0], color=CLOSED, lw=0.8)
    axis.set_xlim(-38, 42)
    axis.set_ylim(-34, 52)
    _labels(axis, "slope - friction, degrees", "atan(b/h) - friction, degrees", loc="upper left", ncol=2)


def _sliding(axis, data, rows):
    for colour, path in zip(COLOURS, data["paths"]):
        time = np.array(path["time"])
        axis.plot(time, 0.5 * path["acceleration"] * time**2, color=CLOSED, lw=0.8)
        axis.plot(time[::2], path["way"][::2], "o", ms=3, color=colour, label=f"{path['slope']:g}°")
    axis.plot([], [], color=CLOSED, lw=0.8, label="closed form")
    _labels(axis, "time, s", "way, m", loc="upper left")


def _newmark(axis, data, rows):
    for colour, path in zip(COLOURS, data["paths"]):
        time = np.array(path["time"]) * data["frequency"]
        axis.plot(time, path["way"], color=colour, label=f"A = {path['ratio']:g} Y")
        cycles = np.arange(1, round(time[-1]) + 1)
        axis.plot(cycles, cycles * path["cycle"], "o", ms=4, mfc="none", mec=CLOSED)
    axis.plot([], [], "o", ms=4, mfc="none", mec=CLOSED, label="closed form")
    _labels(axis, "cycles", "way relative to the plane, m", loc="upper left")


def _rocking(axis, data, rows):
    for colour, path in zip(COLOURS, data["paths"]):
        time = np.array(path["time"]) / path["quarter"]
        axis.plot(time, np.array(path["turn"]) / data["slenderness"], color=colour, label=f"from {path['tilt']:g}")
    axis.axvline(1.0, color=CLOSED, lw=0.8, label="quarter period, closed form")
    axis.axhline(0.0, color=FAINT, lw=0.6)
    axis.set_xlim(0, 2.2)
    _labels(axis, "time over the quarter period", "tilt over atan(b/h)", loc="upper right")


def _arch(axis, data, rows):
    for stones, alpha in ((data["rest"], 1.0), (data["fallen"], 0.35)):
        for stone in stones:
            axis.add_patch(Polygon(stone, fc=STONE if alpha == 1.0 else "none", ec=EDGE, lw=0.6, alpha=alpha))

    def plot(angles, offsets, style, **more):
        radii = 1.0 + np.array(offsets) * data["thickness"]
        axis.plot(radii * np.sin(np.radians(angles)), radii * np.cos(np.radians(angles)), style, **more)

    plot(*data["line"], "-", color=CLOSED, lw=0.9, label="line of thrust, closed form")
    plot(*np.array(data["thrust"]).T, "o", ms=2.5, color=FOUND, label="contact points")
    axis.plot([], [], color=EDGE, lw=0.6, alpha=0.35, label="a tenth thinner, on its way")
    axis.set_aspect("equal")
    axis.set_ylim(-0.05, 1.25)
    axis.set_axis_off()
    axis.legend(fontsize=7, loc="lower center")
    least = next(row for row in rows if row["what"].startswith("least"))
    axis.text(0.0, 0.62, f"t/R = {least['found']:.4f}\nclosed form {least['closed_form']:.4f}", ha="center", fontsize=9)


def _overhang(axis, data, rows):
    reach, height = 0.0, 0.25
    axis.add_patch(Rectangle((-2.0, -0.3), 2.0, 0.3, fc=FAINT, ec=EDGE, lw=0.6))
    for level, step in enumerate(data["steps"]):
        reach += step
        low = level * height
        axis.add_patch(Rectangle((reach - 1.0, low), 1.0, height, fc=STONE, ec=EDGE, lw=0.6))
    axis.plot([0, reach], [low + 1.6 * height] * 2, "|-", color=CLOSED, lw=0.8)
    axis.text(0.5 * reach, low + 1.8 * height, "overhang", ha="center", fontsize=8)
    lines = [f"n = {n}: {row['found']:.4f}  ({row['closed_form']:.4f})" for n, row in zip(data["counts"], rows)]
    text = "\n".join(lines)
    axis.text(1.75, -0.25, "found (closed form)\n" + text, fontsize=7.5, va="bottom")
    axis.set_xlim(-1.6, 3.0)
    axis.set_ylim(-0.35, low + 2.8 * height)
    axis.set_aspect("equal")
    axis.set_axis_off()


def _toppling(axis, data, rows):
    heights = np.array(data["heights"])
    columns = np.arange(len(heights), 1, -1)
    axis.bar(columns - 0.5, data["expected"][:-1], width=0.85, fc=STONE, ec=EDGE, lw=0.6, label="closed form")
    axis.plot(columns - 0.5, data["pushes"], "o", ms=4, color=FOUND, label="found")
    numbers, name = np.arange(1, len(heights) + 1), "height of the column, 0.5 m"
    axis.plot(numbers, 2.0 * heights, color=FAINT, lw=0.8, drawstyle="steps-mid", label=name)
    axis.invert_xaxis()
    text = f"limit: {rows[0]['found']:.3f}°, closed form {rows[0]['closed_form']:.3f}°"
    axis.text(0.02, 0.94, text, transform=axis.transAxes, fontsize=8)
    _labels(axis, "column (toe on the right)", "push between columns / weight of 1 m³, m²", loc="center left")


def _key_block(axis, data, rows):
    corners = np.array(data["corners"])
    faces = [corners[list(i)] for i in ((0, 1, 2), (0, 1, 3), (0, 2, 3), (1, 2, 3))]
    axis.add_collection3d(Poly3DCollection(faces, fc=STONE, ec=EDGE, lw=0.8, alpha=0.75))
    low, high = corners.min(axis=0) - 0.3, corners.max(axis=0) + 0.3
    roof = [[(low[0], low[1], 0), (high[0], low[1], 0), (high[0], high[1], 0), (low[0], high[1], 0)]]
    axis.add_collection3d(Poly3DCollection(roof, fc=FAINT, alpha=0.25))
    axis.set_xlim(low[0], high[0])
    axis.set_ylim(low[1], high[1])
    axis.set_zlim(-0.2, 1.1)
    axis.set_box_aspect((high[0] - low[0], high[1] - low[1], 1.3))
    axis.view_init(-14, -30)
    axis.set_axis_off()
    text = "\n".join(f"{r['found']:.4f}°  ({r['closed_form']:.4f}°)" for r in rows if r["unit"] == "°")
    axis.text2D(0.98, 0.02, "found (closed form)\n" + text, transform=axis.transAxes, fontsize=8, ha="right")


def _rolling(axis, data, rows):
    sides = [path["sides"] for path in data["paths"]]
    axis.loglog(sides, [abs(row["error"]) for row in rows], "o-", color=FOUND, ms=4)
    axis.set_xticks(sides, [str(n) for n in sides])
    axis.minorticks_off()
    axis.grid(alpha=0.3)
    _labels(axis, "sides of the prism", "error of the acceleration, relative")


def _tumbling(axis, data, rows):
    for colour, run in zip(COLOURS, data["runs"]):
        name = f"{run['steps']} steps a turn" + (f", {run['rule']}" if run["rule"] != "Fincham1992" else "")
        drift = np.maximum(np.abs(np.array(run["energy"]) - 1.0), 1e-16)
        axis.semilogy(run["turns"][1:], drift[1:], color=colour, lw=0.9, label=name)
    axis.axhline(1e-6, color=CLOSED, lw=0.8)
    axis.set_ylim(1e-13, 10)
    _labels(axis, "turns", "change of energy, relative", loc="lower right", ncol=2)


def _twist(axis, data, rows):
    for colour, path in zip(COLOURS, data["paths"]):
        axis.plot(path["time"], path["spin"], color=colour, lw=1.2, label=path["name"])
    time = np.array(data["paths"][0]["time"])
    axis.plot(time, data["spin"] - data["deceleration"] * time, "--", color=CLOSED, lw=0.9,
              label="closed form, even pressure")
    _labels(axis, "time, s", "angular velocity, 1/s", loc="lower left")


DRAWN = {
    "incline": _incline,
    "sliding": _sliding,
    "newmark": _newmark,
    "rocking": _rocking,
    "arch": _arch,
    "overhang": _overhang,
    "toppling": _toppling,
    "key_block": _key_block,
    "rolling": _rolling,
    "tumbling": _tumbling,
    "twist": _twist,
}  # fmt: skip
