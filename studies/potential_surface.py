# SPDX-License-Identifier: MIT OR Apache-2.0
"""The surface of one potential particle, in numpy, for pictures and meshes; its mass by the library.

Local frame, lengths in the caller's unit:

    S(x) = (1-k)/r^2 * sum <n_i.x - d_i>^2 + k/R^2 * |x|^2,   s = sqrt(S),   surface: s = 1.

s is convex along every line, so Newton's method started outside walks to the surface from one
side and cannot step over it.
"""

import numpy as np

NEWTON_STEPS = 60  # a safeguard: 5 to 10 are usual


class PotentialSurface:
    """Planes n_i.x <= d_i (rows of `normals`, unit length), rounding r, sphericity k, shadow radius R."""

    def __init__(self, normals, offsets, r, k, R):
        self.normals = np.asarray(normals, float)
        self.offsets = np.asarray(offsets, float)
        self.r, self.k, self.R = float(r), float(k), float(R)
        self._plane_weight = (1.0 - self.k) / self.r**2
        self._sphere_weight = self.k / self.R**2

    def scale(self, points):
        """s at points (..., 3): below 1 inside, 1 on the surface."""
        beyond = np.maximum(points @ self.normals.T - self.offsets, 0.0)
        squared = self._plane_weight * (beyond**2).sum(-1)
        return np.sqrt(squared + self._sphere_weight * (points**2).sum(-1))

    def outward(self, points):
        """Unit outward normals at points (..., 3) on the surface."""
        beyond = np.maximum(points @ self.normals.T - self.offsets, 0.0)
        gradient = self._plane_weight * (beyond @ self.normals) + self._sphere_weight * points
        return gradient / np.linalg.norm(gradient, axis=-1, keepdims=True)

    def distance(self, directions):
        """Distance from the centre to the surface along directions (..., 3) of any length."""
        directions = np.asarray(directions, float)
        unit = directions / np.linalg.norm(directions, axis=-1, keepdims=True)
        reach = self._beyond_everything(unit)
        return reach - self.first_hit(unit * reach[..., None], -unit)

    def mass_properties(self):
        """Volume, centroid (3,) and inertia (3, 3) about the origin, for density 1, local frame; to 1e-8."""
        from potential_particles import ConicPotentialParticle

        planes = np.column_stack([self.normals, self.offsets]).tolist()
        particle = ConicPotentialParticle(planes=planes, r=self.r, k=self.k, R=self.R)
        volume, centroid, inertia, _ = particle.massProperties(1e-8)
        return volume, np.array(centroid), np.array([[inertia[i, j] for j in range(3)] for i in range(3)])

    def first_hit(self, origins, directions, tolerance=1e-13):
        """Way along rays to the surface, in units of |direction|; NaN for rays that miss.

        `origins` must lie outside; s at the hit is within `tolerance` of 1.
        """
        origins, directions = np.broadcast_arrays(origins, directions)
        o, v = origins.reshape(-1, 3).T, directions.reshape(-1, 3).T
        # One row a plane, so that numpy runs along the rays.
        terms = [
            self.normals @ o - self.offsets[:, None],
            self.normals @ v,
            _dot(o, o),
            _dot(o, v),
            _dot(v, v),
        ]
        result, ways = np.zeros(o.shape[1]), np.zeros(o.shape[1])
        active = np.arange(len(result))
        unfinished = np.ones(len(result), bool)
        for _ in range(NEWTON_STEPS):
            at_origin, along, oo, ov, vv = terms
            beyond = np.maximum(at_origin + ways * along, 0.0)
            squared = self._plane_weight * _dot(beyond, beyond) + self._sphere_weight * (
                oo + ways * (2.0 * ov + ways * vv)
            )
            slope = self._plane_weight * _dot(beyond, along) + self._sphere_weight * (ov + ways * vv)
            s = np.sqrt(squared)
            # Outside and no longer approaching: by convexity such a ray never gets in.
            missed = (slope >= 0.0) & (s > 1.0)
            done = unfinished & (missed | (s - 1.0 <= tolerance))
            result[active[done]] = np.where(missed[done], np.nan, ways[done])
            unfinished &= ~done
            left = np.count_nonzero(unfinished)
            if not left:
                break
            ways = ways + (1.0 - s) * s / np.where(slope < 0.0, slope, -1.0)
            if left < 0.7 * len(unfinished):
                terms = [term[..., unfinished] for term in terms]
                active, ways = active[unfinished], ways[unfinished]
                unfinished = np.ones(left, bool)
        else:
            result[active[unfinished]] = ways[unfinished]
        return result.reshape(origins.shape[:-1])

    def _beyond_everything(self, unit):
        """A distance along unit vectors that lies outside the particle."""
        reach = np.full(unit.shape[:-1], np.inf)
        if self.k > 0.0:
            reach = np.full(unit.shape[:-1], self.R / np.sqrt(self.k))
        if self.k < 1.0:
            along = unit @ self.normals.T
            limit = self.offsets + self.r / np.sqrt(1.0 - self.k)
            with np.errstate(divide="ignore", invalid="ignore"):
                reach = np.minimum(reach, np.where(along > 0.0, limit / along, np.inf).min(-1))
        return 1.001 * reach


def _dot(a, b):
    """Columns of a times columns of b."""
    return np.einsum("ij,ij->j", a, b)
