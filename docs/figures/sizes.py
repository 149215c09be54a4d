# SPDX-License-Identifier: MIT OR Apache-2.0
"""The picture of docs/shapes.md of sizes: how far diameters and volumes of round bodies are from closed forms, by the
number of planes.

    scripts/yade.sh -j1 docs/figures/sizes.py        # writes docs/pictures/sizes.png
"""
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

import potential_particles
from potential_particles import polyhedron, shapes
from yade import Vector3

SIDES, PLANES = (6, 8, 12, 16, 24, 32, 48, 64, 96, 128, 256), (8, 12, 20, 30, 48, 60, 80, 100, 130, 200, 300)
POINTS, RAYS = 6000, 1500


def directions(count):
    """Unit vectors spread evenly on a spiral."""
    i = np.arange(count) + 0.5
    z, turn = 1.0 - 2.0 * i / count, i * np.pi * (3.0 - np.sqrt(5.0))
    return np.column_stack([np.sqrt(1 - z**2) * np.cos(turn), np.sqrt(1 - z**2) * np.sin(turn), z])


def scan(axes):
    """Shapes by the number of planes, of points of an ellipsoid; half of its diameters along rays; its volume."""
    axes = np.array(axes)
    return (PLANES, lambda planes: shapes.from_vertices(directions(POINTS) * axes, planes=planes),
            lambda rays: 1.0 / np.linalg.norm(rays / axes, axis=1), 4.0 / 3.0 * np.pi * axes.prod(), directions(RAYS))


def cylinder(radius, height):
    """The same by the number of sides, across."""
    rays = directions(RAYS) * (1.0, 1.0, 0.0)
    return (SIDES, lambda sides: shapes.cylinder(radius, height, sides), lambda rays: np.full(len(rays), radius),
            np.pi * radius**2 * height, rays / np.linalg.norm(rays, axis=1)[:, None])


BODIES = {"cylinder, sides": cylinder(0.5, 1.0), "scan of a sphere": scan((1.0, 1.0, 1.0)),
          "of an ellipsoid 1 : 0.7 : 0.5": scan((1.0, 0.7, 0.5)), "1 : 0.5 : 0.3": scan((1.0, 0.5, 0.3))}  # fmt: skip


def off(shape, of_rays, volume, rays):
    """Of diameters, the largest and in the mean of squares, and of the volume, as shares."""
    local = rays @ polyhedron.rotation(shape.orientation)
    along = [Vector3(*one) for one in np.concatenate([local, -local])]
    both = np.array(potential_particles.conic_particle(shape).surfaceDistance(along)).reshape(2, -1)
    shares = np.abs(both.mean(0) / of_rays(rays) - 1.0)
    return shares.max(), np.sqrt((shares**2).mean()), abs(shape.volume / volume - 1.0)


def main():
    figure, (of_diameters, of_volume) = plt.subplots(1, 2, figsize=(8.2, 3.4), dpi=90, sharex=True, layout="constrained")
    for number, (name, (counts, build, of_rays, volume, rays)) in enumerate(BODIES.items()):
        largest, mean, of_volumes = 100.0 * np.array([off(build(n), of_rays, volume, rays) for n in counts]).T
        of_diameters.loglog(counts, largest, "o-", color=f"C{number}", ms=3, label=name)
        of_diameters.loglog(counts, mean, ":", color=f"C{number}")
        of_volume.loglog(counts, of_volumes, "o-", color=f"C{number}", ms=3)
    for axes, target, title in (of_diameters, 0.2, "diameters: most, dotted the mean"), (of_volume, 0.5, "volume"):
        axes.axhline(target, color="0.6", lw=0.8, zorder=0)
        axes.set(xlabel="planes, or sides", ylabel="off by, %", title=title)
        axes.grid(alpha=0.3)
    of_volume.set_ylim(0.05, 1.0)
    of_diameters.legend(fontsize=7, loc="lower left")
    figure.savefig("docs/pictures/sizes.png")


main()
