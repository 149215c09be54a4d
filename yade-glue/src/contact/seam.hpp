// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which of two facets that share an edge or a vertex has the contact with a particle there.
//
// The scale s of a particle is convex, and so is each facet. The point of a facet where s is least is therefore one of the
// mesh around it exactly if no facet that shares its edge or vertex has a lower s: a facet whose point lies inside it keeps
// its contact, one whose point lies on a seam yields to a neighbour with less. If the least points of both lie on the seam and
// coincide within their uncertainty, there is one contact: of the facet with the lower s, or, if they coincide to rounding, of
// the body with the lower id.
#pragma once

#include "pair/kept_apart.hpp"

#include <potential_particles.h>

#include <algorithm>
#include <cmath>

namespace potential_particles {

// The contact of a facet, alone. Positions from the particle's centre.
struct FacetContact {
    const BoundaryPoints& vertices;
    const pp_flat_contact& found;
    int id;
    double rounding; // distance below which two points count as one
    double uncertainty; // bound on the distance of its point to the exact one

    yade::Vector3r point() const { return yade::Vector3r(found.on_boundary); }
};

// In the particle's size.
constexpr double pointRounding = 1e-9, mostUncertainty = 0.1;

inline FacetContact facetContact(const BoundaryPoints& vertices, const pp_flat_contact& found, int id, double radius)
{
    const double bound = found.point_bound >= 0 ? found.point_bound : mostUncertainty * radius;
    const double rounding = pointRounding * radius;
    return { vertices, found, id, rounding, rounding + std::min(bound, mostUncertainty * radius) };
}

inline double distanceToSegment(const yade::Vector3r& x, const yade::Vector3r& from, const yade::Vector3r& to)
{
    const yade::Vector3r along = to - from;
    const double way = std::clamp((x - from).dot(along) / along.squaredNorm(), 0.0, 1.0);
    return (x - from - way * along).norm();
}

// Edges and vertices of a facet, a bit each: edge i from vertex i to the next one.
struct Parts {
    unsigned edges = 0, vertices = 0;

    bool any() const { return edges || vertices; }
};

// Those on which the point of its contact lies, or may lie for all that is known.
inline Parts partsAt(const FacetContact& facet)
{
    Parts parts;
    const yade::Vector3r x = facet.point();
    for (unsigned i = 0; i < 3; ++i) {
        const yade::Vector3r& from = facet.vertices[i];
        const yade::Vector3r& to = facet.vertices[(i + 1) % 3];
        if (facet.found.feature == PP_ON_EDGE + i || distanceToSegment(x, from, to) <= facet.uncertainty)
            parts.edges |= 1u << i;
        if (facet.found.feature == PP_ON_VERTEX + i || (x - from).norm() <= facet.uncertainty)
            parts.vertices |= 1u << i;
    }
    return parts;
}

// Vertices of the first that the second has as well, and the edges between them.
inline Parts sharedParts(const BoundaryPoints& vertices, const BoundaryPoints& others, double weld)
{
    Parts parts;
    for (unsigned i = 0; i < 3; ++i)
        for (const yade::Vector3r& other : others)
            if ((vertices[i] - other).norm() <= weld)
                parts.vertices |= 1u << i;
    for (unsigned i = 0; i < 3; ++i)
        if ((parts.vertices >> i & 1) && (parts.vertices >> (i + 1) % 3 & 1))
            parts.edges |= 1u << i;
    return parts;
}

inline bool hasFeature(const Parts& parts, unsigned feature)
{
    return feature >= PP_ON_VERTEX ? parts.vertices >> (feature - PP_ON_VERTEX) & 1
        : feature >= PP_ON_EDGE    ? parts.edges >> (feature - PP_ON_EDGE) & 1
                                   : false;
}

// Of a point on an edge: where, from the edge's first vertex to the next one, 0 to 1.
inline double shareOnEdge(const FacetContact& facet)
{
    if (facet.found.feature < PP_ON_EDGE || facet.found.feature >= PP_ON_VERTEX)
        return 0;
    const std::size_t i = facet.found.feature - PP_ON_EDGE;
    const yade::Vector3r along = facet.vertices[(i + 1) % 3] - facet.vertices[i];
    return std::clamp((facet.point() - facet.vertices[i]).dot(along) / along.squaredNorm(), 0.0, 1.0);
}

// Whether S falls from the least point of a facet, on a seam, into the neighbour that has that point as well. By convexity it
// does if it falls towards a vertex, and if it falls the neighbour has a lower one; if it rises towards all, that point is
// the neighbour's least too.
enum class Slope { falls, rises, unclear };

inline Slope slopeInto(const BoundaryPoints& neighbour, const FacetContact& own)
{
    // In directions that are steeper than this no rounding of point and normal matters.
    constexpr double clear = 1e-6;
    if (own.found.feature == PP_ON_INTERIOR || (own.found.flags & PP_FLAG_NORMAL_BY_BOUNDARY))
        return Slope::unclear;
    const yade::Vector3r gradient(own.found.normal);
    bool rises = true;
    for (const yade::Vector3r& vertex : neighbour) {
        const yade::Vector3r way = vertex - own.point();
        const double length = way.norm(), slope = gradient.dot(way);
        if (length <= own.rounding)
            continue;
        if (slope < -clear * length)
            return Slope::falls;
        rises = rises && slope > clear * length;
    }
    return rises ? Slope::rises : Slope::unclear;
}

// Where s is the same to within its error, as on facets in one plane under a flat face of a particle with k = 0, the point
// nearest to the particle's centre is the least: there s is that of k -> 0.
inline bool isLower(const FacetContact& one, const FacetContact& other)
{
    if (!(std::abs(one.found.s - other.found.s) <= one.found.gap + other.found.gap))
        return one.found.s < other.found.s;
    const double way = one.point().squaredNorm(), otherWay = other.point().squaredNorm();
    return way != otherWay ? way < otherWay : one.id < other.id;
}

// Whether the point lies on one of these parts for sure.
inline bool isOn(const FacetContact& facet, const Parts& parts)
{
    for (unsigned i = 0; i < 3; ++i)
        if ((facet.found.feature == PP_ON_EDGE + i && (parts.edges >> i & 1))
            || (facet.found.feature == PP_ON_VERTEX + i && (parts.vertices >> i & 1)))
            return true;
    return false;
}

// `common`: what the two share, of that on which the first one's point lies.
inline bool yieldsTo(const FacetContact& other, const FacetContact& own, const Parts& common)
{
    bool inOnePlace = false;
    const yade::Vector3r x = own.point(), y = other.point();
    const bool close = (x - y).norm() <= own.uncertainty + other.uncertainty;
    for (unsigned i = 0; i < 3; ++i) {
        const yade::Vector3r& from = own.vertices[i];
        if (common.edges >> i & 1) {
            const yade::Vector3r& to = own.vertices[(i + 1) % 3];
            inOnePlace = inOnePlace
                || (close && distanceToSegment(x, from, to) <= own.uncertainty && distanceToSegment(y, from, to) <= other.uncertainty);
        }
        if (common.vertices >> i & 1)
            inOnePlace = inOnePlace || (close && (x - from).norm() <= own.uncertainty && (y - from).norm() <= other.uncertainty);
    }
    if (inOnePlace && (x - y).norm() <= own.rounding + other.rounding)
        return other.id < own.id;
    return (inOnePlace || isOn(own, common)) && isLower(other, own);
}

} // namespace potential_particles
