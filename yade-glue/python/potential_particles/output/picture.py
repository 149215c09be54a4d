# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures of the scene without a display, drawn by VTK: sun, shadows, darkened gaps, and boundaries one can see
through.
"""
import dataclasses
import os

import numpy as np
import yade

from ..arguments import unit, whole
from ..files import written
from . import vtk_files
from .chains import tubes
from .drawn import ShapeMeshes, Triangles, drawn, edges
from .patches import patches as patches_of
from .values import of_bodies as values_of_bodies
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


def plot(file, towards=(0.46, -0.84, 0.42), size=(1000, 800), tolerance=None, bodies=None, patches=False, chains=False,
         colour=None, label=None, up=(0, 0, 1), whole_scene=False, scale_bar=False):
    """Draws the present scene to a PNG: particles, spheres, boxes, facets and walls, each in the colour of its shape.

    towards: direction from the scene to the eye, and up: what is up on the picture, world axes. size: width and height
    in pixels. tolerance: of the meshes of particles (see `mesh`); without one it follows from the size of the bodies on
    the picture. bodies: ids; without them, all. patches: bodies become transparent, and contact patches between them
    (functors with patch=True, bonds) show their pressure, with a scale in pascals. chains: the same with force chains,
    a tube along the line between the centres of each contact, its width and colour by the normal force, with a scale
    in newtons. colour: "velocity", "displacement" (from State.refPos), "stress" (mean pressure within a body),
    "generation" (of Breakage), or a number for each body that is no boundary, as {id: number} or in the order of ids: bodies are coloured by it, with a
    scale, which `label` names. whole_scene: all boundaries are in the picture, not only those near the bodies.
    scale_bar: a bar of a round length, as it is in the middle of the bodies. The camera stands so that all bodies are
    seen, through those boundaries (Box, Facet, Wall, shapes with isBoundary) that would hide them. Needs no display.
    ValueError for a scene that has nothing to draw; RuntimeError with the packages to install where there is no OpenGL.
    """
    scene = [body for body in yade.O.bodies
             if body is not None] if bodies is None else [yade.O.bodies[i] for i in bodies]
    width, height = (whole(one, 16, 20_000, "size") for one in size)
    if tolerance is None:
        tolerance = fitting_tolerance(sum(not body.isClump for body in scene), size)
    if bool(patches) + bool(chains) + (colour is not None) > 1:
        raise ValueError("patches=True, chains=True and colour= have each a scale of their own: draw two pictures")
    turn = _upright(up)
    of_bodies, of_boundaries = (part.turned(turn) for part in drawn(scene, ShapeMeshes(tolerance)))
    towards = turn @ unit(towards, "towards")
    coloured, beside = None, 0
    if patches or chains or colour is not None:
        beside = BAR
        of_bodies, coloured, *scale = _coloured(scene, of_bodies, patches, chains, colour, label, turn)
    view = framing(of_bodies, of_boundaries, towards, (width - beside) / height, whole_scene)
    image = render(of_bodies, of_boundaries, view, width - beside, height, coloured)
    if scale_bar:
        image = _with_bar(image, view)
    _write(file, _with_scale(image, *scale) if beside else image)


def _upright(up):
    """The rotation (3, 3) that makes `up` the z axis of the picture."""
    up = unit(up, "up")
    across = np.cross(np.eye(3)[np.abs(up).argmin()], up) if abs(up[2]) < 1 else np.array([0.0, up[2], 0.0])
    across /= np.linalg.norm(across)
    return np.stack([np.cross(across, up), across, up])


def _coloured(scene, of_bodies, patches, chains, colour, label, turn):
    """(bodies, what is seen through them or None; scale of the colours, its label, whether it has whole numbers)."""
    if colour is not None:
        shown = np.unique(of_bodies.bodies)
        values, name, unit_of = values_of_bodies(colour, [yade.O.bodies[int(one)] for one in shown])
        scale, one, prefix = _scale(values, unit_of)
        rgb = scale.to_rgba(values / one)[:, :3]
        painted = dataclasses.replace(of_bodies, colours=rgb[np.searchsorted(shown, of_bodies.bodies)])
        name = name if label is None else label
        return (painted, None, scale, f"{name}, {prefix}{unit_of}" if unit_of else name,
                not unit_of and (values == np.round(values)).all())
    chosen = {body.id for body in scene}
    contacts = [contact for contact in yade.O.interactions if contact.isReal and {contact.id1, contact.id2} <= chosen]
    if chains:
        corners, forces = tubes(contacts)
        values, name, unit_of = np.repeat(forces[:, None], 3, axis=1), "normal force", "N"
    else:
        found = patches_of(contacts)
        corners, values, name, unit_of = found.corners, found.pressure, "pressure", "Pa"
    scale, one, prefix = _scale(values, unit_of)
    corners = corners @ turn.T
    within = Triangles(corners, np.zeros_like(corners), scale.to_rgba(values / one)[..., :3],
                       np.zeros(len(corners), int))
    return of_bodies, within, scale, f"{name}, {prefix}{unit_of}", False


def _write(file, image):
    from matplotlib.image import imsave
    with written(file) as out:
        imsave(out, image, format=os.path.splitext(file)[1][1:] or None)


def fitting_tolerance(count, size):
    """So that a mesh is wrong by about half a pixel when so many bodies fill a picture of this size."""
    radius = 0.5 * np.sqrt(size[0] * size[1] / max(count, 1))
    return float(np.clip(0.5 / radius, 1e-3, 0.05))


def framing(of_bodies, of_boundaries, towards, aspect, whole_scene=False):
    """The view that holds all bodies, and the boundaries near them, or all of these."""
    points = of_bodies.corners.reshape(-1, 3)
    limits = of_boundaries.corners.reshape(-1, 3)
    if len(points) and len(limits) and not whole_scene:
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


def _scale(values, unit_of):
    """Colours for values in a multiple of their unit, that multiple, and its prefix."""
    from matplotlib import cm, colors
    largest = np.abs(values).max(initial=0.0)
    multiples = ((1e9, "G"), (1e6, "M"), (1e3, "k"), (1.0, ""), (1e-3, "m"), (1e-6, "µ"))
    one, prefix = next((pair for pair in multiples if largest >= pair[0]), (1.0, "")) if unit_of else (1.0, "")
    span = colors.Normalize(values.min(initial=0.0) / one, (values.max(initial=0.0) or largest or 1.0) / one)
    return cm.ScalarMappable(span, PRESSURE_MAP), one, prefix


def _with_bar(image, view):
    """An image with a bar of 1, 2 or 5 times a power of ten of the scene's length, at most a fourth of its width."""
    height, width = image.shape[:2]
    pixels = height / (2.0 * np.tan(0.5 * view.angle) * np.linalg.norm(view.eye - view.target))
    most = 0.25 * width / pixels
    power = 10.0 ** np.floor(np.log10(most))
    length = max(step * power for step in (1, 2, 5) if step * power <= most)
    figure, pixels_of = _figure(width, height)
    axis = figure.add_axes([0, 0, 1, 1])
    axis.imshow(image, extent=(0, width, 0, height), aspect="auto")
    left, low = 0.04 * width, 0.05 * height
    axis.plot([left, left + length * pixels], [low, low], color="0.15", linewidth=3, solid_capstyle="butt")
    axis.text(left + 0.5 * length * pixels, low + 8, f"{length:g} m", ha="center", va="bottom", color="0.15")
    axis.set_axis_off()
    return pixels_of()


def _with_scale(image, scale, label, whole_numbers):
    """An image with a scale of colours on its right."""
    from matplotlib.ticker import MaxNLocator
    figure, pixels_of = _figure(BAR, len(image))
    bar = figure.colorbar(scale, cax=figure.add_axes([0.05, 0.2, 0.2, 0.6]), label=label)
    bar.ax.yaxis.set_major_locator(MaxNLocator(6, integer=whole_numbers))
    return np.concatenate([image, pixels_of()], axis=1)


def _figure(width, height):
    """A white figure of matplotlib of so many pixels, and a function that gives these, as of an image."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure
    dots = 100
    figure = Figure(figsize=(width / dots, height / dots), dpi=dots, facecolor="white")
    canvas = FigureCanvasAgg(figure)

    def pixels():
        canvas.draw()
        return np.asarray(canvas.buffer_rgba())[:height, :width, :3] / np.float32(255.0)

    return figure, pixels


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
