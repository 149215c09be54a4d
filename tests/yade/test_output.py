# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes against the shape, pictures against what must be seen in them, and recorded frames against the scene."""
import math
import os
import tempfile
import warnings

import numpy as np
from yade import Body, FrictMat, Vector3, utils

import potential_particles
from potential_particles import shapes
from harness import Checks, O, cube, joint_scene, plain, pyramid, pyramid_planes, run, turned
from matplotlib.image import imread
from potential_particles.output import picture, values, vtk_files
from potential_particles.output.drawn import ShapeMeshes, corners_of, drawn, edges
from potential_particles.output.mesh import mesh
from potential_particles.output.patches import patches

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
        reference = yade.ConicPotentialParticle(planes=list(zip(shape.a, shape.b, shape.c, shape.d)), r=shape.r,
                                                k=shape.k, R=shape.R)
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
    check.raises(ValueError, lambda: potential_particles.mesh(yade.PotentialParticle(k=2)), "a shape that is none",
                 "k=2")


def test_mesh_files():
    made = potential_particles.mesh(cube(), 1e-2)
    potential_particles.save_mesh(path("cube.vtp"), made, position=(1, 2, 3))
    found = vtk_files.read(path("cube.vtp"))
    check.true(np.allclose(found["points"], made.points + [1, 2, 3], atol=1e-14), "a .vtp has the points")
    check.true((found["triangles"] == made.triangles).all() and np.allclose(found["normal"], made.normals),
               "and the rest")
    potential_particles.save_mesh(path("cube.stl"), cube(), 1e-2)
    # 80 bytes of text, the number of triangles, 50 bytes each.
    data = open(path("cube.stl"), "rb").read()
    check.equal((len(data), int(np.frombuffer(data[80:84], np.uint32)[0])),
                (84 + 50 * len(made.triangles), len(made.triangles)), "size of a .stl")
    check.raises(ValueError, lambda: potential_particles.save_mesh(path("cube.obj"), cube()), "another ending",
                 ".stl or .vtp")
    check.raises(OSError, lambda: potential_particles.save_mesh(path("nowhere/cube.stl"), cube()), "no such folder",
                 "nowhere")
    check.true(not [name for name in os.listdir(folder) if name.endswith(".part")], "no unfinished file stays")


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
    check.true(count > 300, "bodies are seen through a boundary in front of them")
    O.reset()
    O.bodies.append(utils.box((0, 0, 0), (1, 1, 1)))
    potential_particles.plot(path("walls.png"), size=(100, 100))
    # The side that the sun does not reach, the one that it grazes, and the top.
    shades = np.unique(np.round(imread(path("walls.png"))[30:70, 30:70, 0], 1))
    check.true(len(shades) > 1 and shades.max() < 0.97, f"a scene of boundaries alone is drawn: {shades}")
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


def rays(view, width, height):
    """Directions from the eye through the pixels, (height, width, 3), of a pinhole camera."""
    right, up, forward = view.axes()
    x, y = np.meshgrid(np.arange(width) + 0.5 - width / 2, height / 2 - np.arange(height) - 0.5)
    scale = 0.5 * height / np.tan(0.5 * view.angle)
    return forward + np.multiply.outer(x / scale, right) + np.multiply.outer(y / scale, up)


def grown(mask, pixels):
    """A mask with all within so many pixels of it."""
    for _ in range(pixels):
        padded = np.pad(mask, 1)
        mask = padded[1:-1, 1:-1] | padded[:-2, 1:-1] | padded[2:, 1:-1] | padded[1:-1, :-2] | padded[1:-1, 2:]
    return mask


def seen(image):
    """Pixels that are not paper."""
    return (image < 0.97).any(2)


def test_outline():
    """The silhouette of an ellipse of a sphere, and of a sharp cube, against rays that meet them; at any place and
    size.
    """
    width, height = 300, 240
    for size, middle in ((1.0, np.zeros(3)), (1e-4, np.array([2.0, -1.0, 3.0])), (1e5, np.array([1e8, 0.0, -1e8]))):
        for kind in ("sphere", "cube"):
            O.reset()
            O.materials.append(FrictMat())
            if kind == "sphere":
                O.bodies.append(utils.sphere(middle, size, color=(1, 0, 0)))
            else:
                add(cube_of(size), middle, (1, 0, 0), ori=turned((1, 2, 3), 0.7))
            triangles = drawn(list(O.bodies), ShapeMeshes(1e-3))
            view = picture.framing(*triangles, (0.5, -0.8, 0.4), width / height)
            image = picture.render(*triangles, view, width, height)
            eye, way = view.eye - middle, rays(view, width, height)
            if kind == "sphere":
                nearest = eye - way * ((way @ eye) / (way**2).sum(-1))[:, :, None]
                hit = np.linalg.norm(nearest, axis=-1) < size
            else:
                turn = np.array(O.bodies[0].state.ori.toRotationMatrix())
                with np.errstate(divide="ignore"):
                    bounds = np.sort([(side * size - eye @ turn) / (way @ turn) for side in (-1, 1)], axis=0)
                hit = bounds[0].max(-1) < bounds[1].min(-1)
            check.true(hit.mean() > 0.1 and not (seen(image) & ~grown(hit, 2)).any(),
                       f"a {kind} of {size:g}: empty outside its outline")
            inside = ~grown(~hit, 2)
            check.true(seen(image)[inside].all(), f"a {kind} of {size:g}: filled within its outline")
            red = image[inside]
            check.true((red[:, 0] > 0.2).all() and (red[:, 1:] < 0.02).all(),
                       f"a {kind} of {size:g}: in its colour, {red.mean(0)}")


def cube_of(size):
    """A cube of half edge `size`, with edges too sharp to be seen as round."""
    planes = [(*axis, size * (1 - 1e-4)) for axis in np.concatenate([np.eye(3), -np.eye(3)])]
    return yade.ConicPotentialParticle(planes=planes, r=1e-4 * size, k=0, R=2 * size)


def test_light():
    """A red cube above a floor: where the sun, at (-0.45, -0.55, 1), does not reach, the floor is darker, and nowhere
    else.
    """
    O.reset()
    O.materials.append(FrictMat())
    add(cube_of(0.5), (0, 0, 1), (1, 0, 0))
    # Out of the picture, so that the floor on it is all of one colour: that fades with the distance from the bodies'
    # middle.
    for x, y in ((-4, -4), (4, 4)):
        O.bodies.append(utils.sphere((x, y, 1), 0.1, color=(1, 0, 0)))
    O.bodies.append(utils.wall(0.0, axis=2))
    triangles = drawn(list(O.bodies), ShapeMeshes(1e-3))
    width, height = 320, 320
    view = picture.framing_view(np.array([(x, y, 0.0) for x in (-2, 2) for y in (-2, 2)]), (0, 0, 1), 0.42, 1.0)
    image = picture.render(*triangles, view, width, height)
    way = rays(view, width, height)
    ground = view.eye + way * (-view.eye[2] / way[:, :, 2])[:, :, None]
    # To the sun: into the cube |x|, |y|, |z - 1| < 0.5 or not.
    sun = np.array([-0.45, -0.55, 1.0])
    bounds = np.sort([((0, 0, 1) + side * np.full(3, 0.5) - ground) / sun for side in (-1, 1)], axis=0)
    shade = bounds[0].max(-1) < bounds[1].min(-1)
    red = image[:, :, 0] - image[:, :, 1] > 0.2
    floor = ~grown(red, 12)
    bright, dark = image[floor & ~grown(shade, 3)], image[floor & ~grown(~shade, 3)]
    check.true(len(bright) > 500 and len(dark) > 500, f"light and shade are seen: {len(bright)} and {len(dark)} pixels")
    check.true(dark.max() < bright.min() - 0.1,
               f"shade is darker: up to {dark.max():.2f}, light from {bright.min():.2f}")
    wide = picture.framing_view(np.array([(x, y, 0.0) for x in (-20, 20) for y in (-20, 20)]), (0, 0, 1), 0.42, 1.0)
    image = picture.render(*triangles, wide, width, height)
    check.true(image[160, 180].max() < 0.97 and image[0].min() > 0.99, "the floor fades into the paper")


def test_transparent():
    """A facet before a body shows it, in its hue; one behind it changes nothing."""
    from matplotlib.image import imread

    def drawn_with(y):
        O.reset()
        O.materials.append(FrictMat())
        O.bodies.append(utils.sphere((0, 0, 0), 0.5, color=(1, 0, 0)))
        if y is not None:
            O.bodies.append(utils.facet([(-0.6, y, -0.4), (0.6, y, -0.4), (0, y, 0.6)]))
        potential_particles.plot(path("one.png"), towards=(0, -1, 0), size=(200, 200))
        return imread(path("one.png"))[:, :, :3]

    without, front, back = drawn_with(None)[100, 100], drawn_with(-0.6)[100, 100], drawn_with(0.6)[100, 100]
    check.true(front[0] - front[1] > 0.3, f"the body is seen through it: {front}")
    check.true(front[1] > without[1] + 0.02, f"as through a pale glass: {front}, without it {without}")
    check.true(np.allclose(back, without, atol=0.02), f"behind it changes nothing: {back}")


def test_graphics():
    """Without OpenGL there is an error that names the packages; several pictures, from several threads, are alike."""
    import ctypes
    from concurrent.futures import ThreadPoolExecutor
    mixed_scene()
    triangles = drawn(list(O.bodies), ShapeMeshes(0.02))
    view = picture.framing(*triangles, (0.5, -0.8, 0.4), 1.0)
    first = picture.render(*triangles, view, 100, 100)
    with ThreadPoolExecutor(2) as threads:
        again = list(threads.map(lambda _: picture.render(*triangles, view, 100, 100), range(4)))
    check.true(all((image == first).all() for image in again), "pictures of one scene are equal, in several threads")
    load = ctypes.CDLL

    def without_egl(name, *more, **others):
        if name.startswith("libEGL"):
            raise OSError(f"{name}: cannot open shared object file")
        return load(name, *more, **others)

    ctypes.CDLL = without_egl
    try:
        check.raises(RuntimeError, lambda: potential_particles.plot(path("none.png")), "no OpenGL",
                     "apt install python3-vtk9 libegl1")
    finally:
        ctypes.CDLL = load


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
    check.true(
        np.allclose(bodies["velocity"][of], state.vel) and np.allclose(bodies["angular_velocity"][of], state.angVel),
        "with their velocities")
    stress = potential_particles.body_stresses()[ids["pyramid"]]
    check.close(np.abs(bodies["stress"][of][0] - np.array([stress[i, j] for i in range(3) for j in range(3)])).max(), 0.0,
                1e-9 * max(1.0, abs(stress[2, 2])), f"and stress {stress}")
    check.close(np.abs(bodies["colour"][of][0] - np.array(O.bodies[ids["pyramid"]].shape.color)).max(), 0.0, 1e-12,
                "and colour")
    points = bodies["points"][bodies["triangles"][of]].reshape(-1, 3) - np.array(state.pos)
    local = points @ np.array(state.ori.toRotationMatrix())
    worst = max(
        abs(O.bodies[ids["pyramid"]].shape.surfaceDistance([Vector3(*p)])[0] - np.linalg.norm(p)) for p in local[:60])
    check.true(worst < 1e-5, f"their points lie on the surface where it is, off by {worst:g}")
    contacts = vtk_files.read(path("frames/run.contacts.0000002.vtp"))
    contact = O.interactions[ids["cube"], other]
    check.true(contact.isReal and len(contacts["points"]) == 1, "one contact is real, and in the frame")
    for name, value in (("points", contact.geom.contactPoint), ("normal", contact.geom.normal),
                        ("normal_force", contact.phys.normalForce), ("shear_force", contact.phys.shearForce)):
        check.true(np.allclose(contacts[name][0], value, rtol=1e-6, atol=1e-12), f"its {name}")
    check.true(np.linalg.norm(contacts["normal_force"][0]) > 0, "and it pushes")
    check.equal((contacts["id1"][0], contacts["id2"][0]), (contact.id1, contact.id2), "its bodies")
    chains = vtk_files.read(path("frames/run.chains.0000002.vtp"))
    # Recorded after the step: its contact point and force, the centres as they have moved on.
    check.true(np.allclose(chains["points"], [O.bodies[i].state.pos for i in (contact.id1, contact.id2)]),
               "a line between the centres")
    check.close(chains["push"][0], contact.phys.normalForce.norm(), 1e-6 * contact.phys.normalForce.norm(),
                "with the force by which they push")
    check.equal((chains["id1"][0], chains["id2"][0]), (contact.id1, contact.id2), "of its bodies")
    index = open(path("frames/run.bodies.pvd")).read()
    check.equal(index.count("<DataSet"), 2, "frames of the series")
    check.true(not [name for name in os.listdir(path("frames")) if name.endswith(".part")], "no unfinished file stays")


def summed(made):
    """Area of patches, force of their pressure, and its centre."""
    a, b, c = made.corners[:, 0], made.corners[:, 1], made.corners[:, 2]
    area = 0.5 * np.linalg.norm(np.cross(b - a, c - a), axis=1)
    force = area * made.pressure.mean(1)
    # Of a pressure that is linear on each triangle.
    weights = (made.pressure[:, :, None] * (made.corners + made.corners.sum(1)[:, None])).sum(1) / 12
    return area.sum(), force.sum(), (area[:, None] * weights).sum(0) / force.sum()


def joined(bonds=False, periodic=False):
    O.reset()
    O.periodic = periodic
    material = yade.ConicJointMat(normalStiffness=1e9, shearStiffness=5e8, frictionAngle=0.5, density=2000.0,
                                  cohesion=1e30, tensileStrength=1e30)
    joint_scene(yade.ConicInteractionLoop, material, 0.0, (0, 0, 0), False, 1e-6, bonds=bonds)
    if periodic:
        O.cell.setBox(4, 4, 4)
        O.engines[1].allowBiggerThanPeriod = True


def block(position, **more):
    return O.bodies[add(cube(r=1e-3, k=0.0), position, (1, 1, 1), **more)]


def test_patches():
    depth = 1e-5
    # Under even and under one-sided pressure, on a wall, on two facets, on another cube, and across a periodic cell.
    for under in ("wall", "facets", "cube", "cell"):
        for tilt in (0.0, 3 * depth):
            joined(periodic=under == "cell")
            if under == "wall":
                O.bodies.append(utils.wall((0, 0, 0), axis=2, sense=1))
            elif under == "facets":
                O.bodies.append([
                    utils.facet([Vector3(*corner) for corner in corners])
                    for corners in (((-9, -9, 0), (9, -9, 0), (9, 9, 0)), ((-9, -9, 0), (9, 9, 0), (-9, 9, 0)))
                ])
            else:
                block((0, 0, 3.5 if under == "cell" else -0.5))
            upper = block((0, 0, 0.5 - depth), ori=turned((0, 1, 0), tilt))
            for body in O.bodies:
                body.dynamic = False
            O.step()
            contacts = [contact for contact in O.interactions if contact.isReal]
            made = patches(contacts)
            area, force, centre = summed(made)
            expected = sum(contact.geom.contactArea for contact in contacts)
            pressed = sum(contact.phys.normalForce.norm() for contact in contacts)
            middle = sum((contact.phys.normalForce.norm() / pressed * contact.geom.contactPoint
                          for contact in contacts), Vector3.Zero)
            case = f"{under}, tilt {tilt:g}"
            check.true(len(contacts) == (2 if under == "facets" else 1), f"{case}: contacts")
            check.true(abs(area / expected - 1) < 1e-3, f"{case}: area of the patch {area}, expected {expected}")
            check.true(abs(force / pressed - 1) < 0.03, f"{case}: its pressure adds up to {force}, expected {pressed}")
            check.true(np.linalg.norm(centre - middle) < 5e-3, f"{case}: about {centre}, expected {middle}")
            largest = max(contact.geom.largestDepth for contact in contacts) * 1e9
            check.true(0.9 < made.pressure.max() / largest < 1 + 1e-6,
                       f"{case}: largest pressure {made.pressure.max()}, expected {largest}")
    # Laws that know areas, and a round patch in its plane.
    joined()
    for height in (0.0, 0.999):
        O.bodies[add(yade.ConicPotentialParticle(k=1, R=0.5), (0, 0, height), (1, 1, 1))].dynamic = False
    O.engines[2] = yade.InteractionLoop(
        [yade.Ig2_ConicPP_ConicPP_ScGeom(patch=True)],
        [yade.Ip2_FrictMat_FrictMat_KnKsPhys(kn_i=1e9, ks_i=1e9, Knormal=1e9, Kshear=1e9)],
        [yade.Law2_SCG_KnKsPhys_KnKsLaw()])
    run(2)
    contact = O.interactions[0, 1]
    area, force, _ = summed(patches([contact]))
    check.true(
        abs(area / contact.geom.contactArea - 1) < 0.01, f"a round patch: {area}, expected {contact.geom.contactArea}")
    check.true(
        abs(force / contact.phys.normalForce.norm() - 1) < 0.03,
        f"its force: {force}, expected {contact.phys.normalForce}")
    # A bond that is bent and pulled: N/A + M c/I at its edges.
    joined(bonds=True)
    lower, upper = block((0, 0, -0.5)), block((0, 0, 0.5 - 1e-9))
    lower.dynamic = upper.dynamic = False
    O.step()
    upper.state.ori, upper.state.pos = turned((0, 1, 0), 2e-5), Vector3(1e-5, 0, 0.5 + 1e-5)
    O.step()
    made = patches([O.interactions[0, 1]])
    # The edge at +x opens by less: a turn about y lowers what lies at x > 0.
    for x in (-0.5, 0.5):
        at = np.abs(made.corners[..., 0] - x) < 2e-3
        expected = -1e9 * (1e-5 - 2e-5 * x)
        check.true(at.any() and np.allclose(made.pressure[at], expected, atol=0.01 * 1e9 * 1e-5),
                   f"stress of a bond at x = {x}: {made.pressure[at]}, {expected}")
    record = potential_particles.Recorder(path("patches/run"))
    record()
    found = vtk_files.read(path(f"patches/run.patches.{O.iter:07d}.vtp"))
    check.true(
        np.allclose(found["pressure"].reshape(-1, 3), made.pressure) and len(found["triangles"]) == len(made.corners),
        "a frame has the patches")
    check.equal((set(found["id1"]), set(found["id2"])), ({0}, {1}), "and their bodies")
    check.equal(open(path("patches/run.patches.pvd")).read().count("<DataSet"), 1, "and a series")


def test_picture_of_patches():
    from matplotlib.image import imread
    joined()
    lower, upper = block((0, 0, -0.5)), block((0, 0, 0.5 - 1e-4))
    lower.dynamic = upper.dynamic = False
    O.step()
    triangles = drawn(list(O.bodies), ShapeMeshes(0.01))[0]
    lengths = np.linalg.norm(np.diff(edges(triangles), axis=1), axis=2)
    check.true((lengths > 0.99).sum() >= 24, f"edges of two cubes: {np.sort(lengths.ravel())}")
    check.true(
        len(edges(drawn([O.bodies[O.bodies.append(utils.sphere((9, 9, 9), 1))]], ShapeMeshes(0.01))[0])) == 0,
        "a sphere has none")
    O.bodies.erase(2)
    potential_particles.plot(path("patch.png"), size=(400, 300), patches=True)
    image = imread(path("patch.png"))
    check.equal(image.shape[:2], (300, 400), "size of a picture with its scale")
    # Yellow is the largest pressure: the patch lies in the middle, the scale on the right.
    yellow = (image[..., 0] - image[..., 2] > 0.3) & (image[..., 1] > 0.5)
    check.true(yellow[:, :290].sum() > 500 and yellow[:, 290:].sum() > 20,
               f"the patch is seen through the cubes: {yellow[:, :290].sum()}")
    rows = np.nonzero(yellow[:, :290])[0]
    check.true(100 < rows.mean() < 200, f"between them: {rows.mean()}")


def leading(image, channel, column):
    """Share of the coloured pixels left of a column in which one channel leads."""
    part = image[:, :column, :3]
    coloured = np.ptp(part, axis=2) > 0.25
    return (part[coloured].argmax(1) == channel).mean()


def test_colours_by_values():
    O.reset()
    O.materials.append(FrictMat())
    for x in (0, 2, 4):
        add(cube(), (x, 0, 0), (1, 1, 1))
        O.bodies[-1].state.vel = (0, 0, 0.01 * x)
        O.bodies[-1].state.refPos, O.bodies[-1].state.pos = (x, 0, 0), (x, 0, 0.1 * x)
    O.bodies.append(utils.wall(-0.6, axis=2))
    numbers, name, unit = values.of_bodies("velocity", [O.bodies[i] for i in range(3)])
    check.equal((numbers.tolist(), unit), ([0.0, 0.02, 0.04], "m/s"), f"{name}")
    check.close(values.of_bodies("displacement", [O.bodies[2]])[0][0], 0.4, 1e-12, "displacement from refPos")
    seen = []
    for given in ("velocity", [0, 1, 2], {0: 0, 1: 1, 2: 2}):
        potential_particles.plot(path("by.png"), towards=(0, -1, 0.2), size=(400, 200), colour=given, label="order")
        seen.append(imread(path("by.png"))[:, :280])
    # From dark blue to yellow: left, blue leads; right, it does not.
    blue = [leading(seen[0], 2, 90), leading(seen[0][:, 190:], 2, 90)]
    check.true(blue[0] > 0.9 and blue[1] < 0.1, f"bodies by speed: share of blue {blue}")
    check.close(np.abs(seen[1] - seen[0]).max(), 0.0, 0.02, "an array of the same order draws the same")
    check.equal(np.abs(seen[1] - seen[2]).max(), 0.0, "and so do numbers by ids")
    for given, word in (("speed", "there are velocity, displacement, generation, stress"), ([1, 2], "each of the 3 bodies"),
                        ({0: 1.0}, "no number for body 1"), ([1, 2, math.nan], "must be finite")):
        check.raises(ValueError, lambda: potential_particles.plot(path("by.png"), colour=given), f"colour {given}", word)
    potential_particles.plot(path("by.png"), towards=(0, -1, 0), size=(400, 200), up=(1, 0, 0), colour=[0, 1, 2])
    image = imread(path("by.png"))[:, :280]
    yellow = ((image[..., 0] - image[..., 2] > 0.3) & (image[..., 1] > 0.5)).nonzero()[0].mean()
    violet = (image[..., 2] - image[..., 1] > 0.2).nonzero()[0].mean()
    check.true(yellow < violet, f"up=(1, 0, 0): the last body is above, in row {yellow:.0f} against {violet:.0f}")


def test_scale_bar():
    O.reset()
    O.materials.append(FrictMat())
    add(cube(half=0.5), (0, 0, 0), (1, 0, 0))
    potential_particles.plot(path("bar.png"), towards=(0, -1, 0), size=(400, 400), scale_bar=True)
    image = imread(path("bar.png"))
    row = image[380, :, 0] < 0.4
    red = (image[200, :, 0] - image[200, :, 1] > 0.2).sum()
    # The bar is 0.2 m at the middle of the cube, whose front face is nearer to the eye.
    check.true(0.15 < row.sum() / red < 0.22, f"a bar of {row.sum()} pixels, of a cube of {red}")


def test_flat_faces_are_drawn_flat():
    block = mesh(shapes.cuboid((1, 0.5, 0.3), rounding=0.02), 0.02)
    corners, normals = corners_of(block)
    middle = (np.abs(corners.mean(1)[:, 2]) > 0.149)
    check.true(middle.sum() > 0 and np.abs(np.abs(normals[middle][..., 2]) - 1).max() < 1e-3,
               f"the normals of the {middle.sum()} triangles on the large faces")
    ball = corners_of(mesh(shapes.sphere(0.5), 0.02))
    inclined = (ball[1] * ball[0]).sum(-1) / np.linalg.norm(ball[0], axis=-1)
    check.true(inclined.min() > 0.999, f"those of a ball at its points, {inclined.min()}")


def test_movie():
    image_of = __import__("PIL.Image", fromlist=["Image"])
    for number, level in enumerate((0, 120, 255)):
        image_of.new("RGB", (32, 20), (level, 0, 0)).save(path(f"film_{number}.png"))
    potential_particles.movie(path("film.gif"), path("film_*.png"), fps=10)
    with image_of.open(path("film.gif")) as film:
        check.equal((film.n_frames, film.size), (3, (32, 20)), "pictures of a film")
        film.seek(2)
        check.equal(film.convert("RGB").getpixel((3, 3)), (255, 0, 0), "the last of them")
        check.equal(film.info["duration"], 100, "milliseconds of one")
    image_of.new("RGB", (30, 20)).save(path("film_9.png"))
    for arguments, word in (((path("film.gif"), path("film_*.png")), "32 x 20 pixels"),
                            ((path("film.avi"), path("film_*.png")), "one of these endings"),
                            ((path("film.gif"), path("none_*.png")), "no such file"),
                            ((path("film.gif"), [path("film_0.png")], 0), "fps=0 must be above 0")):
        check.raises(ValueError, lambda: potential_particles.movie(*arguments), f"{arguments}", word)


def test_picture_of_chains():
    from matplotlib.image import imread
    from potential_particles.output import chains
    joined()
    lower, upper = block((0, 0, -0.5)), block((0, 0, 0.5 - 1e-4))
    lower.dynamic, O.engines[-1].dead = False, True
    O.step()
    contact = next(one for one in O.interactions if one.isReal)
    corners, forces = chains.tubes([contact])
    check.close(forces[0], contact.phys.normalForce.norm(), 1e-9 * forces[0], "the force of a tube")
    check.true(corners[..., 2].min() > -1e-3 and abs(corners[..., 2].max() - upper.state.pos[2]) < 1e-3,
               "from the contact with what does not move to the centre")
    length = corners[..., 2].max() - corners[..., 2].min()
    check.close(
        np.hypot(corners[..., 0], corners[..., 1]).max(), chains.WIDEST * length, 1e-6,
        "its width, of the largest force")
    potential_particles.plot(path("chains.png"), size=(400, 300), chains=True)
    image = imread(path("chains.png"))
    yellow = (image[..., 0] - image[..., 2] > 0.3) & (image[..., 1] > 0.5)
    check.true(yellow[:, :290].sum() > 100 and yellow[:, 290:].sum() > 20,
               f"it is seen through the cubes: {yellow[:, :290].sum()}")
    check.raises(ValueError, lambda: potential_particles.plot(path("both.png"), patches=True, chains=True),
                 "two scales", "two pictures")


test_patches()
test_picture_of_patches()
test_picture_of_chains()
test_colours_by_values()
test_scale_bar()
test_flat_faces_are_drawn_flat()
test_movie()
test_mesh()
test_mesh_files()
test_outline()
test_light()
test_transparent()
test_graphics()
test_plot()
test_recorder()
check.finish()
