// SPDX-License-Identifier: GPL-2.0-or-later
#include "joint_words.hpp"

#include "error.h"
#include "utils.h"

#include <cmath>
#include <string>

using namespace LAMMPS_NS;

namespace potential_particles {

LawParameters readLaw(LAMMPS* lmp, const char* command, char** arguments, int at)
{
    double value[4];
    const char* names[] = { "normal stiffness", "shear stiffness", "friction", "restitution" };
    for (int n = 0; n < 4; ++n) {
        value[n] = utils::numeric(FLERR, arguments[at + n], false, lmp);
        const bool good = n == 0 ? value[n] > 0 : n == 3 ? value[n] >= lowestRestitution && value[n] <= 1 : value[n] >= 0;
        if (!good || !std::isfinite(value[n]))
            lmp->error->all(FLERR, "{}: {} = {}: it must {}", command, names[n], arguments[at + n],
                n == 0 ? "be above 0" : n == 3 ? "lie in [0.01, 1]" : "not be below 0");
    }
    if (value[1] == 0 && value[2] > 0)
        lmp->error->all(FLERR, "{}: shear stiffness = 0 with friction = {}: give friction 0 for frictionless contacts", command, value[2]);
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

int readStrength(LAMMPS* lmp, const char* command, char** arguments, int at, int count, JointParameters& joint)
{
    const std::string word = arguments[at];
    const int numbers = word == "residual" ? 2 : word == "cohesion" || word == "tension" || word == "softening" ? 1 : 0;
    if (!numbers)
        return 0;
    double value[2] = {};
    for (int n = 0; n < numbers; ++n) {
        if (at + 1 + n >= count)
            lmp->error->all(FLERR, "{}: {}: {} expected after it", command, word, numbers == 2 ? "a coefficient of friction and a stress are" : "a number is");
        value[n] = utils::numeric(FLERR, arguments[at + 1 + n], false, lmp);
        if (!(value[n] >= 0 && std::isfinite(value[n])))
            lmp->error->all(FLERR, "{}: {} = {}: it must not be below 0", command, word, arguments[at + 1 + n]);
    }
    if (joint.shearStiffness == 0 && word == "cohesion" && value[0] > 0)
        lmp->error->all(FLERR, "{}: cohesion = {} with shear stiffness 0: nothing holds along the joint; give a shear stiffness", command, value[0]);
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
