# SPDX-License-Identifier: MIT OR Apache-2.0
"""How far can n blocks lean over the edge of a table? By half of 1 + 1/2 + ... + 1/n of a length.

The block on top leans over the next by 1/2 at most, the next by 1/4, and so on: each time the blocks above are in
balance on the edge (Coffin 1923; Johnson 1955, Gardner 1964 for the sum). The stack is built with all these steps times
a factor, and the largest factor at which it stands is bracketed by halving.
"""

from report import halved, row, target, worst
from block_scene import Scene, box_corners, turn_about_y

TITLE = "n blocks over the edge of a table"
LENGTH, WIDTH, HEIGHT = 1.0, 0.5, 0.25  # m
COUNTS = tuple(range(2, 9))
BRACKET = 5e-4  # of the factor
FALLEN = 0.01  # radians
PATIENCE = 1.5  # s; what stands rests after a tenth of that


def overhang(count):
    """Of the topmost edge, lengths."""
    return 0.5 * sum(1.0 / i for i in range(1, count + 1))


def steps(count):
    """By how much each block leans over what is below it, from the bottom to the top, lengths."""
    return [0.5 / i for i in range(count, 0, -1)]


def stands(count, factor):
    """Whether the stack with all steps times the factor stands in YADE."""
    scene = Scene(size=HEIGHT, load=count * LENGTH * WIDTH * HEIGHT)
    # The edge of the table is at x = 0.
    scene.block(box_corners(4.0 * LENGTH, 2.0, HEIGHT), fixed=True, position=(-2.0 * LENGTH, 0, -0.5 * HEIGHT))
    reach, blocks = 0.0, []
    for level, step in enumerate(steps(count)):
        reach += factor * step * LENGTH
        place = (reach - 0.5 * LENGTH, 0.0, (level + 0.5) * HEIGHT)
        blocks.append(scene.block(box_corners(LENGTH, WIDTH, HEIGHT), position=place))
    scene.start(friction=30.0)
    return scene.comes_to_rest(PATIENCE, every=50.0,
                               fails=lambda: max(abs(turn_about_y(one)) for one in blocks) >= FALLEN)


def largest(count, bracket=BRACKET, low=0.98, high=1.02):
    """(largest overhang in lengths, half the width of its bracket)."""
    if not stands(count, low) or stands(count, high):
        return float("nan"), float("nan")
    low, high = halved(low, high, bracket, lambda factor: not stands(count, factor))
    return 0.5 * (low + high) * overhang(count), 0.5 * (high - low) * overhang(count)


def run(note, short):
    """Two to eight blocks, or three."""
    rows, counts = [], (3,) if short else COUNTS
    for count in counts:
        found, half = largest(count)
        rows.append(row(f"largest overhang of {count} blocks", overhang(count), found, "lengths"))
        rows[-1]["bracket"] = 2.0 * half
        note(sum(one for one in counts if one <= count) / sum(counts))
    aim = target("overhang: error, lengths", 5e-3, worst(rows))
    data = {"counts": list(counts), "steps": steps(counts[-1])}
    return {"title": TITLE, "rows": rows, "targets": [aim], "data": data}
