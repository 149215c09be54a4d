// SPDX-License-Identifier: GPL-2.0-or-later
//
// fix ID group nve/potential/particle
//
// Velocity Verlet for bodies with principal moments of inertia: forces and torques in half steps, free motion between
// (rotation.hpp). Its scalar is the kinetic energy of rotation of the group. LAMMPS's fix nve/asphere takes ellipsoids'
// orientations and inertia, which this has not.
#pragma once

#include "fix.h"

namespace potential_particles {

class FixShapes;

class FixNve : public LAMMPS_NS::Fix {
public:
    FixNve(LAMMPS_NS::LAMMPS* lmp, int count, char** arguments);

    // Bits of the groups that fixes of this style move; 0: there is none.
    static int groups(LAMMPS_NS::LAMMPS* lmp);

    int setmask() override;
    void init() override;
    void initial_integrate(int) override;
    void final_integrate() override { push(); }
    double compute_scalar() override;

private:
    void push(); // by forces and torques, for half a step

    FixShapes* shapes = nullptr;
};

} // namespace potential_particles
