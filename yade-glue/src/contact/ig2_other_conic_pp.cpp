// SPDX-License-Identifier: GPL-3.0-or-later
#include "ig2_other_conic_pp.hpp"

namespace potential_particles {

bool Ig2_Other_ConicPP::goReverse(const boost::shared_ptr<yade::Shape>& shape1,
                                  const boost::shared_ptr<yade::Shape>& shape2, const yade::State& state1,
                                  const yade::State& state2, const yade::Vector3r& shift2, const bool& force,
                                  const boost::shared_ptr<yade::Interaction>& interaction) noexcept
{
    const bool real = interaction->hasGeomAndPhys();
    try {
        interaction->swapOrder();
    } catch (const std::exception& error) {
        fail(*interaction, state1, state2, shift2, error.what());
        return real;
    }
    return go(shape2, shape1, state2, state1, -shift2, force, interaction);
}

} // namespace potential_particles
