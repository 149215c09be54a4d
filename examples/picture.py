# SPDX-License-Identifier: MIT OR Apache-2.0
"""Pictures of potential particles: every pixel's ray meets the true surface, no mesh between.

A pinhole camera; one sun with hard shadows; and a sky of many faint suns, whose shadows add up to
the darkening of gaps and contacts that lets the eye read a pile. World frame, z up.
"""

from dataclasses import dataclass

import numpy as np

# Of s: hits are exact to a small part of a pixel, shadows to a part of a shadow map's pixel.
SURFACE_TOLERANCE, SHADOW_TOLERANCE = 1e-5, 2e-3
SKY_LIGHTS = 14
SKY_PIXELS = 200  # width of the shadow map of one sky light
SUN_PIXELS = 1200
SUN_DIRECTION = np.array([-0.45, -0.55, 1.0])  # from the scene to the sun
SUN_SHARE, SKY_SHARE = 0.62, 0.50  # of the light; their sum may exceed 1 where both reach fully


@dataclass
class Bodies:
    """Particles to draw: all of one shape, or each of its own (then `surface` and `radius` are lists)."""

    surface: object  # PotentialSurface
    radius: float  # of a ball about the centre that holds it
    positions: np.ndarray  # (n, 3)
    rotations: np.ndarray  # (n, 3, 3), local to world
    colours: np.ndarray  # (n, 3), 0 to 1

    def surface_of(self, index):
        """The surface of one body."""
        return self.surface[index] if isinstance(self.surface, list) else self.surface

    def radii(self):
        """Of all bodies, (n,)."""
        return np.broadcast_to(self.radius, len(self.positions))


@dataclass
class View:
    """A pinhole camera at `eye`, looking at `target`; `angle` is the full height of view, radians."""

    eye: np.ndarray
    target: np.ndarray
    angle: float

    def axes(self):
        """Right, up, forward."""
        forward = _unit(self.target - self.eye)
        right = _unit(np.cross(forward, [0.0, 0.0, 1.0]))
        return np.stack([right, np.cross(right, forward), forward])


@dataclass
class Floor:
    """A disc about the z axis at height z, to draw and to catch shadows; it fades towards its rim."""

    z: float
    radius: float
    colour: tuple = (0.80, 0.79, 0.77)


def framing_view(points, towards, angle, aspect, margin=1.03):
    """The view from direction `towards` (scene to eye) that just holds `points` (n, 3).

    aspect: width over height of the picture; margin: 1 fits tightly.
    """
    points, towards = np.asarray(points, float), _unit(towards)
    half_y = np.tan(0.5 * angle) / margin
    half_x = half_y * aspect
    target, distance = points.mean(0), np.ptp(points, axis=0).max() * 4.0
    for _ in range(20):
        view = View(target + distance * towards, target, angle)
        right, up, forward = view.axes()
        x, y, near = (points - target) @ right, (points - target) @ up, (points - target) @ forward
        distance = max((np.abs(x) / half_x - near).max(), (np.abs(y) / half_y - near).max())
        spread_x, spread_y = x / (distance + near), y / (distance + near)
        target = target + 0.5 * distance * (
            (spread_x.max() + spread_x.min()) * right + (spread_y.max() + spread_y.min()) * up
        )
    return View(target + distance * towards, target, angle)


def render(bodies, floor, view, width, height, background=1.0, samples=2):
    """An RGB image (height, width, 3), values 0 to 1; `samples`^2 rays a pixel."""
    columns, rows = width * samples, height * samples
    rays = _camera_rays(view, columns, rows)
    way, who = _trace_camera(bodies, view, rays)
    points, normals, colours = _surface_points(bodies, floor, view, rays, way, who)
    hit = who != NOTHING
    image = np.full((rows, columns, 3), background, float)
    light = _lighting(bodies, points[hit], normals[hit])
    image[hit] = np.clip(colours[hit] * light[:, None], 0.0, 1.0)
    ground = who == FLOOR
    solid = _fade(np.hypot(points[ground][:, 0], points[ground][:, 1]) / floor.radius)[:, None]
    image[ground] = solid * image[ground] + (1.0 - solid) * background
    image = image.reshape(height, samples, width, samples, 3).mean((1, 3))
    # Light adds up linearly; screens expect the usual gamma.
    return image ** (1.0 / 2.2)


NOTHING, FLOOR = -1, -2


def _camera_rays(view, columns, rows):
    """Directions (rows, columns, 3) whose part along `forward` is 1."""
    right, up, forward = view.axes()
    half = np.tan(0.5 * view.angle)
    y = half * (1.0 - 2.0 * (np.arange(rows) + 0.5) / rows)
    x = half * columns / rows * (2.0 * (np.arange(columns) + 0.5) / columns - 1.0)
    return forward + y[:, None, None] * up + x[None, :, None] * right


def _trace_camera(bodies, view, rays):
    """Way along each ray to the first body, and which body."""
    rows, columns = rays.shape[:2]
    way = np.full((rows, columns), np.inf)
    who = np.full((rows, columns), NOTHING)
    axes = view.axes()
    half = np.tan(0.5 * view.angle)
    for index, (position, radius) in enumerate(zip(bodies.positions, bodies.radii())):
        x, y, depth = axes @ (position - view.eye)
        # The ball's outline seen in perspective, a little generous.
        reach = radius / (depth - radius) * 1.05
        scale = 0.5 * rows / half
        left, right = (0.5 * columns + scale * (x / depth + side * reach) for side in (-1, 1))
        top, bottom = (0.5 * rows - scale * (y / depth + side * reach) for side in (1, -1))
        window = (
            slice(max(int(top), 0), min(int(bottom) + 2, rows)),
            slice(max(int(left), 0), min(int(right) + 2, columns)),
        )
        found = _hit(bodies, index, view.eye, rays[window], SURFACE_TOLERANCE)
        nearer = found < way[window]
        way[window][nearer] = found[nearer]
        who[window][nearer] = index
    return way, who


def _hit(bodies, index, origins, rays, tolerance):
    """Way along world rays to one body; infinite where they miss."""
    turn = bodies.rotations[index]
    o = np.broadcast_to((origins - bodies.positions[index]) @ turn, rays.shape)
    v = rays @ turn
    vv, ov = (v * v).sum(-1), (o * v).sum(-1)
    square = ov**2 - vv * ((o * o).sum(-1) - bodies.radii()[index] ** 2)
    found = np.full(rays.shape[:-1], np.inf)
    near = square > 0.0
    entry = (-ov[near] - np.sqrt(square[near])) / vv[near]
    start = o[near] + entry[:, None] * v[near]
    more = bodies.surface_of(index).first_hit(start, v[near], tolerance)
    found[near] = np.where(np.isnan(more), np.inf, entry + more)
    return found


def _surface_points(bodies, floor, view, rays, way, who):
    """World points, normals and colours at the hits; the floor enters `who` where it is nearest."""
    to_floor = (floor.z - view.eye[2]) / np.where(rays[..., 2] < 0.0, rays[..., 2], np.nan)
    spot = view.eye + to_floor[..., None] * rays
    on_floor = np.hypot(spot[..., 0], spot[..., 1]) <= floor.radius
    seen = on_floor & (to_floor < way)
    way[seen], who[seen] = to_floor[seen], FLOOR
    points = view.eye + np.where(np.isfinite(way), way, 0.0)[..., None] * rays
    normals, colours = np.zeros(points.shape), np.zeros(points.shape)
    normals[who == FLOOR], colours[who == FLOOR] = (0.0, 0.0, 1.0), floor.colour
    flat_who, flat_points = who.ravel(), points.reshape(-1, 3)
    order = np.argsort(flat_who, kind="stable")
    starts = np.searchsorted(flat_who[order], np.arange(len(bodies.positions) + 1))
    for index, turn in enumerate(bodies.rotations):
        pixels = order[starts[index] : starts[index + 1]]
        local = (flat_points[pixels] - bodies.positions[index]) @ turn
        normals.reshape(-1, 3)[pixels] = bodies.surface_of(index).outward(local) @ turn.T
        colours.reshape(-1, 3)[pixels] = bodies.colours[index]
    return points, normals, colours


def _fade(radius):
    """1 up to half the radius, falling smoothly to 0 at 1."""
    inward = np.clip(2.0 * (1.0 - radius), 0.0, 1.0)
    return inward**2 * (3.0 - 2.0 * inward)


def _lighting(bodies, points, normals):
    """Brightness at points: the sun, and the sky as the mean of many faint suns."""
    sun = _unit(SUN_DIRECTION)
    light = SUN_SHARE * _lambert(normals, sun) * _lit(bodies, sun, points, normals, SUN_PIXELS)
    sky, total = np.zeros(len(points)), 0.0
    for direction in _sky_directions():
        seen = _lit(bodies, direction, points, normals, SKY_PIXELS)
        sky += _lambert(normals, direction) * seen
        total += max(direction[2], 0.0)
    # Light bounced from the floor keeps undersides from turning black.
    bounce = 0.10 * (0.5 - 0.5 * normals[:, 2])
    return light + SKY_SHARE * sky / total + bounce


def _sky_directions():
    """Evenly spread directions of the upper half sphere (golden spiral)."""
    index = np.arange(SKY_LIGHTS) + 0.5
    z = 1.0 - index / SKY_LIGHTS * 0.95
    angle = np.pi * (1.0 + np.sqrt(5.0)) * index
    flat = np.sqrt(1.0 - z**2)
    return np.stack([flat * np.cos(angle), flat * np.sin(angle), z], axis=1)


def _lambert(normals, direction):
    return np.maximum(normals @ direction, 0.0)


def _lit(bodies, direction, points, normals, pixels):
    """1 where points see the distant light in `direction`, else 0, smoothed over map pixels."""
    side = _unit(np.cross(direction, [0.0, 1.0, 0.1]))
    axes = np.stack([side, np.cross(direction, side)])
    centres = bodies.positions @ axes.T
    radii = bodies.radii()
    low, high = (centres - radii[:, None]).min(0), (centres + radii[:, None]).max(0)
    step = (high - low).max() / pixels
    far = 2.0 * (np.abs(bodies.positions).max() + radii.max())
    count = np.ceil((high - low) / step).astype(int) + 2
    nearest = np.full(count[::-1], np.inf)
    for index, (centre, radius) in enumerate(zip(centres, radii)):
        first = np.maximum(((centre - radius - low) / step).astype(int), 0)
        last = np.minimum(((centre + radius - low) / step).astype(int) + 2, count)
        x, y = (low[i] + step * (np.arange(first[i], last[i]) + 0.5) for i in (0, 1))
        origins = x[None, :, None] * axes[0] + y[:, None, None] * axes[1] + far * direction
        window = (slice(first[1], last[1]), slice(first[0], last[0]))
        found = _hit(bodies, index, origins, np.broadcast_to(-direction, origins.shape), SHADOW_TOLERANCE)
        nearest[window] = np.minimum(nearest[window], found)
    # Points look from slightly above their own surface, by about one pixel of the map.
    lifted = points + 1.5 * step * normals
    way = far - lifted @ direction
    return _smooth_test(nearest, (lifted @ axes.T - low) / step - 0.5, way)


def _smooth_test(nearest, at, way):
    """Share of the four map pixels around `at` (x, y) that are not in front of `way`."""
    corner = np.floor(at).astype(int)
    part = at - corner
    lit = np.zeros(len(at))
    for dx in (0, 1):
        for dy in (0, 1):
            x, y = corner[:, 0] + dx, corner[:, 1] + dy
            outside = (x < 0) | (y < 0) | (x >= nearest.shape[1]) | (y >= nearest.shape[0])
            x, y = np.clip(x, 0, nearest.shape[1] - 1), np.clip(y, 0, nearest.shape[0] - 1)
            weight = (part[:, 0] if dx else 1 - part[:, 0]) * (part[:, 1] if dy else 1 - part[:, 1])
            lit += weight * (outside | (way <= nearest[y, x]))
    return lit


def _unit(vector):
    return np.asarray(vector, float) / np.linalg.norm(vector)
