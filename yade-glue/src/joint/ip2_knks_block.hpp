// SPDX-License-Identifier: GPL-3.0-or-later
//
// KnKsPhys from the materials of two bodies, with stiffnesses of its own at boundaries.
#pragma once

#include "abi/archive.hpp"
#include "abi/functor.hpp"
#include "registration/class_table.hpp"

namespace potential_particles {

class Ip2_FrictMat_FrictMat_KnKsPhys_Block final : public yade::IPhysFunctor {
public:
    ~Ip2_FrictMat_FrictMat_KnKsPhys_Block() override;
    PP_ABI_SERIALIZABLE_OVERRIDES

    PP_FUNCTOR_2D_TYPES

    void go(const boost::shared_ptr<yade::Material>& material1, const boost::shared_ptr<yade::Material>& material2,
            const boost::shared_ptr<yade::Interaction>& interaction) override;

    double Knormal = 0, Kshear = 0, kn_i = 0, ks_i = 0;
    double viscousDamping = 0;
    double cohesion = 0, tension = 0;
    bool cohesionBroken = true, tensionBroken = true;
    double phi_b = 0;
    bool useFaceProperties = false;

    template <class Visit> static void eachAttribute(Visit&& visit)
    {
        using Ip2 = Ip2_FrictMat_FrictMat_KnKsPhys_Block;
        visit("Knormal", &Ip2::Knormal, "Normal stiffness per area, stress over length.");
        visit("Kshear", &Ip2::Kshear, "Shear stiffness per area, stress over length.");
        visit("kn_i", &Ip2::kn_i, "Knormal of contacts in which a body has isBoundary.");
        visit("ks_i", &Ip2::ks_i, "Kshear of contacts in which a body has isBoundary.");
        visit("viscousDamping", &Ip2::viscousDamping, "Share of the critical damping along the normal.");
        visit("cohesion", &Ip2::cohesion, "Cohesion, stress; counts where the law finds KnKsPhys.intactRock.");
        visit("tension", &Ip2::tension, "Tensile strength, stress; counts where tensionBroken is False.");
        visit("cohesionBroken", &Ip2::cohesionBroken, "Whether contacts begin without cohesion.");
        visit("tensionBroken", &Ip2::tensionBroken, "Whether contacts begin without tensile strength.");
        visit("phi_b", &Ip2::phi_b,
              "Accepted; without properties of faces the friction angle is that of the materials.");
        visit("useFaceProperties", &Ip2::useFaceProperties,
              "False: shapes have no properties of faces. potential_particles.rock.joint_engine gives contacts those "
              "of their joint.");
    }

private:
    PP_ARCHIVED
};

} // namespace potential_particles
