# SPDX-License-Identifier: MIT OR Apache-2.0
"""Pictures of an answer of limit analysis: forces at corners in the colour of the friction used, and the mechanism as
arrows and as displaced blocks.
"""
import dataclasses
import os

import numpy as np

# Lengths in the picture, over the mean size of a block: of the largest force, and of the way of the fastest corner.
FORCE, WAY = 0.8, 0.4
# Slower than this part of the fastest, a block has no arrow.
STILL = 0.01
STONE, HELD, EDGE, ARROW = (0.91, 0.886, 0.839), (0.8, 0.8, 0.8), "#555555", "#b03a2e"


@dataclasses.dataclass(frozen=True)
class Block:
    """A body: faces [(m, 3)] and centre, world frame; linear and angular velocity; whether it is held; its colour."""
    faces: list
    centre: np.ndarray
    linear: np.ndarray
    angular: np.ndarray
    held: bool = False
    colour: tuple = STONE

    def moved(self, way):
        """Faces after this way, to first order."""
        return [face + way * (self.linear + np.cross(self.angular, face - self.centre)) for face in self.faces]


def plot(found, blocks, file, towards):
    """Draws an answer of limit analysis (a limit_state.Equilibrium) for these blocks to a PNG, PDF or SVG."""
    stands = "it stands" if found.question == "stands" else f"factor {found.factor:.4g}"
    used = found.used[found.contact_of_corner]
    save([(stands if found.stands else "it falls", blocks, found.corners, found.forces, used)], file, towards)


def save(answers, file, towards):
    """The picture of these answers, written to a file whole or not at all."""
    from .files import written
    drawn = picture(answers, towards, width=8)
    with written(file) as out:
        drawn.savefig(out, dpi=110, format=os.path.splitext(file)[1][1:] or None)


def picture(answers, towards=(0, -1, 0), width=5.5):
    """A figure with a column for each answer (title, blocks, corners (n, 3), forces (n, 3), friction used (n,)): above
    the forces, below the mechanism, if there are any. towards: from the scene to the eye; width: of a column, inches.
    """
    from matplotlib import cm, colors
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure
    axes_of_view = view(towards)
    forced = any(np.any(forces) for _, _, _, forces, _ in answers)
    moving = any(np.any(block.linear) or np.any(block.angular) for _, blocks, *_ in answers for block in blocks)
    rows = [draw for draw, wanted in ((draw_forces, forced), (draw_mechanism, moving)) if wanted] or [draw_forces]
    free = np.vstack([face for block in answers[0][1] if not block.held for face in block.faces]) @ axes_of_view[:2].T
    high = width * np.clip(np.ptp(free[:, 1]) / np.ptp(free[:, 0]), 0.3, 0.9) + 0.4
    figure = Figure((width * len(answers) + 0.8 * forced, high * len(rows)), layout="constrained")
    FigureCanvasAgg(figure)
    scale = cm.ScalarMappable(colors.Normalize(0, 1), "plasma_r")
    all_axes = figure.subplots(len(rows), len(answers), squeeze=False)
    for number, (draw, row) in enumerate(zip(rows, all_axes)):
        for axes, answer in zip(row, answers):
            draw(axes, answer, axes_of_view, scale)
            axes.set_title(answer[0] if number == 0 else "its mechanism")
            axes.set_aspect("equal")
            axes.axis("off")
        if draw is draw_forces and forced:
            figure.colorbar(scale, ax=row, label="friction used", shrink=0.8)
    return figure


def view(towards):
    """Right, up and the direction to the eye, as rows."""
    towards = np.asarray(towards, float) / np.linalg.norm(towards)
    right = np.cross((0, 0, 1), towards) if abs(towards[2]) < 0.999 else np.array([1.0, 0, 0])
    right /= np.linalg.norm(right)
    return np.stack([right, np.cross(towards, right), towards])


def draw_forces(axes, answer, axes_of_view, scale):
    """Each corner's force as a line from it, the largest FORCE sizes of a block long."""
    _, blocks, corners, forces, used = answer
    _draw_blocks(axes, blocks, 0.0, axes_of_view)
    length = FORCE * _size(blocks) / (np.linalg.norm(forces, axis=1).max(initial=0.0) or 1.0)
    for start, end, share in zip(corners @ axes_of_view[:2].T, (corners + length * forces) @ axes_of_view[:2].T, used):
        axes.plot(*zip(start, end), color=scale.to_rgba(min(share, 1.0)), linewidth=1.6, zorder=3)


def draw_mechanism(axes, answer, axes_of_view, scale):
    """Blocks moved along the mechanism, with the velocities of their centres."""
    blocks = answer[1]
    way = WAY * _size(blocks)
    _draw_blocks(axes, blocks, way, axes_of_view)
    fastest = max(np.linalg.norm(block.linear) for block in blocks)
    moving = [block for block in blocks if np.linalg.norm(block.linear) > STILL * fastest]
    if moving:
        at = np.array([block.centre for block in moving]) @ axes_of_view[:2].T
        to = way * np.array([block.linear for block in moving]) @ axes_of_view[:2].T
        axes.quiver(*at.T, *to.T, angles="xy", scale_units="xy", scale=1, color=ARROW, width=0.004, zorder=3)


def _draw_blocks(axes, blocks, way, axes_of_view):
    from matplotlib.collections import PolyCollection
    faces, colours, free = [], [], []
    for block in blocks:
        for face in block.moved(way):
            normal = np.cross(face[1] - face[0], face[2] - face[0])
            light = abs(normal @ axes_of_view[2]) / (np.linalg.norm(normal) or 1.0)
            faces.append(face @ axes_of_view.T)
            colours.append((0.7 + 0.3 * light) * np.array(HELD if block.held else block.colour))
            free += [] if block.held else [faces[-1][:, :2]]
    # The farthest first.
    order = np.argsort([face[:, 2].mean() for face in faces])
    axes.add_collection(PolyCollection([faces[i][:, :2] for i in order], facecolors=[colours[i] for i in order],
                                       edgecolors=EDGE, linewidths=0.6))
    low, high = np.vstack(free).min(axis=0), np.vstack(free).max(axis=0)
    margin = 0.05 * (high - low).max()
    axes.set_xlim(low[0] - margin, high[0] + margin)
    axes.set_ylim(low[1] - margin, high[1] + margin)


def _size(blocks):
    return np.mean([np.ptp(np.vstack(block.faces), axis=0).max() for block in blocks if not block.held])
