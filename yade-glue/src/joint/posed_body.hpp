// SPDX-License-Identifier: GPL-3.0-or-later
//
// A body of YADE as the law of joints looks at its shape.
#pragma once

#include "abi/shape.hpp"
#include "abi/state.hpp"
#include "particle/particle.hpp"

#include "plugin-common/patch_rim.hpp"

#include <memory>

namespace potential_particles {

// shift: of its periodic image, world axes. Throws std::invalid_argument for a shape of another kind; one that is
// refused as a particle is taken for a wall.
class PosedBody : public PosedShape {
public:
    PosedBody(const boost::shared_ptr<yade::Shape>& shape, const yade::State& state, const yade::Vector3r& shift);

private:
    std::shared_ptr<const Particle> keeper;
};

} // namespace potential_particles
