// SPDX-License-Identifier: GPL-2.0-or-later
//
// A file that rank 0 reads for all.
#pragma once

#include "comm.h"
#include "error.h"
#include "lammps.h"

#include <fstream>
#include <iterator>
#include <string>

namespace potential_particles {

// Its bytes, on every rank; ends LAMMPS on all where it cannot be read.
inline std::string fileForAll(LAMMPS_NS::LAMMPS* lmp, const std::string& path)
{
    std::string text;
    long long size = -1;
    if (lmp->comm->me == 0) {
        std::ifstream file(path, std::ios::binary);
        if (file) {
            text.assign(std::istreambuf_iterator<char>(file), {});
            size = static_cast<long long>(text.size());
        }
    }
    MPI_Bcast(&size, 1, MPI_LONG_LONG, 0, lmp->world);
    if (size < 0)
        lmp->error->all(FLERR, "{}: the file cannot be read: give its path from the folder in which LAMMPS was started", path);
    if (size > 2000000000)
        lmp->error->all(FLERR, "{}: {} bytes are more than the 2 GB that are read", path, size);
    text.resize(size);
    MPI_Bcast(text.data(), static_cast<int>(size), MPI_CHAR, 0, lmp->world);
    return text;
}

} // namespace potential_particles
