// SPDX-License-Identifier: GPL-2.0-or-later
//
// What contacts with a wall remember, as atoms migrate and restart.
#include "fix_wall.hpp"
#include "mark.hpp"

#include "atom.h"
#include "comm.h"
#include "error.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <iterator>

using namespace LAMMPS_NS;
using Eigen::Vector3d;

namespace potential_particles {
namespace {

    constexpr const char* otherwise = "another ID, for a wall whose contacts begin anew";

} // namespace

int FixWall::touching(int i) const
{
    return static_cast<int>(
        std::count_if(around[i].known.begin(), around[i].known.end(), [](const Known& one) { return one.touches; }));
}

double FixWall::compute_vector(int n)
{
    if (n == elastic) {
        for (const WallPatch& one : withoutEnergy)
            own[elastic]
                += joint.normalStiffness * one.kept->energy([&](auto... how) { return findPatch(one, how...); });
        withoutEnergy.clear();
    }
    double all = 0;
    MPI_Allreduce(&own[n], &all, 1, MPI_DOUBLE, MPI_SUM, world);
    return all;
}

int FixWall::pack(int i, double* buffer) const
{
    double* to = buffer;
    *to++ = touching(i);
    *to++ = around[i].mark;
    for (const Known& one : around[i].known) {
        if (!one.touches)
            continue;
        *to++ = one.element;
        if (byPatch)
            to = writeNumbers(one.joint, to);
        else
            for (const Vector3d* part : { &one.history.shear, &one.history.normal, &one.history.damping })
                to = std::copy(part->data(), part->data() + 3, to);
    }
    return static_cast<int>(to - buffer);
}

int FixWall::unpack(int i, const double* buffer)
{
    const double* from = buffer;
    around[i] = {};
    around[i].known.resize(static_cast<size_t>(*from++));
    around[i].mark = *from++;
    for (Known& one : around[i].known) {
        one.element = static_cast<int>(*from++);
        one.touches = true;
        if (byPatch) {
            one.joint = readNumbers(from);
            from += countOfNumbers(one.joint);
            continue;
        }
        one.history.touching = true;
        for (Vector3d* part : { &one.history.shear, &one.history.normal, &one.history.damping }) {
            *part = Vector3d(from);
            from += 3;
        }
    }
    return static_cast<int>(from - buffer);
}

double FixWall::mark() const
{
    Mark mark;
    for (const Plane& plane : planes) {
        mark.add(plane.point.data(), 3);
        mark.add(plane.normal.data(), 3);
    }
    if (mesh)
        mesh->addTo(mark);
    return mark.value();
}

std::array<double, 10> FixWall::motion() const
{
    std::array<double, 10> numbers;
    double* to = numbers.data();
    for (const Vector3d* part : { &linear, &centre, &axis })
        to = std::copy(part->data(), part->data() + 3, to);
    *to = rate;
    return numbers;
}

void FixWall::write_restart(FILE* out)
{
    Saved all { savedFormat, mark(), static_cast<double>(byPatch), {}, start, lastTime, 0, {} };
    const auto now = motion();
    std::copy(now.begin(), now.end(), all.motion);
    std::array<double, 1 + std::size(ofRun)> mine {};
    for (int i = 0; i < atom->nlocal; ++i)
        mine[0] += touching(i);
    std::transform(std::begin(ofRun), std::end(ofRun), mine.begin() + 1, [this](Sum sum) { return own[sum]; });
    MPI_Reduce(mine.data(), &all.contacts, static_cast<int>(mine.size()), MPI_DOUBLE, MPI_SUM, 0, world);
    writeSaved(out, all);
}

void FixWall::restart(char* saved)
{
    Saved all;
    std::memcpy(&all.format, saved, sizeof all.format);
    if (all.format != savedFormat)
        error->all(FLERR, "fix {} {}: the restart file is of another version of the plugin: {}", id, style, otherwise);
    std::memcpy(&all, saved, sizeof all);
    if (all.mark != mark())
        error->all(FLERR,
                   "fix {} {}: the restart file has a fix of this ID with other planes or triangles, or in another "
                   "order: give those, or {}",
                   id, style, otherwise);
    if (all.contacts > 0 && all.byPatch != byPatch)
        error->all(
            FLERR,
            "fix {} {}: the contacts of the restart file act {}: give the fix {} 'patch TOL' as when it was written",
            id, style, byPatch ? "in a point" : "on patches", byPatch ? "without" : "with");
    const auto isAtRest = [](const double* motion) {
        return motion[9] == 0 && std::all_of(motion, motion + 3, [](double x) { return x == 0; });
    };
    const auto now = motion();
    if (std::equal(now.begin(), now.end(), all.motion)) {
        start = all.start;
        lastTime = all.lastTime;
    } else if (!isAtRest(all.motion))
        error->all(FLERR,
                   "fix {} {}: the restart file has a fix of this ID with another linear or rotate, by which it has "
                   "moved: give those, or {}",
                   id, style, otherwise);
    for (size_t n = 0; comm->me == 0 && n < std::size(ofRun); ++n)
        own[ofRun[n]] = all.sums[n];
}

} // namespace potential_particles
