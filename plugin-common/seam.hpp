// SPDX-License-Identifier: MIT OR Apache-2.0
//
// Which of two triangles that share an edge or a corner has the contact with a body there.
//
// The scale s of the body is convex, and so is each triangle: each has a point where s is least, x on one and y on
// the other. If x lies on what both share, it is a point of the other triangle as well, so that s(y) <= s(x): the
// first triangle leaves the contact to the other, unless y lies there too. Then s(x) = s(y), and there is one
// contact, of the triangle with the lower number. If neither lies on what both share, each has a contact, as in a
// valley. Along a chain of triangles that leave their contact s falls, or the number where s is the same, so that the
// last one has it. Values of s are not compared: between neighbours in one plane they differ by rounding.
#pragma once

#include "triangle.hpp"

#include <potential_particles.h>

namespace potential_particles {

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
