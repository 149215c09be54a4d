# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs in a YADE with a display: what its 3-D window shows, pixel by pixel, against the shapes themselves.

Argument: when the plugin is imported, "before" the window is opened, "after", or "first", before YADE has made a
renderer. PP_PICTURE in the environment names a file for the first picture.
"""
import contextlib
import os
import sys
import tempfile
import time

import matplotlib.image
import numpy as np
import yade.runtime
from PyQt5.QtCore import QPoint, Qt
from PyQt5.QtTest import QTest
from PyQt5.QtWidgets import QApplication
from scipy.spatial import ConvexHull
from yade import Body, Quaternion, Vector3, utils

from harness import Checks, O, add, cube, cube_planes, fresh_scene, halt, plain, pyramid, pyramid_planes, turned

ORDER = sys.argv[1]
if ORDER != "after":
    import potential_particles  # noqa: F401
# For "first" YADE was started without its window, so that what its launcher does for one is done here.
yade.runtime.hasDisplay = True
from yade import qt  # noqa: E402
application = QApplication.instance() or QApplication(sys.argv)
view = qt.View(timeout=120)
if ORDER == "after":
    O.bodies.append(utils.sphere((0, 0, 0), 1))
    for _ in range(50):
        QApplication.processEvents()
import potential_particles  # noqa: E402
from potential_particles import shapes  # noqa: E402

check = Checks()
folder = tempfile.TemporaryDirectory()
SPACING = 2.6
# Pixels by which an outline may be off: 1 % of a radius of some 60 pixels, the rounding to pixels, the blocks of a
# JPEG.
MARGIN = 2.5
PATIENCE = 120  # seconds, for a busy machine


def draw(seconds=0.0):
    """Lets the window draw for a while."""
    end = time.monotonic() + seconds
    QApplication.processEvents()
    while time.monotonic() < end:
        QApplication.processEvents()
        time.sleep(0.01)


def picture():
    """What the window shows, (height, width, 3), 0 to 1."""
    draw(0.1)
    file = os.path.join(folder.name, "view%d.jpg" % len(os.listdir(folder.name)))
    view.saveSnapshot(file)
    # Until it is there, and whole.
    end = time.monotonic() + PATIENCE
    while time.monotonic() < end:
        draw(0.01)
        with contextlib.suppress(OSError):
            return matplotlib.image.imread(file) / 255.0
    raise RuntimeError(f"the window saved no picture within {PATIENCE} s")


def pixels(points):
    """Where points are seen: columns and rows, of a camera with an opening of 45 degrees."""
    width, height = view.screenSize
    forward, up = np.array(view.viewDir), np.array(view.upVector)
    offset = np.asarray(points) - np.array(view.eyePosition)
    depth = offset @ forward * np.tan(np.pi / 8) / (height / 2)
    return np.stack([width / 2 + offset @ np.cross(forward, up) / depth, height / 2 - offset @ up / depth], axis=1)


def place_of(body):
    """Rows and columns of the square of pixels that is the body's own."""
    middle, next_one = pixels([body.state.pos, body.state.pos + Vector3(SPACING, 0, 0)])
    half = np.linalg.norm(next_one - middle) / 2
    low, high = np.clip([middle - half, middle + half], 0, view.screenSize).astype(int)
    return slice(low[1], high[1]), slice(low[0], high[0])


def beyond(place, points):
    """Of each pixel of a place, how far it lies outside of the outline of points; negative inside."""
    sides = ConvexHull(pixels(points)).equations
    rows, columns = np.mgrid[place] + 0.5
    return (np.stack([columns, rows], axis=-1) @ sides[:, :2].T + sides[:, 2]).max(axis=-1)


def surface(body):
    """Many points of a body's surface: rays from its centre, not the mesh that is drawn."""
    rng = np.random.default_rng(1)
    rays = rng.normal(size=(20000, 3))
    rays /= np.linalg.norm(rays, axis=1)[:, None]
    shape = body.shape
    if isinstance(shape, yade.Sphere):
        local = shape.radius * rays
    else:
        known = yade.ConicPotentialParticle(planes=list(zip(shape.a, shape.b, shape.c, shape.d)), r=shape.r, k=shape.k,
                                            R=shape.R)
        local = rays * np.array(known.surfaceDistance([Vector3(*ray) for ray in rays]))[:, None]
    return local @ np.array(body.state.ori.toRotationMatrix()).reshape(3, 3).T + np.array(body.state.pos)


def box(points):
    low, high = points.min(0), points.max(0)
    return np.array([[(low, high)[i][0], (low, high)[j][1], (low, high)[k][2]] for i in (0, 1) for j in (0, 1)
                     for k in (0, 1)])


def lit(image):
    return (image - background).max(axis=-1) > 0.12


def judge(image, body, text, margin=MARGIN):
    """The body fills its outline, in its colour, and nothing else around it. Returns how many pixels of its box are
    empty.
    """
    points, place = surface(body), place_of(body)
    image, off = image[place], beyond(place, points)
    inside, outside, bright = off < -margin, off > margin, lit(image)
    check.true(inside.sum() > 1500 and bright[inside].all(),
               f"{text}: {(~bright[inside]).sum()} of {inside.sum()} pixels inside are empty")
    check.true(not bright[outside].any(), f"{text}: {bright[outside].sum()} pixels outside are not")
    shown, wanted = image[inside].mean(axis=0) - background, np.array(body.shape.color)
    check.true(shown[wanted == 1].min() > 1.5 * shown[wanted == 0].max() + 0.05,
               f"{text}: its colour, {shown} over the background")
    return (outside & (beyond(place, box(points)) < -margin)).sum()


def place(shape, column, row, colour, **more):
    """A body without mass in its place of the window; the window looks along y."""
    body = Body()
    body.shape, body.state.pos = shape, Vector3(SPACING * (column - 1), 0, SPACING * (1 - row))
    body.state.ori = more.get("turn", Quaternion.Identity)
    shape.color = colour
    shape.wire = more.get("wire", False)
    return O.bodies[O.bodies.append(body)]


# --- the scene ------------------------------------------------------------------------------
fresh_scene(yade.Ig2_PP_PP_ScGeom_Conic(), dt=1e-6)
# Not the first bodies, and without numbers of their own, as YADE's own functor would want them.
ball = utils.sphere((-SPACING, 0, SPACING), 0.9, color=(0, 0, 1))
O.bodies.append(ball)
bodies = {
    "sphere": ball,
    "pyramid": place(pyramid(size=0.6), 1, 0, (1, 0, 0), turn=turned((1, 0.3, 0), 1.0)),
    "sharp cube": place(cube(half=0.65, r=1e-6, k=1e-6, R=2), 2, 0, (0, 1, 0), turn=turned((1, 2, 3), 0.7)),
    "rock": place(potential_particles.conic_particle(shapes.random_rock(3, 1.5, elongation=0.7)), 0, 1, (1, 1, 0), turn=turned((0, 1, 1), 0.5)),
    "plain pyramid": place(plain(pyramid_planes(0.6), r=0.05, k=0.05, R=0.9), 1, 1, (1, 0, 1), turn=turned((0, 0, 1),
                                                                                                           0.6)),
    "ball": place(yade.ConicPotentialParticle(k=1, R=0.9), 2, 1, (0, 1, 1)),
}
lines = place(cube(half=0.7, R=2), 0, 2, (1, 1, 1), wire=True, turn=turned((1, 1, 0), 0.4))
refused = place(yade.PotentialParticle(k=2, R=1), 1, 2, (1, 1, 1))

view.axes = view.scale = False
view.grid, view.timeDisp = (False, False, False), ""
view.viewDir, view.upVector = Vector3(0, 1, 0), Vector3(0, 0, 1)
view.fitSphere(Vector3(0, 0, 0), 1.5 * SPACING)
renderer = qt.Renderer()
background = np.array(renderer.bgColor)
image = picture()
if os.environ.get("PP_PICTURE"):
    matplotlib.image.imsave(os.environ["PP_PICTURE"], image)

check.true(renderer.shape and not renderer.bound, "the window draws shapes, and no boxes in their place")
for name, body in bodies.items():
    # YADE's own sphere shows that the camera is understood; it is drawn with few facets.
    empty = judge(image, body, name, margin=8 if name == "sphere" else MARGIN)
    if "pyramid" in name:
        check.true(empty > 500, f"{name}: {empty} empty pixels within its box")
own = place_of(lines)
off, bright = beyond(own, surface(lines)), lit(image[own])
share = bright[off < -MARGIN].mean()
check.true(0.02 < share < 0.6, f"a body of lines covers {share:.2f} of its outline")
check.true(bright[np.abs(off) < MARGIN].mean() > 0.3, "and there are lines along it")
check.true(not lit(image[place_of(refused)]).any(), "what is no particle is not drawn")

# --- what changes ---------------------------------------------------------------------------
cube_body = bodies["sharp cube"]
cube_body.shape.planes = pyramid_planes(0.6, r=1e-6)
plain_body = bodies["plain pyramid"]
for key, values in zip("abcd", zip(*cube_planes(0.7))):
    setattr(plain_body.shape, key, list(values))
image = picture()
judge(image, cube_body, "a shape whose planes were changed")
judge(image, plain_body, "a plain shape whose planes were changed")

# A click asks which body is seen: the window draws with names.
widget = next(one for one in QApplication.topLevelWidgets() if one.windowTitle() == "Primary view")
for name in ("pyramid", "plain pyramid"):
    column, row = pixels([bodies[name].state.pos])[0]
    QTest.mouseClick(widget, Qt.LeftButton, Qt.ShiftModifier, QPoint(int(column), int(row)))
    end = time.monotonic() + PATIENCE
    while view.selection != bodies[name].id and time.monotonic() < end:
        draw(0.01)
    check.equal(view.selection, bodies[name].id, f"the body under a click on the {name}")
view.selection = -1

# All that the window can draw, of bodies in contact and in a periodic cell, while YADE steps and a shape is changed.
fresh_scene(yade.Ig2_PP_PP_ScGeom_Conic(), dt=1e-6, periodic=True)
O.cell.setBox(4, 4, 4)
for x in (0.0, 0.97):
    add(cube(), Vector3(x, 0, 0), fixed=True)
for switch in ("bound", "intrGeom", "intrPhys", "intrAllWire", "dof", "id"):
    setattr(renderer, switch, True)
renderer.intrWire = renderer.ghosts = True
O.run()
for i in range(30):
    O.bodies[0].shape.r = 0.05 + 1e-4 * i
    draw(0.01)
halt()
check.true(isinstance(O.interactions[0, 1].geom, yade.ScGeomConicPP), "the bodies touch while they are drawn")
picture()
# The controller, which lists all functors; and another window, after the first was closed.
qt.Controller()
view.close()
draw(0.6)
view = qt.View(timeout=60)
check.true(lit(picture()).any(), "another window draws, too")
print(f"{check.passed} passed, {check.failed} failed", flush=True)
folder.cleanup()
# Without Qt's and YADE's ends, which are not what is tried here.
os._exit(1 if check.failed else 0)
