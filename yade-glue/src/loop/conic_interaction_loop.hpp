// SPDX-License-Identifier: GPL-3.0-or-later
//
// The contact loop, which skips pairs that cannot have met.
#pragma once

#include "abi/archive.hpp"
#include "abi/engine.hpp"
#include "registration/class_table.hpp"
#include "step.hpp"

#include <boost/serialization/access.hpp>

namespace potential_particles {

// YADE's InteractionLoop, which it runs as it is: the contact functors find in its Step what they need not find out for every
// pair anew. Bodies are looked at once a step, and pairs that are further apart than their bodies can have moved since cost a
// comparison.
class ConicInteractionLoop final : public yade::InteractionLoop {
public:
    ConicInteractionLoop();
    ~ConicInteractionLoop() override;
    PP_CLASS_OVERRIDES

    void action() override;

private:
    friend class boost::serialization::access;
    template <class Archive> void serialize(Archive& archive, unsigned);

    Step step;
};

} // namespace potential_particles
