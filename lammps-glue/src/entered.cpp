// SPDX-License-Identifier: GPL-2.0-or-later
#include "entered.hpp"

#include "plugin-common/restitution.hpp"

#include "comm.h"
#include "error.h"
#include "utils.h"

#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

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

LawParameters readLaw(LAMMPS* lmp, const char* command, char** arguments, int at)
{
    const double value[] = {
        numberIn(lmp, command, "normal stiffness", arguments[at], 1 / bearable),
        numberIn(lmp, command, "shear stiffness", arguments[at + 1], 1 / bearable, bearable, true),
        numberIn(lmp, command, "friction", arguments[at + 2], 0),
        numberIn(lmp, command, "restitution", arguments[at + 3], leastRestitution, 1),
    };
    if (value[1] == 0 && value[2] > 0)
        lmp->error->all(FLERR, "{}: shear stiffness = 0 with friction = {}: give friction 0 for frictionless contacts",
                        command, value[2]);
    return { value[0], value[1], value[2], dampingRatioOf(value[3]) };
}

JointParameters jointOf(const LawParameters& law)
{
    JointParameters joint;
    joint.normalStiffness = law.normalStiffness;
    joint.shearStiffness = law.shearStiffness;
    joint.friction = joint.residualFriction = law.friction;
    joint.dampingRatio = law.dampingRatio;
    return joint;
}

double readPatchTolerance(LAMMPS* lmp, const char* command, const char* text)
{
    return numberIn(lmp, command, "patch", text, 1e-12, 0.1);
}

int readStrength(LAMMPS* lmp, const char* command, char** arguments, int at, int count, JointParameters& joint)
{
    const std::string word = arguments[at];
    const int numbers = word == "residual" ? 2 : word == "cohesion" || word == "tension" || word == "softening" ? 1 : 0;
    if (!numbers)
        return 0;
    double value[2] = {};
    for (int n = 0; n < numbers; ++n) {
        if (at + 1 + n >= count)
            lmp->error->all(FLERR, "{}: {}: {} expected after it", command, word,
                            numbers == 2 ? "a coefficient of friction and a stress are" : "a number is");
        value[n] = numberIn(lmp, command, word, arguments[at + 1 + n], 1 / bearable, bearable, true);
    }
    if (joint.shearStiffness == 0 && word == "cohesion" && value[0] > 0)
        lmp->error->all(
            FLERR, "{}: cohesion = {} with shear stiffness 0: nothing holds along the joint; give a shear stiffness",
            command, value[0]);
    if (word == "cohesion")
        joint.cohesion = value[0];
    else if (word == "tension")
        joint.tensileStrength = value[0];
    else if (word == "softening")
        joint.softening = value[0];
    else {
        joint.residualFriction = value[0];
        joint.residualCohesion = value[1];
    }
    return 1 + numbers;
}

} // namespace potential_particles
