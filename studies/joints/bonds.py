# SPDX-License-Identifier: GPL-3.0-or-later
"""What is measured of bonds and cohesion: rows as of rows.py."""
import math

import numpy as np

import potential_particles
from scene import O, add, block_shape, fresh, run, wall
from yade import Quaternion, Vector3

NORMAL, SHEAR = 1e9, 4e8  # stiffness per area, N/m^3
STRENGTH = 1e5  # Pa
STRONG = 1e30
LENGTH, WIDTH, HEIGHT, RADIUS, OVERLAP = 0.1, 0.2, 0.1, 1e-4, 1e-10
B, H = WIDTH - 2 * RADIUS, HEIGHT - 2 * RADIUS  # of the flat part of a face
AREA, BENDING, POLAR = B * H, B * H**3 / 12, B * H * (B**2 + H**2) / 12


def _chain(number, bonds=True, gravity=(0, 0, 0), **material):
    """Blocks in a row along x, the first one held, bonded: the moving ones."""
    fresh(gravity=gravity, **{**dict(normalStiffness=NORMAL, shearStiffness=SHEAR, frictionAngle=0.5, cohesion=STRONG,
                                     tensileStrength=STRONG), **material})
    O.engines[3].physDispatcher.functors[0].bonds = bonds
    blocks = [
        add(block_shape((LENGTH, WIDTH, HEIGHT), r=RADIUS), ((LENGTH - OVERLAP) * i, 0, 0), fixed=i == 0)
        for i in range(number + 1)
    ]
    O.dt = 1e-6
    return blocks[1:]


def _bears(move, load, **material):
    """The largest load until the bond of two blocks breaks; move(block, i) places the second one in step i."""
    block, = _chain(1, **material)
    block.state.blockedDOFs = "xyzXYZ"
    O.step()
    most = 0.0
    for i in range(1, 5000):
        move(block, i)
        O.step()
        if not any(contact.isReal and contact.phys.bonded for contact in O.interactions):
            return most
        most = max(most, load(O.forces.f(block.id), O.forces.t(block.id)))
    raise RuntimeError("the bond does not break")


def _displaced(*way):
    def move(block, i):
        block.state.pos = Vector3(LENGTH - OVERLAP, 0, 0) + i * Vector3(*way)
    return move


def _turned(axis, angle):
    """About an axis through the middle of the joint."""
    def move(block, i):
        block.state.ori = Quaternion(Vector3(*axis), i * angle)
        block.state.pos = Vector3(LENGTH / 2, 0, 0) + block.state.ori * Vector3(LENGTH / 2 - OVERLAP, 0, 0)
    return move


def bond_strength():
    """Load at the first crack of a bond: tension s A, shear c A, bending s b h^2/6 (both ways), twist c J/r_max;
    relative error.
    """
    step, corner = STRENGTH / 2000, math.hypot(B, H) / 2
    found = {
        "tension": _bears(_displaced(step / NORMAL, 0, 0), lambda f, t: -f[0], tensileStrength=STRENGTH) /
                   (STRENGTH * AREA),
        "shear": _bears(_displaced(0, step / SHEAR, 0), lambda f, t: -f[1], cohesion=STRENGTH) / (STRENGTH * AREA),
        "bending": _bears(_turned((0, 1, 0), 2 * step / NORMAL / H), lambda f, t: -t[1], tensileStrength=STRENGTH) /
                   (STRENGTH * B * H**2 / 6),
        "bending across": _bears(_turned(
            (0, 0, 1), 2 * step / NORMAL / B), lambda f, t: -t[2], tensileStrength=STRENGTH) /
                          (STRENGTH * H * B**2 / 6),
        "twist": _bears(_turned((1, 0, 0), step / SHEAR / corner), lambda f, t: -t[0], cohesion=STRENGTH) /
                 (STRENGTH * POLAR / corner),
    }
    return {"value": max(abs(share - 1) for share in found.values()), "target": 5e-3, "shares": found}


def fracture_energy():
    """Energy of a bond that is pulled apart, against strength (elastic opening + softening) A/2: brittle, and with
    softening.
    """
    shares = []
    for softening in (0.0, 3 * STRENGTH / NORMAL):
        block, = _chain(1, tensileStrength=STRENGTH, softening=softening)
        block.state.blockedDOFs = "xyzXYZ"
        O.trackEnergy = True
        for i in range(10000):
            _displaced(STRENGTH / NORMAL / 2000, 0, 0)(block, i)
            O.step()
        shares.append(O.energy["bondBreaking"] / (0.5 * STRENGTH * (STRENGTH / NORMAL + softening) * AREA))
    return {"value": max(abs(share - 1) for share in shares), "target": 5e-3, "shares": shares}


def _pushed(bonds, cohesion, peak, residual, pressure=1e5):
    """Peak and residual shear force of a cuboid that is pressed on a wall and pushed along it."""
    fresh(gravity=(0, 0, 0), normalStiffness=NORMAL, shearStiffness=SHEAR, cohesion=cohesion,
          residualCohesion=0.2 * cohesion, tensileStrength=STRONG, frictionAngle=math.atan(peak),
          residualFrictionAngle=math.atan(residual))
    O.engines[3].physDispatcher.functors[0].bonds = bonds
    wall((0, 0, 0), 2, 1)
    block = add(block_shape((LENGTH, WIDTH, HEIGHT), r=1e-3), (0, 0, 0.5 * HEIGHT - pressure / NORMAL))
    block.state.blockedDOFs = "xyzXYZ"
    block.state.vel = Vector3(0.05, 0, 0)
    O.dt, forces = 1e-5, []
    for _ in range(4000):
        O.step()
        forces.append(-O.forces.f(block.id)[0])
    return max(forces), forces[-1], O.forces.f(block.id)[2], O.interactions[0, 1].geom.contactArea


def mohr_coulomb():
    """Shear force of a cohesive joint and of a bond, at the peak c A + mu N and after it; relative error."""
    worst = 0.0
    for bonds in (False, True):
        for cohesion, peak, residual in ((STRENGTH, 0.6, 0.3), (STRENGTH, 0.0, 0.0), (0.0, 0.6, 0.3)):
            most, last, normal, area = _pushed(bonds, cohesion, peak, residual)
            worst = max(worst, abs(most / (cohesion * area + peak * normal) - 1),
                        abs(last / (0.2 * cohesion * area + residual * normal) - 1) if cohesion or residual else last)
    return {"value": worst, "target": 5e-3}


def deflection(number=6, load=10.0):
    """Static deflection at the end of a cantilever of bonded blocks, against the sum over its joints of M s/(k_n I) +
    Q/(k_s A).
    """
    blocks = _chain(number)
    end = blocks[-1]
    O.dt = potential_particles.critical_time_step()
    O.engines[-1].damping = 0.5
    O.forces.setPermF(end.id, Vector3(0, 0, -load))
    run(2.0)
    arms = [end.state.pos[0] - LENGTH * (i + 0.5) for i in range(number)]
    expected = sum(load * arm**2 / (NORMAL * BENDING) + load / (SHEAR * AREA) for arm in arms)
    return {"value": abs(-end.state.pos[2] / expected - 1), "target": 5e-3, "deflection": expected,
            "speed": end.state.vel.norm()}


def _lowest_mode(blocks):
    """Circular frequency and shape (deflection, rotation about y of each block) of rigid blocks with the springs of the
    joints.
    """
    number = len(blocks)
    stiffness, mass = np.zeros((2 * number, 2 * number)), np.zeros(2 * number)
    for i, block in enumerate(blocks):
        mass[2 * i:2 * i + 2] = block.state.mass, block.state.inertia[1]
        # Slip and rotation of the joint before block i; a turn about y by t lowers what lies at x by t x.
        slip, bend = np.zeros(2 * number), np.zeros(2 * number)
        slip[2 * i], slip[2 * i + 1], bend[2 * i + 1] = 1, LENGTH / 2, 1
        if i > 0:
            slip[2 * i - 2], slip[2 * i - 1], bend[2 * i - 1] = -1, LENGTH / 2, -1
        stiffness += SHEAR * AREA * np.outer(slip, slip) + NORMAL * BENDING * np.outer(bend, bend)
    root = 1 / np.sqrt(mass)
    values, vectors = np.linalg.eigh(root[:, None] * stiffness * root)
    shape = root * vectors[:, 0]
    return math.sqrt(values[0]), shape / shape[-2]


def frequency(number=6, periods=3):
    """Lowest natural frequency of the same cantilever, against the eigenvalue of rigid blocks with the springs of the
    joints.
    """
    blocks = _chain(number)
    O.dt = 0.5 * potential_particles.critical_time_step()
    O.step()
    circular, shape = _lowest_mode(blocks)
    for i, block in enumerate(blocks):
        block.state.pos += Vector3(0, 0, 1e-5 * shape[2 * i])
        block.state.ori = Quaternion(Vector3(0, 1, 0), 1e-5 * shape[2 * i + 1])
        block.state.vel, block.state.angVel, block.state.angMom = Vector3.Zero, Vector3.Zero, Vector3.Zero
    crossings, before, start = [], blocks[-1].state.pos[2], O.time
    while len(crossings) < 2 * periods + 1:
        O.step()
        now = blocks[-1].state.pos[2]
        if now * before < 0:
            crossings.append(O.time - start - O.dt * now / (now - before))
        before = now
        if O.time - start > 4 * math.pi * periods / circular:
            raise RuntimeError("it does not swing")
    found = math.pi * 2 * periods / (crossings[-1] - crossings[0])
    return {
        "value": abs(found / circular - 1), "target": 5e-3, "hertz": circular / (2 * math.pi), "found": found /
                                                                                                        (2 * math.pi)
    }


ROWS = {row.__name__: row for row in (bond_strength, fracture_energy, mohr_coulomb, deflection, frequency)}
