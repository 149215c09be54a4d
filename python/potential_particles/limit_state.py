# SPDX-License-Identifier: MIT OR Apache-2.0
"""The answer of limit analysis for bodies that have names: blocks of a rock mass, bodies of YADE (docs/equilibrium.md).
"""
import dataclasses

import numpy as np

from ._core import _equilibrium

# By what a Scene answers each.
QUESTIONS = {"stands": "stands", "load": "load_factor", "strength": "strength_factor"}
# Corners nearer to each other than this, over the size of the polygon, are one.
SAME = 1e-9
# A contact carries nothing if its force is below this part of the largest one, to which forces are balanced.
NOTHING = 1e-6
# A bound this many times the factor comes from forces that friction could clamp between neighbours.
CLAMPS = 3.0


class Body:
    """A rigid body: centre of mass, dead and live force and torque about it, (3,) each; held: it does not move."""

    def __init__(self, held):
        self.held = held
        self.centre, self.dead_force, self.dead_torque, self.live_force, self.live_torque = np.zeros((5, 3))


@dataclasses.dataclass(frozen=True, repr=False)
class Equilibrium:
    """Forces in equilibrium, and the motion at the limit."""
    question: str
    stands: bool  #: whether bodies come to rest; of a factor: with any factor
    may_stand: bool  #: whether any forces hold them, where joints open as they slip
    factor: float  #: load factor or factor of safety; 0 for "stands"
    bound: float  #: that of joints that open as they slip, which none exceeds; inf without a limit, nan if not found
    contacts: list  #: (id1, id2) of the contacts
    corners: np.ndarray  #: (n, 3), world frame
    contact_of_corner: np.ndarray  #: (n,), index in contacts
    forces: np.ndarray  #: (n, 3), on body id2 at each corner; 0 where nothing stands
    velocities: dict  #: {id: (linear, angular)} of the mechanism, the fastest corner at 1; 0 where it stands
    unbalanced: float  #: the largest force that is left on a body, over the mean load of one
    excess: float  #: the largest friction beyond its strength, over the mean load of a body
    largest: float  #: the largest force of a contact over the mean load of a body: far above 1 where blocks clamp
    solves: int  #: number of matrices that were factorised, or of cone programs
    used: np.ndarray  #: (contacts,) share of friction and cohesion that is used; 0 where a contact carries nothing

    def __repr__(self):
        if not self.stands:
            said = "it falls"
        elif self.question == "stands":
            said = "it stands"
        else:
            what = "factor of safety" if self.question == "strength" else "load factor"
            said = f"{what} {self.factor:.6g}, at most {self.bound:.6g}"
            said += ", since friction may clamp" if self.bound > CLAMPS * self.factor else ""
        return f"<Equilibrium: {said}; {len(self.contacts)} contacts>"


def scene_of(bodies, rows):
    """An equilibrium.Scene of bodies [Body] and contacts; rows, one a contact: the places of its two bodies, the normal
    from the first to the second, (friction, cohesion, tension), corners (n, 3), area and stiffness along the normal and
    across it.
    """
    scene = _equilibrium.Scene()
    for one in bodies:
        scene.add_body(one.centre, held=one.held, force=one.dead_force, torque=one.dead_torque,
                       live_force=one.live_force, live_torque=one.live_torque)
    for of, normal, (friction, cohesion, tension), corners, area, stiffness in rows:
        scene.add_contact(*of, corners, normal, friction=friction, cohesion=cohesion, tension=tension, area=area,
                          stiffness=stiffness)
    return scene


def solved(question, dilatant, bodies, names, rows, pairs):
    """The Equilibrium of rigid bodies with these names, bodies and rows as of scene_of(); pairs: the names of the bodies
    of each contact.
    """
    scene = scene_of(bodies, rows)
    # Of the other questions live loads are there once.
    how = {} if question == "load" else {"live": 1.0}
    found = getattr(scene, QUESTIONS[question])(dilatant=bool(dilatant), **how)
    # No rows of what does not exist.
    corners, forces, velocities = scene.corners, np.zeros((len(scene.corners), 3)), np.zeros((len(bodies), 6))
    forces[:len(found.forces)], velocities[:len(found.mechanism)] = found.forces, found.mechanism
    counts = [len(one[3]) for one in rows]
    return Equilibrium(question, found.stands, found.may_stand, found.factor, found.bound, pairs, corners,
                       scene.contact_of_corner.astype(int), forces,
                       {name: (row[:3], row[3:]) for name, row in zip(names, velocities)}, found.unbalanced,
                       found.excess, found.largest, found.solves,
                       _used(rows, np.split(forces, np.cumsum(counts)[:-1])))


def _used(rows, forces):
    """Of each contact: its force along the joint over friction and cohesion there; rows as of solved(), forces of each
    (corners, 3).
    """
    used = np.zeros(len(rows))
    totals = np.array([of.sum(axis=0) for of in forces])
    sizes = np.linalg.norm(totals, axis=1)
    for place in np.flatnonzero(sizes > NOTHING * sizes.max()):
        _, normal, (friction, cohesion, _), _, area, _ = rows[place]
        normal = np.array(normal) / np.linalg.norm(normal)
        pressing = totals[place] @ normal
        strength = friction * max(pressing, 0.0) + cohesion * area
        along = np.linalg.norm(totals[place] - pressing * normal)
        used[place] = along / strength if strength > 0.0 else 0.0
    return used


def asked(question):
    """The question itself, if there is one of this name."""
    if question not in QUESTIONS:
        raise ValueError(f"question={question!r} is unknown: give {', '.join(map(repr, QUESTIONS))}")
    return question


def clipped(normal, point, bounds, reach):
    """The polygon of the plane through a point across a normal within half-spaces, at most `reach` wide: (n, 3)."""
    across = np.cross(normal, np.eye(3)[np.abs(normal).argmin()])
    across /= np.linalg.norm(across)
    frame = np.stack([across, np.cross(normal, across)])
    polygon = reach * np.array([(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)])
    for n, offset in bounds:
        heights = polygon @ (frame @ n) + (n @ point - offset)
        kept = []
        for i, height in enumerate(heights):
            after = heights[(i + 1) % len(heights)]
            if height <= 0.0:
                kept.append(polygon[i])
            if height * after < 0.0:
                kept.append(polygon[i] + height / (height - after) * (polygon[(i + 1) % len(heights)] - polygon[i]))
        polygon = np.array(kept).reshape(-1, 2)
        if not len(polygon):
            return polygon
    size = np.ptp(polygon, axis=0).max()
    apart = np.linalg.norm(polygon - np.roll(polygon, 1, axis=0), axis=1) > SAME * size
    polygon = polygon[apart] if apart.any() else polygon[:1]
    return point + polygon @ frame
