// SPDX-License-Identifier: GPL-3.0-or-later
//
// A value that Python replaces while the threads of a step read it.
#pragma once

#include "retired.hpp"

#include <atomic>
#include <memory>
#include <utility>

namespace potential_particles {

// The value itself never changes. get() is one load: a caller sees one whole value, and may read it until the step
// ends, even if it is replaced meanwhile (retired.hpp). No share of ownership is handed out: threads would exchange it
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
