// SPDX-License-Identifier: MIT OR Apache-2.0
//
// Triangles of walls, and which of two that share an edge or a corner has the contact with a body there.
//
// The scale s of the body is convex, and so is each triangle: each has a point where s is least, x on one and y on
// the other. If x lies on what both share, it is a point of the other triangle as well, so that s(y) <= s(x): the
// first triangle leaves the contact to the other, unless y lies there too. Then s(x) = s(y), and there is one
// contact, of the triangle with the lower number. If neither lies on what both share, each has a contact, as in a
// valley. Along a chain of triangles that leave their contact s falls, or the number where s is the same, so that the
// last one has it. Values of s are not compared: between neighbours in one plane they differ by rounding.
#pragma once

#include <potential_particles.h>

#include <Eigen/Core>

#include <algorithm>
#include <array>

namespace potential_particles {

using Triangle = std::array<Eigen::Vector3d, 3>;

// Nine numbers, as the library takes them.
inline const double* numbersOf(const Triangle& triangle)
{
    static_assert(sizeof(Triangle) == 9 * sizeof(double));
    return triangle[0].data();
}

// Corners within this share of a triangle's longest side of each other are one. STL files round to 1e-7 of a
// coordinate, but alike for all triangles that share the corner.
constexpr double weldShare = 1e-9;

inline double weldOf(const Triangle& triangle)
{
    const auto side = [&](std::size_t i, std::size_t j) { return (triangle[i] - triangle[j]).norm(); };
    return weldShare * std::max({ side(0, 1), side(1, 2), side(2, 0) });
}

// Corners that two triangles have in common, a bit each, in the numbering of either. Two corners share the edge
// between them.
struct SharedCorners {
    unsigned mine = 0, its = 0;

    static SharedCorners of(const Triangle& mine, const Triangle& its)
    {
        const double weld = std::max(weldOf(mine), weldOf(its));
        SharedCorners shared;
        for (unsigned i = 0; i < 3; ++i)
            for (unsigned j = 0; j < 3; ++j)
                if ((mine[i] - its[j]).squaredNorm() <= weld * weld) {
                    shared.mine |= 1u << i;
                    shared.its |= 1u << j;
                }
        return shared;
    }

    explicit operator bool() const { return mine != 0; }
};

// Edge i goes from corner i to the next one.
inline unsigned cornersOfEdge(unsigned i) { return 1u << i | 1u << (i + 1) % 3; }

inline double distanceToSegment(const Eigen::Vector3d& x, const Eigen::Vector3d& from, const Eigen::Vector3d& to)
{
    const Eigen::Vector3d along = to - from;
    return (x - from - std::clamp((x - from).dot(along) / along.squaredNorm(), 0.0, 1.0) * along).norm();
}

// A point within this share of a body's size of an edge or corner lies on it. Where s is constant along an edge, as
// under a face that lies along a ridge, rounding moves its minimiser by about the square root of machine precision.
constexpr double onSeam = 1e-7;

// The contact of one triangle, alone. Positions as the library was given them.
struct TriangleContact {
    const Triangle& corners;
    const pp_flat_contact& found;
    int number; // of the triangle
    double rounding; // onSeam times the body's size

    Eigen::Vector3d point() const { return Eigen::Vector3d(found.on_boundary); }
};

// Whether a point on this feature of a triangle lies on these corners, or on the edges between them.
inline bool isFeatureOf(unsigned corners, unsigned feature)
{
    const unsigned ofFeature = feature >= PP_ON_VERTEX ? 1u << (feature - PP_ON_VERTEX)
        : feature >= PP_ON_EDGE                        ? cornersOfEdge(feature - PP_ON_EDGE)
                                                       : 0;
    return ofFeature && (ofFeature & ~corners) == 0;
}

// Whether the contact's point lies there.
inline bool liesOn(const TriangleContact& contact, unsigned corners)
{
    if (isFeatureOf(corners, contact.found.feature))
        return true;
    const Eigen::Vector3d x = contact.point();
    for (unsigned i = 0; i < 3; ++i) {
        const Eigen::Vector3d &from = contact.corners[i], &to = contact.corners[(i + 1) % 3];
        if (((corners >> i & 1) && (x - from).norm() <= contact.rounding)
            || ((cornersOfEdge(i) & ~corners) == 0 && distanceToSegment(x, from, to) <= contact.rounding))
            return true;
    }
    return false;
}

// Whether the first triangle leaves its contact to the other one, which has one too. Of two triangles at most one does.
inline bool leavesTo(const TriangleContact& own, const TriangleContact& other)
{
    const SharedCorners shared = SharedCorners::of(own.corners, other.corners);
    return shared && liesOn(own, shared.mine) && (!liesOn(other, shared.its) || other.number < own.number);
}

} // namespace potential_particles
