// SPDX-License-Identifier: GPL-3.0-or-later
#include "stand_in.hpp"

#include "abi/primitives.hpp"

#include <algorithm>
#include <iterator>

namespace potential_particles {

using yade::Vector3r;

namespace {

    using Measures = StandIn::Measures;
    using Hull = StandIn::Hull;

    // --- Sphere: k = 1, the shadow sphere alone. Measures: radius.

    Measures measuresOfSphere(const yade::Shape& shape) { return { static_cast<const yade::Sphere&>(shape).radius }; }

    Definition particleOfSphere(const Measures& radius) { return { {}, {}, {}, {}, radius[0], 1, radius[0] }; }

    // --- Cylinder: a segment swept by a ball, k = 0, six planes. Measures: radius, segment.
    //
    // With the segment along u from the origin to u l, and v, w perpendicular to it and to each other, the planes of
    // normals ±v and ±w at distance 0 give <v.x>^2 + <-v.x>^2 + <w.x>^2 + <-w.x>^2, which is the squared distance to
    // the axis, and those of ±u at l and 0 the squared distance along it beyond an end: together, the squared distance
    // to the segment, exactly.

    Measures measuresOfCylinder(const yade::Shape& shape)
    {
        const auto& cylinder = static_cast<const yade::Cylinder&>(shape);
        const Vector3r& segment = cylinder.segment;
        return { cylinder.radius, segment[0], segment[1], segment[2] };
    }

    Definition particleOfCylinder(const Measures& measures)
    {
        const Vector3r segment(measures.data() + 1);
        const double length = segment.norm();
        // Without a length it is a ball, whatever the axis.
        const Vector3r u = length > 0 ? Vector3r(segment / length) : Vector3r(Vector3r::UnitX());
        const Vector3r v = u.unitOrthogonal(), w = u.cross(v);
        return { { u[0], -u[0], v[0], -v[0], w[0], -w[0] },
                 { u[1], -u[1], v[1], -v[1], w[1], -w[1] },
                 { u[2], -u[2], v[2], -v[2], w[2], -w[2] },
                 { length, 0, 0, 0, 0, 0 },
                 measures[0],
                 0,
                 length + measures[0] };
    }

    Hull hullOfCylinder(const Measures& measures)
    {
        return { { Vector3r::Zero(), Vector3r(measures.data() + 1) }, 2, measures[0] };
    }

    // --- Box: k = 0, six planes. Measures: half sizes.

    // Edges and corners of a box are rounded by this share of its least half size: too little to matter to any contact,
    // and over a thousand times what the contact area needs (pp_contact_area). The faces stay where they are.
    constexpr double boxRounding = 1e-6;

    Measures measuresOfBox(const yade::Shape& shape)
    {
        const Vector3r& half = static_cast<const yade::Box&>(shape).extents;
        return { half[0], half[1], half[2] };
    }

    Definition particleOfBox(const Measures& measures)
    {
        const Vector3r half(measures.data());
        const double r = boxRounding * half.minCoeff();
        const Vector3r d = half.array() - r;
        return { { 1, -1, 0, 0, 0, 0 },
                 { 0, 0, 1, -1, 0, 0 },
                 { 0, 0, 0, 0, 1, -1 },
                 { d[0], d[0], d[1], d[1], d[2], d[2] },
                 r,
                 0,
                 half.norm() };
    }

    Hull hullOfBox(const Measures& measures)
    {
        const Vector3r half(measures.data());
        Hull hull { {}, 8, 0 };
        for (std::size_t i = 0; i < 8; ++i)
            hull.points[i] = half.cwiseProduct(Vector3r(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1));
        return hull;
    }

    template <class Shape>
    StandIn row(Measures (*measures)(const yade::Shape&), Definition (*particle)(const Measures&),
                Hull (*hull)(const Measures&))
    {
        const auto isBaseOf = [](const yade::Shape& shape) { return dynamic_cast<const Shape*>(&shape) != nullptr; };
        return { typeid(Shape), isBaseOf, measures, particle, hull };
    }

    // Bases before what derives from them.
    const StandIn table[] = {
        row<yade::Sphere>(measuresOfSphere, particleOfSphere, nullptr),
        row<yade::Cylinder>(measuresOfCylinder, particleOfCylinder, hullOfCylinder),
        row<yade::Box>(measuresOfBox, particleOfBox, hullOfBox),
    };

} // namespace

const StandIn* standInOf(const yade::Shape& shape)
{
    const std::type_info& wanted = typeid(shape);
    for (const StandIn& one : table)
        if (one.shape == wanted)
            return &one;
    return nullptr;
}

const StandIn* standInOfBase(const yade::Shape& shape)
{
    const auto found
        = std::find_if(std::rbegin(table), std::rend(table), [&](const StandIn& one) { return one.isBaseOf(shape); });
    return found != std::rend(table) ? &*found : nullptr;
}

} // namespace potential_particles
