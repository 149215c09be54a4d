# SPDX-License-Identifier: GPL-3.0-or-later
"""How the contact point of two bodies moves as they turn, and what that is as a stiffness against turning.

Let a body turn by t about its centre, which lies a behind the contact point along the normal n. Where it touched, its
surface has moved by a t x n, so that its normal there turns by G (t x n), G = 1 - a k, k the curvature of its surface
(of a ball G = 0: it looks as before). The point goes to where the normals of both surfaces are opposite again, by C G
(t x n) in the tangent plane, C the inverse of the sum of both curvatures, and takes the normal force N with it: against
the turn this is a spring N [n x]^T G C [n x]. A face has a curvature of k r/R^2 only, so that C is hundreds of metres,
without end for k = 0. Springs at the contact
point alone miss this: plates 7 : 1 at rest are four times as stiff, rods twenty times.

The point goes no further than to the edge, so that large turns meet a smaller stiffness. What counts is a turn that is
felt: JITTER times the one that opens a side of the contact by the overlap N/kn. With the half widths h of a body as E =
diag(h^2), C^-1 has the further term JITTER (N/kn) E^-1.
"""
import numpy as np

# Smaller turns may grow, and end by themselves: their energy is some thousandths of that of the overlap.
JITTER = 0.005


def turning_stiffness(contacts, normals, points, forces, stiffnesses):
    """(m, 2, 3, 3) of as many interactions: the stiffness against turning, N m, that the moving point adds to each of
    their bodies, world axes.

    normals, points: (m, 3); forces (m,): the normal ones; stiffnesses (m,): kn.
    """
    import yade
    count = len(contacts)
    tangents = _tangents(normals)
    flat, free = np.zeros((count, 2, 2)), np.zeros((count, 2, 2, 2))
    ease = JITTER * forces / stiffnesses
    sides = {}
    for row, contact in enumerate(contacts):
        for side, number in enumerate((contact.id1, contact.id2)):
            sides.setdefault(number, []).append((row, side))
    for number, where in sides.items():
        body, (rows, of_side) = yade.O.bodies[number], np.array(where).T
        surface = _surface(yade, body, [contacts[row] for row in rows], normals[rows], points[rows], tangents[rows])
        if surface is None:
            continue
        arms, curvature, edges = surface
        flat[rows] += curvature + ease[rows, None, None] * edges
        free[rows, of_side] = _root(np.eye(2) - np.abs(arms)[:, None, None] * curvature)
    turned = np.cross(tangents, normals[:, None])[:, None]
    # Between two planes, of which nothing is known, nothing is added.
    known = np.linalg.det(flat) > 0.0
    found = np.zeros((count, 2, 3, 3))
    ways = np.linalg.inv(flat[known])[:, None]
    found[known] = forces[known, None, None, None] * turned[known].swapaxes(
        2, 3) @ free[known] @ ways @ free[known] @ turned[known]
    return found


def _surface(yade, body, contacts, normals, points, tangents):
    """Of a body: distance of its centre along the normals (m,), curvature and inverse of E in the tangent planes (m, 2,
    2); None if it is flat or unknown.
    """
    from .bodies import image_shift
    shape = body.shape
    centres = np.array(
        [list(body.state.pos + (image_shift(one) if body.id == one.id2 else yade.Vector3.Zero)) for one in contacts])
    arms = ((points - centres) * normals).sum(1)
    if isinstance(shape, yade.Sphere):
        curvature = np.tile(np.eye(2) / shape.radius, (len(contacts), 1, 1))
        return arms, curvature, np.zeros_like(curvature)
    if not isinstance(shape, yade.PotentialParticle):
        return None
    turn = np.array(body.state.ori.toRotationMatrix())
    across = tangents @ turn
    curvature = across @ _curvatures(shape, (points - centres) @ turn) @ across.swapaxes(1, 2)
    half = 0.5 * (np.array(shape.maxAabb) + np.array(shape.minAabb))
    edges = np.linalg.inv(
        (across * half**2) @ across.swapaxes(1, 2)) if (half > 0.0).all() else np.zeros_like(curvature)
    return arms, curvature, edges


def _root(matrices):
    """The square root of the positive part of symmetric matrices."""
    values, vectors = np.linalg.eigh(matrices)
    return (vectors * np.sqrt(np.maximum(values, 0.0))[:, None]) @ vectors.swapaxes(1, 2)


def _tangents(normals):
    """Two unit vectors (m, 2, 3) across each."""
    least = np.eye(3)[np.abs(normals).argmin(1)]
    one = np.cross(normals, least)
    one /= np.linalg.norm(one, axis=1)[:, None]
    return np.stack([one, np.cross(normals, one)], axis=1)


def _curvatures(shape, points):
    """Second derivatives of S over its slope (m, 3, 3) at points (m, 3) of the particle's frame: across the normal the
    curvature of its surface.
    """
    planes = np.array([shape.a, shape.b, shape.c]).T
    weight = (1.0 - shape.k) / shape.r**2 if shape.k < 1.0 else 0.0
    beyond = np.maximum(points @ planes.T - np.array(shape.d), 0.0) if len(planes) else np.zeros((len(points), 0))
    hessian = shape.k / shape.R**2 * np.eye(3)
    slope = shape.k / shape.R**2 * points
    if len(planes):
        hessian = hessian + weight * np.einsum("mi,ij,ik->mjk", (beyond > 0.0).astype(float), planes, planes)
        slope = slope + weight * beyond @ planes
    length = np.linalg.norm(slope, axis=1)
    return hessian / np.where(length > 0.0, length, np.inf)[:, None, None] * np.ones((len(points), 1, 1))
