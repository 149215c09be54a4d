# SPDX-License-Identifier: MIT OR Apache-2.0
"""What oblique, off-centre impacts do to the energy: no gravity, friction or damping.

    scripts/yade.sh -j1 studies/side_by_side/off_centre.py

Environment: IMPACTS (16), STIFFNESS (10000 N/m). For the library and YADE's own functor, at time steps each half of the
one before, the change of the kinetic energy over an impact. What shrinks with the step is the step's; what stays is the
law's: overlap times stiffness along the normal is not the gradient of any energy.
"""

import sys
from pathlib import Path

# YADE runs a script without its folder on Python's path.
HERE = Path(sys.argv[0]).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent)]

import numpy as np
from yade import O, Vector3, utils

import settings
from bounce import world_inertia
from cases import Springs, loop
from contact_functor import BUILTIN, DROP_IN, ContactFunctor
from particles import block, material, plain_body
from pyramid import pyramid

ROUNDING = 0.1  # m; bodies of 1 m
STEPS = (1e-4, 5e-5, 2.5e-5)  # s at 10,000 N/m, where an impact lasts some 200 of the first
LONGEST = 1.0  # s


def main():
    impacts = settings.whole_number("IMPACTS", 16, 1, "number of impacts")
    stiffness = settings.whole_number("STIFFNESS", 10_000, 1, "stiffness of the contacts, N/m")
    print("functor   step (s)  impacts  change of energy: median  worst    overlap/r  stored/energy")
    for kind, steps in ((DROP_IN, STEPS), (BUILTIN, STEPS[1:2])):
        for step in (one * (1e4 / stiffness) ** 0.5 for one in steps):
            found = [impact(kind, seed, step, stiffness) for seed in range(impacts)]
            change, deepest, stored = np.abs([one for one in found if one]).T
            print(
                f"{kind:8}  {step:7.1e}   {len(change):7}  {np.median(change):24.2e}  {change.max():.2e} "
                f"{np.median(deepest):9.1e}  {np.median(stored):13.2f}",
                flush=True,
            )


def impact(kind, seed, step, stiffness):
    """Relative change of the kinetic energy, largest overlap over r, and the energy then stored over the whole; None
    when the two miss each other.
    """
    chance = np.random.default_rng(seed)
    contact = ContactFunctor(kind)
    O.reset()
    stuff = material(0.0, 1.0)
    cube = block(0.5, ROUNDING, 0.1)
    for side, shape in ((1, cube), (-1, pyramid(1.0, ROUNDING, 0.1) if seed % 2 else cube)):
        turn = chance.normal(size=4)
        beside = chance.uniform(-0.25, 0.25, size=2)
        body = plain_body(shape, stuff, (-0.95 * side, *beside), tuple(turn / np.linalg.norm(turn)))
        body.state.vel = Vector3(side, *chance.uniform(-0.2, 0.2, size=2))
        body.state.angVel = Vector3(*chance.uniform(-1.0, 1.0, size=3))
        body.state.angMom = world_inertia(body.state) * body.state.angVel
        O.bodies.append(body)
    # Kept contacts, so that the law's step without force at the start of each is not in it.
    O.engines = loop(contact.functor, Springs(stiffness, stiffness, step), gravity=0.0, never_erase=True)
    O.dt = step
    contact.prepare()
    before, deepest, met = utils.kineticEnergy(), 0.0, False
    while O.time < LONGEST:
        O.step()
        overlap = max((i.geom.penetrationDepth for i in O.interactions if i.isReal), default=0.0)
        if met and overlap <= 0.0:
            break
        met = met or overlap > 0.0
        deepest = max(deepest, overlap)
    if not met:
        return None
    return utils.kineticEnergy() / before - 1.0, deepest / ROUNDING, 0.5 * stiffness * deepest**2 / before


main()
