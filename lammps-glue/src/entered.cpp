// SPDX-License-Identifier: GPL-2.0-or-later
#include "entered.hpp"

#include "comm.h"
#include "error.h"
#include "utils.h"

#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>

using namespace LAMMPS_NS;

namespace potential_particles {
namespace {

constexpr unsigned long long mostBytes = 2000000000; // one message of MPI

// Why the file cannot be read, or nothing, and `bytes`. A device or a pipe may never end.
std::string readOrWhy(const std::string& path, std::string& bytes)
{
    try {
        if (std::filesystem::is_directory(path))
            return "it is a folder: give the path of a file";
        if (std::filesystem::exists(path) && !std::filesystem::is_regular_file(path))
            return "it is a device or a pipe: give the path of a file";
        std::ifstream file(path, std::ios::binary);
        if (!file)
            return "the file cannot be read: give its path from the folder in which LAMMPS was started";
        const auto size = std::filesystem::file_size(path);
        if (size > mostBytes)
            return std::to_string(size) + " bytes are more than the 2 GB that are read";
        bytes.resize(size);
        file.read(bytes.data(), static_cast<std::streamsize>(size));
        return static_cast<bool>(file) ? "" : "the file cannot be read to its end";
    } catch (const std::exception&) {
        return "the file cannot be read, or there is no memory for it";
    }
}

void tellAll(LAMMPS* lmp, std::string& text, int teller)
{
    unsigned long long size = text.size();
    MPI_Bcast(&size, 1, MPI_UNSIGNED_LONG_LONG, teller, lmp->world);
    text.resize(size);
    MPI_Bcast(text.data(), static_cast<int>(size), MPI_CHAR, teller, lmp->world);
}

} // namespace

void endWhereAny(LAMMPS* lmp, const std::string& why)
{
    int teller = 0;
    const int own = why.empty() ? lmp->comm->nprocs : lmp->comm->me;
    MPI_Allreduce(&own, &teller, 1, MPI_INT, MPI_MIN, lmp->world);
    if (teller == lmp->comm->nprocs)
        return;
    std::string told = why;
    tellAll(lmp, told, teller);
    lmp->error->all(FLERR, told);
}

double numberIn(LAMMPS* lmp, const std::string& command, const std::string& what, const char* text, double low,
                double high, bool orZero)
{
    const double value = utils::numeric(FLERR, text, false, lmp);
    if (!((value >= low && value <= high) || (orZero && value == 0)))
        lmp->error->all(FLERR, "{}: {} = {}: it must {}lie in [{}, {}]", command, what, text, orZero ? "be 0 or " : "",
                        low, high);
    return value;
}

double numberOf(const std::string& word)
{
    double value = NAN;
    const char *first = word.data() + (word.size() > 1 && word[0] == '+' && word[1] != '-'),
               *last = word.data() + word.size();
    const auto [end, error] = std::from_chars(first, last, value);
    if (end != last || error == std::errc::invalid_argument)
        return NAN;
    // What is beyond a double: to infinity, or to nothing.
    return error == std::errc()                                                        ? value
        : word.find("e-") != std::string::npos || word.find("E-") != std::string::npos ? 0.0
                                                                                       : INFINITY;
}

std::string fileForAll(LAMMPS* lmp, const std::string& path)
{
    std::string bytes, why;
    if (lmp->comm->me == 0)
        why = readOrWhy(path, bytes);
    endWhereAny(lmp, why.empty() ? why : path + ": " + why);
    tellAll(lmp, bytes, 0);
    return bytes;
}

} // namespace potential_particles
