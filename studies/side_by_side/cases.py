# SPDX-License-Identifier: MIT OR Apache-2.0
"""The scenes that both functors run, from identical initial states. SI units, z up, floor at z = 0.

Each exists with springs of fixed stiffness (N/m) and with springs per contact area (N/m^3), which
is what Law2_SCG_KnKsPhys_KnKsLaw makes of its stiffness when the functor finds an area.
"""

from dataclasses import dataclass

import numpy as np
import yade
from yade import O

import pile
from bodies import reach
from box import SLAB_SPHERICITY, Box
from loose_grid import loose_grid
from particles import ball, block, half_height, material, octahedron, plain_body
from pyramid import pyramid

GRAVITY = 9.81
TOWER_CUBES = 10


@dataclass
class Springs:
    """Stiffness in N/m, or N/m^3 where the functor finds the contact area; and the step that suits it, s."""

    normal: float
    shear: float
    step: float


@dataclass
class Case:
    """A scene to be run. `place` fills O.bodies and returns the ids of the free bodies."""

    name: str
    size: float  # of a particle, m, to which overlaps are related
    place: callable  # with Springs and whether they are per area
    fixed: Springs
    per_area: Springs
    friction: float  # degrees
    viscous: float  # damping along the normal, of critical
    local: float  # YADE's local damping
    density: float  # kg/m^3
    duration: float  # of a full run, s

    def steps(self, area):
        return round(self.duration / self.springs(area).step)

    def springs(self, area):
        return self.per_area if area else self.fixed

    def start(self, contact, area):
        """Empties YADE, builds the scene around a ContactFunctor, and returns the ids of the free bodies."""
        O.reset()
        springs = self.springs(area)
        ids = self.place(self, springs, area)
        O.engines = loop(contact.functor, springs, self.viscous, self.local)
        O.dt = springs.step
        O.timingEnabled = True
        contact.prepare()
        return ids

    def material(self):
        return material(self.friction, self.density)


def loop(functor, springs, viscous=0.0, local=0.0, **more):
    """YADE's engines around a contact functor."""
    engines = pile.engines(functor, normal=springs.normal, shear=springs.shear, viscous=viscous, local=local, **more)
    # The only method of YADE 2023.02a. The default of later ones steps the angular velocity, so that the angular
    # momentum is right only to the order of the step, and what a functor adds to it could not be told.
    if hasattr(engines[-1], "rotAlgorithm"):
        engines[-1].rotAlgorithm = "Fincham1992"
    return engines


def heap(case, kinds, seed):
    """The kinds, one body each, on a loose grid in a box with walls."""
    radius = max(reach(kind) for kind in kinds)
    grid = loose_grid(len(kinds), radius, 0.03 * case.size, seed)
    box = Box(1.15 * grid.half_width, 1.15 * grid.half_width, grid.height + case.size, thickness=case.size)
    stuff = case.material()
    O.bodies.append(box.slabs(yade.PotentialParticle, stuff))
    return [
        O.bodies.append(plain_body(kind, stuff, position, orientation))
        for kind, position, orientation in zip(kinds, grid.positions, grid.orientations)
    ]


def place_pyramids(case, _springs, _area):
    """The pyramids of the demo, a dozen of them."""
    kind = pyramid(case.size)
    return heap(case, [kind] * 12, pile.SEED)


def place_cubes(case, _springs, _area):
    """Rounded cubes, frictionless, in a walled box."""
    half = 0.5 * case.size
    return heap(case, [block(half, 0.1 * half, 0.2)] * 8, seed=100)


def place_mixed(case, _springs, _area):
    """Faces from almost flat to round, edges from sharp to blunt, and one ball."""
    s = case.size
    kinds = [
        block(0.5 * s, 0.02 * s, 0.02),
        block(0.45 * s, 0.2 * s, 0.3),
        block((0.5 * s, 0.35 * s, 0.25 * s), 0.05 * s, 0.1),
        block(0.4 * s, 0.1 * s, 0.9),
        pyramid(0.9 * s, 0.1, 0.05),
        pyramid(0.8 * s, 0.02, 0.3),
        octahedron(0.4 * s, 0.03 * s, 0.05),
        octahedron(0.4 * s, 0.15 * s, 0.6),
        ball(0.4 * s),
    ]
    return heap(case, kinds, seed=7)


def tower_cube(case):
    return block(0.5 * case.size, 0.1 * case.size, 0.05)


def tower_overlaps(case, springs):
    """What each contact of the tower carries over its stiffness, from the floor up: the closed form."""
    weight = tower_cube(case).volume * case.density * GRAVITY
    return weight * np.arange(TOWER_CUBES, 0, -1) / springs.normal


def place_tower(case, springs, area):
    """Ten cubes on each other, at rest: overlaps carry the weights. Per area they start touching."""
    cube, stuff = tower_cube(case), case.material()
    # Rounded by half its thickness: its surface is flat, see box.py.
    plate = block((2.0 * case.size, 2.0 * case.size, 0.5 * case.size), 0.5 * case.size, SLAB_SPHERICITY)
    height = half_height(plate)
    O.bodies.append(plain_body(plate, stuff, (0.0, 0.0, -height), fixed=True))
    overlaps = np.zeros(TOWER_CUBES) if area else tower_overlaps(case, springs)
    half, height, ids = half_height(cube), 0.0, []
    for overlap in overlaps:
        height += half - overlap
        ids.append(O.bodies.append(plain_body(cube, stuff, (0.0, 0.0, height))))
        height += half
    return ids


CASES = [
    Case(
        "pyramids", pile.SIZE, place_pyramids, Springs(pile.NORMAL_STIFFNESS, pile.SHEAR_STIFFNESS, pile.TIME_STEP),
        Springs(1e9, 5e8, 4e-5), friction=pile.FRICTION_ANGLE, viscous=pile.VISCOUS_DAMPING, local=pile.LOCAL_DAMPING,
        density=pile.DENSITY, duration=0.9),
    Case("cubes", 1.0, place_cubes, Springs(1e8, 1e7, 4e-4), Springs(1e8, 1e7, 4e-4), friction=0.0, viscous=0.05,
         local=0.0, density=2000.0, duration=3.0),
    # So viscous that the slowest mode of the chain is still within the run.
    Case("tower", 1.0, place_tower, Springs(1e8, 5e7, 4e-4), Springs(1e8, 5e7, 4e-4), friction=30.0, viscous=1.0,
         local=0.0, density=2000.0, duration=1.6),
    Case("mixed", 0.1, place_mixed, Springs(1.5e6, 7.5e5, 1.2e-4), Springs(5e8, 2.5e8, 3.5e-5), friction=20.0,
         viscous=0.3, local=0.1, density=2600.0, duration=0.6),
]
