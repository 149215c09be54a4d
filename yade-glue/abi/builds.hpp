// SPDX-License-Identifier: GPL-3.0-or-later
//
// In what the builds of YADE differ, as far as the classes declared here go. PP_YADE_VERSION is the version that CMake
// found, as year and number: 202302 for 2023.02a. A build without an entry of its own is taken to be like the last one
// before it: check_abi.py and load_check.cpp say whether it is.
#pragma once

#ifndef PP_YADE_VERSION
#error "compile with -DPP_YADE_VERSION=..., 202302 for YADE 2023.02a: it selects what abi/builds.hpp declares"
#endif

// Shape has a virtual function more, behind those of Serializable.
#define PP_YADE_SHAPE_HAS_VOLUME (PP_YADE_VERSION >= 202601)

// FrictPhys has a number more, behind its tangent.
#define PP_YADE_FRICT_PHYS_EXTRA (PP_YADE_VERSION >= 202601)

// Whether Law2_ScGeom_FrictPhys_CundallStrack and Law2_SCG_KnKsPhys_KnKsLaw compute what a contact loop of ours
// computes in their place. Those of 2026 were not compared.
#define PP_YADE_LAWS_ARE_KNOWN (PP_YADE_VERSION < 202601)

namespace yade {

// What these add to the bytes before KnKsPhys' own fields, and to the words of a shape's virtual table.
constexpr int frictPhysExtraBytes = PP_YADE_FRICT_PHYS_EXTRA ? 8 : 0;
constexpr int shapeExtraSlots = PP_YADE_SHAPE_HAS_VOLUME ? 1 : 0;

} // namespace yade
