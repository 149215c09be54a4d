// SPDX-License-Identifier: GPL-3.0-or-later
//
// YADE's shapes that are particles themselves.
#pragma once

#include "particle.hpp"

#include <array>
#include <typeinfo>

namespace potential_particles {

// One of them, as a row of the table in stand_in.cpp.
struct StandIn {
    // The attributes that say which particle it is; what is left over is 0.
    using Measures = std::array<double, 4>;

    // The shape is the convex hull of balls of this radius about these points, local axes.
    struct Hull {
        std::array<yade::Vector3r, 8> points;
        std::size_t count;
        double radius;
    };

    const std::type_info& shape;
    bool (*isBaseOf)(const yade::Shape&);
    Measures (*measuresOf)(const yade::Shape&);
    Definition (*definitionOf)(const Measures&);
    // Null where a turn moves nothing.
    Hull (*hullOf)(const Measures&);
};

// Of a shape of exactly such a class, else null.
const StandIn* standInOf(const yade::Shape& shape);
// Of a shape whose class is derived from one of them, else null. Takes longer.
const StandIn* standInOfBase(const yade::Shape& shape);

} // namespace potential_particles
