# SPDX-License-Identifier: GPL-3.0-or-later
"""Piles that come to rest: the unbalanced force after 2.5 s, and how far contact points still move."""
import potential_particles
from potential_particles import boundaries, packing, shapes
from scene import O, fresh, moving, run
from yade import Vector3, utils

SIZE = 0.15
STEP = 1.5e-5  # s; critical_time_step() of the pile at rest is 1.54e-5


def _rest(shape, number, height, seconds=2.5):
    """Bodies that fall into a box from where they are loosely packed: not from high above, for a corner that hits at
    speed goes in deep.
    """
    fresh(damping=0.3, young=1e9, poisson=0.3, frictionAngle=0.5, restitution=0.5)
    low, high = (-0.5, -0.5, 0), (0.5, 0.5, height)
    for place in potential_particles.pack(packing.Box(low, high), [shape], number=number):
        potential_particles.add_packing([place])
    O.bodies.append(boundaries.box_walls(low, high))
    if len(moving()) != number:
        raise RuntimeError(f"{len(moving())} of {number} bodies fit into the box: make it higher than {height} m")
    O.dt = STEP
    took = run(seconds)
    before = _points()
    run(O.dt)
    after = _points()
    jitter = max((after[pair] - point).norm() for pair, point in before.items() if pair in after)
    return {
        "value": utils.unbalancedForce(), "target": 1e-5, "jitter": jitter / SIZE, "jitter_target": 1e-6,
        "seconds": took, "kinetic_energy": utils.kineticEnergy(), "bodies": number
    }


def _points():
    return {(contact.id1, contact.id2): Vector3(contact.geom.contactPoint)
            for contact in O.interactions if contact.isReal}


def cubes_at_rest():
    """Unbalanced force of 50 cubes in a box after 2.5 s, and how far points of contact move in a step, over the size.
    """
    return _rest(shapes.cuboid((SIZE,) * 3, k=0), 50, 1.6)


def pyramids_at_rest():
    """The same of 200 four-sided pyramids."""
    return _rest(shapes.prism(sides=4, radius=0.6 * SIZE, height=0.8 * SIZE, top_radius=0, k=0), 200, 2.4)


ROWS = {row.__name__: row for row in (cubes_at_rest, pyramids_at_rest)}
