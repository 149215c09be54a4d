// SPDX-License-Identifier: GPL-3.0-or-later
//
// Scene and its periodic Cell. Neither is ever made here; fields that nobody reads are bytes.
#pragma once

#include "body.hpp"
#include "engine.hpp"
#include "forces.hpp"
#include "interaction_container.hpp"

namespace yade {

class Cell : public Serializable {
public:
    using Matrix = Eigen::Matrix<Real, 3, 3>;

    Cell() = delete;
    ~Cell() override;
    PP_ABI_SERIALIZABLE_OVERRIDES

    std::byte before[288];
    bool hasShear;
    Matrix shearTrsf;
    Matrix unshearTrsf; // from world axes to those in which bounds are sorted
    std::byte between[272];
    Matrix hSize; // the vectors of the cell, as columns
    std::byte behind[296];
};
PP_ABI_SIZE(Cell, 1104);
PP_ABI_OFFSET(Cell, hasShear, 312);
PP_ABI_OFFSET(Cell, shearTrsf, 320);
PP_ABI_OFFSET(Cell, unshearTrsf, 392);
PP_ABI_OFFSET(Cell, hSize, 736);

class Scene : public Serializable {
public:
    Scene() = delete;
    ~Scene() override;
    PP_ABI_SERIALIZABLE_OVERRIDES

    boost::shared_ptr<Engine> engineByName(const std::string& className);

    // A ForceContainer begins here.
    ForceContainer& forces() { return reinterpret_cast<ForceContainer&>(before[8]); }

    std::byte before[416];
    Real dt;
    long iter;
    bool subStepping;
    int subStep;
    Real time;
    Real speed;
    long stopAtIter;
    Real stopAtTime;
    bool isPeriodic;
    bool trackEnergy;
    bool doSort; // the collider shall run in this step
    bool runInternalConsistencyChecks;
    int selectedBody;
    int subdomain;
    boost::shared_ptr<Shape> subD;
    std::vector<std::string> tags;
    std::vector<boost::shared_ptr<Engine>> engines;
    std::vector<boost::shared_ptr<Engine>> nextEngines;
    boost::shared_ptr<BodyContainer> bodies;
    boost::shared_ptr<InteractionContainer> interactions;
    boost::shared_ptr<EnergyTracker> energy;
    std::byte behindEnergy[40];
    boost::shared_ptr<Cell> cell;
    std::byte behind[48];
};
PP_ABI_SIZE(Scene, 752);
PP_ABI_OFFSET(Scene, before, 24); // of which the forces lie at 32
PP_ABI_OFFSET(Scene, dt, 440);
PP_ABI_OFFSET(Scene, iter, 448);
PP_ABI_OFFSET(Scene, isPeriodic, 496);
PP_ABI_OFFSET(Scene, doSort, 498);
PP_ABI_OFFSET(Scene, tags, 528);
PP_ABI_OFFSET(Scene, engines, 552);
PP_ABI_OFFSET(Scene, bodies, 600);
PP_ABI_OFFSET(Scene, interactions, 616);
PP_ABI_OFFSET(Scene, energy, 632);
PP_ABI_OFFSET(Scene, cell, 688);

} // namespace yade
