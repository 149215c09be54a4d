# SPDX-License-Identifier: MIT OR Apache-2.0
"""A particle fitted to a scanned grain: normals and offsets of its planes, r and k, by the derivatives of contacts in
the shape.

    python3 examples/derivatives/grain.py [folder]

The scan, 600 points with normals and a noise of 0.3 % of the size, is that of a superellipsoid with a bump. Seen from a
point c outside, the surface is at the distance rho*s_b, the scale of a ball about c at its closest point on the
particle (formulation "closest"). Least squares on these distances, by Gauss-Newton (scipy), with rows of the Jacobian
from contact_gradient. Needs the wheel, scipy, matplotlib.
"""
import sys

import numpy as np
import potential_particles as pp

PLANES, POINTS, NOISE, OUT, BALL = 20, 600, 0.003, 0.4, 0.8


def fibonacci(count):
    z = 1 - (2 * np.arange(count) + 1) / count
    angle = np.arange(count) * np.pi * (3 - 5**0.5)
    return np.stack([np.sqrt(1 - z * z) * np.cos(angle), np.sqrt(1 - z * z) * np.sin(angle), z], axis=1)


def scanned(random):
    """Points and outward normals: (x/1)^6 + (y/0.8)^6 + (z/0.6)^4 with a bump towards (1, 1, 1)."""
    u = fibonacci(POINTS)
    bump = lambda x: np.exp(6 * (x @ np.full(3, 3**-0.5)) / np.linalg.norm(x, axis=1) - 6)
    level = lambda x: ((x[:, 0]) ** 6 + (x[:, 1] / 0.8) ** 6 + (x[:, 2] / 0.6) ** 4) / (1 + bump(x))
    low, high = np.full(POINTS, 0.1), np.full(POINTS, 3.0)
    for _ in range(60):
        middle = 0.5 * (low + high)
        inside = level(u * middle[:, None]) < 1
        low, high = np.where(inside, middle, low), np.where(inside, high, middle)
    x = u * low[:, None]
    g = np.stack([(level(x + 1e-6 * e) - level(x - 1e-6 * e)) for e in np.eye(3)], axis=1)
    g /= np.linalg.norm(g, axis=1)[:, None]
    return x + NOISE * random.normal(size=(POINTS, 1)) * g, g


def shape(p):
    """Particle of the unknowns: planes, ln r, and k by the logistic function."""
    return pp.Particle(p[:-2].reshape(-1, 4), float(np.exp(p[-2])), float(1 / (1 + np.exp(-p[-1]))), 1.2)


class Fit:
    def __init__(self, points, normals):
        self.poses, self.ball = [pp.Pose(c) for c in points + OUT * normals], pp.Particle.sphere(BALL)
        self.settings, self.home = pp.Settings("closest", solve_separated=True), pp.Pose((0, 0, 0))

    def contacts(self, p):
        particle = shape(p)
        return particle, [pp.detect(particle, self.home, self.ball, pose, self.settings) for pose in self.poses]

    def residuals(self, p):
        return np.array([BALL * contact.s_b - OUT for contact in self.contacts(p)[1]])

    def jacobian(self, p):
        rows, (particle, contacts) = [], self.contacts(p)
        for pose, contact in zip(self.poses, contacts):
            g = pp.contact_gradient(particle, self.home, self.ball, pose, contact, self.settings, s_b=BALL)
            r, k, _ = g.rounding_a
            rows.append(np.concatenate([g.planes_a.ravel(), [r * particle.r, k * particle.k * (1 - particle.k)]]))
        return np.array(rows)


def start_from(points):
    towards = fibonacci(PLANES)
    offsets = 0.8 * np.max(points @ towards.T, axis=0) - 0.1
    return np.concatenate([np.column_stack([towards, offsets]).ravel(), [np.log(0.1), -2.0]])


def main(folder="."):
    from scipy.optimize import least_squares
    points, normals = scanned(np.random.default_rng(7))
    fit = Fit(points, normals)
    start = start_from(points)
    found = least_squares(fit.residuals, start, fit.jacobian, method="lm", max_nfev=60)
    particle, before, after = shape(found.x), fit.residuals(start), found.fun
    rms = lambda e: float(np.sqrt(np.mean(e**2)))
    print(
        f"rms distance {rms(before):.4f} -> {rms(after):.5f} (noise {NOISE}) in {found.njev} Jacobians; r = {particle.r:.3f}, k = {particle.k:.3f}"
    )
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    figure = plt.figure(figsize=(10, 4.2))
    for i, (p, errors, title) in enumerate([(start, before, "start"), (found.x, after, "fitted")]):
        axes = figure.add_subplot(1, 2, i + 1, projection="3d")
        mesh = shape(p).mesh(0.01)
        axes.plot_trisurf(*mesh.vertices.T, triangles=mesh.triangles.astype(int), color="0.8", alpha=0.5, linewidth=0)
        dots = axes.scatter(*points.T, c=errors, s=5, cmap="coolwarm", vmin=-0.02 if i else -0.2,
                            vmax=0.02 if i else 0.2)
        figure.colorbar(dots, shrink=0.6, label="distance")
        axes.set(title=f"{title}: rms {rms(errors):.4f}", aspect="equal")
    figure.tight_layout()
    figure.savefig(f"{folder}/derivatives_grain.png", dpi=110)


if __name__ == "__main__":
    main(*sys.argv[1:])
