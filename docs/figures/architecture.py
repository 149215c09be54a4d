#!/usr/bin/python3
# SPDX-License-Identifier: MIT OR Apache-2.0
"""The picture of docs/architecture.md: the parts of the repository and the way of a call.

    docs/figures/architecture.py        # writes docs/pictures/architecture.svg
"""
from html import escape
from pathlib import Path

PICTURE = Path(__file__).resolve().parents[1] / "pictures/architecture.svg"
WIDTH, HEIGHT = 960, 640
USER, PLUGIN, LIBRARY, CALL = "#eceff1", "#fff3e0", "#e8f0fe", "#d2e3fc"

parts = []


def text(x, y, words, size=13, weight="normal", colour="#202124", anchor="middle"):
    parts.append(
        f'<text x="{x}" y="{y}" font-size="{size}" font-weight="{weight}" fill="{colour}" text-anchor="{anchor}">{escape(words)}</text>'
    )


def box(x, y, width, height, title, *lines, fill=LIBRARY):
    parts.append(f'<rect x="{x}" y="{y}" width="{width}" height="{height}" rx="6" fill="{fill}" stroke="#5f6368"/>')
    text(x + width / 2, y + 20, title, weight="bold")
    for i, line in enumerate(lines):
        text(x + width / 2, y + 39 + 16 * i, line, size=12, colour="#3c4043")


def frame(x, y, width, height, title):
    parts.append(
        f'<rect x="{x}" y="{y}" width="{width}" height="{height}" rx="8" fill="none" stroke="#9aa0a6" stroke-dasharray="5 4"/>'
    )
    text(x + 12, y + 19, title, weight="bold", colour="#5f6368", anchor="start")


def arrow(*points, label=None, at=None):
    path = " ".join(f"{x},{y}" for x, y in points)
    parts.append(f'<polyline points="{path}" fill="none" stroke="#202124" stroke-width="1.3"/>')
    (before_x, before_y), (x, y) = points[-2:]
    length = abs(x - before_x) + abs(y - before_y)  # along an axis
    u, v = (x - before_x) / length, (y - before_y) / length
    parts.append(
        f'<polygon points="{x},{y} {x - 9 * u + 4 * v},{y - 9 * v + 4 * u} {x - 9 * u - 4 * v},{y - 9 * v - 4 * u}" fill="#202124"/>'
    )
    if label:
        text(*at, label, size=11, colour="#5f6368")


box(40, 16, 400, 46, "A YADE script", "bodies, engines, laws: YADE's own", fill=USER)
box(620, 16, 140, 46, "C, C++", "header, pkg-config", fill=USER)
box(790, 16, 140, 46, "Rust", "a crate", fill=USER)

frame(20, 84, 440, 196, "The plugin: yade-glue/ (C++, Python)")
box(40, 114, 400, 44, "Python, with python/", "shapes, packing, rock; boundaries, output, ranks", fill=PLUGIN)
box(40, 178, 88, 88, "shape", "the body's", "particle", fill=PLUGIN)
box(136, 178, 88, 88, "bounds", "boxes for", "the collider", fill=PLUGIN)
box(232, 178, 100, 88, "loop, pair", "what a step", "and a pair keep", fill=PLUGIN)
box(340, 178, 100, 88, "contact", "functors:", "ScGeom,", "KnKsPhys", fill=PLUGIN)

frame(20, 300, 920, 330, "The library: src/ (Rust)")
box(40, 330, 880, 46, "capi: the C interface",
    "checks arguments, stops panics, converts; include/potential_particles.h is made from it")
box(40, 402, 150, 66, "particle, pose", "shapes, checked once", "two bodies: a pair", fill=CALL)
box(226, 402, 150, 66, "pair: separation", "tests that reject", "bodies apart", fill=CALL)
box(412, 402, 170, 66, "model, solver", "Newton in doubles,", "then 32 digits", fill=CALL)
box(618, 402, 130, 66, "bounds", "gap of s, error", "of the point", fill=CALL)
box(784, 402, 136, 66, "contact", "point, normal,", "overlap, state", fill=CALL)
for left, right in (190, 226), (376, 412), (582, 618), (748, 784):
    arrow((left, 435), (right, 435))
arrow((301, 468), (301, 486), (852, 486), (852, 468), label="rejected: separated, with a lower bound on the distance",
      at=(580, 500))
box(40, 520, 150, 92, "linalg", "numbers of 16 and", "32 digits, lanes,", "3×3 factors")
box(206, 520, 170, 92, "boundary", "planes and triangles", "as boundaries")
box(392, 520, 170, 92, "reference", "the paper's cone", "programs, to compare")
box(578, 520, 170, 92, "section, surface", "contact area,", "meshes")
box(764, 520, 156, 92, "packing", "bodies in containers")

arrow((360, 62), (360, 114))
arrow((283, 158), (283, 178))
arrow((390, 266), (390, 330), label="pp_contact_…", at=(434, 294))
arrow((690, 62), (690, 330))
arrow((860, 62), (860, 300))
arrow((115, 376), (115, 402))
arrow((852, 402), (852, 376))

style = 'font-family="DejaVu Sans, Arial, sans-serif"'
PICTURE.write_text("\n".join([
    f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" width="{WIDTH}" height="{HEIGHT}" {style}>',
    f'<rect width="{WIDTH}" height="{HEIGHT}" fill="white"/>', *parts, "</svg>"
]) + "\n")
