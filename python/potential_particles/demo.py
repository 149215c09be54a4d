# SPDX-License-Identifier: MIT OR Apache-2.0
"""Two particles and their contact."""
import sys

import numpy as np

from . import Pose, detect, patch_of_contact, shapes

COLOURS = "#2a6fb0", "#d98032"


def bodies():
    """A rounded brick that leans on a regular solid of twelve faces: [(particle, pose), (particle, pose)]."""
    solid = shapes.platonic_solid(12, 0.7, rounding=0.08)
    brick = shapes.cuboid((2.0, 1.2, 0.8), rounding=0.15)
    return [(solid.particle, Pose((0.0, 0.0, 0.0))), (brick.particle, Pose((0.5, 0.1, 1.13), (1.0, 0.08, 0.12, 0.2)))]


def demo(file):
    """Prints the contact, and draws it to a file if matplotlib is there. The exit code: 0, or 1 without a picture."""
    (a, pose_a), (b, pose_b) = bodies()
    contact = detect(a, pose_a, b, pose_b)
    patch = patch_of_contact(a, pose_a, b, pose_b, contact)
    print(f"A: {a}\nB: {b}")
    print(f"{contact.kind}: s = {contact.s:.12f}, right to {contact.gap:.1e}, iterations: {contact.iterations}")
    print(f"overlap {contact.overlap:.9f}, normal {contact.normal}, point {contact.point}")
    print(f"patch: area {patch.area:.6f}, mean overlap {patch.mean_depth:.6f}")
    try:
        import matplotlib
    except ImportError:
        print("no picture without matplotlib: pip install matplotlib", file=sys.stderr)
        return 1
    matplotlib.use("Agg")
    draw(file, [(a, pose_a), (b, pose_b)], contact, patch)
    print(f"picture: {file}")
    return 0


def draw(file, pair, contact, patch):
    """A picture of two bodies, seen through, with their contact point, normal and patch; beside it the patch from the
    front.
    """
    import matplotlib.pyplot as plt
    figure = plt.figure(figsize=(11, 5.5), dpi=120)
    scene = figure.add_subplot(1, 2, 1, projection="3d")
    corners = [_surface(scene, particle, pose, colour) for (particle, pose), colour in zip(pair, COLOURS)]
    points = contact.point + patch.points[:, :3]
    scene.scatter(*points.T, c=patch.points[:, 4], cmap="inferno", s=6, depthshade=False)
    scene.quiver(*contact.point, *(0.9 * contact.normal), color="black", linewidth=2)
    _equal(scene, np.vstack(corners))
    scene.view_init(elev=14, azim=-58)
    scene.set_title(f"overlap {contact.overlap:.4f}, s = {contact.s:.4f}, error of s below {contact.gap:.0e}")
    front = figure.add_subplot(1, 2, 2)
    across = np.cross(contact.normal, np.eye(3)[np.argmin(np.abs(contact.normal))])
    across /= np.linalg.norm(across)
    along = np.cross(contact.normal, across)
    shown = front.scatter(patch.points[:, :3] @ across, patch.points[:, :3] @ along, c=patch.points[:, 4],
                          cmap="inferno", s=12)
    front.plot(0, 0, "k+", markersize=12)
    front.set_aspect("equal")
    front.set_title(f"patch: area {patch.area:.4f}; + is the contact point")
    figure.colorbar(shown, ax=front, label="depth")
    figure.tight_layout()
    figure.savefig(file)
    plt.close(figure)


def _surface(scene, particle, pose, colour):
    from mpl_toolkits.mplot3d.art3d import Poly3DCollection
    mesh = particle.mesh(2e-3)
    corners = mesh.vertices @ pose.rotation.T + pose.position
    normals = np.cross(*(corners[mesh.triangles[:, i]] - corners[mesh.triangles[:, 0]] for i in (1, 2)))
    light = normals @ np.array([0.3, -0.7, 0.65]) / np.maximum(np.linalg.norm(normals, axis=1), 1e-300)
    from matplotlib.colors import to_rgb
    shades = np.clip(0.55 + 0.45 * light, 0.2, 1.0)[:, None] * np.array(to_rgb(colour))
    scene.add_collection3d(
        Poly3DCollection(corners[mesh.triangles], facecolors=np.column_stack([shades,
                                                                              np.full(len(shades), 0.45)])))
    return corners


def _equal(scene, corners):
    low, high = corners.min(0), corners.max(0)
    for side, a, b in zip("xyz", low, high):
        getattr(scene, f"set_{side}lim")(a, b)
    scene.set_box_aspect(high - low)
    scene.locator_params(nbins=5)
