// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a user may set on the contact functor, and its form for the library.
#pragma once

#include "abi/base.hpp"

#include <potential_particles.h>

#include <string>

namespace potential_particles {

struct ContactSettings {
    ContactSettings();

    std::string formulation = "midway";
    std::string backEnd = "fast";
    double tolerance; // these two: the library's defaults
    double flatRegularisation;
    double carryTolerance = 1e-9;
    bool patch = false;
    double patchTolerance = 1e-4;
    bool calContactArea = true;
    double areaTolerance = 1e-6;
    bool twoDimension = false;
    yade::Vector3r twoDdir = yade::Vector3r::UnitY();
    double unitWidth2D = 1.0;
    // Of YADE's own functor, so that its keyword arguments are understood.
    int areaStep = 5;
    double accuracyTol = 1e-7;
    bool measureTime = false;
    double interactionDistance = 0.0;
    bool rotations = false;

    // Whether laws get the distance of a pair, not only that it is apart.
    bool seesGaps() const { return rotations || interactionDistance > 0; }

    // The settings for the library. Throws std::invalid_argument naming the attribute, its value
    // and what it may be.
    pp_settings parsed() const;

    // As of registration/attributes.hpp: a last number is the version of the class from which archives have it.
    template <class Visit> static void eachAttribute(Visit&& visit)
    {
        using S = ContactSettings;
        visit(
            "formulation", &S::formulation,
            "'midway' (the point that minimises the larger of both potentials, as Ig2_PP_PP_ScGeom does) or 'closest' "
            "(the deepest point of each particle in the other, paper eqs 34-43).");
        visit("backEnd", &S::backEnd,
              "'fast' (the library's own solver) or 'cone_program' (the second-order cone "
              "programs of the paper: slow, for comparison).");
        visit("tolerance", &S::tolerance, "Relative gap of the squared scale at which the solver may stop.");
        visit(
            "flatRegularisation", &S::flatRegularisation,
            "Smallest sphericity that the solver takes as given; below it, the contact point on a flat face is chosen "
            "as if k were this. Raise it (1e-4, say) when flat faces jitter.");
        visit("carryTolerance", &S::carryTolerance,
              "To what part of the smaller particle's size the point of a contact has to be known that is carried on "
              "from the "
              "last step without a solution from the planes; 0: every contact is solved in every step.",
              1);
        visit("patch", &S::patch,
              "Whether the contact patch decides: contactPoint is then its centre of pressure, normal the direction of "
              "the force of its "
              "pressure, penetrationDepth that force over stiffness and area, KnKsPhys.contactArea the area.",
              2);
        visit("patchTolerance", &S::patchTolerance, "Relative error allowed in the patch's force and area.", 2);
        visit("calContactArea", &S::calContactArea,
              "Whether KnKsPhys.contactArea is computed; otherwise it is 1 (with twoDimension: unitWidth2D).");
        visit("areaTolerance", &S::areaTolerance, "Relative error allowed in the contact area.");
        visit("twoDimension", &S::twoDimension, "Whether contactArea is a length in the plane times unitWidth2D.");
        visit("twoDdir", &S::twoDdir, "Normal of that plane.");
        visit("unitWidth2D", &S::unitWidth2D, "Width of a two-dimensional problem out of its plane.");
        visit("areaStep", &S::areaStep,
              "Accepted for scripts written for Ig2_PP_PP_ScGeom and not used: the area here is not sampled by angles. "
              "See areaTolerance.");
        visit("accuracyTol", &S::accuracyTol,
              "Accepted for scripts written for Ig2_PP_PP_ScGeom and not used. See tolerance.");
        visit("measureTime", &S::measureTime, "Whether the time inside this functor is added up in seconds.");
        visit("interactionDistance", &S::interactionDistance,
              "Particles whose gap along the normal is at most this interact, with penetrationDepth = -gap: for laws "
              "that hold them together. The collider "
              "must see such pairs (verletDist of half of it, with BoundWatch).",
              3);
        visit("rotations", &S::rotations,
              "Whether the geometry is YADE's ScGeom6D, with bending and twist, for laws that ask for it "
              "(Law2_ScGeom6D_...); penetrationDepth "
              "is then -gap of particles that have come apart. Pairs are solved from nothing in each step.",
              3);
    }
};

// One value of all settings, checked. Never changes, so threads may share it.
struct AcceptedSettings {
    // Throws as parsed() does.
    explicit AcceptedSettings(const ContactSettings& settings)
        : given(settings)
        , library(settings.parsed())
    {
    }

    const ContactSettings given;
    const pp_settings library;
};

} // namespace potential_particles
