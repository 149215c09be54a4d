// SPDX-License-Identifier: GPL-3.0-or-later
//
// The library's particles of shapes that cannot carry one: YADE's own PotentialParticle and the stand-ins.
#pragma once

#include "particle.hpp"
#include "stand_in.hpp"

#include <array>
#include <mutex>
#include <unordered_map>

#include <boost/weak_ptr.hpp>

namespace potential_particles {

// Keyed by the address of the shape, and checked against every coefficient at every look-up, so that neither a changed
// attribute nor a reused address can return an outdated particle. The comparison costs some ten nanoseconds; the locks
// are spread over shards, since the threads of a step look up different bodies most of the time.
class ParticleStore {
public:
    static ParticleStore& instance();

    std::shared_ptr<const Particle> find(const boost::shared_ptr<yade::Shape>& owner,
                                         const yade::PotentialParticle& shape);
    // As the stand-in has it.
    std::shared_ptr<const Particle> find(const boost::shared_ptr<yade::Shape>& owner, const StandIn& kind);
    // Held while the lists of a shape are compared or copied here; code that may set them during a step holds it too
    // (plane_lists.hpp). No holder may request Python's lock.
    std::mutex& mutexOf(const yade::PotentialParticle& shape) { return shardOf(&shape).mutex; }
    // Particles held now, for tests and curiosity.
    std::size_t size();

private:
    struct Entry {
        boost::weak_ptr<yade::Shape> owner;
        std::shared_ptr<const Particle> particle;
        // What it was made of, unless it is a PotentialParticle.
        const StandIn* kind;
        StandIn::Measures measures;
    };
    struct Shard {
        std::mutex mutex;
        std::unordered_map<const void*, Entry> entries;
        // Entries of shapes that died are swept when the shard reaches this size.
        std::size_t sweepAt = 64;
    };

    // describes(entry): whether the entry is still right; definition(): of a particle that is made, under the lock.
    template <class Describes, class MakeDefinition>
    std::shared_ptr<const Particle> findOrMake(const boost::shared_ptr<yade::Shape>& owner, const void* address,
                                               const StandIn* kind, const StandIn::Measures& measures,
                                               Describes describes, MakeDefinition definitionOf);
    Shard& shardOf(const void* address);
    static void sweep(Shard& shard);

    std::array<Shard, 64> shards;
};

} // namespace potential_particles
