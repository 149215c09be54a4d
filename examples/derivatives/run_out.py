# SPDX-License-Identifier: MIT OR Apache-2.0
"""Friction recovered from a run-out: Newton's method through a whole simulation, with the derivatives of its contacts.

    python3 examples/derivatives/run_out.py [folder]

A block slides (it does not turn) down a slope of 12 degrees from 2 m/s until friction stops it, on a contact with
spring, damper and Coulomb's friction. Beside its state the loop carries the derivative of the state in the coefficient
mu, for which boundary_derivatives gives that of the overlap and the normal in the pose. From the measured run-out
Newton's method finds mu; closed form: v^2 / (2 g (mu cos - sin)). Needs the wheel, matplotlib.
"""
import sys

import numpy as np
import potential_particles as pp

SLOPE, SPEED, MASS, STIFFNESS, DAMPING, GRAVITY, STEP, CREEP = np.radians(12), 2.0, 1.0, 1e4, 200.0, 9.81, 2e-4, 1e-2
SIDES = [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)]
BLOCK = pp.Particle([(*side, 0.08) for side in SIDES], 0.02, 0.05, 0.2)
DOWN, UP = np.array((np.cos(SLOPE), 0, -np.sin(SLOPE))), np.array((np.sin(SLOPE), 0, np.cos(SLOPE)))
GROUND, TURN = pp.Wall((0, 0, 0), UP), (np.cos(SLOPE / 2), 0, np.sin(SLOPE / 2), 0)


def force(x, v, mu):
    """Force on the block, and its derivatives in x, v and mu."""
    weight, pose = np.array((0, 0, -MASS * GRAVITY)), pp.Pose(x, TURN)
    contact = pp.contact_with_plane(BLOCK, pose, GROUND)
    if not contact.overlapping:
        return weight, np.zeros((3, 3)), np.zeros((3, 3)), np.zeros(3)
    d = pp.boundary_derivatives(BLOCK, pose, contact)
    n, by_n = -contact.normal, -d.normal[:, :3]
    press = STIFFNESS * contact.overlap - DAMPING * (n @ v)
    along = v - n * (n @ v)
    speed = np.sqrt(along @ along + CREEP**2)  # friction without a kink at rest
    t = along / speed
    direction = n - mu * t
    t_by_v = (np.eye(3) - np.outer(t, t)) @ (np.eye(3) - np.outer(n, n)) / speed
    t_by_n = -(np.eye(3) - np.outer(t, t)) @ (np.outer(n, v) + (n @ v) * np.eye(3)) / speed
    by_x = np.outer(direction, STIFFNESS * d.overlap[:3] - DAMPING * (v @ by_n)) + press * (by_n - mu * t_by_n @ by_n)
    by_v = np.outer(direction, -DAMPING * n) - press * mu * t_by_v
    return weight + press * direction, by_x, by_v, -press * t


def run(mu):
    """Ways and speeds down the slope, and the derivative of the last way in mu: the same steps, linearised."""
    sunk = MASS * GRAVITY * np.cos(SLOPE) / STIFFNESS
    x, v = (0.1 - sunk) * UP, SPEED * DOWN
    dx, dv, history = np.zeros(3), np.zeros(3), []
    for _ in range(int(4 / STEP)):
        history.append((x @ DOWN, v @ DOWN))
        f, by_x, by_v, by_mu = force(x, v, mu)
        v, dv = v + STEP / MASS * f, dv + STEP / MASS * (by_x @ dx + by_v @ dv + by_mu)
        x, dx = x + STEP * v, dx + STEP * dv
        if len(history) > 1000 and abs(history[-1][1] - history[-1000][1]) < 1e-7:
            break
    return np.array(history), dx @ DOWN


def main(folder="."):
    measured = SPEED**2 / (2 * GRAVITY * (0.37 * np.cos(SLOPE) - np.sin(SLOPE)))
    mu, tries = 0.5, []
    for step in range(10):
        history, by_mu = run(mu)
        tries.append((mu, history))
        off = history[-1, 0] - measured
        print(f"{step}: mu = {mu:.8f}, run-out {history[-1, 0]:.6f} m ({off:+.1e}), d/dmu = {by_mu:.4f} m")
        if abs(off) < 1e-9:
            break
        mu -= off / by_mu
    print(f"recovered mu = {mu:.5f}; 0.37 by the closed form for rigid contact")
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    figure, axes = plt.subplots(figsize=(7, 3))
    for mu, history in tries:
        axes.plot(*history.T, lw=1, label=f"{mu:.4f}")
    axes.axvline(measured, color="0.6", ls=":")
    axes.legend(title="mu", ncols=2, fontsize=8)
    axes.set(xlabel="way down the slope (m)", ylabel="speed (m/s)",
             title="run-outs on the way to the measured one (dotted)")
    figure.tight_layout()
    figure.savefig(f"{folder}/derivatives_run_out.png", dpi=110)


if __name__ == "__main__":
    main(*sys.argv[1:])
