// SPDX-License-Identifier: GPL-2.0-or-later
#include "joint_words.hpp"
#include "entered.hpp"

#include "error.h"

#include <string>

using namespace LAMMPS_NS;

namespace potential_particles {

LawParameters readLaw(LAMMPS* lmp, const char* command, char** arguments, int at)
{
    const double value[] = {
        numberIn(lmp, command, "normal stiffness", arguments[at], 1 / bearable),
        numberIn(lmp, command, "shear stiffness", arguments[at + 1], 1 / bearable, bearable, true),
        numberIn(lmp, command, "friction", arguments[at + 2], 0),
        numberIn(lmp, command, "restitution", arguments[at + 3], lowestRestitution, 1),
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
