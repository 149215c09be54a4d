// SPDX-License-Identifier: GPL-3.0-or-later
//
// Boxes of potential particles, in the axes in which YADE's collider sorts them.
#pragma once

#include "abi/bound.hpp"
#include "abi/scene.hpp"
#include "abi/shape.hpp"
#include "abi/state.hpp"

#include <algorithm>

namespace potential_particles {

struct Box {
    yade::Vector3r lower;
    yade::Vector3r upper;

    // To the nearest side of the bound; negative for a box that is not within, or not a number.
    double roomIn(const yade::Bound& bound) const
    {
        const double room = std::min((lower - bound.min).minCoeff(), (bound.max - upper).minCoeff());
        return room >= 0 && lower.allFinite() && upper.allFinite() && !bound.min.hasNaN() && !bound.max.hasNaN() ? room
                                                                                                                 : -1;
    }
};

// Of a shape that is a PotentialParticle. Where the script gave a box (AabbMinMax), that box is turned; else the
// library says how far the particle reaches. Any thread.
Box boxAsTurned(const boost::shared_ptr<yade::Shape>& shape, const yade::Se3r& at, const yade::Scene& scene);

// The same, however the body may turn about its centre.
Box boxOfAnyTurn(const boost::shared_ptr<yade::Shape>& shape, const yade::Se3r& at, const yade::Scene& scene);

// Whether the shape is a Facet, or its equivalent particle has a hull; then its box as it is turned.
bool hasCorners(const yade::Shape& shape);
Box boxOfCorners(const yade::Shape& shape, const yade::Se3r& at, const yade::Scene& scene);

} // namespace potential_particles
