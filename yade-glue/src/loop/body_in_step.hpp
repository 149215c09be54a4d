// SPDX-License-Identifier: GPL-3.0-or-later
//
// A body as the pairs of one step see it.
#pragma once

#include "abi/body.hpp"
#include "abi/state.hpp"
#include "particle/particle.hpp"

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>

namespace potential_particles {

// A value that one thread writes while others read it. Readers get a value that it once had, perhaps of another step
// than the values beside it: enough to fetch memory ahead of its use, which does no harm if it is wrong.
template <class Value> class Guess {
public:
    Guess(Value value) : held(value) { }
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

} // namespace potential_particles
