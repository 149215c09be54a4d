#!/usr/bin/env python3
"""Contacts of potential particles with planes and triangles to 40 digits, by another way than the library's.

    python3 tests/data/flats.py > tests/data/flats.jsonl

Independent of the library: S is minimised in barycentric coordinates (of a plane: along two vectors at right angles to
its normal), in arithmetic of 120 digits, by Newton's method whose line search walks from one plane's switch to the
next; on a triangle also along each edge. Every minimum is checked against the condition g.(v - x) >= 0 for the vertices
v.

One object a line: the particle {n, d, r, k, R}, its pose {pos, q}, "vertices" or "point" and "normal", all as exact
    doubles, and
the truth as decimal strings: s, and x, the point of the boundary minus pos (null for k = 0, where it may not be
    unique). Needs mpmath.
"""
import json
import random

from mpmath import mp, mpf, sqrt

mp.dps = 120
SEED = 20261122
# Stands in for k = 0 where a minimum may not be unique; s is known to its root.
LEAST_WEIGHT = mpf(10) ** -90


def dot(a, b):
    return sum((x * y for x, y in zip(a, b)), mpf(0))


def plus(a, b, share=1):
    return [x + share * y for x, y in zip(a, b)]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def rotation(q):
    w, x, y, z = (mpf(c) for c in q)
    t = 2 / (w * w + x * x + y * y + z * z)
    return [
        [1 - t * (y * y + z * z), t * (x * y - w * z), t * (x * z + w * y)],
        [t * (x * y + w * z), 1 - t * (x * x + z * z), t * (y * z - w * x)],
        [t * (x * z - w * y), t * (y * z + w * x), 1 - t * (x * x + y * y)],
    ]


class Scale:
    """S about the centre, in world axes."""

    def __init__(self, particle, q):
        turn = rotation(q)
        self.normals = [[dot(row, n) for row in turn] for n in [[mpf(c) for c in n] for n in particle["n"]]]
        self.offsets = [mpf(d) for d in particle["d"]]
        k = mpf(particle["k"])
        self.w = (1 - k) / mpf(particle["r"]) ** 2 if k < 1 else mpf(0)
        self.m = k / mpf(particle["R"]) ** 2 if k > 0 else LEAST_WEIGHT

    def depths(self, x):
        return [dot(n, x) - d for n, d in zip(self.normals, self.offsets)]

    def value(self, x):
        return self.w * sum((t * t for t in self.depths(x) if t > 0), mpf(0)) + self.m * dot(x, x)

    def gradient(self, x):
        g = [2 * self.m * c for c in x]
        for n, t in zip(self.normals, self.depths(x)):
            if t > 0:
                g = plus(g, n, 2 * self.w * t)
        return g

    def curvature(self, x, a, b):
        on = [n for n, t in zip(self.normals, self.depths(x)) if t > 0]
        return 2 * self.w * sum((dot(n, a) * dot(n, b) for n in on), mpf(0)) + 2 * self.m * dot(a, b)

    def to_least(self, x, v):
        """The step along v at which S is least, from one switch of a plane to the next."""
        rates = [dot(n, v) for n in self.normals]
        depths = self.depths(x)
        switches = sorted(-t / rate for t, rate in zip(depths, rates) if rate != 0 and -t / rate > 0)
        begin = mpf(0)
        for end in switches + [None]:
            middle = (begin + end) / 2 if end is not None else begin + 1
            on = [(t, rate) for t, rate in zip(depths, rates) if t + middle * rate > 0]
            slope = 2 * self.w * sum((t * rate for t, rate in on), mpf(0)) + 2 * self.m * dot(x, v)
            curvature = 2 * self.w * sum((rate * rate for _, rate in on), mpf(0)) + 2 * self.m * dot(v, v)
            least = max(-slope / curvature, begin)
            if end is None or least <= end:
                return least
            begin = end

    def least(self, x, ways):
        """The least S at x plus any combination of one or two vectors."""
        for _ in range(400):
            g = self.gradient(x)
            slope = [dot(g, way) for way in ways]
            h = [[self.curvature(x, a, b) for b in ways] for a in ways]
            if len(ways) == 1:
                shares = [-slope[0] / h[0][0]]
            else:
                determinant = h[0][0] * h[1][1] - h[0][1] * h[1][0]
                shares = [
                    (h[0][1] * slope[1] - h[1][1] * slope[0]) / determinant,
                    (h[1][0] * slope[0] - h[0][0] * slope[1]) / determinant,
                ]
            v = [mpf(0)] * 3
            for share, way in zip(shares, ways):
                v = plus(v, way, share)
            whole = plus(x, v)
            on, then = [[t > 0 for t in self.depths(y)] for y in (x, whole)]
            if on == then or dot(v, v) <= mpf(10) ** -140 * dot(x, x):
                return whole
            x = plus(x, v, self.to_least(x, v))
        raise ArithmeticError("no minimum after 400 steps")


def on_plane(scale, point, normal):
    axis = min(range(3), key=lambda i: abs(normal[i]))
    first = cross(normal, [mpf(i == axis) for i in range(3)])
    second = cross(normal, first)
    ways = [[c / sqrt(dot(way, way)) for c in way] for way in (first, second)]
    foot = plus([mpf(0)] * 3, normal, dot(normal, point) / dot(normal, normal))
    return scale.least(foot, ways)


def on_triangle(scale, vertices):
    a, b, c = vertices
    normal = cross(plus(b, a, -1), plus(c, a, -1))
    x = on_plane(scale, a, normal)
    inside = all(
        dot(cross(plus(q, p, -1), plus(x, p, -1)), normal) >= 0 for p, q in ((a, b), (b, c), (c, a))
    )
    if not inside:
        found = []
        for p, q in ((a, b), (b, c), (c, a)):
            way = plus(q, p, -1)
            y = scale.least(p, [way])
            share = min(max(dot(plus(y, p, -1), way) / dot(way, way), mpf(0)), mpf(1))
            y = plus(p, way, share)
            found.append((scale.value(y), y))
        x = min(found, key=lambda pair: pair[0])[1]
    g = scale.gradient(x)
    longest = max(sqrt(dot(plus(v, x, -1), plus(v, x, -1))) for v in vertices)
    least = min(dot(g, plus(v, x, -1)) for v in vertices)
    assert least >= -mpf(10) ** -50 * (1 + longest) * (1 + sqrt(dot(g, g))), least
    return x


def solve(case):
    scale = Scale(case["A"], case["q"])
    about = [mpf(c) for c in case["pos"]]

    def relative(point):
        return plus([mpf(c) for c in point], about, -1)

    if "vertices" in case:
        x = on_triangle(scale, [relative(v) for v in case["vertices"]])
    else:
        x = on_plane(scale, relative(case["point"]), [mpf(c) for c in case["normal"]])
    return sqrt(scale.value(x)), x


def random_direction(rng):
    while True:
        v = [rng.uniform(-1, 1) for _ in range(3)]
        length = sum(c * c for c in v) ** 0.5
        if 0.1 < length <= 1:
            return [c / length for c in v]


def polyhedron(rng, planes, r, k, long_normals=False):
    """Random planes at 0.4 to 0.8 around the origin, in six directions at least."""
    normals = [[float(s if i == j else 0) + rng.uniform(-0.2, 0.2) for j in range(3)] for i in range(3)
               for s in (1, -1)]
    normals += [random_direction(rng) for _ in range(planes - 6)]
    n, d = [], []
    for normal in normals:
        length = sum(c * c for c in normal) ** 0.5
        factor = (10 ** rng.uniform(-2, 2) if long_normals else 1) / length
        n.append([c * factor for c in normal])
        d.append(rng.uniform(0.4, 0.8) * length * factor)
    return {"n": n, "d": d, "r": r, "k": k, "R": 1.0}


def cube(r, k):
    n = [[float(s) if i == j else 0.0 for j in range(3)] for i in range(3) for s in (1, -1)]
    return {"n": n, "d": [0.5 - r] * 6, "r": r, "k": k, "R": 1.0}


def moved(case, direction, wanted):
    """Moves the particle by bisection to where s is about as wanted."""
    low, high = 0.0, 4.0
    start = case["pos"]
    for _ in range(24):
        middle = (low + high) / 2
        case["pos"] = [float(c + middle * e) for c, e in zip(start, direction)]
        s, _ = solve(case)
        low, high = (low, middle) if s > wanted else (middle, high)
    return case


def triangle(rng, size, sliver=1.0):
    """Vertices about a point within it or near it."""
    centre = [rng.uniform(-0.6, 0.6) * min(size, 1.0) for _ in range(3)]
    e, f = random_direction(rng), random_direction(rng)
    spread = [(rng.uniform(-1, 1), sliver * rng.uniform(-1, 1)) for _ in range(3)]
    return [[c + size * (a * x + b * y) for c, x, y in zip(centre, e, f)] for a, b in spread]


def cases(rng):
    def generic(**options):
        return polyhedron(rng, rng.randint(6, 14), 10 ** rng.uniform(-2, -0.5), 10 ** rng.uniform(-2, -0.3), **options)

    def sharp():
        return polyhedron(rng, rng.randint(6, 14), 10 ** rng.uniform(-8, -4), 10 ** rng.uniform(-8, -4))

    def flat():
        return cube(10 ** rng.uniform(-3, -0.7), 0.0)

    sphere = {"n": [], "d": [], "r": 0.0, "k": 1.0, "R": 0.7}
    families = [
        ("generic", generic, 1.0, 1.0, 0.0),
        ("long normals", lambda: generic(long_normals=True), 1.0, 1.0, 0.0),
        ("sharp", sharp, 1.0, 1.0, 0.0),
        ("polyhedron", flat, 1.0, 1.0, 0.0),
        ("sphere", lambda: sphere, 1.0, 1.0, 0.0),
        ("large", generic, 1e6, 1.0, 0.0),
        ("large and sharp", sharp, 1e6, 1.0, 0.0),
        ("tiny", generic, 1e-4, 1.0, 0.0),
        ("tiny and sharp", sharp, 1e-4, 1.0, 0.0),
        ("sliver", generic, 1.0, 1e-5, 0.0),
        ("far", generic, 1.0, 1.0, 1e6),
    ]
    for family, particle, size, sliver, far in families:
        for number in range(16):
            vertices = triangle(rng, size, sliver)
            case = {"family": family, "A": particle(), "q": [rng.uniform(-1, 1) for _ in range(4)]}
            shift = [rng.uniform(-far, far) for _ in range(3)]
            vertices = [[c + s for c, s in zip(v, shift)] for v in vertices]
            case["vertices"] = vertices
            # From outside towards a point of the triangle, or of the plane near it.
            weights = [rng.uniform(0.1, 1) for _ in range(3)]
            target = [sum(w * v[i] for w, v in zip(weights, vertices)) / sum(weights) for i in range(3)]
            if size > 1:
                target = [sum(v[i] * w for w, v in zip((1 - 2e-7, 1e-7, 1e-7), vertices)) for i in range(3)]
            away = random_direction(rng)
            case["pos"] = [float(t + 3 * a) for t, a in zip(target, away)]
            wanted = [rng.uniform(0.2, 0.99), rng.uniform(0.9, 1.1), 1 + 1e-6 * rng.uniform(-1, 1), 1.5][number % 4]
            yield moved(case, [-a for a in away], wanted)
            if number % 4 == 0:
                normal = [c * 10 ** rng.uniform(-2, 2) for c in random_direction(rng)]
                of_plane = {key: value for key, value in case.items() if key != "vertices"}
                of_plane |= {"point": vertices[0], "normal": normal}
                side = 1 if sum(a * n for a, n in zip(away, normal)) > 0 else -1
                length = sum(c * c for c in normal) ** 0.5
                of_plane["pos"] = [
                    float(v + 3 * side * n / length + rng.uniform(-1, 1)) for v, n in zip(vertices[0], normal)
                ]
                yield moved(of_plane, [-side * n / length for n in normal], wanted)


def main():
    rng = random.Random(SEED)
    for case in cases(rng):
        s, x = solve(case)
        case["s"] = mp.nstr(s, 40)
        case["x"] = [mp.nstr(c, 40) for c in x] if case["A"]["k"] > 0 else None
        print(json.dumps(case))


if __name__ == "__main__":
    main()
