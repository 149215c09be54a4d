# SPDX-License-Identifier: GPL-2.0-or-later
"""The same motion in plain Python, written from the formulas: velocity Verlet, rotation matrices, one contact after the
other.
"""
import numpy as np
from potential_particles import Pose, Wall, contact_with_plane, detect
from potential_particles.lammps.shapes import principal


def quaternion(R):
    w = 0.5 * np.sqrt(max(0.0, 1 + np.trace(R)))
    if w > 0.1:
        return np.array(
            [w, (R[2, 1] - R[1, 2]) / (4 * w), (R[0, 2] - R[2, 0]) / (4 * w), (R[1, 0] - R[0, 1]) / (4 * w)])
    _, vectors = np.linalg.eigh(
        np.array([[R[0, 0] - R[1, 1] - R[2, 2], R[0, 1] + R[1, 0], R[0, 2] + R[2, 0], R[2, 1] - R[1, 2]],
                  [0, R[1, 1] - R[0, 0] - R[2, 2], R[1, 2] + R[2, 1], R[0, 2] - R[2, 0]],
                  [0, 0, R[2, 2] - R[0, 0] - R[1, 1], R[1, 0] - R[0, 1]], [0, 0, 0, np.trace(R)]]) / 3, UPLO="U")
    x, y, z, w = vectors[:, -1]
    return np.array([w, x, y, z])


def matrix(q):
    w, x, y, z = q
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                     [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                     [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])


def about(axis, angle):
    c, s = np.cos(angle), np.sin(angle)
    i, j = (axis + 1) % 3, (axis + 2) % 3
    R = np.eye(3)
    R[i, i], R[i, j], R[j, i], R[j, j] = c, -s, s, c
    return R


class Loop:
    """shapes: list of Particle by type; bodies as in scene.write; planes: list of (point, normal)."""

    def __init__(self, shapes, bodies, density, stiffness, shear, friction, dt, gravity=9.81, planes=(), moving=()):
        self.shapes = [principal(shape)[0] for shape in shapes]
        self.kind = [b[0] - 1 for b in bodies]
        self.x, self.v, self.w = (np.array([b[n] for b in bodies], float) for n in (1, 2, 3))
        self.R = [matrix(np.array(b[4])) for b in bodies]
        masses = [shape.mass_properties(1e-9) for shape in self.shapes]
        self.mass = np.array([density * masses[t].volume for t in self.kind])
        self.moments = [density * np.diag(masses[t].inertia) for t in self.kind]
        self.kn, self.ks, self.mu, self.dt, self.gravity, self.planes = stiffness, shear, friction, dt, gravity, planes
        self.moving = list(moving) or [np.zeros(3)] * len(planes)
        self.memory, self.ever = {}, set()  # pairs that touch, that have touched; walls count down from -1
        self.forces(first=True)

    def poses(self):
        return [Pose(x, quaternion(R)) for x, R in zip(self.x, self.R)]

    def forces(self, first=False):
        self.F = self.mass[:, None] * np.array([0, 0, -self.gravity])
        self.T = np.zeros_like(self.F)
        self.contacts, poses, seen = 0, self.poses(), set()
        for i in range(len(self.x)):
            for j in range(i + 1, len(self.x)):
                a, b = self.shapes[self.kind[i]], self.shapes[self.kind[j]]
                if np.linalg.norm(self.x[i] - self.x[j]) > a.bounding_radius + b.bounding_radius:
                    continue
                found = detect(a, poses[i], b, poses[j])
                if found.overlapping:
                    seen.add((i, j))
                    self.touch((i, j), found.overlap, found.normal, found.branch_a, found.branch_b, i, j, None, first)
            for p, (point, normal) in enumerate(self.planes):
                found = contact_with_plane(self.shapes[self.kind[i]], poses[i], Wall(point, normal))
                if found.overlapping:
                    seen.add((i, -1 - p))
                    self.touch((i, -1 - p), found.overlap, found.normal, found.branch, None, i, None, self.moving[p], first)
        self.memory = {key: self.memory[key] for key in seen}
        self.ever |= seen

    def touch(self, key, overlap, n, arm_a, arm_b, i, j, wall_velocity, first):
        wj = self.w[j] if j is not None else np.zeros(3)
        vj = self.v[j] + np.cross(wj, arm_b) if j is not None else wall_velocity
        relative = vj - self.v[i] - np.cross(self.w[i], arm_a)
        shear, before = self.memory.get(key, (np.zeros(3), n))
        if not first:
            shear = shear - np.cross(shear, np.cross(before, n))
            shear = shear - np.cross(shear, n * (0.5 * self.dt * n @ (self.w[i] + wj)))
            shear = shear - self.ks * self.dt * (relative - (relative @ n) * n)
            most = self.mu * self.kn * overlap
            if np.linalg.norm(shear) > most:
                shear *= most / np.linalg.norm(shear)
        self.memory[key] = (shear, n)
        on_b = self.kn * overlap * n + shear
        self.F[i] -= on_b
        self.T[i] -= np.cross(arm_a, on_b)
        if j is not None:
            self.F[j] += on_b
            self.T[j] += np.cross(arm_b, on_b)
        self.contacts += 1

    def kick(self):
        self.v += 0.5 * self.dt * self.F / self.mass[:, None]
        for i, R in enumerate(self.R):
            inertia = R @ np.diag(self.moments[i]) @ R.T
            self.w[i] = np.linalg.solve(inertia, inertia @ self.w[i] + 0.5 * self.dt * self.T[i])

    def step(self):
        self.kick()
        self.x += self.dt * self.v
        for i, R in enumerate(self.R):
            momentum = R @ (self.moments[i] * (R.T @ self.w[i]))
            for axis, share in ((0, 0.5), (1, 0.5), (2, 1.0), (1, 0.5), (0, 0.5)):
                R = R @ about(axis, share * self.dt * (R.T @ momentum)[axis] / self.moments[i][axis])
            self.R[i] = R
            self.w[i] = R @ ((R.T @ momentum) / self.moments[i])
        self.forces()
        self.kick()
