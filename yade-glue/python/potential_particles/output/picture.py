# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures of the scene without a display: triangles in numpy, with sun, shadows and a sky."""
import numpy as np
import yade

from .drawn import ShapeMeshes, Triangles, drawn
from .light import brightness
from .rasteriser import NOTHING, interpolate, nearest_triangles
from .view import framing_view, unit

VIEW_ANGLE = 0.42  # full height, radians
SAMPLES = 2  # along each side of a pixel
PAPER = 1.0
BOUNDARY_COLOUR = (0.80, 0.79, 0.77)
# Boundaries fade into the paper between these distances from the middle, in radii of the scene.
FADE = (1.1, 2.2)


def plot(file, towards=(0.46, -0.84, 0.42), size=(1000, 800), tolerance=None, bodies=None):
    """Draws the present scene to a PNG: particles, spheres, boxes, facets and walls, each in the colour of its shape.

    towards: direction from the scene to the eye, world axes. size: width and height in pixels. tolerance: of the meshes of
    particles (see `mesh`); without one it follows from the size of the bodies on the picture. bodies: ids; without them, all.
    The camera stands so that all bodies are seen. Of boundaries (Box, Facet, Wall, shapes with isBoundary) what would hide
    the bodies is left out. Needs no display. ValueError for a scene that has nothing to draw.
    """
    from matplotlib.image import imsave
    scene = [body for body in yade.O.bodies if body is not None] if bodies is None else [yade.O.bodies[i] for i in bodies]
    width, height = size
    if tolerance is None:
        tolerance = fitting_tolerance(sum(not body.isClump for body in scene), size)
    of_bodies, of_boundaries = drawn(scene, ShapeMeshes(tolerance))
    view = framing(of_bodies, of_boundaries, towards, width / height)
    imsave(file, render(of_bodies, of_boundaries, view, width, height))


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
        limits = limits[np.linalg.norm(limits - middle, axis=1) <= FADE[0] * radius]
    points = np.concatenate([points, limits])
    if not len(points):
        raise ValueError("there is nothing to draw: the scene has no body with a shape that can be drawn")
    return framing_view(points, towards, VIEW_ANGLE, aspect)


def render(of_bodies, of_boundaries, view, width, height):
    """An RGB image (height, width, 3), 0 to 1, of triangles (drawn.Triangles) as the view sees them."""
    middle, radius = _ball((of_bodies if len(of_bodies.corners) else of_boundaries).corners.reshape(-1, 3))
    scene = Triangles.together([of_bodies, _behind(of_boundaries, view, middle)])
    columns, rows = SAMPLES * width, SAMPLES * height
    corners = view.project(scene.corners, columns, rows)
    closeness, index = nearest_triangles(corners, columns, rows)
    seen, closeness = (array.reshape(height, SAMPLES, width, SAMPLES).swapaxes(1, 2).reshape(height * width, -1)
                       for array in (index, closeness))
    # Samples of a pixel that see the same triangle share the light at the first of them.
    first = (seen[:, :, None] == seen[:, None, :]).argmax(2)
    pixel, sample = np.nonzero((first == np.arange(SAMPLES**2)) & (seen != NOTHING))
    chosen = seen[pixel, sample]
    x, y = pixel % width * SAMPLES + sample % SAMPLES + 0.5, pixel // width * SAMPLES + sample // SAMPLES + 0.5
    points = view.points(x, y, closeness[pixel, sample], columns, rows)
    normals = unit(interpolate(corners, scene.normals, chosen, x, y))
    light = brightness(points, normals, of_bodies.corners)
    is_boundary = chosen >= len(of_bodies.corners)
    # Light adds up linearly; colours are given, and screens expect them, with the usual gamma.
    colours = np.where(is_boundary[:, None], BOUNDARY_COLOUR, scene.colours[chosen] ** 2.2)
    far = np.linalg.norm(points - middle, axis=1) / radius
    inward = np.clip((FADE[1] - far) / (FADE[1] - FADE[0]), 0.0, 1.0)
    solid = np.where(is_boundary, inward**2 * (3.0 - 2.0 * inward), 1.0)[:, None]
    image = np.full((height * width, SAMPLES**2, 3), PAPER, np.float32)
    image[pixel, sample] = solid * np.clip(colours * light[:, None], 0.0, 1.0) + (1.0 - solid) * PAPER
    image = np.take_along_axis(image, first[:, :, None], axis=1).mean(1)
    return image.reshape(height, width, 3) ** (1.0 / 2.2)


def _ball(points):
    """Middle and radius of a ball about the middle of the box of points that holds them."""
    middle = 0.5 * (points.min(0) + points.max(0))
    return middle, np.linalg.norm(points - middle, axis=1).max()


def _behind(boundaries, view, middle):
    """The boundaries without the triangles between the eye and the middle of the bodies."""
    corners = boundaries.corners
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    side = [((point - corners[:, 0]) * normal).sum(1) for point in (view.eye, middle)]
    return boundaries.where(side[0] * side[1] >= 0.0)
