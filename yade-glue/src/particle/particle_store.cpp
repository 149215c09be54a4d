// SPDX-License-Identifier: GPL-3.0-or-later
#include "particle_store.hpp"

#include <algorithm>
#include <cstdint>
#include <cstring>

namespace potential_particles {

ParticleStore& ParticleStore::instance()
{
    // Never destroyed: OpenMP threads may outlive the statics of this module.
    static ParticleStore& store = *new ParticleStore;
    return store;
}

std::shared_ptr<const Particle> ParticleStore::find(const boost::shared_ptr<yade::Shape>& owner,
                                                    const yade::PotentialParticle& shape)
{
    return findOrMake(
        owner, &shape, nullptr, {},
        [&](const Entry& entry) { return !entry.kind && entry.particle->definition.describes(shape); },
        [&] { return Definition::of(shape); });
}

std::shared_ptr<const Particle> ParticleStore::find(const boost::shared_ptr<yade::Shape>& owner, const StandIn& kind)
{
    const StandIn::Measures measures = kind.measuresOf(*owner);
    return findOrMake(
        owner, owner.get(), &kind, measures,
        [&](const Entry& entry) {
            // Bit for bit, so that a NaN equals itself.
            return entry.kind == &kind && std::memcmp(&entry.measures, &measures, sizeof measures) == 0;
        },
        [&] { return kind.definitionOf(measures); });
}

template <class Describes, class MakeDefinition>
std::shared_ptr<const Particle>
ParticleStore::findOrMake(const boost::shared_ptr<yade::Shape>& owner, const void* address, const StandIn* kind,
                          const StandIn::Measures& measures, Describes describes, MakeDefinition definitionOf)
{
    Shard& shard = shardOf(address);
    Definition definition;
    {
        const std::lock_guard<std::mutex> lock(shard.mutex);
        const auto found = shard.entries.find(address);
        if (found != shard.entries.end() && describes(found->second))
            return found->second.particle;
        definition = definitionOf();
    }
    // Made outside the lock: two threads may both make it, which is waste and no error.
    auto made = Particle::make(std::move(definition));
    const std::lock_guard<std::mutex> lock(shard.mutex);
    shard.entries[address] = { owner, made, kind, measures };
    if (shard.entries.size() >= shard.sweepAt)
        sweep(shard);
    return made;
}

std::size_t ParticleStore::size()
{
    std::size_t total = 0;
    for (Shard& shard : shards) {
        const std::lock_guard<std::mutex> lock(shard.mutex);
        total += shard.entries.size();
    }
    return total;
}

ParticleStore::Shard& ParticleStore::shardOf(const void* address)
{
    // Shapes are some hundred bytes apart: drop the low bits, mix in higher ones.
    const auto bits = reinterpret_cast<std::uintptr_t>(address) >> 6;
    return shards[(bits ^ (bits >> 6) ^ (bits >> 12)) % shards.size()];
}

void ParticleStore::sweep(Shard& shard)
{
    for (auto entry = shard.entries.begin(); entry != shard.entries.end();) {
        if (entry->second.owner.expired())
            entry = shard.entries.erase(entry);
        else
            ++entry;
    }
    shard.sweepAt = std::max<std::size_t>(64, 2 * shard.entries.size());
}

} // namespace potential_particles
