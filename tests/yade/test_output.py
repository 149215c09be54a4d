# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes against the shape, pictures against what must be seen in them, and recorded frames against the scene."""
import os
import tempfile
import warnings

import numpy as np
from yade import Body, FrictMat, Vector3, utils

import potential_particles
from potential_particles import shapes
from harness import Checks, O, cube, plain, pyramid, pyramid_planes, turned
from potential_particles.output import vtk_files
from potential_particles.output.rasteriser import NOTHING, nearest_triangles

import yade

check = Checks()
folder = tempfile.mkdtemp()


def path(name):
    return os.path.join(folder, name)


def edges_of(triangles):
    return np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])


def closed(triangles):
    """Whether each edge is met once each way round."""
    edges = {tuple(edge) for edge in edges_of(triangles)}
    return len(edges) == 3 * len(triangles) and all((b, a) in edges for a, b in edges)


def test_mesh():
    for shape in (pyramid(), cube(r=1e-6, k=0), plain(pyramid_planes(), r=0.05, k=0.05, R=0.7)):
        mesh = potential_particles.mesh(shape, 1e-2)
        check.true(closed(mesh.triangles), "a mesh is closed")
        reference = yade.ConicPotentialParticle(planes=list(zip(shape.a, shape.b, shape.c, shape.d)), r=shape.r, k=shape.k, R=shape.R)
        radius = reference.boundingRadius
        check.true(0 < mesh.error <= 1e-2 * radius, "its error is within the tolerance")
        off = max(abs(reference.surfaceDistance([Vector3(*point)])[0] - np.linalg.norm(point)) for point in mesh.points)
        check.true(off < 1e-12 * radius, f"its points lie on the surface, off by {off:g}")
        # Rays through the middle of the triangles, which lie inside.
        middles = mesh.points[mesh.triangles].mean(1)
        gap = np.array(reference.surfaceDistance([Vector3(*m) for m in middles])) - np.linalg.norm(middles, axis=1)
        check.true(gap.min() > -1e-12, "it lies inside the particle")
    shape = shapes.cuboid((1, 2, 3))
    mesh = potential_particles.mesh(shape, 1e-3)
    a, b, c = (mesh.points[mesh.triangles[:, i]] for i in range(3))
    volume = (a * np.cross(b, c)).sum() / 6
    check.true(0 < 1 - volume / shape.volume < 5e-3, f"a Shape has a mesh, of its volume: {volume} and {shape.volume}")
    check.raises(ValueError, lambda: potential_particles.mesh(cube(), 0), "tolerance 0", "[1e-5, 1]")
    check.raises(ValueError, lambda: potential_particles.mesh(cube(), float("nan")), "tolerance nan", "[1e-5, 1]")
    check.raises(ValueError, lambda: potential_particles.mesh(yade.PotentialParticle(k=2)), "a shape that is none", "k=2")


def test_mesh_files():
    made = potential_particles.mesh(cube(), 1e-2)
    potential_particles.save_mesh(path("cube.vtp"), made, position=(1, 2, 3))
    found = vtk_files.read(path("cube.vtp"))
    check.true(np.allclose(found["points"], made.points + [1, 2, 3], atol=1e-14), "a .vtp has the points")
    check.true((found["triangles"] == made.triangles).all() and np.allclose(found["normal"], made.normals), "and the rest")
    potential_particles.save_mesh(path("cube.stl"), cube(), 1e-2)
    # 80 bytes of text, the number of triangles, 50 bytes each.
    data = open(path("cube.stl"), "rb").read()
    check.equal((len(data), int(np.frombuffer(data[80:84], np.uint32)[0])),
                (84 + 50 * len(made.triangles), len(made.triangles)), "size of a .stl")
    check.raises(ValueError, lambda: potential_particles.save_mesh(path("cube.obj"), cube()), "another ending", ".stl or .vtp")
    check.raises(OSError, lambda: potential_particles.save_mesh(path("nowhere/cube.stl"), cube()), "no such folder", "nowhere")
    check.true(not [name for name in os.listdir(folder) if name.endswith(".part")], "no unfinished file stays")


def test_rasteriser():
    """Against the nearest of many random triangles, by the sign of areas at each pixel's centre."""
    random = np.random.default_rng(7)
    corners = np.concatenate([random.uniform(-5, 25, (60, 3, 2)), random.uniform(1, 2, (60, 3, 1))], axis=2)
    closeness, index = nearest_triangles(corners, 20, 15)
    x, y = np.meshgrid(np.arange(20) + 0.5, np.arange(15) + 0.5)
    best, name = np.full(x.shape, -np.inf), np.full(x.shape, NOTHING)
    for i, (a, b, c) in enumerate(corners):
        area = np.linalg.det([b[:2] - a[:2], c[:2] - a[:2]])
        if area >= 0:
            continue
        parts = [((q[0] - p[0]) * (y - p[1]) - (q[1] - p[1]) * (x - p[0])) / area for p, q in ((b, c), (c, a), (a, b))]
        near = sum(part * corner[2] for part, corner in zip(parts, (a, b, c)))
        seen = (np.min(parts, axis=0) >= 0) & (near > best)
        best[seen], name[seen] = near[seen], i
    check.true((index == name).all(), f"nearest triangle, {(index != name).sum()} of {index.size} pixels differ")
    hit = index != NOTHING
    check.true(hit.any() and np.allclose(closeness[hit], best[hit]), "and how near it is")


def add(shape, position, colour, **more):
    shape.color = colour
    body = Body()
    body.shape, body.material = shape, O.materials[0]
    body.state.pos = position
    for name, value in more.items():
        setattr(body.state, name, value)
    return O.bodies.append(body)


def mixed_scene():
    O.reset()
    O.materials.append(FrictMat())
    ids = {
        "pyramid": add(pyramid(), (0, 0, 0.5), (1, 0, 0), vel=(1, 2, 3), angVel=(4, 5, 6), ori=turned((1, 2, 3), 0.7)),
        "cube": add(cube(), (1.5, 0, 0.5), (0, 1, 0)),
        "sphere": O.bodies.append(utils.sphere((3, 0, 0.5), 0.5, color=(0, 0, 1))),
        "facet": O.bodies.append(utils.facet([(-1, -1, 0), (4, -1, 0), (4, 1, 0)])),
        "box": O.bodies.append(utils.box((1.5, 1.5, 0.5), (2, 0.1, 0.5))),
        "wall": O.bodies.append(utils.wall(-0.1, axis=2)),
    }
    return ids


def shown(image, channel):
    """Pixels in which one colour clearly leads: (number, mean column)."""
    others = np.delete(image[:, :, :3], channel, axis=2).max(2)
    rows, columns = np.nonzero(image[:, :, channel] - others > 0.2)
    return len(columns), columns.mean() if len(columns) else None


def test_plot():
    from matplotlib.image import imread
    mixed_scene()
    potential_particles.plot(path("scene.png"), size=(300, 200))
    image = imread(path("scene.png"))
    check.equal(image.shape[:2], (200, 300), "size of the picture")
    counts, columns = zip(*(shown(image, channel) for channel in range(3)))
    check.true(min(counts) > 300, f"all bodies are seen: {counts}")
    # From the front, x runs to the right.
    check.true(columns[0] < columns[1] < columns[2], f"in their places: {columns}")
    potential_particles.plot(path("behind.png"), towards=(0, 1, 0.4), size=(300, 200))
    count, _ = shown(imread(path("behind.png")), 0)
    check.true(count > 300, "a boundary in front of the bodies is left out")
    O.reset()
    check.raises(ValueError, lambda: potential_particles.plot(path("empty.png")), "an empty scene", "nothing to draw")
    O.materials.append(FrictMat())
    add(cube(), (0, 0, 0), (1, 1, 1))
    add(yade.GridNode(), (2, 0, 0), (1, 1, 1))
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        potential_particles.plot(path("one.png"), size=(100, 100))
        potential_particles.plot(path("one.png"), size=(100, 100))
    check.true(len(told) <= 1, "what is not drawn is said once")


def test_recorder():
    ids = mixed_scene()
    other = add(cube(), (1.5, 0, 1.49), (0, 1, 0))
    O.engines = [
        yade.ForceResetter(),
        yade.InsertionSortCollider([yade.PotentialParticle2AABB(), yade.Bo1_Sphere_Aabb()], verletDist=0),
        yade.InteractionLoop([yade.Ig2_ConicPP_ConicPP_ScGeom()],
                             [yade.Ip2_FrictMat_FrictMat_FrictPhys()],
                             [yade.Law2_ScGeom_FrictPhys_CundallStrack(sphericalBodies=False)]),
    ]
    O.dt = 1e-6
    record = potential_particles.Recorder(path("frames/run"))
    record()
    O.run(2, True)
    record()
    bodies = vtk_files.read(path("frames/run.bodies.0000002.vtp"))
    check.equal(set(bodies["id"]), {*ids.values(), other}, "all bodies are in the frame")
    of = bodies["id"] == ids["pyramid"]
    state = O.bodies[ids["pyramid"]].state
    check.true(np.allclose(bodies["velocity"][of], state.vel) and np.allclose(bodies["angular_velocity"][of], state.angVel),
               "with their velocities")
    points = bodies["points"][bodies["triangles"][of]].reshape(-1, 3) - np.array(state.pos)
    local = points @ np.array(state.ori.toRotationMatrix())
    worst = max(abs(O.bodies[ids["pyramid"]].shape.surfaceDistance([Vector3(*p)])[0] - np.linalg.norm(p)) for p in local[:60])
    check.true(worst < 1e-5, f"their points lie on the surface where it is, off by {worst:g}")
    contacts = vtk_files.read(path("frames/run.contacts.0000002.vtp"))
    contact = O.interactions[ids["cube"], other]
    check.true(contact.isReal and len(contacts["points"]) == 1, "one contact is real, and in the frame")
    for name, value in (("points", contact.geom.contactPoint), ("normal", contact.geom.normal),
                        ("normal_force", contact.phys.normalForce), ("shear_force", contact.phys.shearForce)):
        check.true(np.allclose(contacts[name][0], value, rtol=1e-6, atol=1e-12), f"its {name}")
    check.true(np.linalg.norm(contacts["normal_force"][0]) > 0, "and it pushes")
    check.equal((contacts["id1"][0], contacts["id2"][0]), (contact.id1, contact.id2), "its bodies")
    index = open(path("frames/run.bodies.pvd")).read()
    check.equal(index.count("<DataSet"), 2, "frames of the series")
    check.true(not [name for name in os.listdir(path("frames")) if name.endswith(".part")], "no unfinished file stays")


test_mesh()
test_mesh_files()
test_rasteriser()
test_plot()
test_recorder()
check.finish()
