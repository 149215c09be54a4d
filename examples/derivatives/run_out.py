# SPDX-License-Identifier: MIT OR Apache-2.0
"""Friction recovered from a run-out: Newton's method through a whole simulation, with the derivatives of its contacts.

    python3 examples/derivatives/run_out.py [folder]

A rounded block slides (it does not turn) down a slope of 35 degrees and out on a floor, on linear contacts with dampers and Coulomb's friction. Beside
its state the loop carries the derivative of the state in the coefficient mu, for which contact_derivatives of each contact give that of the
overlap and the normal in the pose. From the measured place of rest Newton's method finds mu. Needs the wheel, matplotlib.
"""
import sys

import numpy as np
import potential_particles as pp

SLOPE, START, MASS, STIFFNESS, GRAVITY, STEP, CREEP = np.radians(35), 3.0, 1.0, 1e5, 9.81, 2e-4, 1e-3
DAMPING = 2 * np.sqrt(STIFFNESS * MASS)
SIDES = [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)]
BLOCK = pp.Particle([(*side, 0.08) for side in SIDES], 0.02, 0.05, 0.2)
UP = [np.array((0.0, 0, 1)), np.array((np.sin(SLOPE), 0, np.cos(SLOPE)))]
WALLS = [pp.Wall((0, 0, 0), up) for up in UP]


def force(x, v, mu, walls=range(2)):
    """Force on the block, and its derivatives in x, v and mu."""
    f, by_x, by_v, by_mu = np.array((0, 0, -MASS * GRAVITY)), np.zeros((3, 3)), np.zeros((3, 3)), np.zeros(3)
    pose = pp.Pose(x, TURN)
    for wall in walls:
        contact = pp.contact_with_plane(BLOCK, pose, WALLS[wall])
        if not contact.overlapping or contact.normal @ UP[wall] > 0:
            continue
        d = pp.boundary_derivatives(BLOCK, pose, contact)
        n = -contact.normal
        press = STIFFNESS * contact.overlap - DAMPING * (n @ v)
        if press <= 0:
            continue
        along = v - n * (n @ v)
        speed = np.sqrt(along @ along + CREEP**2)
        t, across = along / speed, np.eye(3) - np.outer(n, n)
        by_t = (np.eye(3) - np.outer(t, t)) @ across / speed
        f = f + press * (n - mu * t)
        by_x += STIFFNESS * np.outer(n - mu * t, d.overlap[:3])
        by_v += np.outer(n - mu * t, -DAMPING * n) - press * mu * by_t
        by_mu -= press * t
    return f, by_x, by_v, by_mu


def run(mu):
    """Places over time, and the derivative of the last one in mu: the same steps, linearised."""
    x, v = START * np.array((-np.cos(SLOPE), 0, np.sin(SLOPE))) + 0.1 * UP[1], np.zeros(3)
    dx, dv, places = np.zeros(3), np.zeros(3), [x]
    for _ in range(int(6 / STEP)):
        f, by_x, by_v, by_mu = force(x, v, mu)
        v, dv = v + STEP / MASS * f, dv + STEP / MASS * (by_x @ dx + by_v @ dv + by_mu)
        x, dx = x + STEP * v, dx + STEP * dv
        places.append(x)
        if len(places) > 2000 and v @ v < (2 * CREEP) ** 2:
            break
    return np.array(places), dx


TURN = (1, 0, 0, 0)


def main(folder="."):
    measured = run(0.37)[0][-1][0]
    mu, tries = 0.5, []
    for step in range(8):
        places, by_mu = run(mu)
        tries.append((mu, places))
        off = places[-1][0] - measured
        print(f"{step}: mu = {mu:.10f}, at rest at {places[-1][0]:.6f} m ({off:+.1e}), d/dmu = {by_mu[0]:.3f} m")
        if abs(off) < 1e-9:
            break
        mu = max(mu - off / by_mu[0], 0.5 * mu)
    print(f"recovered mu = {mu:.8f} (true 0.37)")
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    figure, axes = plt.subplots(figsize=(7, 3))
    axes.plot([-3.2 * np.cos(SLOPE), 0, 4], [3.2 * np.sin(SLOPE), 0, 0], "k-", lw=1)
    for i, (mu, places) in enumerate(tries):
        axes.plot(places[:, 0], places[:, 2] + 0.05 * i, lw=1, label=f"{mu:.4f}")
    axes.axvline(measured, color="0.6", ls=":")
    axes.legend(title="mu", ncols=2, fontsize=8)
    axes.set(xlabel="x (m)", ylabel="z (m), shifted by try", title="run-outs on the way to the measured one")
    figure.tight_layout()
    figure.savefig(f"{folder}/derivatives_run_out.png", dpi=110)


if __name__ == "__main__":
    main(*sys.argv[1:])
