# SPDX-License-Identifier: MIT OR Apache-2.0
"""A wall at its limit, moved along its mechanism, with forces and the use of friction: python3
benches/equilibrium/plot.py; reads and writes out/equilibrium.
"""
import json
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

OUT, MOVED = Path("out/equilibrium"), 0.8

walls = json.loads((OUT / "wall.json").read_text())
picture, all_axes = plt.subplots(2, len(walls), figsize=(11, 7), layout="constrained")
for (name, wall), axes in zip(walls.items(), all_axes.T):
    for body in wall["bodies"]:
        half = np.array([0.5 * body["length"], 0.5])
        centre, linear = np.array(body["centre"])[[0, 2]], np.array(body["linear"])[[0, 2]]
        corners = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]]) * half
        # A rotation by omega about y moves (x, z) by omega (z, -x).
        turned = corners + MOVED * body["angular"][1] * corners[:, ::-1] * [1, -1]
        axes[0].add_patch(plt.Polygon(corners + centre, facecolor="#e8e2d6", edgecolor="#555555", linewidth=0.6))
        axes[1].add_patch(
            plt.Polygon(turned + centre + MOVED * linear, facecolor="#e8e2d6", edgecolor="#555555", linewidth=0.6))
    colours = matplotlib.colormaps["plasma_r"]
    largest = max(np.linalg.norm(force) for contact in wall["contacts"] for _, force in contact["corners"])
    for contact in wall["contacts"]:
        for at, force in contact["corners"]:
            if at[1] == 0:
                end = np.array(at)[[0, 2]] + 1.5 * np.array(force)[[0, 2]] / largest
                axes[0].plot(*zip(np.array(at)[[0, 2]], end), color=colours(min(1.0, contact["use"])), linewidth=1.6)
    axes[0].set_title(f"{name}: load factor {wall['factor']:.4f}")
    axes[1].set_title("its mechanism")
    for one in axes:
        one.set_aspect("equal")
        one.autoscale_view()
        one.axis("off")
scale = plt.cm.ScalarMappable(plt.Normalize(0, 1), matplotlib.colormaps["plasma_r"])
picture.colorbar(scale, ax=all_axes[0], label="friction used", shrink=0.8)
picture.savefig(OUT / "equilibrium.png", dpi=110)
