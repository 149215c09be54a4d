// SPDX-License-Identifier: GPL-2.0-or-later
//
// fix ID all potential/particle/shapes FILE type T NAME DENSITY ... [orient random SEED]
//
// Which shape the atoms of a type have. Gives each atom its mass and the radius of its bounding ball, and keeps
// orientations, quaternions w x y z, in LAMMPS's own custom property d2_orientation (fix property/atom), which
// migrates, restarts, and is read and written by read_data, dump and set. An atom whose quaternion is 0 0 0 0 has
// none yet, and gets one: 1 0 0 0, or a random one.
#pragma once

#include "shape.hpp"

#include "plugin-common/joint_sides.hpp"

#include "fix.h"

namespace potential_particles {

// Without it there are no potential particles: what runs they can be in is judged here.
class FixShapes : public LAMMPS_NS::Fix {
public:
    FixShapes(LAMMPS_NS::LAMMPS* lmp, int count, char** arguments);
    ~FixShapes() override;

    int setmask() override;
    void post_constructor() override;
    void init() override;
    void setup_pre_force(int) override;
    void pre_neighbor() override;
    void pre_force(int) override;
    void set_arrays(int i) override;
    int pack_forward_comm(int count, int* atoms, double* buffer, int, int*) override;
    void unpack_forward_comm(int count, int first, double* buffer) override;
    double memory_usage() override;

    const Shape& shape(int type) const { return shapes[ofType[type]]; }
    double largestRadius() const;
    double smallestRadius() const;
    double massOf(int type) const { return densities[type] * shape(type).volume; }
    double** orientations() const; // of local atoms, rows w x y z

    // What atom i, which may be a ghost, holds beside a joint of the last step, by all pairs and walls. outwards:
    // the normal of the joint points away from it.
    JointSide sideOf(int i, const JointLoad& load, bool outwards) const;

    // The only one of a simulation; ends LAMMPS, in the name of `asker`, where there is none.
    static FixShapes* of(LAMMPS_NS::LAMMPS* lmp, const std::string& asker);

private:
    void checkRun() const;
    std::string whyNotOfItsType() const; // of an atom that is not, or empty
    void gatherJoints();
    Eigen::Vector3d pointFrom(int i, const JointLoad& load) const;
    void give(int i); // radius and mass by its type
    std::string whyNotOriented(double* quaternion, LAMMPS_NS::tagint tag) const; // or it is now

    std::vector<Shape> shapes;
    std::vector<int> ofType; // by atom type, from 1
    std::vector<double> densities;
    std::vector<JointsOfBody> joints; // in the last step, of all atoms, from their centres; empty without patches
    bool random = false;
    unsigned long long seed = 0;
};

} // namespace potential_particles
