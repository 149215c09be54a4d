// SPDX-License-Identifier: GPL-3.0-or-later
#include "registration/definitions.hpp"

#include "conic_interaction_loop.hpp"

namespace potential_particles {

ConicInteractionLoop::ConicInteractionLoop() = default;
ConicInteractionLoop::~ConicInteractionLoop() = default;

PP_CLASS_DEFINITIONS(ConicInteractionLoop)
PP_PYTHON_AS_BASE(ConicInteractionLoop, yade::InteractionLoop)

void ConicInteractionLoop::action()
{
    const Step::Running running(step);
    InteractionLoop::action();
}

template <class Archive> void ConicInteractionLoop::serialize(Archive& archive, unsigned version)
{
    requireReadable<ConicInteractionLoop>(version);
    serializeBase<yade::InteractionLoop>(archive, *this, "InteractionLoop");
}

} // namespace potential_particles

BOOST_CLASS_EXPORT_IMPLEMENT(potential_particles::ConicInteractionLoop)
