// SPDX-License-Identifier: GPL-3.0-or-later
#include "retired.hpp"

#include <chrono>
#include <deque>
#include <mutex>

namespace potential_particles {

namespace {

    using Clock = std::chrono::steady_clock;

    // A contact takes microseconds. The time is for a thread that the system stops in the middle of
    // one; the number is for a process that was stopped as a whole while the clock ran on.
    constexpr std::chrono::seconds atLeast { 1 };
    constexpr std::size_t andNewer = 256;

    struct Replaced {
        Clock::time_point when;
        std::shared_ptr<const void> what;
    };

    struct Queue {
        std::mutex mutex;
        std::deque<Replaced> entries;
    };

} // namespace

void retire(std::shared_ptr<const void> old)
{
    // Never destroyed: OpenMP threads may outlive the statics of this module.
    static Queue& queue = *new Queue;
    const auto now = Clock::now();
    const std::lock_guard<std::mutex> lock(queue.mutex);
    queue.entries.push_back({ now, std::move(old) });
    while (queue.entries.size() > andNewer && now - queue.entries.front().when > atLeast)
        queue.entries.pop_front();
}

} // namespace potential_particles
