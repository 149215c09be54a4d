# SPDX-License-Identifier: GPL-3.0-or-later
# Voxels as bodies in place, surfaces that are not convex as clumps: volumes and places against those given. Scans as
# shapes: python/tests/test_scans.py.
import os
import sys
import tempfile
import types
import warnings

import numpy as np
import potential_particles
import yade
from harness import *
from potential_particles import shapes

check = Checks()
folder = tempfile.mkdtemp()
O.materials.append(yade.FrictMat(density=2000.0))


def told(action):
    """What an action returns, and what it warns of."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        made = action()
    return made, [str(one.message) for one in caught]


def write(points, triangles, name):
    path = os.path.join(folder, name + ".obj")
    with open(path, "w") as file:
        file.writelines("v %.9g %.9g %.9g\n" % tuple(p) for p in points)
        file.writelines("f %d %d %d\n" % tuple(i + 1 for i in t) for t in triangles)
    return path


# A solid that is not convex, an L.
outline = np.array([(0, 0), (2, 0), (2, 0.5), (0.5, 0.5), (0.5, 1.5), (0, 1.5)], float)
solid = np.array([(x, y, z) for z in (0, 0.6) for x, y in outline])
cap = [(0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 5)]
sides = [t for i in range(6) for t in ((i, (i + 1) % 6, i + 6), ((i + 1) % 6, (i + 1) % 6 + 6, i + 6))]
ell = write(solid, [(a, c, b) for a, b, c in cap] + [(a + 6, b + 6, c + 6) for a, b, c in cap] + sides, "ell")
VOLUME = 0.6 * (2 * 0.5 + 0.5)
shape, said = told(lambda: shapes.from_mesh(ell, hull=True))
check.true(len(said) == 1 and "more volume" in said[0] and "clump_from_mesh" in said[0], f"the hull of an L: {said}")
shape, said = told(lambda: shapes.from_mesh(ell, hull=True, planes=12))
check.true(
    abs(shape.volume / VOLUME - 1) < 1e-3 and not said and shape.fit.largest > 0.1,
    f"its volume can be kept, its form cannot: {shape}, {said}")

# Cut by hand, in the place of the packages that cut.
real = {name: sys.modules.get(name) for name in ("coacd", "vhacdx")}
sys.modules.update(coacd=None, vhacdx=None)
check.raises(ImportError, lambda: shapes.clump_from_mesh(ell), "neither is there", "pip install")
boxes = [[(x, y, z) for x in xs for y in ys for z in (0, 0.6)]
         for xs, ys in (((0, 2), (0, 0.5)), ((0, 0.5), (0.4, 1.5)))]
asked = {}


def cut(mesh, **settings):
    asked.update(settings, size=np.ptp(mesh[0], axis=0).max())
    return [((np.array(box) - (1, 0.75, 0.3)) / 2, None) for box in boxes]


sys.modules["coacd"] = types.SimpleNamespace(set_log_level=lambda level: None, Mesh=lambda *mesh: mesh, run_coacd=cut)
parts = shapes.clump_from_mesh(ell, parts=5, concavity=0.1)
check.equal((asked["max_convex_hull"], asked["threshold"], round(asked["size"], 6)), (5, 0.1, 1.0),
            "what the cutter is asked for")
# They share 0.5 x 0.1 x 0.6, which the union counts once.
check.true(len(parts.shapes) == 2 and abs(parts.error) < 3e-3, f"two parts, whose union is the L: {parts}")
check.close(parts.volume, VOLUME, 1e-6, "the volume of the surface")
O.reset()
O.materials.append(yade.FrictMat(density=2000.0))
number = potential_particles.add_clump(parts, position=(0, 0, 5), color=(1, 0, 0))
check.close(O.bodies[number].state.mass / (2000 * VOLUME), 1.0, 3e-3, "mass of the clump")
centre = Vector3(*((0.5 * np.array([1, 0.25]) + 0.25 * np.array([0.25, 1])) / 0.75), 5.3)
check.close(O.bodies[number].state.pos, centre, 5e-3, "which stands where the file has it")
open_one = write(solid, [(a, c, b) for a, b, c in cap] + sides, "open")
check.raises(ValueError, lambda: shapes.clump_from_mesh(open_one), "an open surface", "close it, or")
sys.modules.update(
    coacd=None,
    vhacdx=types.SimpleNamespace(compute_vhacd=lambda points, faces, **_: [((np.array(box) - (1, 0.75, 0.3)) / 2, None)
                                                                           for box in boxes if faces[0] == 3]))
check.close(
    shapes.clump_from_mesh(ell).error, parts.error, 1e-9, "V-HACD, whose faces begin with their number of corners")
for name, module in real.items():
    sys.modules.pop(name)
    if module is not None:
        sys.modules[name] = module

# Voxels: rocks at known places in an image of [z, y, x].
N, EDGE = 26, 0.01
grid = np.indices((N, N, N)).reshape(3, -1).T + 0.5
image, rocks = np.zeros((2 * N, 2 * N, 2 * N), np.uint16), {}
for number, corner in enumerate([(0, 0, 0), (0, N, N), (N, 0, N)], 1):
    rock = shapes.random_rock(number, size=0.15, elongation=0.8, flatness=0.8)
    place = np.array([0.13, 0.12, 0.135])
    at = grid[:, ::-1] * EDGE - place
    planes = np.array(rock.planes)
    s = (1 - rock.k) / rock.r**2 * (np.maximum(at @ planes[:, :3].T - planes[:, 3], 0.0)**
                                    2).sum(1) + rock.k / rock.R**2 * (at**2).sum(1)
    image[tuple(slice(c, c + N) for c in corner)] = np.where(s <= 1, number, 0).reshape(N, N, N)
    rocks[number] = rock, place + np.array(corner)[::-1] * EDGE
image[-2:, -2:, -2:] = 7
grains = shapes.from_voxels(image, spacing=EDGE, planes=20, progress=False)
check.equal((len(grains), list(grains.left_out)), (3, [7]), "a body for each grain, none for eight voxels")
check.true("fewer than 64" in grains.left_out[7] and "\n" not in repr(grains) and "3 of" in repr(grains), repr(grains))
O.reset()
O.materials.append(yade.FrictMat(density=2000.0))
ids = potential_particles.add_packing(grains)
for number, (one, body) in enumerate(zip(grains, ids), 1):
    rock, place = rocks[number]
    voxels = np.count_nonzero(image == number) * EDGE**3
    check.close(one.shape.volume / voxels, 1.0, 1e-3, "the volume of its voxels")
    check.close(O.bodies[body].state.pos, Vector3(*place), 0.25 * EDGE, "in place, to a quarter of a voxel")
    check.close(sorted(O.bodies[body].state.inertia)[0] / (2000 * min(rock.inertia)), 1.0, 0.08, "its inertia")
    check.true(one.shape.fit.mean < 0.03 and len(one.shape.planes) <= 20, f"near to it: {one.shape}")
touching = shapes.from_voxels(np.pad(image, 1)[1:, 1:, 1:], spacing=EDGE, border=False, least=8, progress=False)
check.equal(touching.left_out.get(7), None, "eight voxels are enough if one says so")
image[0, N // 2, N // 2] = 1
check.true("touches the border" in shapes.from_voxels(image, border=False, progress=False).left_out[1],
           "cut off by the border")

# The same from a file.
from PIL import Image  # noqa: E402
pages = [Image.fromarray(page) for page in image]
path = os.path.join(folder, "labels.tif")
pages[0].save(path, save_all=True, append_images=pages[1:])
again = shapes.from_voxels(path, spacing=EDGE, planes=20, progress=False)
check.equal([one.shape.volume for one in again],
            [one.shape.volume for one in shapes.from_voxels(image, EDGE, 20, progress=False)], "from a .tif file")
for bad, words in ((np.zeros((3, 3, 3), int), "no grain"), (np.zeros((3, 3), int), "three axes"), (np.full(
    (3, 3, 3), 0.5), "whole numbers"), (np.full(
        (3, 3, 3), -1), "range from -1"), (path + "f", "is no file"), (ell, "cannot be read as .tif")):
    check.raises(ValueError, lambda: shapes.from_voxels(bad), f"{words}", words)


# Labels as they come; files of pages, whole and damaged.
grains = np.zeros((12, 12, 12), int)
grains[1:6, 1:6, 1:6], grains[7:11, 7:11, 7:11] = 2**31 - 1, 5
made = shapes.from_voxels(grains, progress=False)
check.equal([one.shape.name for one in made], ["grain 5", f"grain {2**31 - 1}"], "large labels")
check.close(made[1].shape.volume, 125.0, 0.1, "the grain of the largest one")
from PIL import Image  # noqa: E402
pages = [Image.fromarray(page.astype(np.int32)) for page in grains]
tif = os.path.join(folder, "grains.tif")
pages[0].save(tif, save_all=True, append_images=pages[1:])
check.equal(len(shapes.from_voxels(tif, progress=False)), 2, "a .tif")
whole = open(tif, "rb").read()
seed = 1
random, refused = np.random.default_rng(seed), 0
warnings.simplefilter("ignore")
for number in range(200):
    content = bytearray(whole)
    for _ in range(random.integers(1, 6)):
        content[random.integers(len(content))] = random.integers(256)
    with open(tif, "wb") as file:
        file.write(content[:random.integers(len(content))] if number % 3 == 0 else content)
    try:
        shapes.voxel_image(tif)
    except ValueError as error:
        refused += 1
        if "grains.tif" not in str(error) and "labels" not in str(error):
            check.true(False, f"seed {seed}, file {number}: {error}")
    except Exception as error:
        check.true(False, f"seed {seed}, file {number}: {error!r}")
check.true(refused > 30, f"damaged pages are refused, seed {seed}: {refused}")
check.finish()
