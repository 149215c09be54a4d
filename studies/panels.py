# SPDX-License-Identifier: MIT OR Apache-2.0
"""A figure of several states of one scene side by side, all seen by the same camera."""

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

from potential_particles.output.drawn import floor
from potential_particles.output.picture import render

PANEL_PIXELS = (560, 620)  # width, height
DOTS_PER_INCH = 150


def save_panels(path, states, ground, view, title, note):
    """states: list of (caption, Triangles of the bodies); ground: half the width of the floor at z = 0, m; writes a
    PNG.
    """
    width, height = PANEL_PIXELS
    inches = (len(states) * width / DOTS_PER_INCH, (height + 150) / DOTS_PER_INCH)
    figure, axes = plt.subplots(1, len(states), figsize=inches, dpi=DOTS_PER_INCH, squeeze=False)
    for letter, axis, (caption, bodies) in zip("abcdefgh", axes[0], states):
        axis.imshow(render(bodies, floor(0.0, ground), view, width, height), interpolation="antialiased")
        axis.set_axis_off()
        axis.set_title(f"({letter}) {caption}", fontsize=9.5, y=-0.06)
    figure.suptitle(title, fontsize=11, y=0.985)
    figure.text(0.5, 0.012, note, ha="center", va="bottom", fontsize=7.5, color="0.35")
    figure.subplots_adjust(left=0.0, right=1.0, bottom=0.105, top=0.93, wspace=0.02)
    figure.savefig(path)
    plt.close(figure)
