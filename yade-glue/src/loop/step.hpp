// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a contact loop knows about bodies and pairs from step to step.
#pragma once

#include "abi/interaction.hpp"
#include "abi/scene.hpp"
#include "blocks.hpp"
#include "body_in_step.hpp"
#include "pair_in_step.hpp"

#include <potential_particles.h>

#include <atomic>
#include <cstdint>
#include <vector>

namespace potential_particles {

// A ConicInteractionLoop has one, and lets the functor see it while it runs.
class Step {
public:
    // Of the loop that runs, if it is one of ours; else null.
    static Step* current() noexcept { return running.load(std::memory_order_acquire); }

    // From here to the end of the scope, one step of this loop runs.
    class Running {
    public:
        explicit Running(Step& step) noexcept
        {
            ++step.count;
            running.store(&step, std::memory_order_release);
        }
        ~Running() { running.store(nullptr, std::memory_order_release); }
        Running(const Running&) = delete;
        Running& operator=(const Running&) = delete;
    };

    std::uint64_t number() const { return count; }

    // Null when memory runs out.
    BodyInStep* body(int id, const boost::shared_ptr<yade::Shape>& shape, const yade::State& state)
    {
        BodyInStep* const body = id >= 0 ? bodies.at(static_cast<std::size_t>(id)) : nullptr;
        if (body)
            look(*body, shape, state);
        return body;
    }

    void look(BodyInStep& body, const boost::shared_ptr<yade::Shape>& shape, const yade::State& state)
    {
        if (body.step.load(std::memory_order_acquire) != count)
            lookAnew(body, shape, state);
    }

    // For a loop of our own: so many bodies there are.
    void begin(std::size_t bodies) { ways.resize(bodies); }
    // Then, by any thread, looks at one of them, which may be null. False when memory runs out.
    bool gather(std::size_t id, yade::Body* body);

    // A body that was gathered.
    BodyInStep& gathered(int id) const { return *bodies.find(static_cast<std::size_t>(id)); }

    PairInStep* pair(const yade::Interaction& pair)
    {
        return pair.linIx >= 0 ? pairs.at(static_cast<std::size_t>(pair.linIx)) : nullptr;
    }
    PairInStep* pairAt(std::size_t place) { return pairs.at(place); }
    // How far the gathered bodies have come, by id.
    const std::vector<Way>& waysOfBodies() const { return ways; }
    const PairInStep* knownPairAt(std::size_t place) const { return pairs.find(place); }

    ContactInStep* contactAt(std::size_t place) { return contacts.at(place); }
    ContactInStep* knownContactAt(std::size_t place) const { return contacts.find(place); }

    // The pair at that place of YADE's list touches.
    void noteContact(std::size_t place, PairInStep& pair, const yade::Interaction& interaction)
    {
        ContactInStep* const contact = contacts.at(place);
        if (!contact)
            return;
        pair.touching = true;
        contact->interaction = &interaction;
        contact->geom = interaction.geom.get();
        contact->phys = interaction.phys.get();
    }

    // Asks for the data of the pair that is so many places further than this one in YADE's list, if it touches.
    void fetchAhead(std::size_t place) const
    {
        const PairInStep* const next = pairs.find(place + ahead);
        if (!next || !next->touching)
            return;
        fetch(bodies.find(static_cast<std::size_t>(next->id1)), BodyInStep::hotSize);
        fetch(bodies.find(static_cast<std::size_t>(next->id2)), BodyInStep::hotSize);
        const ContactInStep* const contact = contacts.find(place + ahead);
        if (!contact)
            return;
        fetch(contact->interaction, sizeof(yade::Interaction));
        fetch(contact->geom, geomSize);
        fetch(contact->phys, physSize);
    }

private:
    // A contact takes some hundred nanoseconds, and so does a load from memory: six contacts are time enough for the loads
    // of one.
    static constexpr std::size_t ahead = 6;
    static constexpr std::size_t lineSize = 64;
    // What a contact touches of ScGeomConicPP and KnKsPhys.
    static constexpr std::size_t geomSize = 256 + sizeof(pp_pair_state), physSize = 480;
    static constexpr std::uint64_t busy = ~std::uint64_t(0);

    static void fetch(const void* place, std::size_t size)
    {
        if (!place)
            return;
        // GCC 12 takes a function of __builtin_prefetch alone for one without effect, and drops it.
        for (std::size_t i = 0; i < size; i += lineSize)
            asm volatile("prefetcht0 (%0)" : : "r"(static_cast<const char*>(place) + i));
    }

    static void lookAtFlat(BodyInStep& body, const yade::Shape& shape);
    void lookAnew(BodyInStep& body, const boost::shared_ptr<yade::Shape>& shape, const yade::State& state);

    static std::atomic<Step*> running;
    std::uint64_t count = 0;
    Blocks<BodyInStep> bodies;
    std::vector<Way> ways;
    Blocks<PairInStep> pairs;
    Blocks<ContactInStep> contacts;
};

} // namespace potential_particles
