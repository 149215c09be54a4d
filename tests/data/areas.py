#!/usr/bin/env python3
"""Contact areas to 40 digits, by another way than the library's: the answers in areas.jsonl.

    python3 tests/data/areas.py tests/data/areas.jsonl > answers.jsonl

Every input line keeps what it has and gets "area" anew: the area of the cut of both particles with the plane through
the contact point at right angles to the normal, exact for the given doubles. Needs mpmath.

Where the edge of a cut changes its conic is found for each plane by itself: along the line in which plane and section
meet, S is convex and piecewise quadratic, and both its roots on the line are such points. Sorted by angle around the
contact point, those of both particles divide the intersection into sectors in which each edge is one conic. Crossings
are found by halving, and a sector's area by mapping its conic to a circle.
"""
import json
import sys
from bisect import bisect_left

from mpmath import asin, atan2, cos, mp, mpf, nstr, pi, sin, sqrt

mp.dps = 120

# Samples of each arc between which a crossing is looked for.
SAMPLES = 16
# Halvings of a bracket.
HALVINGS = 180
# Angles and determinants that are nothing but rounding.
TINY = mpf(10) ** -90


def vector(numbers):
    return [mpf(x) for x in numbers]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def perp(a, b):
    return a[0] * b[1] - a[1] * b[0]


def unit(a):
    length = sqrt(dot(a, a))
    return [x / length for x in a]


class Cut:
    """S of one particle in the section, origin at the contact point."""

    def __init__(self, particle, rotation, branch, axes):
        r, k, shadow = (mpf(particle[name]) for name in "rkR")
        local = lambda v: [sum(rotation[i][j] * v[i] for i in range(3)) for j in range(3)]
        x, (u, v) = local(branch), [local(axis) for axis in axes]
        self.weight = (1 - k) / r**2 if k < 1 else mpf(0)
        sphere = k / shadow**2 if k > 0 else mpf(0)
        self.constant = sphere * dot(x, x) - 1
        self.linear = [sphere * dot(x, u), sphere * dot(x, v)]
        self.quadratic = [sphere * dot(u, u), sphere * dot(u, v), sphere * dot(v, v)]
        self.lines = []
        if self.weight:
            for n, d in zip(particle["n"], particle["d"]):
                n = vector(n)
                self.lines.append((dot(n, x) - mpf(d), dot(n, u), dot(n, v)))

    def conic(self, active):
        """(m, b, c) with S − 1 = mᵢⱼyᵢyⱼ + 2b·y + c while these lines count."""
        m, b, c = list(self.quadratic), list(self.linear), self.constant
        for i in active:
            e, g, h = self.lines[i]
            m = [m[0] + self.weight * g * g, m[1] + self.weight * g * h, m[2] + self.weight * h * h]
            b = [b[0] + self.weight * e * g, b[1] + self.weight * e * h]
            c += self.weight * e * e
        return m, b, c

    def along(self, p, e, skip=None):
        """Roots of S − 1 along p + t·e, the lower and the upper one, each with the lines that count there."""
        excess = []
        for i, (c, g, h) in enumerate(self.lines):
            excess.append((mpf(0), mpf(0)) if i == skip else (c + g * p[0] + h * p[1], g * e[0] + h * e[1]))
        ends = sorted(-v / g for v, g in excess if g)

        def active(t):
            return [i for i, (v, g) in enumerate(excess) if v + g * t > 0]

        def piece(of):
            m, b, c = self.conic(of)
            a2 = m[0] * e[0] ** 2 + 2 * m[1] * e[0] * e[1] + m[2] * e[1] ** 2
            mp_ = [m[0] * p[0] + m[1] * p[1], m[1] * p[0] + m[2] * p[1]]
            return a2, dot(b, e) + dot(mp_, e), c + 2 * dot(b, p) + dot(mp_, p)

        def value(t):
            a2, a1, a0 = piece(active(t))
            return (a2 * t + 2 * a1) * t + a0

        def slope(t):
            a2, a1, _ = piece(active(t))
            return a2 * t + a1

        def between(low, high):
            if low is None and high is None:
                return mpf(0)
            return high - 1 if low is None else low + 1 if high is None else (low + high) / 2

        end = lambda i: ends[i] if 0 <= i < len(ends) else None
        lowest = bisect_left(range(len(ends)), True, key=lambda i: slope(ends[i]) >= 0)
        a2, a1, a0 = piece(active(between(end(lowest - 1), end(lowest))))
        if (a0 - a1 * a1 / a2 if a2 > 0 else a0) >= 0:
            return None
        above = lowest + bisect_left(range(lowest, len(ends)), True, key=lambda i: value(ends[i]) >= 0)
        below = bisect_left(range(lowest), True, key=lambda i: value(ends[i]) < 0)
        roots = []
        for low, high, sign in ((below - 1, below, -1), (above - 1, above, 1)):
            of = active(between(end(low), end(high)))
            a2, a1, a0 = piece(of)
            root = sqrt(max(a1 * a1 - a2 * a0, mpf(0)))
            roots.append(((-a1 + sign * root) / a2 if a2 > 0 else -a0 / (2 * a1), of))
        return roots

    def breaks(self):
        """Angles at which the edge changes its conic."""
        angles = []
        for i, (c, g, h) in enumerate(self.lines):
            square = g * g + h * h
            if square > TINY:
                p, e = [-c * g / square, -c * h / square], unit([-h, g])
                angles += [atan2(p[1] + t * e[1], p[0] + t * e[0]) for t, _ in self.along(p, e, i) or []]
        return angles

    def active_towards(self, angle):
        return self.along([mpf(0), mpf(0)], [cos(angle), sin(angle)])[1][1]


class Arc:
    """A conic of an edge, seen from the contact point."""

    def __init__(self, cut, active):
        self.m, self.b, self.c = cut.conic(active)
        self.det = self.m[0] * self.m[2] - self.m[1] ** 2

    def distance(self, angle):
        e = [cos(angle), sin(angle)]
        a2 = self.m[0] * e[0] ** 2 + 2 * self.m[1] * e[0] * e[1] + self.m[2] * e[1] ** 2
        a1 = dot(self.b, e)
        root = sqrt(max(a1 * a1 - a2 * self.c, mpf(0)))
        return -self.c / (a1 + root) if a1 >= 0 else (root - a1) / a2

    def point(self, angle):
        rho = self.distance(angle)
        return [rho * cos(angle), rho * sin(angle)]

    def centre(self):
        return [(self.m[1] * self.b[1] - self.m[2] * self.b[0]) / self.det,
                (self.m[1] * self.b[0] - self.m[0] * self.b[1]) / self.det]

    def is_straight(self):
        return self.det <= TINY * (self.m[0] + self.m[2]) ** 2

    def to_circle(self):
        """Lower triangle l with (l·h)² = hᵀmh."""
        l0 = sqrt(self.m[0])
        return l0, self.m[1] / l0, sqrt(self.m[2] - (self.m[1] / l0) ** 2)

    def angles(self, start, end):
        """Angles of points evenly spread on the arc."""
        y0, y1 = self.point(start), self.point(end)
        shares = [mpf(i) / SAMPLES for i in range(1, SAMPLES)]
        if self.is_straight():
            points = [[a + (b - a) * t for a, b in zip(y0, y1)] for t in shares]
        else:
            o, (l0, l1, l2) = self.centre(), self.to_circle()
            on_circle = lambda y: (l0 * (y[0] - o[0]) + l1 * (y[1] - o[1]), l2 * (y[1] - o[1]))
            z0, z1 = on_circle(y0), on_circle(y1)
            radius, t0, t1 = sqrt(dot(z0, z0)), atan2(z0[1], z0[0]), atan2(z1[1], z1[0])
            t1 += 2 * pi if t1 < t0 else 0
            points = []
            for t in shares:
                t = t0 + (t1 - t0) * t
                b = radius * sin(t) / l2
                points.append([(radius * cos(t) - l1 * b) / l0 + o[0], b + o[1]])
        found = []
        for p in points:
            angle = atan2(p[1], p[0])
            while angle < start:
                angle += 2 * pi
            if angle < end:
                found.append(angle)
        return found

    def sector(self, start, end):
        y0, y1 = self.point(start), self.point(end)
        chord = [y1[0] - y0[0], y1[1] - y0[1]]
        form = self.m[0] * chord[0] ** 2 + 2 * self.m[1] * chord[0] * chord[1] + self.m[2] * chord[1] ** 2
        length = sqrt(max(form, mpf(0)))
        triangle = perp(y0, y1) / 2
        q = [self.b[0] + self.m[0] * y0[0] + self.m[1] * y0[1], self.b[1] + self.m[1] * y0[0] + self.m[2] * y0[1]]
        power = self.m[2] * q[0] ** 2 - 2 * self.m[1] * q[0] * q[1] + self.m[0] * q[1] ** 2
        if self.is_straight():
            return triangle + (length**3 / (12 * sqrt(power)) if power > 0 else 0)
        o, square = self.centre(), power / self.det
        turn = 2 * asin(min(length / (2 * sqrt(square)), mpf(1)))
        if perp(chord, [o[0] - y0[0], o[1] - y0[1]]) < 0:
            turn = 2 * pi - turn
        return triangle + square / (2 * sqrt(self.det)) * (turn - sin(turn))


def crossings(arcs, start, end):
    ahead = lambda angle: arcs[0].distance(angle) - arcs[1].distance(angle)
    inset = (end - start) * mpf(10) ** -15
    angles = {start + inset, end - inset}
    for arc in arcs:
        angles.update(arc.angles(start, end))
    angles = sorted(angles)
    found = []
    signs = [ahead(angle) > 0 for angle in angles]
    for low, high, before, after in zip(angles, angles[1:], signs, signs[1:]):
        if before != after:
            for _ in range(HALVINGS):
                middle = (low + high) / 2
                if (ahead(middle) > 0) == before:
                    low = middle
                else:
                    high = middle
            found.append(low)
    return found


def area(case):
    normal = unit(vector(case["normal"]))
    least = min(range(3), key=lambda i: abs(normal[i]))
    first = unit(cross(normal, [mpf(i == least) for i in range(3)]))
    axes = [first, cross(normal, first)]
    cuts = []
    for name in "ab":
        rotation = [vector(row) for row in case["rotation_" + name]]
        cuts.append(Cut(case[name.upper()], rotation, vector(case["branch_" + name]), axes))
    eighths = [(2 * i - 7) * pi / 8 for i in range(8)]
    angles = sorted(cuts[0].breaks() + cuts[1].breaks() + eighths)
    angles.append(angles[0] + 2 * pi)
    total = mpf(0)
    for start, end in zip(angles, angles[1:]):
        if end - start < TINY:
            continue
        arcs = [Arc(cut, cut.active_towards((start + end) / 2)) for cut in cuts]
        marks = [start] + crossings(arcs, start, end) + [end]
        for low, high in zip(marks, marks[1:]):
            middle = (low + high) / 2
            inner = arcs[0] if arcs[0].distance(middle) <= arcs[1].distance(middle) else arcs[1]
            total += inner.sector(low, high)
    return total


def main():
    with open(sys.argv[1], encoding="utf-8") as file:
        for line in file:
            case = json.loads(line)
            case["area"] = nstr(area(case), 40)
            print(json.dumps(case, separators=(",", ":")), flush=True)


if __name__ == "__main__":
    main()
