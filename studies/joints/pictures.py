# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures of rows, drawn into files."""
import math

import matplotlib
import potential_particles

matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402


def all_rows(listed, path):
    """Each figure over its target."""
    names = [entry["name"] for entry in listed]
    figure, axes = pyplot.subplots(figsize=(7, 0.45 * len(names) + 1.2))
    shares = [max(entry["measured"] / entry["target"], 1e-6) for entry in listed]
    axes.barh(names, shares, left=1e-6, color=["#4a7fb5" if share <= 1 else "#c0563b" for share in shares])
    axes.axvline(1, color="black", linewidth=1)
    axes.set_xscale("log")
    axes.set_xlabel("measured / target")
    axes.invert_yaxis()
    _save(figure, path)


def spread_dashpots(ratio):
    """What a block keeps that lands on a hard bed of dashpots that never pull and sticks to it: ln kept = -int q (1 -
    y)/(3 - q (1 - y) y) dy for y from -1/2 to 1/2, q = 1/(1/12 + 1/(3 ratio^2)).
    """
    q, steps = 1 / (1 / 12 + 1 / (3 * ratio**2)), [(i + 0.5) / 200 - 0.5 for i in range(200)]
    return math.exp(-sum(q * (1 - y) / (3 - q * (1 - y) * y) for y in steps) / 200)


def housner(row, path):
    """What blocks keep of their angular velocity as they land, by width over height; and by stiffness."""
    figure, (kept, converged) = pyplot.subplots(1, 2, figsize=(9, 3.6))
    ratios = [0.2 + 0.01 * i for i in range(61)]
    kept.plot(ratios, [1 - 1.5 * math.sin(math.atan(one))**2 for one in ratios], color="black", label="Housner")
    kept.plot(ratios, [spread_dashpots(one) for one in ratios], color="#999999", linestyle="--",
              label="dashpots spread over the face")
    for number, (name, found) in enumerate((key, one) for key, one in row.items() if key.startswith("ratio_")):
        ratio, color = float(name[6:]), ("#4a7fb5", "#c0563b")[number % 2]
        closed = 1 - 1.5 * math.sin(math.atan(ratio))**2
        kept.plot([ratio] * len(found["landing"]), [one * closed for one in found["landing"].values()], "o",
                  color=color, label=f"landing, b/h = {ratio:g}")
        converged.loglog([float(one) for one in found["rocking_by_stiffness"]],
                         [abs(one - 1) for one in found["rocking_by_stiffness"].values()], "o-", color=color,
                         label=f"with its weight, b/h = {ratio:g}")
    kept.set(xlabel="b/h", ylabel="angular velocity after / before")
    converged.axhline(row["rocking_target"], color="black", linewidth=1)
    converged.set(xlabel="stiffness per area, N/m³ (b = 1 m)", ylabel="error")
    for axes in (kept, converged):
        axes.legend(fontsize=8)
    _save(figure, path)


def _save(figure, path):
    figure.tight_layout()
    figure.savefig(path, dpi=120)
    pyplot.close(figure)


def pressure(path):
    """That in the joints of the scene."""
    potential_particles.plot(str(path), patches=True, towards=(0.4, -1, 0.35), size=(1000, 640))


# Of what a row returned, and of the scene that it left.
OF_ROWS = {"housner": housner}
OF_SCENES = dict.fromkeys(("running_bond", "reduced_wall", "reduced_dome", "reduced_tunnel"), pressure)
