// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a script replaced while YADE may be stepping in another thread.
#pragma once

#include <cstddef>
#include <memory>

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

} // namespace potential_particles
