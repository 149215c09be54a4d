# SPDX-License-Identifier: MIT OR Apache-2.0
"""Files of shapes, as `fix potential/particle/shapes` reads them."""
import numpy as np

from .._core import Particle
from ..files import written
from ..shape import Shape

# Of the centre of mass over the radius, and of products of inertia over the largest moment; of the mass, relative.
CENTRED, ROUNDS, TOLERANCE = 1e-9, 20, 1e-9


def polyhedron(normals, distances, rounding):
    """A Particle with k = 0 whose faces lie at these distances from the origin along these normals; edges are rounded
    by `rounding` (length).
    """
    normals = np.asarray(normals, float)
    normals = normals / np.linalg.norm(normals, axis=1)[:, None]
    return Particle(np.column_stack([normals, np.asarray(distances, float) - rounding]), rounding, 0.0,
                    np.max(distances))


def principal(particle):
    """The same shape about its centre of mass, in principal axes; and what carries a point of that frame into the old
    one: (centre, rotation).
    """
    centre, rotation = np.zeros(3), np.eye(3)
    for _ in range(ROUNDS):
        mass = particle.mass_properties(TOLERANCE)
        inertia, at = mass.inertia, mass.centroid
        is_off = np.linalg.norm(at) > CENTRED * particle.bounding_radius
        size = np.abs(inertia).max()
        if not is_off and np.abs(inertia - np.diag(np.diag(inertia))).max() <= CENTRED * size:
            return particle, (centre, rotation)
        if particle.k > 0 and is_off:
            turn = np.eye(3)  # the shadow sphere stays about the origin: shape and centre change together
        else:
            turn = _axes(inertia - mass.volume * (at @ at * np.eye(3) - np.outer(at, at)))
        normals, offsets = particle.planes[:, :3], particle.planes[:, 3]
        centre, rotation = centre + rotation @ at, rotation @ turn
        particle = Particle(np.column_stack([normals @ turn, offsets - normals @ at]), particle.r, particle.k, particle.R)
    raise ValueError("the shape cannot be centred: choose another origin, nearer to its centre of mass")


def _axes(inertia):
    """Columns: principal axes, each named after the axis of the old frame to which it is nearest."""
    size = np.abs(inertia).max()
    if np.abs(inertia - np.diag(np.diag(inertia))).max() <= CENTRED * size:
        return np.eye(3)
    _, axes = np.linalg.eigh(inertia)
    order = []
    for row in range(3):
        order.append(max((c for c in range(3) if c not in order), key=lambda c: abs(axes[row, c])))
    axes = axes[:, order] * np.sign(np.diag(axes[:, order]) + 1e-300)
    if np.linalg.det(axes) < 0:
        axes[:, 2] *= -1
    return axes


def write_shapes(path, shapes):
    """shapes: {name: Particle or Shape}. Each is written about its centre of mass and in principal axes; returns {name:
    (centre, rotation)}, in the old frame.
    """
    frames = {}
    with written(path, text=True) as file:
        for name, particle in shapes.items():
            if not name or any(c.isspace() or c == "#" for c in name):
                raise ValueError(f"shape name {name!r}: it must be one word without '#'")
            own, frames[name] = principal(particle.particle if isinstance(particle, Shape) else particle)
            file.write(f"shape {name}\nr {own.r!r}\nk {own.k!r}\nR {own.R!r}\n")
            file.writelines("plane " + " ".join(repr(float(x)) for x in row) + "\n" for row in own.planes)
            file.write("end\n")
    return frames


def read_shapes(path):
    """{name: Particle} of a file that write_shapes has written, or by hand."""
    shapes, name = {}, None
    with open(path, encoding="utf-8") as file:
        lines = file.readlines()
    for line in lines:
        words = line.split("#")[0].split()
        if not words:
            continue
        if words[0] == "shape":
            name, planes, numbers = words[1], [], {}
        elif words[0] == "plane":
            planes.append([float(x) for x in words[1:]])
        elif words[0] == "end":
            shapes[name] = Particle(planes, numbers["r"], numbers["k"], numbers["R"])
        else:
            numbers[words[0]] = float(words[1])
    return shapes


def write_drum(path, radius, length, sides=48):
    """A closed drum about the y axis as a text STL, its middle at the origin: `sides` flat strips and two ends."""
    at = 2 * np.pi * np.arange(sides + 1) / sides
    rim = radius * np.column_stack([np.cos(at), np.zeros(sides + 1), np.sin(at)])
    near, far = rim - [0, 0.5 * length, 0], rim + [0, 0.5 * length, 0]
    near[-1], far[-1] = near[0], far[0]
    triangles = []
    for i in range(sides):
        triangles += [(near[i], near[i + 1], far[i]), (near[i + 1], far[i + 1], far[i])]
        triangles += [((0, s * 0.5 * length, 0), rims[i], rims[i + 1]) for s, rims in ((-1, near), (1, far))]
    with written(path, text=True) as file:
        file.write("solid drum\n")
        for triangle in triangles:
            file.write("facet normal 0 0 0\nouter loop\n" + "".join("vertex %.7g %.7g %.7g\n" % tuple(v)
                                                                    for v in triangle) + "endloop\nendfacet\n")
        file.write("endsolid drum\n")
