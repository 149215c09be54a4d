// SPDX-License-Identifier: GPL-3.0-or-later
//
// The forces of all contacts, added up for each body in an order that does not depend on threads.
#pragma once

#include "step.hpp"

#include <cstdint>
#include <vector>

namespace potential_particles {

// For each body a list of its contacts in the order of the other bodies' ids: that in which one thread of YADE adds
// them up when its loop goes through the sorted list of interactions.
class Pushes {
public:
    // Contacts that are listed carry this number.
    std::uint64_t number() const { return lists; }

    // Before the sums of a step: enters the contacts at these places, which are in no list yet. pairs, bodies: totals.
    void list(const std::vector<std::size_t>& missing, Step& step, std::size_t pairs, std::size_t bodies);

    // Adds up what pushes a body, and hands it to the scene; many threads may do so at once.
    void add(const Step& step, yade::ForceContainer& forces, std::size_t body) const;

private:
    struct Entry {
        int other;
        std::uint32_t place; // in YADE's list; of a pair that has ended, another one may have taken it
    };
    // For this many steps an ended contact stays in new lists: many begin again.
    static constexpr std::uint64_t late = 100;
    // Entries whose contacts are fetched before their turn.
    static constexpr std::size_t ahead = 16;
    // Contacts that may come to a body before all lists are made anew.
    static constexpr std::uint32_t spare = 6;

    bool enter(int body, Entry entry);
    void makeAnew(Step& step, std::size_t pairs, std::size_t bodies);

    std::uint64_t lists = 0;
    std::vector<std::uint32_t> begins; // of the room of each body, in entries; and the end
    std::vector<std::uint32_t> ends; // of what is in it
    std::vector<Entry> entries;
};

} // namespace potential_particles
