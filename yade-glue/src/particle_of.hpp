// SPDX-License-Identifier: GPL-3.0-or-later
//
// The particle behind a shape.
#pragma once

#include "conic_potential_particle.hpp"
#include "particle_store.hpp"

#include <memory>
#include <typeinfo>

namespace potential_particles {

// `keeper` owns it when the shape itself does not.
inline const Particle* particleOf(const boost::shared_ptr<yade::Shape>& shape, const yade::PotentialParticle& pp,
                                  std::shared_ptr<const Particle>& keeper)
{
    if (typeid(pp) == typeid(ConicPotentialParticle))
        if (const Particle* particle = static_cast<const ConicPotentialParticle&>(pp).particle())
            return particle;
    keeper = ParticleStore::instance().find(shape, pp);
    return keeper.get();
}

} // namespace potential_particles
