// SPDX-License-Identifier: GPL-3.0-or-later
//
// Boxes of potential particles, in the axes in which YADE's collider sorts them.
#pragma once

#include "../abi/bound.hpp"
#include "../abi/scene.hpp"
#include "../abi/shape.hpp"
#include "../abi/state.hpp"

namespace potential_particles {

struct Box {
    yade::Vector3r lower;
    yade::Vector3r upper;

    // False for what is not a number.
    bool liesIn(const yade::Bound& bound) const
    {
        return (bound.min.array() <= lower.array()).all() && (upper.array() <= bound.max.array()).all();
    }
};

// Of a shape that is a PotentialParticle. Where the script gave a box (AabbMinMax), that box is turned; else the library
// says how far the particle reaches. Any thread.
Box boxAsTurned(const boost::shared_ptr<yade::Shape>& shape, const yade::Se3r& at, const yade::Scene& scene);

// The same, however the body may turn about its centre.
Box boxOfAnyTurn(const boost::shared_ptr<yade::Shape>& shape, const yade::Se3r& at, const yade::Scene& scene);

} // namespace potential_particles
