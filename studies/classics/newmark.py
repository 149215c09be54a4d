# SPDX-License-Identifier: MIT OR Apache-2.0
"""Newmark's block: it rests on a plane that is shaken, and slides down a little in every cycle.

Newmark (1965). The plane dips by a and moves along its dip with the acceleration A sin(w t). Downwards relative to the
plane the block is accelerated by A sin(w t) - Y, with the yield acceleration Y = g (cos a tan(friction) - sin a). It
starts when that exceeds 0, and stops when its velocity is 0 again.
"""

import numpy as np
import yade
from scipy.optimize import brentq
from yade import O

from report import row, target, worst
from block_scene import GRAVITY, Scene, box_corners, tilted_gravity

TITLE = "Newmark's block on a shaken plane"
SLOPE, FRICTION = 15.0, 30.0  # degrees
FREQUENCY = 1.0  # Hz
RATIOS = (1.2, 1.5, 2.0, 2.5)  # A over Y; from 2.7 on it would slide upwards as well
CYCLES = 4


def yield_acceleration(slope, friction):
    """m/s^2; degrees."""
    a, phi = np.radians(slope), np.radians(friction)
    return GRAVITY * (np.cos(a) * np.tan(phi) - np.sin(a))


def displacement(ratio, yields, omega):
    """In one cycle, m: A = ratio Y, Y = yields (m/s^2), w = omega (1/s). The block rests at the beginning of the next.
    """
    start = np.arcsin(1.0 / ratio)

    def velocity(phase):  # times w / A
        return np.cos(start) - np.cos(phase) - (phase - start) / ratio

    high = 2.0 * np.pi + start
    if velocity(high) > 0.0:
        raise ValueError(f"ratio={ratio:g}: the block would not come to rest within a cycle; take a smaller one")
    # Velocity grows until the phase pi - start, and falls from there to its only zero.
    stop = brentq(velocity, np.pi - start, high, xtol=1e-14)
    way = np.cos(start) * (stop - start) - (np.sin(stop) - np.sin(start)) - 0.5 * (stop - start) ** 2 / ratio
    return ratio * yields / omega**2 * way


def simulate(ratio, cycles=CYCLES):
    """Time (s) and way (m) relative to the plane, looked at 40 times a cycle."""
    omega = 2.0 * np.pi * FREQUENCY
    amplitude = ratio * yield_acceleration(SLOPE, FRICTION) / omega**2
    scene = Scene(size=1.0, load=1.0, moving=True)
    plane = scene.block(box_corners(8.0, 2.0, 1.0), fixed=True, position=(0, 0, -0.5))
    block = scene.block(box_corners(1.0, 1.0, 1.0), position=(0, 0, 0.5))
    shaking = yade.HarmonicMotionEngine(ids=[plane.id], A=(0, 0, 0), f=(FREQUENCY, 0, 0), fi=(0, 0, 0), dead=True)
    scene.start(FRICTION, gravity=tilted_gravity(SLOPE), before=[shaking])
    scene.settle()
    # The engine's velocity is -a w sin(w t + fi), a its amplitude. The plane is to have a w cos(w t'), t' from now, so
    # that it is accelerated upwards by A sin(w t'). The block shares the velocity at first.
    shaking.A = (amplitude, 0, 0)
    shaking.fi = (-0.5 * np.pi - omega * O.time, 0, 0)
    shaking.dead = False
    block.state.vel = block.state.vel + yade.Vector3(amplitude * omega, 0, 0)
    begin, origin, looks = O.time, block.state.pos[0] - plane.state.pos[0], [(0.0, 0.0)]
    for look in range(1, 40 * cycles + 1):
        scene.run(begin + look / (40 * FREQUENCY) - O.time)
        looks.append((O.time - begin, block.state.pos[0] - plane.state.pos[0] - origin))
    scene.check()
    return np.array(looks).T


def run(note, short):
    """Four strengths of shaking, or one."""
    omega, yields = 2.0 * np.pi * FREQUENCY, yield_acceleration(SLOPE, FRICTION)
    rows, paths, ratios = [], [], RATIOS[2:3] if short else RATIOS
    for number, ratio in enumerate(ratios, 1):
        time, way = simulate(ratio)
        closed, found = displacement(ratio, yields, omega), float(way[-1]) / CYCLES
        rows.append(row(f"way of a cycle, A = {ratio:g} Y", closed, found, "m", relative=True))
        paths.append({"ratio": ratio, "time": time.tolist(), "way": way.tolist(), "cycle": closed})
        note(number / len(ratios))
    aim = target("Newmark: error of the way of a cycle, relative", 5e-3, worst(rows))
    return {"title": TITLE, "rows": rows, "targets": [aim], "data": {"paths": paths, "frequency": FREQUENCY}}
