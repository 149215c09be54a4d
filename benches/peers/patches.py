# SPDX-License-Identifier: MIT OR Apache-2.0
"""Contact patches beside Drake's hydroelastic contact: the same bodies at the same depth, both against closed forms.

Both have a pressure field in each body and press on each other where the two are equal. Drake's is E times the depth
over the largest depth of the body, linear in each tetrahedron of a mesh; a potential particle's is K (ℓ_A + ℓ_B)(1 −
s). E is chosen for each body such that both rise from its surface at the
same rate: E/(largest depth) = K (ℓ_A + ℓ_B)/ℓ. On faces, and in spheres but for the mesh, the fields are then the same.
"""

import json
import subprocess
from dataclasses import dataclass

import numpy as np
from scipy.integrate import quad
from scipy.optimize import brentq
from scipy.spatial.transform import Rotation

import install
from contestants import DRAKE, OURS
from summary import markdown, target

TOLERANCE = 1e-4  # of our patch: what laws take
ROUNDING = 2e-4  # of the boxes that meet with their edges; the closed forms, of sharp boxes, differ by about that
DEPTH = 1e-4
HINTS = (0.2, 0.1, 0.05, 0.025, 0.0125)  # Drake's resolution of a sphere of radius 0.5
NEAR_ENOUGH = 0.01  # error of a force with which a time counts
STRAIGHT = (1.0, 0.0, 0.0, 0.0)


@dataclass(frozen=True)
class Body:
    """A ball of a radius, a cube with half its side and a rounding, or the ground z <= 0."""

    kind: str
    size: float = 0.0
    rounding: float = 0.0

    @property
    def depth_length(self):
        """ℓ: of the ground, which is rigid, 0."""
        return {"ball": self.size, "box": self.rounding, "ground": 0.0}[self.kind]

    def words(self):
        return {"ball": [self.size], "box": [self.size] * 3 + [self.rounding], "ground": []}[self.kind]


@dataclass(frozen=True)
class Case:
    """The upper body on the lower one; force and torque are those on the upper body, the torque about a point, all for
    K = 1.
    """

    name: str
    lower: Body
    upper: Body
    position: tuple
    turn: tuple
    about: tuple
    force: np.ndarray
    torque: np.ndarray
    area: float

    def modulus(self, body):
        """Drake's E of a body, None of a rigid one."""
        return body.size * self.length / body.depth_length if body.depth_length else None

    @property
    def length(self):
        return self.lower.depth_length + self.upper.depth_length

    @property
    def hints(self):
        return HINTS if "ball" in (self.lower.kind, self.upper.kind) else (None,)


def face(side, depth, angle):
    """Force, moment and area of a bed of stiffness 1 under a square that is pressed in by a depth at its middle and
    tilted by an angle.
    """
    reach = min(0.5 * side, depth / np.tan(angle)) if angle else 0.5 * side
    # The pressure is depth + tan(angle) x from -reach to side/2.
    ends = np.array([-reach, 0.5 * side])
    powers = [np.diff(ends**n)[0] / n for n in (1, 2, 3)]
    slope = np.tan(angle)
    force = side * (depth * powers[0] + slope * powers[1])
    return force, side * (depth * powers[1] + slope * powers[2]), side * powers[0] / np.cos(angle)


def pressed(name, lower, half, angle):
    """A cube with half its side on a body whose top is at z = 0, by DEPTH at the middle of its face, turned about y."""
    force, moment, area = face(2 * half, DEPTH, angle)
    turn = Rotation.from_rotvec([0, angle, 0])
    # At x > 0 a positive turn about y lowers the face.
    position = turn.apply([0, 0, half]) - [0, 0, DEPTH]
    if lower.kind == "box":
        position[2] += lower.size
    about = (0.0, 0.0, position[2] - turn.apply([0, 0, half])[2])
    quaternion = tuple(np.roll(turn.as_quat(), 1))
    normal = turn.apply([0, 0, 1.0]) if lower.kind == "box" else np.array([0, 0, 1.0])
    # Between two beds of equal stiffness the patch halves the angle.
    normal = (normal + [0, 0, 1]) / np.linalg.norm(normal + [0, 0, 1])
    return Case(name, lower, Body("box", half, ROUNDING), tuple(position), quaternion, about, force * normal,
                np.array([0, -moment, 0]), area)


def round_on(name, lower, radius, overlap, aside):
    """A ball on a ball or on the middle of a face, by quadrature over the distance from the axis; the torque about the
    origin.
    """
    upper = Body("ball", radius)
    top = lower.size
    height = top + radius - overlap
    length = lower.depth_length + radius

    def of_lower(rho, z):
        """1 − s, in units of the pressure, and its slopes."""
        if lower.kind == "ball":
            return 1 - np.hypot(rho, z) / top, -np.array([rho, z]) / (top * np.hypot(rho, z))
        return (top - z) / lower.rounding, np.array([0.0, -1 / lower.rounding])

    def of_upper(rho, z):
        away = np.array([rho, z - height])
        return 1 - np.linalg.norm(away) / radius, -away / (radius * np.linalg.norm(away))

    def level(rho):
        return brentq(lambda z: of_lower(rho, z)[0] - of_upper(rho, z)[0], height - radius - overlap, top + overlap,
                      xtol=1e-15)

    def terms(rho):
        z = level(rho)
        slopes = of_lower(rho, z)[1] - of_upper(rho, z)[1]
        return of_lower(rho, z)[0], 2 * np.pi * rho, np.hypot(*slopes) / abs(slopes[1])

    rim = brentq(lambda rho: terms(rho)[0], 1e-6, radius * np.sqrt(2 * overlap / radius) * 1.1)
    force = length * quad(lambda rho: np.prod(terms(rho)[:2]), 0, rim, epsrel=1e-11)[0]
    area = quad(lambda rho: np.prod(terms(rho)[1:]), 0, rim, epsrel=1e-11)[0]
    along = np.array([0, 0, force])
    position = (aside, 0.0, height)
    return Case(name, lower, upper, position, STRAIGHT, (0.0, 0.0, 0.0), along, np.cross(position, along), area)


def cases():
    small, big = 0.25, Body("box", 0.5, ROUNDING)
    within, beyond = 0.5 * DEPTH / small, 2.0 * DEPTH / small
    return [
        pressed("equal boxes, face on face", big, 0.5, 0.0),
        pressed("a box on a box, tilted within its base", big, small, within),
        pressed("a box on a box, tilted beyond", big, small, beyond),
        pressed("a box on the ground, tilted within its base", Body("ground"), small, within),
        round_on("a sphere on a box", Body("box", 0.5, 0.1), 0.5, 0.02, 0.1),
        round_on("a sphere on a smaller one", Body("ball", 0.3), 0.5, 0.02, 0.0),
    ]


def rows(found, quick):
    """One dictionary for each case, program and resolution; the fastest of several windows."""
    listed = cases()
    if OURS not in found.commands:
        return []
    path = install.OUT / "patches.txt"
    path.write_text("".join(_line(case) for case in listed))
    seconds = 0.02 if quick else 0.3
    answers = _ask([install.program("patches"), path, TOLERANCE, seconds])
    made = []
    for case, (force, torque, area, estimate, cold, carried) in zip(listed, answers):
        made.append(
            _row(case, OURS, None, force, torque, area, cold, carried_microseconds=1e6 * carried, estimate=estimate))
    if DRAKE in found.commands:
        python = found.commands[DRAKE][0]
        asked = json.dumps([_for_drake(case, quick) for case in listed])
        for case, answers in zip(listed, _ask([python, install.HERE / "drake_patches.py", asked, seconds])):
            for hint, (force, torque, at_middles, area, polygons, cold) in zip(case.hints, answers):
                made.append(
                    _row(case, DRAKE, hint, force, torque, area, cold, polygons=polygons, torque_at_middles=at_middles))
    return sorted(made, key=lambda row: [case.name for case in listed].index(row["case"]))


def _line(case):
    words = [word for body in (case.lower, case.upper) for word in (body.kind, *body.words())]
    return " ".join(map(str, [*words, *case.position, *case.turn, *case.about])) + "\n"


def _for_drake(case, quick):
    bodies = [[body.kind, body.size, case.modulus(body)] for body in (case.lower, case.upper)]
    lower = [0.0, 0.0, 0.0]
    return {
        "bodies": bodies, "poses": [[lower, STRAIGHT], [case.position, case.turn]], "about": case.about,
        "hints": case.hints[:3 if quick else None]
    }


def _ask(command):
    lines = subprocess.run([str(part) for part in command], check=True, capture_output=True,
                           text=True).stdout.splitlines()
    return [json.loads(line) for line in lines]


def _row(case, program, hint, force, torque, area, seconds, **more):
    size = np.linalg.norm(case.force)
    # Half the patch's width is the arm of the torque's error.
    arm = 0.5 * np.sqrt(case.area)
    return {
        "case": case.name,
        "program": program,
        "hint": hint,
        "force": force,
        "torque": torque,
        "area": area,
        "microseconds": 1e6 * seconds,
        "force_error": np.linalg.norm(force - case.force) / size,
        "torque_error": np.linalg.norm(torque - case.torque) / (size * arm),
        "area_error": abs(area / case.area - 1),
        **more,
    }


def targets(made):
    """The same force and torque, and faster than the fastest of Drake's meshes that are near enough."""
    found = []
    for name in dict.fromkeys(row["case"] for row in made):
        of_case = [row for row in made if row["case"] == name]
        ours = next(row for row in of_case if row["program"] == OURS)
        error = max(ours["force_error"], ours["torque_error"])
        found.append(target(f"patch, {name}: our force and torque against the closed form", "at most", 1e-3, error))
        drakes = [row for row in of_case if row["program"] == DRAKE]
        if not drakes:
            continue
        near = [row for row in drakes if max(row["force_error"], row["torque_error"]) <= NEAR_ENOUGH]
        ratio = min(row["microseconds"] for row in near) / ours["microseconds"] if near else None
        found.append(target(f"patch, {name}: Drake within {NEAR_ENOUGH:.0%} / ours, time from nothing", "at least", 1.0,
                            ratio))
    return found


def table(made):
    heads = ("bodies", "code", "polygons", "error of the force", "of the torque", "of the area", "a call, µs")
    rows = []
    for row in made:
        label = "ours" if row["program"] == OURS else "Drake" + (f", hint {row['hint']}" if row["hint"] else "")
        errors = (f"{row[key]:.1e}" for key in ("force_error", "torque_error", "area_error"))
        time = f"{row['microseconds']:.1f}" + (f"; carried on {row['carried_microseconds']:.2f}"
                                               if row["program"] == OURS else "")
        rows.append((row["case"], label, row.get("polygons", "–"), *errors, time))
    return markdown(heads, rows)
