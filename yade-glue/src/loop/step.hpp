// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a contact loop knows about bodies and pairs from step to step.
#pragma once

#include "abi/interaction.hpp"
#include "abi/state.hpp"
#include "blocks.hpp"
#include "particle/particle.hpp"

#include <potential_particles.h>

#include <atomic>
#include <cstdint>
#include <memory>

namespace potential_particles {

// A value that one thread writes while others read it. Readers get some value that it has had, perhaps of another step than
// the values beside it: enough to fetch memory ahead of its use, which does no harm where it turns out wrong.
template <class Value> class Guess {
public:
    Guess(Value value) : held(value) { }
    operator Value() const noexcept { return held.load(std::memory_order_relaxed); }
    void operator=(Value value) noexcept { held.store(value, std::memory_order_relaxed); }

private:
    std::atomic<Value> held;
};

// A body as the pairs of one step see it: looked at once a step, by the thread that meets it first.
class alignas(64) BodyInStep {
public:
    // Null when there is no valid particle or pose: the pair then finds out why by itself.
    const Particle* particle = nullptr;
    // A bound on the way that any point of the body has come since the loop met it; never less, whatever is rounded.
    double travelled = 0;
    // Number of the period over which `travelled` has been summed. A new one begins, at 0, when the body gets another
    // particle or moves by what has no bound (not a number, say); ways of two periods cannot be compared. Never 0.
    std::uint64_t generation = 0;
    Guess<const yade::State*> state = nullptr; // to be fetched, never followed

private:
    friend class Step;
    std::atomic<std::uint64_t> step { 0 }; // the one in which it was looked at last
    std::uint64_t serial = 0; // of the particle; its address may be used again
    yade::Vector3r position = yade::Vector3r::Zero();
    yade::Quaternionr orientation = yade::Quaternionr::Identity();
    std::shared_ptr<const Particle> keeper; // of particles that the shape cannot hold itself
};

// A pair of bodies, where YADE keeps their interaction in its list. Written by the thread that has the interaction.
struct alignas(64) PairInStep {
    Guess<int> id1 = -1, id2 = -1;
    std::uint64_t generation1 = 0, generation2 = 0;
    // They do not touch while the bodies have travelled less than this, taken together.
    double wakes = 0;
    // Where its data lies, to be fetched before its turn; never followed, since it may be gone. A geometry only if they touch.
    Guess<const void*> interaction = nullptr;
    Guess<const void*> geom = nullptr;
    Guess<const void*> phys = nullptr;

    // An interaction that YADE made anew is looked at once more, so that its memory becomes the same as by InteractionLoop.
    bool sleeps(const yade::Interaction& pair, const BodyInStep& body1, const BodyInStep& body2) const
    {
        return pair.geom && body1.travelled + body2.travelled < wakes && id1 == pair.id1 && id2 == pair.id2
            && generation1 == body1.generation && generation2 == body2.generation;
    }

    // They are `room` apart now; 0: nothing is known.
    void note(const yade::Interaction& pair, const BodyInStep& body1, const BodyInStep& body2, double room)
    {
        interaction = &pair;
        geom = nullptr;
        phys = nullptr;
        id1 = pair.id1;
        id2 = pair.id2;
        generation1 = body1.generation;
        generation2 = body2.generation;
        // Three roundings of sums, and that of the room.
        const double travelled = body1.travelled + body2.travelled;
        wakes = room > 0 ? (travelled + room) - 1e-15 * (travelled + room) : 0;
    }
};

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

    // Null when memory runs out.
    BodyInStep* body(int id, const boost::shared_ptr<yade::Shape>& shape, const yade::State& state)
    {
        BodyInStep* const body = id >= 0 ? bodies.at(static_cast<std::size_t>(id)) : nullptr;
        if (body && body->step.load(std::memory_order_acquire) != count)
            look(*body, shape, state);
        return body;
    }

    PairInStep* pair(const yade::Interaction& pair)
    {
        return pair.linIx >= 0 ? pairs.at(static_cast<std::size_t>(pair.linIx)) : nullptr;
    }

    // Asks for the data of the pair that is so many places further in YADE's list.
    void fetchAhead(const yade::Interaction& pair) const
    {
        const PairInStep* const next = pairs.find(static_cast<std::size_t>(pair.linIx) + ahead);
        if (!next)
            return;
        // Once each: another thread may be writing them.
        const void* const interaction = next->interaction;
        const void* const geom = next->geom;
        if (!interaction)
            return;
        fetch(interaction, sizeof(yade::Interaction));
        const BodyInStep* const bodiesOfNext[] = { bodies.find(next->id1), bodies.find(next->id2) };
        for (const BodyInStep* body : bodiesOfNext)
            fetch(body, geom ? sizeof(BodyInStep) : lineSize);
        if (!geom)
            return;
        fetch(geom, geomSize);
        fetch(next->phys, physSize);
        for (const BodyInStep* body : bodiesOfNext)
            if (body)
                fetch(body->state, stateSize);
    }

private:
    // A contact takes some hundred nanoseconds, and so does a load from memory: six contacts are time enough for the loads
    // of one.
    static constexpr std::size_t ahead = 6;
    static constexpr std::size_t lineSize = 64;
    // What a contact touches of ScGeomConicPP, KnKsPhys and State.
    static constexpr std::size_t geomSize = 256 + sizeof(pp_pair_state), physSize = 480, stateSize = 240;
    static constexpr std::uint64_t busy = ~std::uint64_t(0);

    static void fetch(const void* place, std::size_t size)
    {
        if (!place)
            return;
        // GCC 12 takes a function of __builtin_prefetch alone for one without effect, and drops it.
        for (std::size_t i = 0; i < size; i += lineSize)
            asm volatile("prefetcht0 (%0)" : : "r"(static_cast<const char*>(place) + i));
    }

    void look(BodyInStep& body, const boost::shared_ptr<yade::Shape>& shape, const yade::State& state);

    static std::atomic<Step*> running;
    std::uint64_t count = 0;
    Blocks<BodyInStep> bodies;
    Blocks<PairInStep> pairs;
};

} // namespace potential_particles
