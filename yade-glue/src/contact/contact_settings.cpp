// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact_settings.hpp"
#include "particle/particle.hpp"

#include <cmath>
#include <sstream>
#include <stdexcept>

namespace potential_particles {

namespace {

    [[noreturn]] void refuse(const char* attribute, const std::string& value, const std::string& remedy)
    {
        throw std::invalid_argument(std::string(attribute) + " = " + value + ": " + remedy);
    }

    std::string shown(double value)
    {
        std::ostringstream text;
        text.precision(17);
        text << value;
        return text.str();
    }

    // Two overlapping unit spheres, to ask the library itself whether it accepts a setting: it decides, and
    // the messages below only name its ranges. (Whether it also finds this contact does not matter here.)
    class Trial {
    public:
        Trial() { requireOk(pp_particle_new(nullptr, 0, 1, 1, 1, &sphere, nullptr, 0)); }
        ~Trial() { pp_particle_free(sphere); }
        Trial(const Trial&) = delete;
        Trial& operator=(const Trial&) = delete;

        pp_status status(const pp_settings& settings)
        {
            return pp_contact_detect(sphere, &left, sphere, &right, &settings, nullptr, &found);
        }
        bool accepts(const pp_settings& settings) { return status(settings) != PP_BAD_SETTING; }
        bool acceptsForArea(double tolerance)
        {
            requireOk(pp_contact_detect(sphere, &left, sphere, &right, nullptr, nullptr, &found));
            double area;
            return pp_contact_area(sphere, &left, sphere, &right, &found, tolerance, &area) != PP_BAD_SETTING;
        }

        bool acceptsForPatch(double tolerance)
        {
            requireOk(pp_contact_detect(sphere, &left, sphere, &right, nullptr, nullptr, &found));
            pp_patch patch;
            return pp_patch_of_contact(sphere, &left, sphere, &right, &found, tolerance, 0, nullptr, &patch, nullptr, 0,
                                       nullptr)
                != PP_BAD_SETTING;
        }

    private:
        static constexpr pp_pose left = { { 0, 0, 0 }, { 1, 0, 0, 0 } };
        static constexpr pp_pose right = { { 1.5, 0, 0 }, { 1, 0, 0, 0 } };
        pp_particle* sphere = nullptr;
        pp_contact found;
    };

    pp_settings defaults()
    {
        pp_settings settings;
        requireOk(pp_settings_default(&settings));
        return settings;
    }

} // namespace

ContactSettings::ContactSettings()
    : tolerance(defaults().gap_tolerance)
    , flatRegularisation(defaults().flat_regularisation)
{
}

pp_settings ContactSettings::parsed() const
{
    pp_settings settings = defaults();
    Trial trial;

    if (formulation == "midway")
        settings.formulation = PP_MIDWAY;
    else if (formulation == "closest")
        settings.formulation = PP_CLOSEST;
    else
        refuse("formulation", "'" + formulation + "'", "choose 'midway' or 'closest'");

    if (backEnd == "fast")
        settings.back_end = PP_FAST;
    else if (backEnd == "cone_program")
        settings.back_end = PP_CONE_PROGRAM;
    else if (backEnd == "conic")
        refuse("backEnd", "'conic'", "it is called 'cone_program' now");
    else
        refuse("backEnd", "'" + backEnd + "'", "choose 'fast' or 'cone_program'");
    if (trial.status(settings) == PP_NO_CONE_PROGRAM)
        refuse("backEnd", "'cone_program'", pp_status_message(PP_NO_CONE_PROGRAM));

    settings.gap_tolerance = tolerance;
    if (!trial.accepts(settings))
        refuse("tolerance", shown(tolerance), "it must lie in (0, 0.1]");
    settings.flat_regularisation = flatRegularisation;
    if (!trial.accepts(settings))
        refuse("flatRegularisation", shown(flatRegularisation), "it must lie in [0, 0.1]");
    settings.carry_tolerance = carryTolerance;
    if (!trial.accepts(settings))
        refuse("carryTolerance", shown(carryTolerance), "it must lie in [0, 0.1]");
    if (!trial.acceptsForArea(areaTolerance))
        refuse("areaTolerance", shown(areaTolerance), "it must lie in [1e-12, 0.1]");
    if (!trial.acceptsForPatch(patchTolerance))
        refuse("patchTolerance", shown(patchTolerance), "it must lie in [1e-12, 0.1]");
    if (patch && twoDimension)
        refuse("patch", "True", "with twoDimension the contact area is a width: choose one of them");

    if (!(std::isfinite(interactionDistance) && interactionDistance >= 0))
        refuse("interactionDistance", shown(interactionDistance), "give a length, or 0");
    if (patch && seesGaps())
        refuse("patch", "True",
               "a patch ends where bodies come apart: rotations and interactionDistance are for laws at a point, "
               "joints have bonds of their own");
    if (!(std::isfinite(unitWidth2D) && unitWidth2D > 0))
        refuse("unitWidth2D", shown(unitWidth2D), "give a positive length");
    if (!(twoDdir.allFinite() && !twoDdir.isZero(0)))
        refuse("twoDdir", "(" + shown(twoDdir.x()) + ", " + shown(twoDdir.y()) + ", " + shown(twoDdir.z()) + ")",
               "give a vector with a direction");
    return settings;
}

} // namespace potential_particles
