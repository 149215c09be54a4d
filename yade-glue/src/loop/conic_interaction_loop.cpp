// SPDX-License-Identifier: GPL-3.0-or-later
#include "registration/archives.hpp"

#include "registration/class_versions.hpp"
#include "conic_interaction_loop.hpp"
#include "registration/python_class.hpp"

namespace potential_particles {

namespace {
    constexpr char doc[]
        = "InteractionLoop for scenes of potential particles: the same contacts, forces and attributes in less time. Put it in the\n"
          "place of InteractionLoop. Bodies are looked at once a step, and pairs that cannot have met since they were last\n"
          "looked at are passed over. Shapes of other kinds are served as by InteractionLoop.";
}

ConicInteractionLoop::ConicInteractionLoop() = default;
ConicInteractionLoop::~ConicInteractionLoop() = default;

std::string ConicInteractionLoop::getClassName() const { return "ConicInteractionLoop"; }
std::string ConicInteractionLoop::getBaseClassName(unsigned int index) const
{
    return index == 0 ? "InteractionLoop" : "";
}

void ConicInteractionLoop::pyRegisterClass(py::object scope)
{
    checkPyClassRegistersItself("ConicInteractionLoop");
    const py::scope inside(scope);
    const auto style = docstringStyle();
    registerClass<ConicInteractionLoop, yade::InteractionLoop>("ConicInteractionLoop", doc);
}

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

BOOST_CLASS_EXPORT(potential_particles::ConicInteractionLoop)
