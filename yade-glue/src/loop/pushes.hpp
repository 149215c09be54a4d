// SPDX-License-Identifier: GPL-3.0-or-later
//
// The forces of all contacts, added up for each body in an order that does not depend on threads.
#pragma once

#include "step.hpp"

#include <cstdint>
#include <vector>

namespace potential_particles {

// For each body, its contacts in the order of the other bodies' ids: that in which one thread of YADE adds them up when its loop goes through
// the sorted list of interactions.
class Pushes {
public:
    // Contacts that push are looked for in the lists; where one is missing, they must be made anew.
    std::uint64_t number() const { return lists; }

    // Finds all contacts of late among so many pairs.
    void makeLists(Step& step, std::size_t pairs, std::size_t bodies);

    // Adds up what pushes the bodies of one piece of the lists, and hands it to the scene; many threads may do so at once.
    void add(const Step& step, yade::ForceContainer& forces, std::size_t body) const;

    std::size_t bodies() const { return begins.empty() ? 0 : begins.size() - 1; }

private:
    struct Entry {
        int other;
        std::uint32_t place; // in YADE's list; the topmost bit: it is the second body
    };
    static constexpr std::uint32_t second = std::uint32_t(1) << 31;
    // A contact that has ended stays in the lists for so many steps: many begin again.
    static constexpr std::uint64_t late = 100;

    std::uint64_t lists = 0;
    std::vector<std::uint32_t> begins; // of each body, in entries; and the end
    std::vector<std::uint32_t> filled;
    std::vector<Entry> entries;
};

} // namespace potential_particles
