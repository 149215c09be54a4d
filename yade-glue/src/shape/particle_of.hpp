// SPDX-License-Identifier: GPL-3.0-or-later
//
// The particle behind a shape.
#pragma once

#include "conic_potential_particle.hpp"
#include "particle/particle_store.hpp"

#include <memory>
#include <stdexcept>
#include <typeinfo>

namespace potential_particles {

// Identifies the class of an object, which does not change, by its virtual table.
inline const void* classOf(const yade::Shape& shape) { return *reinterpret_cast<const void* const*>(&shape); }

// `keeper` owns it when the shape itself does not.
inline const Particle* particleOf(const boost::shared_ptr<yade::Shape>& shape, const yade::PotentialParticle& pp,
                                  std::shared_ptr<const Particle>& keeper)
{
    const auto* own
        = typeid(pp) == typeid(ConicPotentialParticle) ? static_cast<const ConicPotentialParticle*>(&pp) : nullptr;
    if (own)
        if (const Particle* particle = own->particle())
            return particle;
    keeper = ParticleStore::instance().find(shape, pp);
    // Between these two looks a script in another thread may have finished one change of several attributes, by which
    // the shape has its particle again, and have begun the next.
    if (own && keeper->pending())
        if (const Particle* particle = own->particle())
            return particle;
    return keeper.get();
}

// Null for other shapes.
inline const yade::PotentialParticle* potentialParticle(const yade::Shape& shape)
{
    if (typeid(shape) == typeid(ConicPotentialParticle) || typeid(shape) == typeid(yade::PotentialParticle))
        return static_cast<const yade::PotentialParticle*>(&shape);
    return dynamic_cast<const yade::PotentialParticle*>(&shape);
}

// The same for every shape that is a particle: a PotentialParticle or one with a stand-in. Throws std::invalid_argument
// for others.
inline const Particle* particleOf(const boost::shared_ptr<yade::Shape>& shape, std::shared_ptr<const Particle>& keeper)
{
    const yade::Shape& one = *shape;
    if (typeid(one) == typeid(ConicPotentialParticle)) // most are; others need a comparison of names
        return particleOf(shape, static_cast<const ConicPotentialParticle&>(one), keeper);
    if (const StandIn* kind = standInOf(one))
        keeper = ParticleStore::instance().find(shape, *kind);
    else if (const auto* pp = potentialParticle(one))
        return particleOf(shape, *pp, keeper);
    else if (const StandIn* kind = standInOfBase(one))
        keeper = ParticleStore::instance().find(shape, *kind);
    else
        throw std::invalid_argument("a " + one.getClassName() + " is no particle");
    return keeper.get();
}

} // namespace potential_particles
