// SPDX-License-Identifier: GPL-3.0-or-later
//
// The contact loop, which skips pairs that cannot have met.
#pragma once

#include "abi/archive.hpp"
#include "abi/engine.hpp"
#include "pushes.hpp"
#include "registration/class_table.hpp"
#include "step.hpp"

namespace potential_particles {

// In the place of YADE's InteractionLoop. Bodies are looked at once a step; pairs that are further apart than their
// bodies can have moved since cost a comparison; contacts go through our functors and through laws that are known
// (known_laws.hpp) without a virtual call, and push their bodies in an order of their own. What YADE shows of a contact
// is as by its own loop, to the last bit.
//
// YADE's loop runs as it is in periodic cells and with callbacks, and serves, in one thread, what this one has no
// functor for: it fills the dispatchers' tables, or says what is missing.
class ConicInteractionLoop final : public yade::InteractionLoop {
public:
    ConicInteractionLoop();
    ~ConicInteractionLoop() override;
    PP_CLASS_OVERRIDES

    void action() override;

private:
    PP_ARCHIVED

    bool isOurs() const;
    void serveRest(const std::vector<std::size_t>& left);

    Step step;
    Pushes pushes;
};

} // namespace potential_particles
