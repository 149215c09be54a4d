// SPDX-License-Identifier: GPL-3.0-or-later
//
// From the materials of two bodies to the physics of their joint.
#pragma once

#include "abi/archive.hpp"
#include "abi/functor.hpp"
#include "registration/class_table.hpp"

#include <boost/serialization/access.hpp>

namespace potential_particles {

class Ip2_ConicJointMat_ConicJointMat_ConicJointPhys final : public yade::IPhysFunctor {
public:
    ~Ip2_ConicJointMat_ConicJointMat_ConicJointPhys() override;
    PP_ABI_SERIALIZABLE_OVERRIDES

    std::string get2DFunctorType1() const override;
    std::string get2DFunctorType2() const override;
    std::string checkOrder() const override;

    void go(const boost::shared_ptr<yade::Material>& material1, const boost::shared_ptr<yade::Material>& material2,
            const boost::shared_ptr<yade::Interaction>& interaction) override;

    bool bonds = false;
    long cohesiveTresholdIteration = 1;

    template <class Visit> static void eachAttribute(Visit&& visit)
    {
        using Ip2 = Ip2_ConicJointMat_ConicJointMat_ConicJointPhys;
        visit("bonds", &Ip2::bonds, "Whether joints made before cohesiveTresholdIteration are bonded.", 1);
        visit("cohesiveTresholdIteration", &Ip2::cohesiveTresholdIteration,
              "Joints made before this step are whole; later ones have the residual values from the start.", 1);
    }

private:
    friend class boost::serialization::access;
    template <class Archive> void serialize(Archive& archive, unsigned);
};

} // namespace potential_particles
