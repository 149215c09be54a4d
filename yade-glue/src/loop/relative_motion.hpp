// SPDX-License-Identifier: GPL-3.0-or-later
//
// How two bodies move against each other at their contact, to the last bit as YADE's ScGeom and laws compute it outside
// of periodic cells. The order of the operations matters.
#pragma once

#include "abi/scgeom.hpp"
#include "in_step.hpp"

namespace potential_particles {

// From the centres of both bodies to a point.
struct Levers {
    Levers(const yade::Vector3r& point, const BodyInStep& one, const BodyInStep& other)
        : first(point - one.position)
        , second(point - other.position)
    {
    }

    // Of the second body against the first, at the point.
    yade::Vector3r velocity(const BodyInStep& one, const BodyInStep& other) const
    {
        const yade::Vector3r ofSecond = other.velocity + other.spin.cross(second),
                             ofFirst = one.velocity + one.spin.cross(first);
        return ofSecond - ofFirst;
    }

    yade::Vector3r first, second;
};

// ScGeom::precompute(): the stored normal must still be that of the last step, and the point the present one.
inline void turnFrame(yade::ScGeom& geom, const BodyInStep& one, const BodyInStep& other, double dt,
                      const yade::Vector3r& normal, bool isNew)
{
    using yade::Vector3r;
    if (isNew) {
        geom.twist_axis = geom.orthonormal_axis = Vector3r::Zero();
    } else {
        const Vector3r spins = one.spin + other.spin;
        const double angle = dt * 0.5 * geom.normal.dot(spins);
        geom.orthonormal_axis = geom.normal.cross(normal);
        geom.twist_axis = angle * geom.normal;
    }
    geom.normal = normal;
    Vector3r velocity = Levers(geom.contactPoint, one, other).velocity(one, other);
    velocity += Vector3r::Zero(); // that of periodic images; -0 becomes 0
    const Vector3r along = velocity - normal.dot(velocity) * normal;
    geom.shearInc = along * dt;
}

// ScGeom::rotate().
inline void carryAlong(const yade::ScGeom& geom, yade::Vector3r& tangent)
{
    tangent -= tangent.cross(geom.orthonormal_axis);
    tangent -= tangent.cross(geom.twist_axis);
}

} // namespace potential_particles
