// SPDX-License-Identifier: GPL-3.0-or-later
//
// The law of joints in YADE: forces and moments of a contact patch, as plugin-common has them.
#pragma once

#include "abi/archive.hpp"
#include "abi/functor.hpp"
#include "registration/class_table.hpp"

namespace potential_particles {

struct BodyPush;
struct JointEnergies;

// go() runs in many threads at once.
class Law2_ScGeomConicPP_ConicJointPhys final : public yade::LawFunctor {
public:
    ~Law2_ScGeomConicPP_ConicJointPhys() override;
    PP_ABI_SERIALIZABLE_OVERRIDES

    PP_FUNCTOR_2D_TYPES

    bool go(boost::shared_ptr<yade::IGeom>& geometry, boost::shared_ptr<yade::IPhys>& physics,
            yade::Interaction* interaction) override;
    // The same; what it does to the bodies goes there and not to the scene, if given: one push a body, or none.
    bool act(yade::IGeom& geometry, yade::IPhys& physics, const yade::Interaction& interaction, BodyPush* onFirst,
             BodyPush* onSecond);

    bool neverErase = false;

    template <class Visit> static void eachAttribute(Visit&& visit)
    {
        visit("neverErase", &Law2_ScGeomConicPP_ConicJointPhys::neverErase,
              "Whether a contact that opens is kept, without force, and with what it remembers.");
    }

private:
    PP_ARCHIVED

    void track(const JointEnergies& energies);

    // Where the scene's tracker keeps them; each thread finds the same.
    int elasticNumber = -1, frictionNumber = -1, viscousNumber = -1, areaNumber = -1, breakingNumber = -1;
};

} // namespace potential_particles
