// SPDX-License-Identifier: GPL-3.0-or-later
#include "registration.hpp"

#include "abi/registry.hpp"

#include "bounds/bo1_conic_pp_aabb.hpp"
#include "bounds/bound_watch.hpp"
#include "loop/conic_interaction_loop.hpp"
#include "shape/conic_potential_particle.hpp"
#include "drawing/gl1_potential_particle_conic.hpp"
#include "contact/ig2_flat_conic_pp.hpp"
#include "contact/ig2_other_conic_pp.hpp"
#include "pair/sc_geom_conic_pp.hpp"

#include <boost/shared_ptr.hpp>

#include <iterator>
#include <stdexcept>

namespace potential_particles {

namespace {

    template <class Class> void registerWithFactory(const char* name)
    {
        using yade::Factorable;
        const bool added = Singleton<yade::ClassFactory>::instance().registerFactorable(
            name, []() -> Factorable* { return new Class; },
            []() -> boost::shared_ptr<Factorable> { return boost::shared_ptr<Class>(new Class); },
            []() -> void* { return new Class; });
        if (!added)
            throw std::runtime_error(std::string("YADE already has a class ") + name
                                     + ": is potential_particles loaded from two places?");
    }

} // namespace

void registerClasses()
{
    // The shape's class index must exist before any dispatcher sizes its table.
    const ConicPotentialParticle indexed;

    registerWithFactory<ConicPotentialParticle>(classNames[0]);
    registerWithFactory<ScGeomConicPP>(classNames[1]);
    registerWithFactory<Ig2_ConicPP_ConicPP_ScGeom>(classNames[2]);
    registerWithFactory<Ig2_PP_PP_ScGeom_Conic>(classNames[3]);
    registerWithFactory<Bo1_ConicPP_Aabb>(classNames[4]);
    registerWithFactory<Bo1_PP_Aabb_Conic>(classNames[5]);
    registerWithFactory<BoundWatch>(classNames[6]);
    registerWithFactory<ConicInteractionLoop>(classNames[7]);
    registerWithFactory<Ig2_Sphere_ConicPP_ScGeom>(classNames[8]);
    registerWithFactory<Ig2_Box_ConicPP_ScGeom>(classNames[9]);
    registerWithFactory<Ig2_Wall_ConicPP_ScGeom>(classNames[10]);
    registerWithFactory<Ig2_Facet_ConicPP_ScGeom>(classNames[11]);
    registerWithFactory<Gl1_PotentialParticle_Conic>(classNames[12]);

    // The list of plugins is read once, when YADE starts; this enters classes later than that.
    Singleton<yade::Omega>::instance().buildDynlibDatabase({ std::begin(classNames), std::end(classNames) });
}

} // namespace potential_particles
