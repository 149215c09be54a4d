# SPDX-License-Identifier: MIT OR Apache-2.0
"""The figures of docs/theory.md.

    cargo build --release --example solve_pairs
    python3 docs/figures/theory.py [target/release/examples/solve_pairs]

Writes docs/pictures/dual_path.png and docs/pictures/gap_tolerance.png.
"""

import json
import math
import statistics
import subprocess
import sys
from pathlib import Path

try:
    import matplotlib
    import numpy as np
except ImportError:
    sys.exit("theory.py: no figures without matplotlib and numpy (Debian: python3-matplotlib, python3-numpy)")

matplotlib.use("Agg")
import matplotlib.pyplot as plt

ROOT = Path(__file__).resolve().parents[2]
PICTURES = ROOT / "docs" / "pictures"
PAIRS = ROOT / "tests" / "data" / "pairs.jsonl"
BLUE, RED, GREY, GREEN = "#0b3c8c", "#c2182f", "#666666", "#2e8b3d"


class Particle:
    """A potential particle of the plane (paper eq. 2), placed in the world."""

    def __init__(self, normals, offsets, r, k, shadow, centre, angle):
        turn = np.array([[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]])
        normals = np.array(normals, dtype=float)
        self.normals = (normals / np.linalg.norm(normals, axis=1)[:, None]) @ turn.T
        self.centre = np.array(centre, dtype=float)
        self.offsets = np.array(offsets, dtype=float)
        self.planes, self.sphere = (1 - k) / r**2, k / shadow**2

    def derivatives(self, x):
        """S, its gradient and its Hessian."""
        y = x - self.centre
        depth = self.normals @ y - self.offsets
        on = depth > 0
        normals, depth = self.normals[on], depth[on]
        value = self.planes * depth @ depth + self.sphere * y @ y
        gradient = 2 * (self.planes * normals.T @ depth + self.sphere * y)
        return value, gradient, 2 * (self.planes * normals.T @ normals + self.sphere * np.eye(2))

    def values(self, x, y):
        """S on a grid."""
        at = np.stack([x - self.centre[0], y - self.centre[1]])
        depth = np.maximum(np.tensordot(self.normals, at, axes=1) - self.offsets[:, None, None], 0)
        return self.planes * (depth**2).sum(axis=0) + self.sphere * (at**2).sum(axis=0)


def minimiser(a, b, u, x):
    """Minimum of (1−u)·S_A + u·S_B by Newton's method with halved steps."""
    total = lambda x: (1 - u) * a.derivatives(x)[0] + u * b.derivatives(x)[0]
    for _ in range(200):
        (_, g_a, h_a), (_, g_b, h_b) = a.derivatives(x), b.derivatives(x)
        step = -np.linalg.solve((1 - u) * h_a + u * h_b, (1 - u) * g_a + u * g_b)
        before, share = total(x), 1.0
        while total(x + share * step) > before and share > 1e-12:
            share /= 2
        x = x + share * step
        if np.linalg.norm(step) < 1e-13:
            break
    return x


def where(a, b, beyond, x):
    """The point of the path at which `beyond` changes its sign from false to true, by bisection in logit u."""
    low, high = -30.0, 30.0
    for _ in range(200):
        middle = 0.5 * (low + high)
        u = 1 / (1 + math.exp(-middle))
        x = minimiser(a, b, u, x)
        low, high = (low, middle) if beyond(x) else (middle, high)
    return x, u


def dual_path():
    a = Particle([(1, 0), (-1, 0), (0, 1), (0, -1)], [0.75, 0.75, 0.55, 0.55], 0.25, 0.15, 1.2, (0.0, 0.0), 0.35)
    hexagon = [(math.cos(t), math.sin(t)) for t in np.radians([90, 210, 330])]
    b = Particle(hexagon, [0.35] * 3, 0.3, 0.15, 1.0, (1.42, 0.62), 0.1)
    s_a, s_b = (lambda x: a.derivatives(x)[0]), (lambda x: b.derivatives(x)[0])
    middle = 0.5 * (a.centre + b.centre)
    p2, _ = where(a, b, lambda x: s_b(x) < 1, middle)
    p3, u3 = where(a, b, lambda x: s_a(x) > s_b(x), middle)
    p1, _ = where(a, b, lambda x: s_a(x) > 1, middle)
    logits = np.linspace(-16, 16, 1200)
    path, x = [], a.centre
    for u in 1 / (1 + np.exp(-logits)):
        x = minimiser(a, b, u, x)
        path.append(x)
    path = np.array(path)

    figure, (left, right) = plt.subplots(1, 2, figsize=(11, 4.6), gridspec_kw={"width_ratios": [1.35, 1]})
    x, y = np.meshgrid(np.linspace(-1.25, 2.45, 700), np.linspace(-1.05, 1.65, 600))
    for particle, colour, name in [(a, BLUE, "A"), (b, RED, "B")]:
        s = np.sqrt(particle.values(x, y))
        left.contour(x, y, s, levels=[0.25, 0.5, 0.75, 1.25, 1.5], colors=colour, linewidths=0.6, alpha=0.45)
        left.contour(x, y, s, levels=[1], colors=colour, linewidths=2)
        left.plot(*particle.centre, "o", color=colour, markersize=5)
        left.annotate(name, particle.centre, textcoords="offset points", xytext=(-4, -15), color=colour, fontsize=12)
    left.plot(path[:, 0], path[:, 1], color="black", linewidth=1.6)
    for point, name, marker, shift in [(p2, "P2", "s", (-22, -5)), (p3, "P3", "D", (-8, 9)), (p1, "P1", "^", (7, 1))]:
        left.plot(*point, marker, color="black", markersize=6)
        left.annotate(name, point, textcoords="offset points", xytext=shift, fontsize=11)
    left.set_aspect("equal")
    left.set_title("s = 0.25, 0.5 … 1.5 of A and of B (bold: the surfaces), and the dual path", fontsize=10)

    weights = 1 / (1 + np.exp(-logits))
    values = np.sqrt([[s_a(point), s_b(point)] for point in path])
    dual = [(1 - u) * s_a(point) + u * s_b(point) for u, point in zip(weights, path)]
    right.plot(weights, values[:, 0], color=BLUE, label="s_A on the path")
    right.plot(weights, values[:, 1], color=RED, label="s_B on the path")
    right.plot(weights, np.sqrt(dual), color="black", label="√((1−u)·S_A + u·S_B), the dual value")
    right.axhline(1, color=GREY, linewidth=0.6)
    right.plot(u3, math.sqrt(s_a(p3)), "D", color="black", markersize=6)
    right.annotate("P3", (u3, math.sqrt(s_a(p3))), textcoords="offset points", xytext=(-4, 10), fontsize=11)
    right.set_xlim(0, 1)
    right.set_ylim(0, 1.7)
    right.set_xlabel("weight u of B")
    right.set_title("the dual value is largest where s_A = s_B", fontsize=10)
    right.legend(fontsize=9, loc="lower center")
    figure.tight_layout()
    figure.savefig(PICTURES / "dual_path.png", dpi=110)


def answers(program, tolerance):
    """Midway of every pair: (gap, |s − s*|, both relative to the larger of s and 1, whether in extended precision)."""
    command = [program, "--formulation", "midway", "--gap-tolerance", repr(tolerance), str(PAIRS)]
    output = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    with open(PAIRS) as file:
        truths = [json.loads(line)["truth"]["s4"] for line in file]
    for line, truth in zip(output.splitlines(), truths):
        midway = json.loads(line)["midway"]
        s, size = midway["s"], max(float(truth), 1.0)
        # The truth has more digits than a double: the difference is taken before it is rounded.
        error = abs(float(s - float(truth)) - (float_rest(truth)))
        yield midway["gap"] / size, error / size, "extended" in midway["path"]


def float_rest(decimal):
    """What a decimal number has beyond its nearest double."""
    from fractions import Fraction

    return float(Fraction(decimal) - Fraction(float(decimal)))


def gap_tolerance(program):
    tolerances = [10.0 ** (-exponent / 2) for exponent in range(18, 33)]
    rows = [list(answers(program, tolerance)) for tolerance in tolerances]
    figure, (left, right) = plt.subplots(1, 2, figsize=(11, 4.2), gridspec_kw={"width_ratios": [1.6, 1]})
    for extended, colour, name in [(False, BLUE, "doubles"), (True, RED, "extended tier")]:
        def of(pick, column):
            found = [[max(row[column], 1e-17) for row in answers if row[2] == extended] for answers in rows]
            return [pick(values) if values else math.nan for values in found]

        left.plot(tolerances, of(max, 0), "." "-", color=colour, label=f"largest gap, {name}")
        left.plot(tolerances, of(statistics.median, 0), "." "--", color=colour, label=f"median gap, {name}")
        left.plot(tolerances, of(max, 1), "." ":", color=colour, label=f"largest error, {name}")
        right.plot(tolerances, [sum(row[2] == extended for row in answers) for answers in rows], color=colour,
                   marker=".", label=name)
    left.plot(tolerances, tolerances, color=GREY, linewidth=0.6)
    left.annotate("gap = tolerance", (2e-10, 2e-10), color=GREY, fontsize=9, xytext=(4, -12),
                  textcoords="offset points")
    left.set_yscale("log")
    left.set_ylim(1e-17, 1e-5)
    left.set_ylabel("relative to max(s, 1)")
    left.legend(fontsize=8, loc="upper right")
    right.set_ylabel(f"answers of {len(rows[0])}")
    right.legend(fontsize=9)
    for axes in (left, right):
        axes.set_xscale("log")
        axes.invert_xaxis()
        axes.set_xlabel("gap_tolerance")
    figure.tight_layout()
    figure.savefig(PICTURES / "gap_tolerance.png", dpi=110)


if __name__ == "__main__":
    program = sys.argv[1] if len(sys.argv) > 1 else str(ROOT / "target" / "release" / "examples" / "solve_pairs")
    dual_path()
    gap_tolerance(program)
