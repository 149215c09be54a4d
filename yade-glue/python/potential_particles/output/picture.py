# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures of the scene without a display, drawn by VTK: sun, shadows, darkened gaps, and boundaries one can see
through.
"""
import os

import numpy as np
import yade

from ..arguments import whole
from ..files import written
from . import vtk_files
from .chains import tubes
from .drawn import ShapeMeshes, Triangles, drawn, edges
from .patches import patches as patches_of
from .view import View, framing_view

VIEW_ANGLE = 0.42  # full height, radians
SAMPLES = 2  # along each side of a pixel
PAPER = 1.0
BOUNDARY_COLOUR = (0.92, 0.915, 0.905)
GLASS = 0.12  # opacity of the boundaries between the eye and the bodies
SKY_SHARE = 0.6  # of the light; the rest is the sun's
GAP = 0.1  # how far apart surfaces may be that darken each other, in radii of the scene
ROUGH = 0.01  # nearer than this, VTK's half-precision places cannot tell a gap from a surface
VEIL = 0.22  # opacity of bodies whose patches are shown
EDGE_COLOUR, EDGE_PIXELS = (0.35, 0.36, 0.38), 1.2
PRESSURE_MAP = "plasma"
BAR = 110  # pixels beside the picture for the scale of the pressure
NEAR = 1.1  # boundaries that far from the middle, in radii of the scene, are held by the view


def plot(file, towards=(0.46, -0.84, 0.42), size=(1000, 800), tolerance=None, bodies=None, patches=False, chains=False):
    """Draws the present scene to a PNG: particles, spheres, boxes, facets and walls, each in the colour of its shape.

    towards: direction from the scene to the eye, world axes. size: width and height in pixels. tolerance: of the meshes
    of particles (see `mesh`); without one it follows from the size of the bodies on the picture. bodies: ids; without
    them, all. patches: bodies become transparent, and contact patches between them (functors with patch=True, bonds)
    show their pressure, with a scale in pascals. chains: the same with force chains, a tube along the line between the
    centres of each contact, its width and colour by the normal force, with a scale in newtons. The camera stands so
    that all bodies are seen, through those boundaries (Box, Facet, Wall, shapes with isBoundary) that would hide them.
    Needs no display. ValueError for a scene that has nothing to draw; RuntimeError with the packages to install where
    there is no OpenGL.
    """
    scene = [body for body in yade.O.bodies
             if body is not None] if bodies is None else [yade.O.bodies[i] for i in bodies]
    width, height = (whole(one, 16, 20_000, "size") for one in size)
    if tolerance is None:
        tolerance = fitting_tolerance(sum(not body.isClump for body in scene), size)
    of_bodies, of_boundaries = drawn(scene, ShapeMeshes(tolerance))
    if patches and chains:
        raise ValueError("patches=True and chains=True have each a scale of their own: draw two pictures")
    if not patches and not chains:
        view = framing(of_bodies, of_boundaries, towards, width / height)
        _write(file, render(of_bodies, of_boundaries, view, width, height))
        return
    chosen = {body.id for body in scene}
    contacts = [contact for contact in yade.O.interactions if contact.isReal and {contact.id1, contact.id2} <= chosen]
    if chains:
        corners, forces = tubes(contacts)
        values, name, unit = np.repeat(forces[:, None], 3, axis=1), "normal force", "N"
    else:
        shown = patches_of(contacts)
        corners, values, name, unit = shown.corners, shown.pressure, "pressure", "Pa"
    view = framing(of_bodies, of_boundaries, towards, (width - BAR) / height)
    scale, one, prefix = _scale(values)
    coloured = Triangles(corners, np.zeros_like(corners),
                         scale.to_rgba(values / one)[..., :3], np.zeros(len(corners), int))
    _write(
        file,
        _with_scale(render(of_bodies, of_boundaries, view, width - BAR, height, coloured), scale,
                    f"{name}, {prefix}{unit}"))


def _write(file, image):
    from matplotlib.image import imsave
    with written(file) as out:
        imsave(out, image, format=os.path.splitext(file)[1][1:] or None)


def fitting_tolerance(count, size):
    """So that a mesh is wrong by about half a pixel when so many bodies fill a picture of this size."""
    radius = 0.5 * np.sqrt(size[0] * size[1] / max(count, 1))
    return float(np.clip(0.5 / radius, 1e-3, 0.05))


def framing(of_bodies, of_boundaries, towards, aspect):
    """The view that holds all bodies, and the boundaries near them."""
    points = of_bodies.corners.reshape(-1, 3)
    limits = of_boundaries.corners.reshape(-1, 3)
    if len(points) and len(limits):
        middle, radius = _ball(points)
        limits = limits[np.linalg.norm(limits - middle, axis=1) <= NEAR * radius]
    points = np.concatenate([points, limits])
    if not len(points):
        raise ValueError("there is nothing to draw: the scene has no body with a shape that can be drawn")
    return framing_view(points, towards, VIEW_ANGLE, aspect)


def render(of_bodies, of_boundaries, view, width, height, within=None):
    """An RGB image (height, width, 3), 0 to 1, of triangles (drawn.Triangles) as the view sees them.

    within: triangles with a colour at each corner, (n, 3, 3), that are seen through the bodies.
    """
    from ..graphics import with_graphics
    return with_graphics(_render, of_bodies, of_boundaries, view, width, height, within)


def _render(window, of_bodies, of_boundaries, view, width, height, within):
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from . import light
    # In VTK's single precision, whatever the place and the size of the scene.
    middle, radius = _ball((of_bodies if len(of_bodies.corners) else of_boundaries).corners.reshape(-1, 3))
    view = View((view.eye - middle) / radius, (view.target - middle) / radius, view.angle)
    bodies = _actor(of_bodies, middle, radius)
    parts = _sides(of_boundaries, view, middle, radius) if bodies else (of_boundaries, Triangles.together([]))
    behind, before = (_actor(part, middle, radius, BOUNDARY_COLOUR) for part in parts)
    shadows = light.sun_map(window, bodies) if bodies else None
    renderer = _renderer(view, occlusion=within is None)
    if bodies:
        light.light(bodies, shadows if within is None else None, view, fading=False)
    if bodies and within is not None:
        bodies.GetProperty().SetOpacity(VEIL)
        renderer.AddActor(_lines(edges(of_bodies), middle, radius))
        inner = _actor(within, middle, radius)
        if inner:
            inner.GetProperty().LightingOff()
            inner.GetProperty().BackfaceCullingOff()
            # Before a boundary that it lies on.
            inner.GetMapper().SetResolveCoincidentTopologyToPolygonOffset()
            inner.GetMapper().SetRelativeCoincidentTopologyPolygonOffsetParameters(-4.0, -4.0)
            renderer.AddActor(inner)
    if behind:
        light.light(behind, shadows, view, fading=True)
    if before:
        before.GetProperty().SetOpacity(GLASS)
        light.light(before, None, view, fading=True)
    for actor in filter(None, (bodies, behind, before)):
        renderer.AddActor(actor)
    window.SetSize(SAMPLES * width, SAMPLES * height)
    window.AddRenderer(renderer)
    window.Render()
    image = vtk_to_numpy(light.read(window).GetPointData().GetScalars())
    # VTK counts rows from below.
    image = image.reshape(height, SAMPLES, width, SAMPLES, 3)[::-1].mean((1, 3), dtype=np.float32)
    return image / 255.0


def _actor(triangles, middle, radius, colour=None):
    """Triangles as an actor of VTK, None without any; each, or each of its corners, in its own colour where there is
    not one for all.
    """
    from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper
    if not len(triangles.corners):
        return None
    points = ((triangles.corners.reshape(-1, 3) - middle) / radius).astype(np.float32)
    data = {"normal": triangles.normals.reshape(-1, 3).astype(np.float32)}
    if colour is None:
        colours = np.round(255.0 * triangles.colours).astype(np.uint8)
        data["colour"] = colours.reshape(-1, 3) if colours.ndim == 3 else np.repeat(colours, 3, axis=0)
    mapper, actor = vtkPolyDataMapper(), vtkActor()
    mapper.SetInputData(vtk_files.triangles(points, np.arange(len(points)).reshape(-1, 3), data, normals="normal"))
    mapper.SetScalarModeToUsePointFieldData()
    mapper.SelectColorArray("colour")
    actor.SetMapper(mapper)
    surface = actor.GetProperty()
    surface.SetColor(colour or (1.0, 1.0, 1.0))
    surface.SetAmbient(SKY_SHARE)
    surface.SetDiffuse(1.0 - SKY_SHARE)
    surface.BackfaceCullingOn()
    return actor


def _lines(segments, middle, radius):
    """Segments (n, 2, 3) as an actor of VTK."""
    from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper
    mapper, actor = vtkPolyDataMapper(), vtkActor()
    mapper.SetInputData(vtk_files.lines(((segments - middle) / radius).astype(np.float32)))
    actor.SetMapper(mapper)
    actor.GetProperty().SetColor(EDGE_COLOUR)
    actor.GetProperty().LightingOff()
    actor.GetProperty().SetLineWidth(SAMPLES * EDGE_PIXELS)
    return actor


def _scale(values):
    """Colours for values in a multiple of their unit, that multiple, and its prefix."""
    from matplotlib import cm, colors
    largest = np.abs(values).max(initial=0.0)
    one, prefix = next(((size, name) for size, name in ((1e9, "G"), (1e6, "M"), (1e3, "k")) if largest >= size),
                       (1.0, ""))
    span = colors.Normalize(values.min(initial=0.0) / one, (values.max(initial=0.0) or largest or 1.0) / one)
    return cm.ScalarMappable(span, PRESSURE_MAP), one, prefix


def _with_scale(image, scale, label):
    """An image with a scale of colours on its right."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure
    height, dots = len(image), 100
    figure = Figure(figsize=(BAR / dots, height / dots), dpi=dots, facecolor="white")
    canvas = FigureCanvasAgg(figure)
    figure.colorbar(scale, cax=figure.add_axes([0.05, 0.2, 0.2, 0.6]), label=label)
    canvas.draw()
    return np.concatenate([image, np.asarray(canvas.buffer_rgba())[:height, :, :3] / np.float32(255.0)], axis=1)


def _renderer(view, occlusion=True):
    """A renderer with a camera, the sun, and gaps and contacts that are darker than what the sky reaches, if
    `occlusion` is wanted.
    """
    from vtkmodules.vtkRenderingCore import vtkLight, vtkRenderer
    from vtkmodules.vtkRenderingOpenGL2 import vtkRenderStepsPass, vtkSSAOPass
    from .light import FADE, SUN
    renderer, sun = vtkRenderer(), vtkLight()
    renderer.SetBackground(PAPER, PAPER, PAPER)
    renderer.SetAutomaticLightCreation(False)
    sun.SetLightTypeToSceneLight()
    sun.SetPosition(SUN)
    sun.SetFocalPoint(0.0, 0.0, 0.0)
    renderer.AddLight(sun)
    camera, distance = renderer.GetActiveCamera(), np.linalg.norm(view.eye)
    camera.SetPosition(view.eye)
    camera.SetFocalPoint(view.target)
    camera.SetViewUp(view.axes()[1])
    camera.SetViewAngle(np.degrees(view.angle))
    camera.SetClippingRange(max(distance - FADE[1], 0.01 * distance), distance + FADE[1])
    if occlusion:
        darkened = vtkSSAOPass()
        darkened.SetDelegatePass(vtkRenderStepsPass())
        darkened.SetRadius(GAP)
        darkened.SetBias(ROUGH)
        darkened.BlurOn()
        renderer.SetPass(darkened)
    return renderer


def _ball(points):
    """Middle and radius of a ball about the middle of the box of points that holds them."""
    middle = 0.5 * (points.min(0) + points.max(0))
    return middle, np.linalg.norm(points - middle, axis=1).max()


def _sides(boundaries, view, middle, radius):
    """The boundaries behind the middle of the bodies or beside it, and those between it and the eye."""
    corners = (boundaries.corners - middle) / radius
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    side = [((point - corners[:, 0]) * normal).sum(1) for point in (view.eye, np.zeros(3))]
    hidden = side[0] * side[1] < 0.0
    return boundaries.where(~hidden), boundaries.where(hidden)
