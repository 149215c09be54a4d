// SPDX-License-Identifier: GPL-2.0-or-later
//
// What scripts say of the pair style, and what is needed before a run.
#include "pair_potential_particle.hpp"
#include "entered.hpp"
#include "fix_nve.hpp"
#include "fix_shapes.hpp"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "force.h"
#include "modify.h"
#include "neighbor.h"
#include "update.h"
#include "utils.h"

#include <algorithm>
#include <cmath>
#include <cstring>

using namespace LAMMPS_NS;

namespace potential_particles {
namespace {

    constexpr const char* coefficients = "pair_coeff of potential/particle";
    constexpr const char* options = "expected carry TOL, flat EPS, closest, threads N, failures stop or count, patch "
                                    "TOL, whole STEP, bonds yes or no";

} // namespace

void PairPotentialParticle::settings(int count, char** arguments)
{
    pp_settings_default(&how);
    how.carry_tolerance = 1e-9;
    threads = 1;
    stopAtFailure = true;
    const bool known = byPatch, first = !memory_; // the same on all ranks
    byPatch = makesBonds = false;
    patchTolerance = 1e-4;
    wholeBefore = 1;
    bool hasStrengthWords = false;
    for (int i = 0; i < count; ++i) {
        const std::string word = arguments[i];
        if (word == "closest") {
            how.formulation = PP_CLOSEST;
            continue;
        }
        if (++i == count)
            error->all(FLERR, "{}: '{}' is no option, or its value is missing: {}", style, word, options);
        const auto tolerance = [&] { return numberIn(lmp, style, word, arguments[i], 0, 0.1); };
        if (word == "carry")
            how.carry_tolerance = tolerance();
        else if (word == "flat")
            how.flat_regularisation = tolerance();
        else if (word == "threads") {
            const int value = utils::inumeric(FLERR, arguments[i], false, lmp);
            if (value < 1 || value > 256)
                error->all(FLERR, "{}: threads = {}: it must lie in [1, 256]", style, value);
            threads = static_cast<uint32_t>(value);
        } else if (word == "failures" && (!strcmp(arguments[i], "stop") || !strcmp(arguments[i], "count")))
            stopAtFailure = !strcmp(arguments[i], "stop");
        else if (word == "patch") {
            patchTolerance = readPatchTolerance(lmp, style, arguments[i]);
            byPatch = true;
        } else if (word == "whole") {
            wholeBefore = utils::bnumeric(FLERR, arguments[i], false, lmp);
            hasStrengthWords = true;
        } else if (word == "bonds" && (!strcmp(arguments[i], "yes") || !strcmp(arguments[i], "no"))) {
            makesBonds = !strcmp(arguments[i], "yes");
            hasStrengthWords = true;
        } else
            error->all(FLERR, "{}: '{} {}': {}", style, word, arguments[i], options);
    }
    if (hasStrengthWords && !byPatch)
        error->all(FLERR, "{}: whole and bonds are for contacts by patch: add 'patch 1e-4', or leave them out", style);
    if (known != byPatch && !first)
        error->all(
            FLERR,
            "{}: contacts that there are cannot change between point and patch: give pair_style before the first run",
            style);
}

void PairPotentialParticle::coeff(int count, char** arguments)
{
    if (count < 6)
        error->all(FLERR, "{}: expected I J KN KS FRICTION RESTITUTION, {} values were given", coefficients, count);
    if (!allocated)
        allocate();
    int lowI, highI, lowJ, highJ;
    utils::bounds(FLERR, arguments[0], 1, atom->ntypes, lowI, highI, error);
    utils::bounds(FLERR, arguments[1], 1, atom->ntypes, lowJ, highJ, error);
    const LawParameters law = readLaw(lmp, coefficients, arguments, 2);
    JointParameters joint = jointOf(law);
    for (int i = 6; i < count;) {
        const int taken = byPatch ? readStrength(lmp, coefficients, arguments, i, count, joint) : 0;
        if (!taken)
            error->all(FLERR, "{}: '{}': {}", coefficients, arguments[i],
                       byPatch ? std::string("expected ") + strengthWords
                               : "strength is for contacts by patch: pair_style potential/particle patch 1e-4");
        i += taken;
    }
    for (int i = lowI; i <= highI; ++i)
        for (int j = std::max(lowJ, i); j <= highJ; ++j) {
            laws[i * (atom->ntypes + 1) + j] = laws[j * (atom->ntypes + 1) + i] = law;
            jointLaws[i * (atom->ntypes + 1) + j] = jointLaws[j * (atom->ntypes + 1) + i] = joint;
            setflag[i][j] = 1;
        }
    checkedStep = -1;
}

void PairPotentialParticle::init_style()
{
    if (force->newton_pair)
        error->all(FLERR,
                   "{}: it needs 'newton off' (or 'newton off on'), before the box is made: each rank that has a body "
                   "of a pair keeps its history",
                   style);
    if (!comm->ghost_velocity)
        error->all(FLERR, "{}: it needs velocities of ghosts: give 'comm_modify vel yes'", style);
    if (!atom->tag_enable)
        error->all(FLERR, "{}: it needs atom IDs: leave out 'atom_modify id no'", style);
    shapes = FixShapes::of(lmp, style);
    const auto memories = modify->get_fix_by_style("^potential/particle/memory$");
    memory_ = static_cast<ContactMemory*>(
        memories.empty() ? modify->add_fix(fmt::format("{} all potential/particle/memory", memoryId))
                         : memories.front());
    memory_->attach(this);
    moving = FixNve::groups(lmp);
    checkedStep = -1;
    neighbor->add_request(this);
}

double PairPotentialParticle::init_one(int i, int j)
{
    if (!setflag[i][j])
        error->all(FLERR,
                   "{}: types {} and {} have no coefficients: give 'pair_coeff {} {} KN KS FRICTION RESTITUTION'",
                   style, i, j, i, j);
    return shapes->shape(i).radius + shapes->shape(j).radius;
}

// Two bodies on one spring are no slower than this, whatever the levers. Of a patch the area is not known before there
// is one.
void PairPotentialParticle::checkTimeSteps()
{
    if (checkedStep == update->dt)
        return;
    checkedStep = update->dt;
    for (int i = 1; !byPatch && i <= atom->ntypes; ++i)
        for (int j = i; j <= atom->ntypes; ++j) {
            const double massA = shapes->massOf(i), massB = shapes->massOf(j);
            const double most
                = 2 * std::sqrt(massA * massB / (massA + massB) / laws[i * (atom->ntypes + 1) + j].stiffest());
            if (update->dt > most)
                error->all(FLERR,
                           "{}: timestep = {}: a contact of types {} and {} is unstable above {}, and with levers well "
                           "below: take {} or less",
                           style, update->dt, i, j, most, 0.1 * most);
        }
}

} // namespace potential_particles
