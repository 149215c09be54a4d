// SPDX-License-Identifier: GPL-3.0-or-later
//
// Makes our classes known to YADE.
#pragma once

namespace potential_particles {

// To YADE's factory, class table and Python module yade.wrapper. Throws std::runtime_error when a
// name is taken.
void registerClasses();

// In the order in which bases come before what derives from them.
constexpr const char* classNames[]
    = { "ConicPotentialParticle", "ScGeomConicPP",     "Ig2_ConicPP_ConicPP_ScGeom", "Ig2_PP_PP_ScGeom_Conic",
        "Bo1_ConicPP_Aabb",       "Bo1_PP_Aabb_Conic", "BoundWatch",
        "ConicInteractionLoop",
        "Ig2_Sphere_ConicPP_ScGeom", "Ig2_Box_ConicPP_ScGeom", "Ig2_Wall_ConicPP_ScGeom", "Ig2_Facet_ConicPP_ScGeom",
        "Gl1_PotentialParticle_Conic" };

} // namespace potential_particles
