// SPDX-License-Identifier: GPL-3.0-or-later
//
// The version of each of our classes in archives: the one that is written, and the newest that can be read.
#pragma once

#include <stdexcept>
#include <string>

#include <boost/serialization/version.hpp>

namespace potential_particles {

class ConicPotentialParticle;
class ScGeomConicPP;
class Ig2_ConicPP_ConicPP_ScGeom;
class Ig2_PP_PP_ScGeom_Conic;
class Ig2_Sphere_ConicPP_ScGeom;
class Ig2_Box_ConicPP_ScGeom;
class Ig2_Wall_ConicPP_ScGeom;
class Ig2_Facet_ConicPP_ScGeom;
class Bo1_ConicPP_Aabb;
class Bo1_PP_Aabb_Conic;
class BoundWatch;
class ConicInteractionLoop;

} // namespace potential_particles

// Who changes what serialize() of a class writes raises its version here and reads the older ones on. Every version that was ever
// written has a file in tests/yade/data.
BOOST_CLASS_VERSION(potential_particles::ConicPotentialParticle, 0)
BOOST_CLASS_VERSION(potential_particles::ScGeomConicPP, 1) // 0: a memory of 8 numbers
BOOST_CLASS_VERSION(potential_particles::Ig2_ConicPP_ConicPP_ScGeom, 1) // 0: without carryTolerance
BOOST_CLASS_VERSION(potential_particles::Ig2_PP_PP_ScGeom_Conic, 0)
BOOST_CLASS_VERSION(potential_particles::Ig2_Sphere_ConicPP_ScGeom, 0)
BOOST_CLASS_VERSION(potential_particles::Ig2_Box_ConicPP_ScGeom, 0)
BOOST_CLASS_VERSION(potential_particles::Ig2_Wall_ConicPP_ScGeom, 0)
BOOST_CLASS_VERSION(potential_particles::Ig2_Facet_ConicPP_ScGeom, 0)
BOOST_CLASS_VERSION(potential_particles::Bo1_ConicPP_Aabb, 0)
BOOST_CLASS_VERSION(potential_particles::Bo1_PP_Aabb_Conic, 0)
BOOST_CLASS_VERSION(potential_particles::BoundWatch, 0)
BOOST_CLASS_VERSION(potential_particles::ConicInteractionLoop, 0)

namespace potential_particles {

// Call first in serialize(): Boost itself hands over what it reads, however new, and it would be misread.
template <class Class> void requireReadable(unsigned version)
{
    constexpr unsigned newest = boost::serialization::version<Class>::value;
    if (version > newest)
        throw std::runtime_error("the file holds " + Class().getClassName() + " of version " + std::to_string(version)
                                 + ", and this potential_particles reads versions up to " + std::to_string(newest)
                                 + ": load it with the newer potential_particles that saved it");
}

} // namespace potential_particles
