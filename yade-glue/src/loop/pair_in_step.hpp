// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a contact loop knows about a pair from step to step.
#pragma once

#include "abi/interaction.hpp"
#include "body_in_step.hpp"

#include "plugin-common/motion_bound.hpp"

#include <boost/weak_ptr.hpp>

#include <cstdint>

namespace potential_particles {

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
