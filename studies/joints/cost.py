# SPDX-License-Identifier: GPL-3.0-or-later
"""What patches cost: seconds of a step with them over one with points, of the same scene."""
import math

import potential_particles
import yade
from scene import O, add, block_shape, fresh, run, wall
from yade import Quaternion

NUMBER, SIZE, R = 2000, 0.1, 0.005
STIFFNESS = 5e8  # per area, N/m^3
FALLING_STEPS, SETTLING_STEPS, REST_STEPS = 60, 1500, 100


def _pyramid():
    slope = 1 / math.sqrt(5)
    sides = [(2 * x * slope, 2 * y * slope, slope, 0.3 * SIZE - R) for x, y in ((1, 0), (-1, 0), (0, 1), (0, -1))]
    return yade.ConicPotentialParticle(planes=[*sides, (0, 0, -1, 0.25 * SIZE - R)], r=R, k=0.0, R=SIZE)


def _cubes(falling):
    """Five layers: with a gap of 1e-6 of the size below each if they fall, so that all meet in the first steps, else
    sunk in about as far as the layers above press.
    """
    edge, sinking = math.ceil(math.sqrt(NUMBER / 5)), 4.5e-5 * SIZE
    drops = [0.0]
    for layer in range(5):
        drops.append(drops[-1] + (-1e-6 * SIZE if falling else (5 - layer) * sinking))
    for n in range(NUMBER):
        layer, rest = divmod(n, edge * edge)
        add(block_shape((SIZE, ) * 3, r=R), (1.001 * SIZE * (rest % edge), 1.001 * SIZE *
                                             (rest // edge), (layer + 0.5) * SIZE - drops[layer + 1]),
            Quaternion((0, 0, 1), 1e-4 * (n % 7)))


def _pyramids(falling):
    """On their bases, tilted if they fall."""
    edge = math.ceil(math.sqrt(NUMBER))
    for n in range(NUMBER):
        tilt = Quaternion((1, 0, 0), 1e-3 * (1 + n % 7)) if falling else Quaternion.Identity
        add(_pyramid(), (2 * SIZE * (n % edge), 2 * SIZE * (n // edge), 0.25 * SIZE), tilt)


def _law(patch, joints):
    material = dict(young=1e8, poisson=0.3, frictionAngle=0.5)
    fresh(patch=patch and joints, damping=0.3, **material, **({"restitution": 0.5} if patch and joints else {}))
    if not joints:
        for functor in O.engines[3].geomDispatcher.functors:
            functor.patch = patch
        O.engines[3] = yade.ConicInteractionLoop(
            O.engines[3].geomDispatcher.functors,
            [yade.Ip2_FrictMat_FrictMat_KnKsPhys(kn_i=STIFFNESS, ks_i=STIFFNESS, Knormal=STIFFNESS, Kshear=STIFFNESS)],
            [yade.Law2_SCG_KnKsPhys_KnKsLaw(traceEnergy=False)])


def _seconds(make, patch, joints):
    """Of a step as the bodies meet, and at rest; and which part of the patches was carried on then."""
    seconds = []
    for falling in (True, False):
        _law(patch, joints)
        wall((0, 0, 0), 2, 1)
        make(falling)
        O.dt = potential_particles.critical_time_step()
        run((10 if falling else SETTLING_STEPS) * O.dt)
        functors = O.engines[3].geomDispatcher.functors
        for functor in functors:
            functor.resetCounters()
        steps = FALLING_STEPS if falling else REST_STEPS
        seconds.append(run(steps * O.dt) / steps)
    patches, carried = (sum(getattr(functor, name) for functor in functors) for name in ("patches", "patchesCarried"))
    return *seconds, carried / patches if patches else 0.0


def _row(joints):
    row = {}
    for make in (_cubes, _pyramids):
        patched, plain = (_seconds(make, patch, joints) for patch in (True, False))
        name = make.__name__[1:]
        row[f"{name}_at_rest"], row[f"{name}_falling"] = patched[1] / plain[1], patched[0] / plain[0]
        row[f"{name}_seconds"], row[f"{name}_carried"] = patched[:2] + plain[:2], patched[2]
    return {"value": max(row["cubes_at_rest"], row["pyramids_at_rest"]), "target": 1.8,
            "falling": max(row["cubes_falling"], row["pyramids_falling"]), "falling_target": 4.0, **row}


def cost_of_joints():
    """Seconds of a step of 2,000 cubes, of 2,000 pyramids: the law of joints over YADE's at one point; at rest, and as
    they meet.
    """
    return _row(joints=True)


def cost_of_areas():
    """The same with YADE's law of stiffness per area (KnKs), patch over point."""
    return _row(joints=False)


ROWS = {row.__name__: row for row in (cost_of_joints, cost_of_areas)}
