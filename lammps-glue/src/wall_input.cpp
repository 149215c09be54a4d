// SPDX-License-Identifier: GPL-2.0-or-later
//
// What a script says of a wall.
#include "fix_wall.hpp"
#include "joint_words.hpp"
#include "text_file.hpp"

#include "atom.h"
#include "error.h"
#include "utils.h"

#include <cmath>
#include <cstring>

using namespace LAMMPS_NS;
using Eigen::Vector3d;

namespace potential_particles {
namespace {

constexpr const char* expected
    = "expected KN KS FRICTION RESTITUTION, then plane X Y Z NX NY NZ, stl FILE, scale S, flat EPS, linear VX VY VZ, rotate X Y Z AX AY AZ PERIOD, or "
      "patch TOL and with it cohesion C, residual FRICTION COHESION, whole STEP";

} // namespace

FixWall::FixWall(LAMMPS* lmp, int count, char** arguments)
    : Fix(lmp, count, arguments)
{
    restart_peratom = restart_global = create_attribute = 1;
    maxexchange_dynamic = 1;
    vector_flag = extvector = global_freq = 1;
    size_vector = sums;
    if (count < 7)
        error->all(FLERR, "{}: {}", style, expected);
    pp_settings_default(&how);
    law = readLaw(lmp, style, arguments, 3);
    joint = jointOf(law);
    bool hasStrength = false;
    double scale = 1;
    for (int i = 7; i < count;) {
        const auto threeAt = [&](int at, const char* what) {
            return Vector3d(numberAt(arguments, at, what), numberAt(arguments, at + 1, what), numberAt(arguments, at + 2, what));
        };
        const auto is = [&](const char* word, int values) { return !strcmp(arguments[i], word) && i + values < count; };
        if (is("plane", 6)) {
            planes.push_back({ threeAt(i + 1, "plane"), threeAt(i + 4, "plane") });
            if (!(planes.back().normal.norm() > 0))
                error->all(FLERR, "{}: plane {} has a normal of length 0", style, planes.size());
            planes.back().normal.normalize();
            i += 7;
        } else if (is("stl", 1)) {
            file = arguments[i + 1];
            i += 2;
        } else if (is("scale", 1)) {
            scale = numberAt(arguments, i + 1, "scale");
            if (!(scale > 0))
                error->all(FLERR, "{}: scale = {}: it must be above 0", style, scale);
            i += 2;
        } else if (is("flat", 1)) {
            how.flat_regularisation = numberAt(arguments, i + 1, "flat");
            if (!(how.flat_regularisation >= 0 && how.flat_regularisation <= 0.1))
                error->all(FLERR, "{}: flat = {}: it must lie in [0, 0.1]", style, arguments[i + 1]);
            i += 2;
        } else if (is("linear", 3)) {
            linear = threeAt(i + 1, "linear");
            i += 4;
        } else if (is("rotate", 7)) {
            centre = threeAt(i + 1, "rotate");
            axis = threeAt(i + 4, "rotate");
            const double period = numberAt(arguments, i + 7, "period");
            if (!(axis.norm() > 0) || period == 0)
                error->all(FLERR, "{}: rotate needs an axis of some length and a period other than 0", style);
            axis.normalize();
            rate = 2 * M_PI / period;
            i += 8;
        } else if (is("patch", 1)) {
            patchTolerance = numberAt(arguments, i + 1, "patch");
            if (!(patchTolerance >= 1e-12 && patchTolerance <= 0.1))
                error->all(FLERR, "{}: patch = {}: the relative error of a patch must lie in [1e-12, 0.1]; 1e-4 is a good choice", style, arguments[i + 1]);
            byPatch = true;
            i += 2;
        } else if (is("whole", 1)) {
            wholeBefore = utils::bnumeric(FLERR, arguments[i + 1], false, lmp);
            hasStrength = true;
            i += 2;
        } else if (!strcmp(arguments[i], "tension") || !strcmp(arguments[i], "softening"))
            error->all(FLERR, "{}: '{}': walls make no bonds; give cohesion alone, or make the wall of bodies that do not move", style, arguments[i]);
        else if (const int taken = readStrength(lmp, style, arguments, i, count, joint)) {
            hasStrength = true;
            i += taken;
        } else
            error->all(FLERR, "{}: '{}': {}", style, arguments[i], expected);
    }
    if (hasStrength && !byPatch)
        error->all(FLERR, "{}: strength is for contacts by patch: add 'patch 1e-4'", style);
    if (!file.empty()) {
        try {
            mesh = std::make_unique<Mesh>(fileForAll(lmp, file), file, scale);
        } catch (const std::runtime_error& refused) {
            error->all(FLERR, std::string(refused.what()));
        }
    }
    if (planes.empty() && !mesh)
        error->all(FLERR, "{}: there is no wall: give plane or stl", style);
    start = lastTime = timeNow();
    grow_arrays(atom->nmax);
    atom->add_callback(Atom::GROW);
    atom->add_callback(Atom::RESTART);
}

double FixWall::numberAt(char** arguments, int i, const char* what) const
{
    const double value = utils::numeric(FLERR, arguments[i], false, lmp);
    if (!std::isfinite(value))
        error->all(FLERR, "{}: {} = {}: it must be finite", style, what, arguments[i]);
    return value;
}

} // namespace potential_particles
