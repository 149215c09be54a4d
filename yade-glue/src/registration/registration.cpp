// SPDX-License-Identifier: GPL-3.0-or-later
#include "registration.hpp"

#include "abi/registry.hpp"

#include "class_table.hpp"
#include "joint/conic_joint_mat.hpp"
#include "joint/conic_joint_phys.hpp"
#include "shape/conic_potential_particle.hpp"

namespace potential_particles {

void registerClasses()
{
    // Their class indices must exist before any dispatcher sizes its table.
    const ConicPotentialParticle shape;
    const ConicJointMat material;
    const ConicJointPhys physics;

#define PP_CLASS(Name, Base, First, Second, Version, Doc) enterInFactory<Name>();
#include "class_table.inc"

    // The list of plugins is read once, when YADE starts; this enters classes later than that.
    std::vector<std::string> names;
#define PP_CLASS(Name, Base, First, Second, Version, Doc) names.push_back(#Name);
#include "class_table.inc"
    Singleton<yade::Omega>::instance().buildDynlibDatabase(names);
}

} // namespace potential_particles
