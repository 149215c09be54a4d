#!/usr/bin/env python3
"""Derivatives of contacts to some 40 digits, by differences and not by the library's way: the lines of
derivatives.jsonl.

    python3 tests/data/derivatives.py > tests/data/derivatives.jsonl

The first pairs of each family of pairs.jsonl (which says how their solutions were found) are solved again with one
number of a pose or a shape changed by ±1e-40 of its size: Newton's method on the optimality conditions in arithmetic of
130 digits, with the planes that are active at each iterate, from the known solution. No derivative of a solution is
used but the quotient of such differences, whose error is 1e-60 or so. Small turns about world axes multiply the
rotation from the left.

One object a line: the line of the pair (from 0), the formulation, and

    pose    of each of s, s_b, overlap, normal, point, on_a, on_b (null where it does not apply): rows of 12 numbers,
            shift and turn of A, of B
    shape   for some weights {name: number or vector} on them, of the weighted sum: of both bodies
            {"planes": {index: [a, b, c, d]}, "rkR": [...]}

Planes that are not listed have derivatives of 0, being active nowhere. A derivative in k or R at k = 0 or 1, where it
is one-sided, or in what is not used, is null. Pairs of k = 0 with a free direction are left out. Needs mpmath.
"""
import json
import random
import sys
from pathlib import Path

from mpmath import lu_solve, matrix, mp, mpf, sqrt

mp.dps = 130
STEP = mpf(10) ** -40
SEED = 20261125
PER_FAMILY = {"midway": 8, "closest": 5}
NAMES = ["s", "s_b", "overlap", "normal", "point", "on_a", "on_b"]


def dot(a, b):
    return sum((x * y for x, y in zip(a, b)), mpf(0))


def plus(a, b, share=1):
    return [x + share * y for x, y in zip(a, b)]


def unit(a):
    length = sqrt(dot(a, a))
    return [x / length for x in a]


def rotation(q):
    w, x, y, z = (mpf(c) for c in q)
    t = 2 / (w * w + x * x + y * y + z * z)
    return [
        [1 - t * (y * y + z * z), t * (x * y - w * z), t * (x * z + w * y)],
        [t * (x * y + w * z), 1 - t * (x * x + z * z), t * (y * z - w * x)],
        [t * (x * z - w * y), t * (y * z + w * x), 1 - t * (x * x + y * y)],
    ]


class Body:
    """Numbers of one body, world axes about a common origin, which are changed one at a time."""

    def __init__(self, shape, place, origin):
        self.n = [[mpf(c) for c in n] for n in shape["n"]]
        self.d = [mpf(d) for d in shape["d"]]
        self.rkR = [mpf(shape[name]) for name in "rkR"]
        self.centre = plus([mpf(c) for c in place["pos"]], [mpf(c) for c in origin], -1)
        self.turn = rotation(place["q"])
        self.settle()

    def settle(self):
        r, k, shadow = self.rkR
        self.w = (1 - k) / r**2 if k < 1 else mpf(0)
        self.m = k / shadow**2 if k > 0 else mpf(0)
        self.normals = {}

    def normal(self, i):
        if i not in self.normals:
            self.normals[i] = [dot(row, self.n[i]) for row in self.turn]
        return self.normals[i]

    def at(self, x, count_from=None):
        """S, its gradient and Hessian, and the planes that are on."""
        y = plus(x, self.centre, -1)
        value, gradient = self.m * dot(y, y), [2 * self.m * c for c in y]
        hessian = [[2 * self.m if i == j else mpf(0) for j in range(3)] for i in range(3)]
        on = []
        for i in range(len(self.d)) if self.w else ():
            n = self.normal(i)
            t = dot(n, y) - self.d[i]
            if t > 0:
                on.append(i)
                value += self.w * t * t
                gradient = plus(gradient, n, 2 * self.w * t)
                for p in range(3):
                    for q in range(3):
                        hessian[p][q] += 2 * self.w * n[p] * n[q]
        return value, gradient, hessian, on


def newton(bodies, x, lam, kind):
    """Optimum: g_A + lam g_B = 0 and S_A = S_B, or S_B = 1, or S_A = 1."""
    for _ in range(60):
        (s_a, g_a, h_a, on_a), (s_b, g_b, h_b, on_b) = (body.at(x) for body in bodies)
        rest = {"midway": s_a - s_b, "on_b": s_b - 1, "on_a": s_a - 1}[kind]
        row = {"midway": plus(g_a, g_b, -1), "on_b": g_b, "on_a": g_a}[kind]
        # Rows in units of their own size.
        unit_force = sqrt(dot(g_a, g_a))
        m = matrix(4, 4)
        for i in range(3):
            for j in range(3):
                m[i, j] = (h_a[i][j] + lam * h_b[i][j]) / unit_force
            m[i, 3] = g_b[i] / unit_force
            m[3, i] = row[i]
        right = matrix([-(a + lam * b) / unit_force for a, b in zip(g_a, g_b)] + [-rest])
        step = lu_solve(m, right)
        x, lam = plus(x, list(step)[:3]), lam + step[3]
        if max(abs(c) for c in step[:3]) < mpf(10) ** -105 and abs(step[3]) < mpf(10) ** -100 * abs(lam):
            return x, lam, on_a, on_b
    raise ArithmeticError("Newton's method did not settle")


def to_surface(body, x, n):
    """The way along n from x inside to S = 1."""
    value, gradient, hessian, _ = body.at(x)
    way = mpf(0)
    for _ in range(200):
        p = plus(x, n, way)
        value, gradient, _, on = body.at(p)
        step = (1 - value) / dot(gradient, n)
        way += step
        if abs(step) < mpf(10) ** -105:
            return way, on
    raise ArithmeticError("no surface")


class Contact:
    """All numbers of a contact, from a start near its optimum or optima."""

    def __init__(self, formulation, bodies, start):
        self.on = [set(), set()]
        self.values = dict.fromkeys(NAMES)
        (self.midway if formulation == "midway" else self.closest)(bodies, start)

    def optimum(self, bodies, kind, start):
        x, lam, on_a, on_b = newton(bodies, *start, kind)
        self.on[0] |= set(on_a)
        self.on[1] |= set(on_b)
        return x, lam

    def midway(self, bodies, start):
        x, lam = self.optimum(bodies, "midway", start["midway"])
        (value, g_a, _, _), (_, g_b, _, _) = (body.at(x) for body in bodies)
        n = unit(plus(unit(g_a), unit(g_b), -1))
        self.values |= {"s": [sqrt(value)], "normal": n, "point": x}
        self.start = {"midway": (x, lam)}
        if value < 1:
            (to_a, on_a), (to_b, on_b) = to_surface(bodies[0], x, n), to_surface(bodies[1], x, [-c for c in n])
            self.on[0] |= set(on_a)
            self.on[1] |= set(on_b)
            self.values |= {"overlap": [to_a + to_b], "on_a": plus(x, n, to_a), "on_b": plus(x, n, -to_b)}

    def closest(self, bodies, start):
        p1, lam1 = self.optimum(bodies, "on_a", start["on_a"])
        p2, lam2 = self.optimum(bodies, "on_b", start["on_b"])
        self.start = {"on_a": (p1, lam1), "on_b": (p2, lam2)}
        n = unit(plus(unit(bodies[0].at(p1)[1]), unit(bodies[1].at(p2)[1]), -1))
        s, s_b = sqrt(bodies[0].at(p2)[0]), sqrt(bodies[1].at(p1)[0])
        self.values |= {"s": [s], "s_b": [s_b], "normal": n, "point": [(a + b) / 2 for a, b in zip(p1, p2)]}
        if s < 1:
            way = plus(p1, p2, -1)
            self.values |= {"overlap": [sqrt(dot(way, way))], "on_a": p1, "on_b": p2}


def difference(formulation, bodies, contact, change, step):
    """Central difference of all values for a change(±step), which returns the number itself."""
    ends = []
    for sign in (1, -1):
        undo = change(sign * step)
        for body in bodies:
            body.settle()
        ends.append(Contact(formulation, bodies, contact.start).values)
        undo()
    for body in bodies:
        body.settle()
    quotient = lambda a, b: None if a is None else [(x - y) / (2 * step) for x, y in zip(a, b)]
    return {name: quotient(ends[0][name], ends[1][name]) for name in NAMES}


def pose_change(body, column):
    def change(step):
        centre, turn = body.centre, body.turn
        if column < 3:
            body.centre = [c + (step if i == column else 0) for i, c in enumerate(centre)]
        else:
            # (1 + [w] + [w]²/2) R: off by the third power of the step.
            i, j = [(1, 2), (2, 0), (0, 1)][column - 3]
            body.turn = [list(row) for row in turn]
            body.turn[i] = [(1 - step**2 / 2) * a - step * b for a, b in zip(turn[i], turn[j])]
            body.turn[j] = [(1 - step**2 / 2) * b + step * a for a, b in zip(turn[i], turn[j])]

        def undo():
            body.centre, body.turn = centre, turn

        return undo

    return change


def number_change(numbers, i):
    def change(step):
        old = numbers[i]
        numbers[i] = old + step

        def undo():
            numbers[i] = old

        return undo

    return change


def usable(body, i):
    """Whether a derivative in r, k or R is two-sided and used."""
    r, k, _ = body.rkR
    return [k < 1 and bool(body.d), 0 < k < 1, k > 0][i]


def shape_of(formulation, bodies, contact, size, weights):
    """Derivatives of the weighted sums, one for each set of weights."""
    answers = [[] for _ in weights]
    total = lambda d, w: sum(
        (dot(d[name], [w[name]] if not isinstance(w[name], list) else w[name]) for name in w), mpf(0))
    for which, body in enumerate(bodies):
        planes, rkR = [{} for _ in weights], [[None] * 3 for _ in weights]
        for i in sorted(contact.on[which]):
            for j in range(4):
                change = number_change(body.n[i], j) if j < 3 else number_change(body.d, i)
                d = difference(formulation, bodies, contact, change, STEP * (1 if j < 3 else size))
                for p, w in zip(planes, weights):
                    p.setdefault(str(i), []).append(float(total(d, w)))
        for i in range(3):
            if usable(body, i):
                d = difference(formulation, bodies, contact, number_change(body.rkR, i), STEP * body.rkR[i])
                for q, w in zip(rkR, weights):
                    q[i] = float(total(d, w))
        for answer, p, q in zip(answers, planes, rkR):
            answer.append({"planes": p, "rkR": q})
    return [{"weights": w, "a": a[0], "b": a[1]} for w, a in zip(weights, answers)]


def derivatives(pair, formulation, chance):
    origin = pair["b"]["pos"]
    bodies = [Body(pair["A"], pair["a"], origin), Body(pair["B"], pair["b"], origin)]
    truth = pair["truth"]
    point = lambda name: [mpf(c) for c in truth[name]]
    if formulation == "midway":
        u = mpf(truth["u4"])
        start = {"midway": (point("x4"), u / (1 - u))}
    else:
        # The weight follows from the gradients, which are opposed.
        start = {}
        for kind, name in (("on_a", "P1"), ("on_b", "P2")):
            x = point(name)
            g_a, g_b = (body.at(x)[1] for body in bodies)
            start[kind] = (x, sqrt(dot(g_a, g_a) / dot(g_b, g_b)))
    contact = Contact(formulation, bodies, start)
    size = max(sqrt(dot(body.centre, body.centre)) for body in bodies)
    rows = {name: None if contact.values[name] is None else [[] for _ in contact.values[name]] for name in NAMES}
    for body in bodies:
        for column in range(6):
            step = STEP * (size if column < 3 else 1)
            d = difference(formulation, bodies, contact, pose_change(body, column), step)
            for name in NAMES:
                for i, value in enumerate(d[name] or ()):
                    rows[name][i].append(float(value))
    some = lambda: round(chance.uniform(-1, 1), 3)
    weights = []
    for group in (["s", "s_b"], ["overlap"], ["normal"], ["point"], ["on_a", "on_b"]):
        names = [name for name in group if contact.values[name] is not None]
        if names:
            weights.append({n: some() if len(contact.values[n]) == 1 else [some(), some(), some()] for n in names})
    return {"pose": rows, "shape": shape_of(formulation, bodies, contact, size, weights)}


def main():
    chance = random.Random(SEED)
    counts = {}
    for line, text in enumerate(Path(__file__).with_name("pairs.jsonl").open()):
        pair = json.loads(text)
        truth = pair["truth"]
        for formulation, most in PER_FAMILY.items():
            count = counts.setdefault((pair["family"], formulation), 0)
            overlap = float(truth["s4"]) < 1
            solved = truth["ok4"] if formulation == "midway" else truth["ok1"] and truth["ok2"] and overlap
            if count >= most or not solved:
                continue
            try:
                found = derivatives(pair, formulation, chance)
            except (ArithmeticError, ZeroDivisionError) as error:
                print(f"pair {line} ({pair['family']}, {formulation}): {error}", file=sys.stderr)
                continue
            counts[pair["family"], formulation] += 1
            print(json.dumps({"pair": line, "formulation": formulation} | found), flush=True)


if __name__ == "__main__":
    main()
