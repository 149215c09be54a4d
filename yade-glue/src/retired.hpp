// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a script replaced in a shape while YADE may be stepping in another thread.
#pragma once

#include <memory>

namespace potential_particles {

// Holds `old` until no contact that was being computed when it was replaced can still be reading it:
// for a second, and until many others have come. YADE tells nobody when a step ends, and a lock
// around every contact would cost what scripts that leave their shapes alone should not pay.
void retire(std::shared_ptr<const void> old);

} // namespace potential_particles
