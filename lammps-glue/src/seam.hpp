// SPDX-License-Identifier: GPL-2.0-or-later
//
// Which of two triangles that share an edge or a vertex has the contact with a body there.
//
// The scale s of a body is convex, and so is each triangle: the point of a triangle where s is least is one of the mesh around it exactly if no
// triangle that shares the edge or vertex on which it lies has a lower s. So a triangle whose point lies on a seam yields to a neighbour
// with less; where s is the same to within its error, to the one whose point is nearer to the centre, then to the lower number.
#pragma once

#include "mesh.hpp"

#include <potential_particles.h>

#include <algorithm>

namespace potential_particles {

struct TriangleContact {
    int triangle;
    pp_flat_contact found;
    double uncertainty; // bound on the distance of its point to the exact one

    Eigen::Vector3d point() const { return Eigen::Vector3d(found.on_boundary); }
    // Squared distance of the point to the centre: half the overlap beyond the arm.
    double way() const { return (Eigen::Vector3d(found.branch) + 0.5 * found.overlap * Eigen::Vector3d(found.normal)).squaredNorm(); }
};

// Two points within this share of a body's size count as one; a point is never less certain than the other share.
constexpr double samePoint = 1e-9, mostUncertain = 0.1;

inline double uncertaintyOf(const pp_flat_contact& found, double radius)
{
    return samePoint * radius + (found.point_bound >= 0 ? std::min(found.point_bound, mostUncertain * radius) : mostUncertain * radius);
}

inline bool isLower(const TriangleContact& one, const TriangleContact& other)
{
    if (!(std::abs(one.found.s - other.found.s) <= one.found.gap + other.found.gap))
        return one.found.s < other.found.s;
    const double way = one.way(), otherWay = other.way();
    return way != otherWay ? way < otherWay : one.triangle < other.triangle;
}

inline double distanceToSegment(const Eigen::Vector3d& x, const Eigen::Vector3d& from, const Eigen::Vector3d& to)
{
    const Eigen::Vector3d along = to - from;
    return (x - from - std::clamp((x - from).dot(along) / along.squaredNorm(), 0.0, 1.0) * along).norm();
}

inline bool yieldsTo(const Mesh& mesh, const TriangleContact& other, const TriangleContact& own)
{
    const auto &mine = mesh.triangle(own.triangle), &its = mesh.triangle(other.triangle);
    const auto shares = [&](int v) { return std::find(its.begin(), its.end(), v) != its.end(); };
    const bool close = (own.point() - other.point()).norm() <= own.uncertainty + other.uncertainty;
    for (unsigned i = 0; i < 3; ++i) {
        const int from = mine[i], to = mine[(i + 1) % 3];
        if (!shares(from))
            continue;
        const bool onVertex = own.found.feature == PP_ON_VERTEX + i
            || (close && (own.point() - mesh.vertex(from)).norm() <= own.uncertainty);
        const bool onEdge = shares(to)
            && (own.found.feature == PP_ON_EDGE + i
                || (close && distanceToSegment(own.point(), mesh.vertex(from), mesh.vertex(to)) <= own.uncertainty));
        if ((onVertex || onEdge) && isLower(other, own))
            return true;
    }
    return false;
}

} // namespace potential_particles
