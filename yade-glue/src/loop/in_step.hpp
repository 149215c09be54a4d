// SPDX-License-Identifier: GPL-3.0-or-later
//
// A body as the pairs of one step see it, and what a contact loop knows about a pair from step to step.
#pragma once

#include "abi/body.hpp"
#include "abi/interaction.hpp"
#include "abi/state.hpp"

#include "particle/particle.hpp"

#include "plugin-common/motion_bound.hpp"

#include <boost/weak_ptr.hpp>

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>

namespace potential_particles {

// A value that one thread writes while others read it. Readers get a value that it once had, perhaps of another step
// than the values beside it: enough to fetch memory ahead of its use, which does no harm if it is wrong.
template <class Value> class Guess {
public:
    Guess(Value value)
        : held(value)
    {
    }
    operator Value() const noexcept { return held.load(std::memory_order_relaxed); }
    void operator=(Value value) noexcept { held.store(value, std::memory_order_relaxed); }

private:
    std::atomic<Value> held;
};

// How far a body has come.
struct Way {
    // An upper bound, despite rounding, on the way of any point of the body since the loop met it.
    double travelled = 0;
    // Number of the period over which `travelled` has been summed. A new one begins, at 0, when the body gets another
    // particle or its motion has no bound (not a number, say); ways of two periods cannot be compared. 0: unknown.
    std::uint64_t generation = 0;
};

// A wall or a facet as it was at the last look: where no point of it moves by more than the body does.
struct Flat {
    enum class Kind : unsigned char { none, wall, facet } kind = Kind::none;
    int axis = 0, sense = 0; // of a wall
    std::array<yade::Vector3r, 3> vertices; // of a facet, local axes
    double radius = 0; // of the ball about its position in which they lie
};

// Its particle and its way are looked at once a step, by the thread that meets it first; the rest is there in a loop of
// our own.
class alignas(64) BodyInStep {
public:
    // Null when there is no valid particle or pose: the pair then finds out why by itself.
    const Particle* particle = nullptr;
    Way way;
    // Null: there is none with that id.
    yade::Body* body = nullptr;
    // Its own, if it has both.
    const boost::shared_ptr<yade::Shape>* shape = nullptr;
    const yade::State* state = nullptr;
    yade::Vector3r position = yade::Vector3r::Zero();
    yade::Quaternionr orientation = yade::Quaternionr::Identity();
    yade::Vector3r velocity, spin;
    yade::Vector3r lowest, highest; // corners of its box
    double mass = 0;
    int subdomain = 0;
    bool hasShape = false, isClump = false, isHeld = false, hasBox = false;
    // As of a PotentialParticle.
    bool isPotential = false, isBoundary = false, fixesNormal = false;

    static constexpr std::size_t hotSize = 256; // all above

    // In a loop of our own. Of a wall or a facet the way is known as of a particle.
    Flat flat;

private:
    friend class Step;
    std::atomic<std::uint64_t> step { 0 }; // the one in which it was looked at last
    std::atomic<std::uint64_t> gatheredIn { 0 }; // the same for all above
    std::uint64_t serial = 0; // of the particle; its address may be used again
    const void* classOfShape = nullptr; // its virtual table
    // Where and how it was at the last look.
    yade::Vector3r formerPosition = yade::Vector3r::Zero();
    yade::Quaternionr formerOrientation = yade::Quaternionr::Identity();
    std::shared_ptr<const Particle> keeper; // of particles that the shape cannot hold itself
};

// Where YADE keeps the pair's interaction in its list. Written by the thread that has the interaction. One cache line:
// of a skipped pair no other is read.
struct alignas(64) PairInStep {
    Guess<int> id1 = -1, id2 = -1;
    std::uint64_t generation1 = 0, generation2 = 0;
    // The bodies do not touch while the sum of their ways is less than this.
    double wakes = 0;
    // The step in which it last pushed its bodies, if ever.
    std::uint64_t pushedIn = 0;
    Guess<bool> touching = false;
    // Of the loop's functors, the one that let it sleep.
    unsigned char functor = 0;

    // Whether it is that of this interaction. The block that counts its references stays where it is for as long as
    // this one is held, so that no other interaction can have it.
    bool isOf(const boost::shared_ptr<yade::Interaction>& pair) const
    {
        return !of.owner_before(pair) && !pair.owner_before(of);
    }

    // Begins anew for another interaction. An interaction that YADE made anew is looked at, so that its memory becomes
    // the same as by InteractionLoop.
    void become(const boost::shared_ptr<yade::Interaction>& pair)
    {
        of = pair;
        id1 = pair->id1;
        id2 = pair->id2;
        generation1 = generation2 = 0;
        wakes = 0;
        pushedIn = 0;
        touching = false;
    }

    // Of the interaction that it is of.
    bool sleeps(const Way& way1, const Way& way2) const
    {
        return way1.travelled + way2.travelled < wakes && generation1 == way1.generation
            && generation2 == way2.generation;
    }

    // They are `room` apart now; 0: nothing is known. The bodies in the order of the interaction.
    void note(const boost::shared_ptr<yade::Interaction>& pair, const BodyInStep& body1, const BodyInStep& body2,
              double room)
    {
        if (!isOf(pair))
            become(pair);
        id1 = pair->id1;
        id2 = pair->id2;
        generation1 = body1.way.generation;
        generation2 = body2.way.generation;
        wakes = wakesAt(body1.way.travelled + body2.way.travelled, room);
        touching = false;
    }

private:
    boost::weak_ptr<yade::Interaction> of;
};
static_assert(sizeof(PairInStep) <= 128);

// What a contact does to its bodies. On the second one acts the opposite force.
struct Push {
    yade::Vector3r force; // on the first body
    yade::Vector3r torque1, torque2; // about the bodies' positions
};

// More of a pair that touches.
struct alignas(64) ContactInStep {
    // Where its data lies, to be fetched before its turn; never followed, since it may be gone.
    Guess<const void*> interaction = nullptr;
    Guess<const void*> geom = nullptr;
    Guess<const void*> phys = nullptr;
    // The number of the lists (Pushes) that it is in; 0: it is in none.
    std::uint64_t listedIn = 0;
    std::uint64_t pushedIn = 0; // its step
    int id1 = -1, id2 = -1; // the bodies that it pushed
    Push push;
};

} // namespace potential_particles
