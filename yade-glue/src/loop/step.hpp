// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a contact loop knows about bodies and pairs from step to step.
#pragma once

#include "abi/interaction.hpp"
#include "abi/scene.hpp"
#include "blocks.hpp"
#include "in_step.hpp"
#include "joint/conic_joint.hpp"
#include "particle/fetch.hpp"
#include "pair/sc_geom_conic_pp.hpp"

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
    void begin(std::size_t bodies)
    {
        ways.resize(bodies);
        flats.resize(bodies);
    }
    // Then, by any thread, looks at one of them, which may be null. False when memory runs out. Walls and facets are
    // many, and most have nothing near them: a known one that no pair has needed for some steps waits until one does.
    bool gather(std::size_t id, yade::Body* body)
    {
        if (body && flats[id].body == body && flats[id].waits < count)
            return true;
        BodyInStep* const found = bodies.at(id);
        if (found) {
            fill(*found, body);
            ways[id] = found->isPotential && found->hasShape ? found->way : Way();
            flats[id].body = found->flat.kind == Flat::Kind::none ? nullptr : body;
            found->gatheredIn.store(count, std::memory_order_release);
        }
        return found;
    }

    // A body of those that were gathered or wait.
    BodyInStep& gathered(int id)
    {
        BodyInStep& body = *bodies.find(static_cast<std::size_t>(id));
        if (body.gatheredIn.load(std::memory_order_acquire) != count)
            fillLate(body, flats[static_cast<std::size_t>(id)]);
        return body;
    }

    PairInStep* pair(const yade::Interaction& pair)
    {
        return pair.linIx >= 0 ? pairs.at(static_cast<std::size_t>(pair.linIx)) : nullptr;
    }
    PairInStep* pairAt(std::size_t place) { return pairs.at(place); }
    std::size_t bodyCount() const { return ways.size(); }
    // Whether a pair of gathered bodies is skipped.
    bool sleeps(const PairInStep& pair) { return pair.sleeps(wayOf(pair.id1), wayOf(pair.id2)); }
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
        if (const PairInStep* const later = pairs.find(place + 2 * ahead); later && later->touching)
            fetch(contacts.find(place + 2 * ahead), sizeof(ContactInStep));
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
        fetch(contact->geom, stateSize, stateOffset);
        fetch(contact->phys, physSize);
    }

private:
    // A contact takes some hundred nanoseconds, and so does a load from memory: six contacts are time enough for the
    // loads of one.
    static constexpr std::size_t ahead = 6;
    // What a contact touches of ScGeomConicPP, and of KnKsPhys or ConicJointPhys.
    static constexpr std::size_t geomSize = 256, stateOffset = sizeof(ScGeomConicPP) - sizeof(pp_pair_state);
    static constexpr std::size_t stateSize = sizeof(pp_pair_state), physSize = sizeof(ConicJointPhys);
    static constexpr std::uint64_t busy = ~std::uint64_t(0);

    struct FlatBody {
        yade::Body* body = nullptr; // null: it is no wall or facet
        std::uint64_t waits = 0; // from the step after this one on, until a pair asks for it
    };
    // In the order of ids their data is met as it lies in memory.
    static constexpr std::uint64_t remembered = 50;

    const Way& wayOf(int id)
    {
        const auto at = static_cast<std::size_t>(id);
        return flats[at].body ? gathered(id).way : ways[at];
    }

    void fill(BodyInStep& body, yade::Body* given);
    void fillLate(BodyInStep& body, FlatBody& flat);
    bool mayLook(std::atomic<std::uint64_t>& step) const;
    static void lookAtParticle(BodyInStep& body, const boost::shared_ptr<yade::Shape>& shape, const yade::State& state);
    static void lookAtFlat(BodyInStep& body, const yade::Shape& shape);
    void lookAnew(BodyInStep& body, const boost::shared_ptr<yade::Shape>& shape, const yade::State& state);

    static std::atomic<Step*> running;
    std::uint64_t count = 0;
    Blocks<BodyInStep> bodies;
    std::vector<Way> ways; // of those that were gathered
    std::vector<FlatBody> flats; // by id
    Blocks<PairInStep> pairs;
    Blocks<ContactInStep> contacts;
};

} // namespace potential_particles
