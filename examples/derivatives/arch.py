# SPDX-License-Identifier: MIT OR Apache-2.0
"""The least thickness of a semicircular arch by Newton's method on the shape of its voussoirs.

    python3 examples/derivatives/arch.py [folder]

An arch of no tension stands as long as a line of thrust fits into it (Milankovitch 1907). At the least thickness t
(mean radius 1) the line that starts at the extrados of the crown touches the intrados at the haunch and the extrados at
the springing. How far it is from a face is what a voussoir overlaps with a plane through it; the derivatives in the
thickness, via the offsets of its planes, and in the place of the line are those of that contact. Two unknowns, the
thrust H and t; closed form for radial joints: t = 0.10748, hinge at 54.5 degrees. Needs the wheel, matplotlib.
"""
import sys

import numpy as np
import potential_particles as pp

# Voussoirs of half the arch; planes lie so far inwards of the line.
COUNT, ROUNDING, SPHERICITY, INWARDS = 400, 1e-4, 1e-6, 0.02
STEP = 0.5 * np.pi / COUNT


def voussoir(t):
    """About its middle at radius 1, x along the axis of the arch, y outwards; and the derivative of its offsets in t.
    """
    half, middle = 0.5 * STEP, np.cos(0.5 * STEP)
    sides = [(np.cos(half), -np.sin(half), 0, np.sin(half)), (-np.cos(half), -np.sin(half), 0, np.sin(half))]
    faces = [(0, 1, 0, (1 + t / 2) * middle - 1), (0, -1, 0, 1 - (1 - t / 2) * middle), (0, 0, 1, 0.5), (0, 0, -1, 0.5)]
    planes = np.array(sides + faces)
    planes[:, 3] -= ROUNDING
    return pp.Particle(planes, ROUNDING, SPHERICITY, 1.0), np.array([0, 0, middle / 2, middle / 2, 0, 0])


def thrust_line(h, t):
    """Radius of the line at all joints, and its derivatives in H and t."""
    angle = STEP * np.arange(COUNT + 1)
    weight = t * STEP  # of a voussoir of density 1
    radius = np.sinc(0.5 * STEP / np.pi) * (1 + t * t / 12)
    arms = np.concatenate([[0], np.cumsum(radius * np.sin(STEP * (np.arange(COUNT) + 0.5)))])
    load, moment = weight * np.arange(COUNT + 1), weight * arms
    above = h * (1 + t / 2) + moment
    below = h * np.cos(angle) + load * np.sin(angle)
    by_h = (1 + t / 2) / below - above * np.cos(angle) / below**2
    by_t = (h / 2 + moment * (1 / t + t / 6 / (1 + t * t / 12))) / below - above * load / t * np.sin(angle) / below**2
    return above / below, by_h, by_t


def clearance(t, joint, line, outwards):
    """Distance of the line from the extrados or the intrados of the voussoir before a joint, and its derivatives in
    radius and t.
    """
    particle, by_t = voussoir(t)
    place = np.array([line[joint] * np.sin(0.5 * STEP), line[joint] * np.cos(0.5 * STEP) - 1, 0])
    normal = np.array([0, outwards, 0])
    home, wall = pp.Pose((0, 0, 0)), pp.Wall(place - INWARDS * normal, normal)
    contact = pp.contact_with_plane(particle, home, wall)
    gradient = pp.boundary_gradient(particle, home, contact, overlap=1.0)
    by_radius = gradient.poses[6:9] @ (np.sin(0.5 * STEP), np.cos(0.5 * STEP), 0)
    return contact.overlap - INWARDS, by_radius, gradient.planes_a[:, 3] @ by_t


def least_thickness():
    """Thickness, line of thrust and its joint at the haunch."""
    t = 0.15
    h = 0.6 * t
    for step in range(12):
        line, by_h, by_t = thrust_line(h, t)
        haunch = int(np.argmin(line[: COUNT * 4 // 5]))
        value, jacobian = np.zeros(2), np.zeros((2, 2))
        for row, (joint, outwards) in enumerate([(haunch, -1), (COUNT, 1)]):
            value[row], of_radius, of_t = clearance(t, joint, line, outwards)
            jacobian[row] = of_radius * by_h[joint], of_radius * by_t[joint] + of_t
        print(
            f"{step}: t = {t:.12f}, H = {h:.6f}, hinge at {np.degrees(haunch * STEP):.1f} degrees, clearances {value[0]:+.1e} {value[1]:+.1e}"
        )
        if max(abs(value)) < 1e-13:
            return t, line, haunch
        h, t = (h, t) - np.linalg.solve(jacobian, value)
    raise ArithmeticError("Newton's method did not settle")


def main(folder="."):
    t, line, haunch = least_thickness()
    print(f"least thickness {t:.5f} of the mean radius (closed form 0.10748)")
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    angle, (figure, axes) = STEP * np.arange(COUNT + 1), plt.subplots(figsize=(7, 4))
    for radius, style in ((1 - t / 2, "k-"), (1 + t / 2, "k-"), (line, "r-")):
        x, y = radius * np.sin(angle), radius * np.cos(angle)
        axes.plot(np.concatenate([-x[::-1], x]), np.concatenate([y[::-1], y]), style, lw=1)
    for joint in (0, haunch, COUNT):
        axes.plot([line[joint] * np.sin(angle[joint]), -line[joint] * np.sin(angle[joint])],
                  [line[joint] * np.cos(angle[joint])] * 2, "ro", ms=5)
    axes.set(aspect="equal",
             title=f"least thickness {t:.5f} R, hinges at 0, {np.degrees(haunch * STEP):.1f} and 90 degrees")
    figure.tight_layout()
    figure.savefig(f"{folder}/derivatives_arch.png", dpi=110)


if __name__ == "__main__":
    main(*sys.argv[1:])
