# SPDX-License-Identifier: MIT OR Apache-2.0
"""A .vtp series of bodies that each have a shape of their own."""

import numpy as np

from surface_mesh import surface_mesh
from vtp import VtpSeries, write_vtp


class BlockSeries(VtpSeries):
    """As VtpSeries, with one mesh a body; cells carry the number of their body as `body`."""

    def __init__(self, folder, name, surfaces):
        self.folder, self.name, self.frames = folder, name, []
        self.meshes = [surface_mesh(surface) for surface in surfaces]
        first = np.cumsum([0] + [len(points) for points, _, _ in self.meshes])
        self.triangles = np.vstack(
            [triangles + shift for (_, _, triangles), shift in zip(self.meshes, first)]
        ).astype(np.int32)
        sizes = [len(triangles) for _, _, triangles in self.meshes]
        self.body = np.repeat(np.arange(len(sizes), dtype=np.int32), sizes)

    def write(self, step, time, positions, rotations):
        """positions (n, 3) and rotations (n, 3, 3), local to world; time in s."""
        bodies = list(zip(self.meshes, positions, rotations))
        points = np.vstack([mesh[0] @ turn.T + place for mesh, place, turn in bodies])
        normals = np.vstack([mesh[1] @ turn.T for mesh, _, turn in bodies])
        path = self.folder / f"{self.name}.{step:06d}.vtp"
        write_vtp(
            path,
            points.astype(np.float32),
            self.triangles,
            {"normal": normals.astype(np.float32)},
            {"body": self.body},
        )
        self.frames.append((time, path.name))
        self._write_index()
