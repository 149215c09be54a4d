# SPDX-License-Identifier: MIT OR Apache-2.0
"""Which pieces of rock at a free face can leave, and how (Goodman & Shi, Block Theory and Its Application to Rock
Engineering, 1985).

A piece of rock moves by s if no face pushes into a neighbour: n_i.s >= 0 for the inward normals n_i of all faces that
lie on others, the cone C. It is removable if C holds more than 0; where the planes have all directions between them
(rank 3), that is if one of +-(n_i x n_j) lies in C, since C has then edges, and edges lie on two planes. Under a force
r without friction it moves along the projection of r on C:

    falling     s = r: no face is pressed
    sliding     s = r - (r.n_i) n_i on a face with r.n_i < 0, if s lies in C
    wedge       s = +-(n_i x n_j) with r.s > 0 and both faces pressed, if s lies in C

and r = s - N_i n_i - N_j n_j has the forces N on the faces. (Of three faces that share a line two are enough.) With
friction and cohesion on faces of area A the factor of safety is sum (N tan phi + c A) / |T|, T the part of r along s.
Translations alone: a block that would turn over is not seen.
"""
import dataclasses
import math

import numpy as np

from ..arguments import LARGE, positive, vector, whole, within
from .loads import loads_of
from .mass import LEAST_SHARE, OF_DOMAIN, marked, planes_of

# Of unit vectors: a direction that leaves a plane by less lies in it.
TOLERANCE = 1e-9

# Of the two thirds power of the volume of a block: a face of a smaller area, as where many planes meet in a point,
# opens and holds nothing.
LEAST_AREA = 1e-9

# The friction angle where none is given, degrees; a coefficient above that of 84 degrees is an angle.
USUAL, STEEPEST = 30.0, 10.0

MODES = ("falling", "sliding", "wedge", "resting", "locked", "inner")
#: By mode, and beyond what friction holds.
COLOURS = {
    "falling": (0.80, 0.20, 0.16), "sliding": (0.93, 0.55, 0.16), "wedge": (0.95, 0.83, 0.25),
    "held": (0.45, 0.66, 0.45), "resting": (0.55, 0.68, 0.80), "locked": (0.74, 0.72, 0.69), "inner": (0.86, 0.85, 0.83)
}


@dataclasses.dataclass(frozen=True)
class KeyBlock:
    """A piece of rock and how it can move.

    blocks: numbers of its blocks. mode: "falling", "sliding" on one plane, "wedge" on two, "resting" (it could leave,
    but no force drives it), "locked" (at a free face, but not removable), "inner" (at none). direction: of the motion,
    unit vector, None without one. faces: numbers of the face, or two, on which it slides. factor: of safety, 0 of what
    falls, math.inf without a motion. force: on it, weight and loads.
    """

    blocks: tuple
    mode: str
    direction: tuple
    faces: tuple
    factor: float
    volume: float
    force: tuple

    @property
    def removable(self):
        """Whether it could leave in some direction."""
        return self.mode not in ("locked", "inner")

    @property
    def moves(self):
        """Whether it leaves: a factor of safety below 1."""
        return self.factor < 1.0

    @property
    def color(self):
        """By mode, for pictures; what friction holds is green."""
        return COLOURS["held" if self.mode in ("sliding", "wedge") and not self.moves else self.mode]


def key_blocks(mass, free, friction=None, cohesion=0.0, density=2600.0, gravity=(0.0, 0.0, -9.81), removed=(),
               loads=None, degrees=None):
    """The KeyBlock of each piece of a RockMass, sorted by factor of safety, the largest first among equals.

    free: numbers of the planes of the domain that are free faces (slope, crest); its other planes hold. removed: blocks
    that are taken out, as mass.inside(0); what bordered them is free, too, and so is what bordered what the domain
    leaves out.
    friction: of joints, a coefficient, or in its place degrees, the angle (neither: 30 degrees); cohesion: their shear
    strength without pressure, force per area: numbers, or dicts by entries of the `joints` of slice(), whose key None is
    for all others. density, gravity: of the weight.
    loads: (blocks, 6), forces (and torques, which do not count) beside it, as of water_pressure.
    """
    free = planes_of(mass, free, "free")
    friction, cohesion = friction_of(friction, degrees), by_set(cohesion, "cohesion")
    weight = positive(density, "density") * vector(gravity, "gravity")
    gone = marked(removed, len(mass), "removed")
    pushed = np.zeros((len(mass), 3)) if loads is None else loads_of(loads, len(mass))[:, :3]
    pressed, touching = _areas(mass, gone)
    outer = (mass.faces["of"] == OF_DOMAIN) & ~np.isin(mass.faces["index"].astype(int), free)
    found = []
    for blocks in mass.blocks_of_pieces:
        if not len(blocks) or gone[blocks].all():
            continue
        faces = np.concatenate([
            mass.blocks["first_face"][one].astype(int) + np.arange(int(mass.blocks["face_count"][one]))
            for one in blocks
        ])
        area = mass.faces["area"][faces]
        counts = area > LEAST_AREA * np.cbrt(mass.blocks["volume"][mass.faces["block"][faces].astype(int)]) ** 2
        holding = faces[counts & ((pressed[faces] > LEAST_SHARE * area) | outer[faces])]
        is_open = bool(np.any(counts & ~outer[faces] & (touching[faces] < (1.0 - LEAST_SHARE) * area)))
        force = weight * mass.blocks["volume"][blocks].sum() + pushed[blocks].sum(0)
        strength = [(friction(one), cohesion(one)) for one in mass.set_of_face[holding]]
        mode, direction, on, factor = _motion(-mass.faces["plane"][holding, :3], pressed[holding], strength,
                                              force) if is_open else ("inner", None, (), math.inf)
        found.append(
            KeyBlock(tuple(map(int, blocks)), mode, None if direction is None else tuple(map(float, direction)),
                     tuple(int(holding[one]) for one in on), float(factor), float(mass.blocks["volume"][blocks].sum()),
                     tuple(map(float, force))))
    return sorted(found, key=lambda one: (one.factor, MODES.index(one.mode), -one.volume))


def summary(found):
    """A table of key blocks as text: how many of each mode, volume, how many of them move, the least factor of safety.
    """
    lines = [f"{'mode':10} {'pieces':>7} {'volume':>10} {'move':>6} {'least factor':>13}"]
    for mode in MODES:
        of_mode = [one for one in found if one.mode == mode]
        if of_mode:
            least = min(one.factor for one in of_mode)
            lines.append(
                f"{mode:10} {len(of_mode):7d} {sum(one.volume for one in of_mode):10.4g} {sum(one.moves for one in of_mode):6d} "
                f"{least if least < math.inf else '-':>13{'.3f' if least < math.inf else ''}}")
    return "\n".join(lines)


def _motion(normals, areas, strength, force):
    """(mode, direction, positions of the faces slid on, factor of safety) of a piece with these inward normals (n, 3).
    """
    size = np.linalg.norm(force)
    if not size > 0.0:
        return ("resting" if _is_removable(normals) else "locked"), None, (), math.inf
    pull = force / size

    def allowed(direction):
        return bool(np.all(normals @ direction >= -TOLERANCE))

    if allowed(pull):
        return "falling", pull, (), 0.0
    against = normals @ pull
    for i in np.flatnonzero(against < -TOLERANCE):
        along = pull - against[i] * normals[i]
        length = np.linalg.norm(along)
        if length > TOLERANCE and allowed(along / length):
            # All faces of the same plane carry it together.
            on = np.flatnonzero(normals @ normals[i] > 1.0 - TOLERANCE)
            return "sliding", along / length, (i,), _factor(size * -against[i], on, areas, strength) / (size * length)
    for i, j in _pairs(len(normals)):
        line = np.cross(normals[i], normals[j])
        length = np.linalg.norm(line)
        if length < TOLERANCE:
            continue
        line *= math.copysign(1.0, line @ pull) / length
        driving = line @ pull
        if driving <= TOLERANCE or not allowed(line):
            continue
        cosine = normals[i] @ normals[j]
        on_i, on_j = np.linalg.solve([[1.0, cosine], [cosine, 1.0]], [-against[i], -against[j]])
        if on_i > 0.0 and on_j > 0.0:
            held = sum(
                _factor(size * part, np.flatnonzero(normals @ normals[k] > 1.0 - TOLERANCE), areas, strength)
                for k, part in ((i, on_i), (j, on_j)))
            return "wedge", line, (i, j), held / (size * driving)
    return ("resting" if _is_removable(normals) else "locked"), None, (), math.inf


def _factor(pressing, on, areas, strength):
    """What friction and cohesion hold on faces of one plane, whose share of the pressing force is that of their areas.
    """
    total = sum(areas[one] for one in on)
    if not total > 0.0:
        return pressing * strength[on[0]][0]
    return sum(pressing * areas[one] / total * strength[one][0] + strength[one][1] * areas[one] for one in on)


def _is_removable(normals):
    """Whether {s : n_i.s >= 0} holds more than 0."""
    if np.linalg.matrix_rank(normals, tol=TOLERANCE) < 3:
        return True
    for i, j in _pairs(len(normals)):
        line = np.cross(normals[i], normals[j])
        length = np.linalg.norm(line)
        if length > TOLERANCE:
            heights = normals @ (line / length)
            if heights.min() >= -TOLERANCE or heights.max() <= TOLERANCE:
                return True
    return False


def _pairs(count):
    return ((i, j) for i in range(count) for j in range(i))


def _areas(mass, gone):
    """Of each face what lies on other pieces of rock, and on any rock, area."""
    owners, pieces = mass.faces["block"].astype(int), mass.pieces
    pressed, touching = np.zeros(len(mass.faces)), np.zeros(len(mass.faces))
    pairs = mass.partners["faces"].astype(int)
    there = ~gone[owners[pairs]].any(1)
    other = there & (pieces[owners[pairs[:, 0]]] != pieces[owners[pairs[:, 1]]])
    for side in (0, 1):
        np.add.at(touching, pairs[there, side], mass.partners["area"][there])
        np.add.at(pressed, pairs[other, side], mass.partners["area"][other])
    return pressed, touching


def friction_of(friction, degrees):
    """tan phi by entry, as by_set has it, of a coefficient, of an angle in degrees in its place, or of neither."""
    if friction is not None and degrees is not None:
        raise ValueError(f"friction={friction!r} and degrees={degrees!r} both give the friction: leave out one")
    if friction is None:
        angle = by_set(USUAL if degrees is None else degrees, "degrees", 89.9)
        return lambda entry: math.tan(math.radians(angle(entry)))
    tangent = by_set(friction, "friction")
    largest = max(friction.values()) if isinstance(friction, dict) else friction
    if largest > STEEPEST:
        raise ValueError(f"friction={largest:g} is a coefficient, the tangent of an angle: give degrees={largest:g}")
    return tangent


def by_set(given, name, most=math.inf):
    """Of a number, or a dict by entries of the `joints` of slice(): the value, 0 to `most`, for an entry."""
    if not isinstance(given, dict):
        value = within(given, 0.0, most, name)
        return lambda entry: value
    values = {
        entry if entry is None else whole(entry, 0, LARGE, f"an entry of {name}"): within(value, 0.0, most,
                                                                                          f"{name}[{entry!r}]")
        for entry, value in given.items()
    }
    if None not in values:
        raise ValueError(f"{name} has no key None, for joints of other entries and for planes that are no joints: add "
                         f"{name}[None], of which no use is made where there are none")
    return lambda entry: values.get(int(entry), values[None])
