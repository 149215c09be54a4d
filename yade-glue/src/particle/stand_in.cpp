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

    // --- Box: k = 0, six planes. Measures: half sizes.

    // Edges and corners of a box are rounded by this share of its least half size: as little as makes no difference to any
    // contact, and over a thousand times what the contact area needs (pp_contact_area). The faces stay where they are.
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
        return { { 1, -1, 0, 0, 0, 0 }, { 0, 0, 1, -1, 0, 0 }, { 0, 0, 0, 0, 1, -1 }, { d[0], d[0], d[1], d[1], d[2], d[2] },
                 r, 0, half.norm() };
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
    StandIn row(Measures (*measures)(const yade::Shape&), Definition (*particle)(const Measures&), Hull (*hull)(const Measures&))
    {
        const auto isBaseOf = [](const yade::Shape& shape) { return dynamic_cast<const Shape*>(&shape) != nullptr; };
        return { typeid(Shape), isBaseOf, measures, particle, hull };
    }

    // Bases before what derives from them.
    const StandIn table[] = {
        row<yade::Sphere>(measuresOfSphere, particleOfSphere, nullptr),
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
    const auto found = std::find_if(std::rbegin(table), std::rend(table), [&](const StandIn& one) { return one.isBaseOf(shape); });
    return found != std::rend(table) ? &*found : nullptr;
}

} // namespace potential_particles
