// SPDX-License-Identifier: GPL-2.0-or-later
//
// What contacts with a wall remember, as atoms migrate and restart.
#include "fix_wall.hpp"

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

int FixWall::touching(int i) const
{
    return static_cast<int>(std::count_if(around[i].known.begin(), around[i].known.end(), [](const Known& one) { return one.touches; }));
}

double FixWall::compute_vector(int n)
{
    double all = 0;
    MPI_Allreduce(&own[n], &all, 1, MPI_DOUBLE, MPI_SUM, world);
    return all;
}

int FixWall::pack(int i, double* buffer) const
{
    double* to = buffer;
    *to++ = touching(i);
    *to++ = savedSize();
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
    if (const int size = static_cast<int>(*from++); size != savedSize() && !around[i].known.empty())
        error->one(FLERR, "{}: the contacts of the restart file act {}: give the fix {} 'patch TOL' as when it was written", style,
            byPatch ? "in a point" : "on patches", byPatch ? "without" : "with");
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

int FixWall::pack_exchange(int i, double* buffer) { return pack(i, buffer); }

int FixWall::unpack_exchange(int i, double* buffer) { return unpack(i, buffer); }

int FixWall::pack_restart(int i, double* buffer)
{
    const int size = 1 + pack(i, buffer + 1);
    buffer[0] = size;
    return size;
}

void FixWall::unpack_restart(int i, int nth)
{
    const double* extra = atom->extra[i];
    for (int n = 0; n < nth; ++n)
        extra += static_cast<int>(extra[0]);
    unpack(i, extra + 1);
}

int FixWall::maxsize_restart()
{
    int most = 3;
    for (int i = 0; i < atom->nlocal; ++i)
        most = std::max(most, size_restart(i));
    return most;
}

void FixWall::write_restart(FILE* out)
{
    std::array<double, std::size(ofRun)> mine;
    std::array<double, std::size(ofRun) + 2> all;
    std::transform(std::begin(ofRun), std::end(ofRun), mine.begin(), [this](Sum sum) { return own[sum]; });
    MPI_Reduce(mine.data(), all.data(), static_cast<int>(mine.size()), MPI_DOUBLE, MPI_SUM, 0, world);
    if (comm->me == 0) {
        all[mine.size()] = start;
        all[mine.size() + 1] = lastTime;
        const int size = sizeof all;
        fwrite(&size, sizeof size, 1, out);
        fwrite(all.data(), sizeof all, 1, out);
    }
}

void FixWall::restart(char* saved)
{
    std::array<double, std::size(ofRun) + 2> all;
    std::memcpy(all.data(), saved, sizeof all);
    start = all[std::size(ofRun)];
    lastTime = all[std::size(ofRun) + 1];
    for (size_t n = 0; comm->me == 0 && n < std::size(ofRun); ++n)
        own[ofRun[n]] = all[n];
}

} // namespace potential_particles
