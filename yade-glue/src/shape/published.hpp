// SPDX-License-Identifier: GPL-3.0-or-later
//
// A value that Python replaces while the threads of a step read it, and when the old one is freed.
#pragma once

#include <atomic>
#include <cstddef>
#include <memory>
#include <utility>

namespace potential_particles {

// Keeps `old`, in whose place the caller is about to put something else, until no step can still be reading it. Only
// steps read without Python's lock, and a step that begins after the replacement meets the new one. So `old` is freed
// by a later call of this function, with Python's lock, that finds either
//
//  - no step in progress (O.subStep is -1), or
//  - that O.iter has changed twice since. YADE counts when a step ends, so the first change says that the step has
//    ended in which `old` was handed over; the second is for a replacement that came a moment after that, in the next
//    step, and for a script that sets the count back (O.resetTime).
//
// What is held is therefore what was replaced during the last few steps, and one more. Readers take no lock and leave
// no trace. If there is no memory to keep `old`, this throws std::bad_alloc, and the caller must leave it where it is.
void retire(std::shared_ptr<const void> old);

// How many are held, for tests.
std::size_t retiredCount();

// The value itself never changes. get() is one load: a caller sees one whole value, and may read it until the step
// ends, even if it is replaced meanwhile (retire()). No share of ownership is handed out: threads would exchange it
// for every pair.
template <class Value> class Published {
public:
    // Any thread. Null before the first replace().
    const Value* get() const noexcept { return shown.load(std::memory_order_acquire); }

    // With Python's lock.
    const std::shared_ptr<const Value>& held() const { return owned; }
    void replace(std::shared_ptr<const Value> next)
    {
        // First, since it may run out of memory: nothing has changed then.
        if (owned)
            retire(owned);
        shown.store(next.get(), std::memory_order_release);
        owned = std::move(next);
    }

private:
    std::shared_ptr<const Value> owned;
    std::atomic<const Value*> shown { nullptr };
};

} // namespace potential_particles
