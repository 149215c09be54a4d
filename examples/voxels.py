# SPDX-License-Identifier: MIT OR Apache-2.0
"""Grains of a labelled image of voxels (micro-tomography) become bodies in place: yade -x -n -j1 examples/voxels.py

Environment: IMAGE (a .tif of labels; without it, one of BODIES (1000) rocks is made), PLANES (30), OUTPUT (out/voxels).
Writes voxels.png, with outlines of the bodies over a slice of the image, the bodies, and how far they are off, and
summary.json. Lengths in voxels.
"""
import os
import time

import numpy as np
import potential_particles
from matplotlib import pyplot
from potential_particles import files, packing, shapes
from yade import *

COUNT, PLANES, OUT = int(os.environ.get("BODIES",
                                        1000)), int(os.environ.get("PLANES",
                                                                   30)), os.environ.get("OUTPUT", "out/voxels")


def potential(shape, points):
    """S of a shape at points (n, 3) from its centroid, along its axes; at most 1 within."""
    planes = np.array(shape.planes)
    return (1 - shape.k) / shape.r**2 * (np.maximum(points @ planes[:, :3].T - planes[:, 3], 0)**
                                         2).sum(1) + shape.k / shape.R**2 * (points**2).sum(1)


def local(body, points):
    return (points - np.array(body.state.pos)) @ np.array(body.state.ori.toRotationMatrix())


def image_of_rocks():
    """Labels [z, y, x] of rocks of 24 planes, about 24 voxels wide."""
    side = int(30 * COUNT ** (1 / 3))
    rocks = potential_particles.pack(packing.Box(
        (0, 0, 0), (side, ) * 3), [shapes.random_rock(seed) for seed in range(20)], sizes=24.0, number=COUNT,
                                     dense=True)
    image = np.zeros((side,) * 3, np.uint16)
    for label, number in enumerate(potential_particles.add_packing(rocks), 1):
        body = O.bodies[number]
        low = np.maximum((np.array(body.state.pos) - body.shape.boundingRadius).astype(int), 0)
        box = tuple(slice(a, a + 2 + int(2 * body.shape.boundingRadius)) for a in low[::-1])
        here = image[box]
        points = (np.indices(here.shape).reshape(3, -1).T + 0.5)[:, ::-1] + low
        here[(potential(rocks[label - 1].shape.scaled(rocks[label - 1].scale), local(body, points))
              <= 1).reshape(here.shape)] = label
    O.bodies.clear()
    return image


O.materials.append(FrictMat(young=1e7, density=2650))
image = os.environ.get("IMAGE") or image_of_rocks()
begin, processor = time.perf_counter(), time.process_time()
grains = shapes.from_voxels(image, planes=PLANES)
seconds, processor = time.perf_counter() - begin, time.process_time() - processor
ids = potential_particles.add_packing(grains, color=(0.75, 0.62, 0.45))
os.makedirs(OUT, exist_ok=True)
potential_particles.plot(os.path.join(OUT, "bodies.png"), size=(700, 700))

image = shapes.voxel_image(image)
picture, (left, middle, right) = pyplot.subplots(1, 3, figsize=(12, 3.9), layout="constrained")
z = len(image) // 2
left.imshow(image[z] > 0, cmap="Greys", alpha=0.5, origin="lower", extent=(0, image.shape[2], 0, image.shape[1]))
grid = np.stack(
    np.meshgrid(np.arange(0, image.shape[2], 0.5), np.arange(0, image.shape[1], 0.5), [z + 0.5], indexing="ij"),
    axis=-1)[:, :, 0]
for one, number in zip(grains, ids):
    body = O.bodies[number]
    if abs(body.state.pos[2] - z) < body.shape.boundingRadius:
        near = [
            slice(*(np.clip(2 * (body.state.pos[i] + np.array([-1, 1]) * body.shape.boundingRadius), 0, 2e9).astype(int)
                    + [0, 2])) for i in (0, 1)
        ]
        part = grid[near[0], near[1]]
        values = potential(one.shape, local(body, part.reshape(-1, 3))).reshape(part.shape[:2])
        if values.min() < 1:
            left.contour(part[..., 0], part[..., 1], values, [1.0], colors="C3", linewidths=1)
left.set(title=f"slice z = {z}", xlim=(0, min(150, image.shape[2])), ylim=(0, min(150, image.shape[1])))
middle.imshow(pyplot.imread(os.path.join(OUT, "bodies.png")))
middle.set_axis_off()
right.hist([100 * one.shape.fit.mean for one in grains], 30, label="mean")
right.hist([100 * one.shape.fit.largest for one in grains], 30, label="largest")
right.set(xlabel="off the surface of the voxels, % of the diameter", ylabel="grains")
right.legend()
picture.savefig(os.path.join(OUT, "voxels.png"), dpi=110)
volumes = np.array([one.shape.volume / one.shape.fit.volume for one in grains])
summary = {
    "grains": len(grains), "left_out": len(grains.left_out), "seconds": seconds,
    "processor_seconds": processor, "volume_off": float(np.abs(volumes - 1).max()), "mean_off": float(
        np.median([one.shape.fit.mean for one in grains])), "largest_off": max(one.shape.fit.largest for one in grains)
}
files.write_summary(os.path.join(OUT, "summary.json"), summary)
print(summary)
