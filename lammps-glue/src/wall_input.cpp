// SPDX-License-Identifier: GPL-2.0-or-later
//
// What a script says of a wall.
#include "fix_wall.hpp"
#include "entered.hpp"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "utils.h"

#include <cmath>
#include <cstring>
#include <set>

using namespace LAMMPS_NS;
using Eigen::Vector3d;

namespace potential_particles {
namespace {

    constexpr const char* expected
        = "expected KN KS FRICTION RESTITUTION, then plane X Y Z NX NY NZ, stl FILE, scale S, "
          "flat EPS, linear VX VY VZ, rotate X Y Z AX AY AZ PERIOD, or "
          "patch TOL and with it cohesion C, residual FRICTION COHESION, whole STEP";

} // namespace

FixWall::FixWall(LAMMPS* lmp, int count, char** arguments)
    : CarryingFix(lmp, count, arguments)
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
    std::string file;
    std::set<std::string> given;
    for (int i = 7; i < count;) {
        const auto threeAt = [&](int at, const char* what) {
            return Vector3d(numberIn(lmp, style, what, arguments[at]), numberIn(lmp, style, what, arguments[at + 1]),
                            numberIn(lmp, style, what, arguments[at + 2]));
        };
        const auto directionAt = [&](int at, const char* what) {
            const Vector3d direction = threeAt(at, what);
            if (direction.isZero(0))
                error->all(FLERR, "{}: {} has a direction of length 0: give a vector of any other length", style, what);
            return Vector3d(direction.stableNormalized());
        };
        const auto is = [&](const char* word, int values) { return !strcmp(arguments[i], word) && i + values < count; };
        if (const std::string word = arguments[i]; word != "plane" && !given.insert(word).second)
            error->all(FLERR, "{}: '{}' is given twice: a wall has one of each, and any number of planes", style, word);
        if (is("plane", 6)) {
            planes.push_back({ threeAt(i + 1, "plane"), directionAt(i + 4, "plane") });
            i += 7;
        } else if (is("stl", 1)) {
            file = arguments[i + 1];
            i += 2;
        } else if (is("scale", 1)) {
            scale = numberIn(lmp, style, "scale", arguments[i + 1], 1 / bearable);
            i += 2;
        } else if (is("flat", 1)) {
            how.flat_regularisation = numberIn(lmp, style, "flat", arguments[i + 1], 0, 0.1);
            i += 2;
        } else if (is("linear", 3)) {
            linear = threeAt(i + 1, "linear");
            i += 4;
        } else if (is("rotate", 7)) {
            centre = threeAt(i + 1, "rotate");
            axis = directionAt(i + 4, "rotate");
            const double period = numberIn(lmp, style, "period", arguments[i + 7]);
            if (std::abs(period) < 1 / bearable)
                error->all(FLERR, "{}: period = {}: it must not lie in (-1e-100, 1e-100)", style, arguments[i + 7]);
            rate = 2 * M_PI / period;
            i += 8;
        } else if (is("patch", 1)) {
            patchTolerance = readPatchTolerance(lmp, style, arguments[i + 1]);
            byPatch = true;
            i += 2;
        } else if (is("whole", 1)) {
            wholeBefore = utils::bnumeric(FLERR, arguments[i + 1], false, lmp);
            hasStrength = true;
            i += 2;
        } else if (!strcmp(arguments[i], "tension") || !strcmp(arguments[i], "softening"))
            error->all(
                FLERR,
                "{}: '{}': walls make no bonds; give cohesion alone, or make the wall of bodies that do not move",
                style, arguments[i]);
        else if (const int taken = readStrength(lmp, style, arguments, i, count, joint)) {
            hasStrength = true;
            i += taken;
        } else
            error->all(FLERR, "{}: '{}': {}", style, arguments[i], expected);
    }
    if (hasStrength && !byPatch)
        error->all(FLERR, "{}: strength is for contacts by patch: add 'patch 1e-4'", style);
    if (given.count("scale") && !given.count("stl"))
        error->all(FLERR, "{}: scale is for a mesh: add 'stl FILE', or leave it out", style);
    if (given.count("stl")) {
        try {
            mesh = std::make_unique<Mesh>(fileForAll(lmp, file), file, scale);
        } catch (const std::runtime_error& refused) {
            error->all(FLERR, std::string(refused.what()));
        }
        if (mesh->repeated() > 0 && comm->me == 0)
            error->warning(FLERR, "{}: {} of the triangles of {} have the corners of another one, and are left out",
                           style, mesh->repeated(), file);
    }
    if (planes.empty() && !mesh)
        error->all(FLERR, "{}: there is no wall: give plane or stl", style);
    start = lastTime = timeNow();
    grow_arrays(atom->nmax);
    atom->add_callback(Atom::GROW);
    atom->add_callback(Atom::RESTART);
}

} // namespace potential_particles
