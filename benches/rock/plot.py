# SPDX-License-Identifier: MIT OR Apache-2.0
"""The slope that the benchmark of slicing cuts, its blocks moved apart a little: python3 benches/rock/plot.py; reads
and writes out/rock.
"""
import json
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from mpl_toolkits.mplot3d.art3d import Poly3DCollection

OUT, APART = Path("out/rock"), 1.12
COLOURS = {-1: "#d9d2c5", 0: "#c26a4a", 1: "#5b7fa6", 2: "#7d9b5f"}
LABELS = {-1: "outside", 0: "bedding, dip 35° to the east", 1: "joints, 80° to the west", 2: "joints, 85° to the north"}

faces = json.loads((OUT / "slope.json").read_text())
centre = np.mean([face["centroid"] for face in faces], axis=0)
light = np.array([0.5, -0.6, 0.65]) / np.linalg.norm([0.5, -0.6, 0.65])
polygons, colours = [], []
for face in faces:
    corners, middle = np.array(face["corners"]), np.array(face["centroid"])
    polygons.append(corners + (APART - 1.0) * (middle - centre))
    normal = sum(np.cross(corners[i] - corners[0], corners[i + 1] - corners[0]) for i in range(1, len(corners) - 1))
    shade = 0.55 + 0.45 * max(0.0, normal @ light / (np.linalg.norm(normal) or 1.0))
    colours.append(shade * np.array(matplotlib.colors.to_rgb(COLOURS[face["set"]])))
picture = plt.figure(figsize=(8, 6.5), layout="constrained")
axes = picture.add_subplot(projection="3d", proj_type="persp")
axes.add_collection3d(Poly3DCollection(polygons, facecolors=colours, edgecolors="#3b3b3b", linewidths=0.3))
every = np.concatenate(polygons)
axes.set(xlim=(every[:, 0].min(), every[:, 0].max()), ylim=(every[:, 1].min(), every[:, 1].max()),
         zlim=(every[:, 2].min(), every[:, 2].max()), xlabel="east, m", ylabel="north, m", zlabel="up, m")
axes.set_aspect("equal")
axes.view_init(elev=22, azim=-48)
axes.legend(handles=[plt.Rectangle((0, 0), 1, 1, color=COLOURS[one], label=LABELS[one]) for one in COLOURS],
            loc="upper right", fontsize=8)
picture.savefig(OUT / "rock.png", dpi=100)
