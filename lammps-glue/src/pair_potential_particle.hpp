// SPDX-License-Identifier: GPL-2.0-or-later
//
// pair_style potential/particle [carry TOL] [flat EPS] [closest] [threads N] [failures stop|count] [patch TOL] [whole
// STEP] [bonds yes|no] pair_coeff I J KN KS FRICTION RESTITUTION [cohesion C] [tension T] [residual FRICTION COHESION]
// [softening W]
//
// Contacts act in a point (point_law), or, with `patch`, on the patch by the law of joints (plugin-common), stiffnesses
// being per area. A step: poses of all atoms are gathered. Pairs of the list of neighbours are *far* or *near*. A far
// pair is skipped until both bodies together have moved by their distance at the last look; it has no memory. Near
// pairs have a slot each, with the library's state and the history of the contact, and are solved in one call of the
// library.
#pragma once

#include "plugin-common/point_law.hpp"
#include "contact_memory.hpp"
#include "joint_history.hpp"
#include "mark.hpp"

#include "pair.h"

#include <potential_particles.h>

#include <array>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace potential_particles {

class FixShapes;

class PairPotentialParticle : public LAMMPS_NS::Pair {
public:
    explicit PairPotentialParticle(LAMMPS_NS::LAMMPS* lmp);
    ~PairPotentialParticle() override;

    void settings(int count, char** arguments) override;
    void coeff(int count, char** arguments) override;
    void init_style() override;
    double init_one(int i, int j) override;
    void compute(int eflag, int vflag) override;
    int pack_forward_comm(int count, int* atoms, double* buffer, int, int*) override;
    void unpack_forward_comm(int count, int first, double* buffer) override;
    double memory_usage() override;

    // For the fix that carries memories (ContactMemory).
    void rebuild(); // from the new list of neighbours
    bool actsOnPatches() const { return byPatch; }
    int slotCount() const { return static_cast<int>(bodies.size()); }
    int localAtBuild() const { return local; }
    LAMMPS_NS::tagint tagAtBuild(int atom) const
    {
        return tags[atom];
    } // a fix may have replaced ghosts by new atoms since
    double markAtBuild(int slot) const { return markOfBoth(marks[bodies[slot].a], marks[bodies[slot].b]); }
    std::pair<int, int> bodiesOf(int slot) const { return { bodies[slot].a, bodies[slot].b }; }
    bool lasts(int slot) const { return byPatch ? joints[slot].lasts() : histories[slot].touching; }
    // Calls add(atom, load, whether its normal points away from it) for both atoms of each joint.
    template <class Add> void eachLoad(Add&& add) const
    {
        for (int slot = 0; slot < slotCount(); ++slot) {
            add(static_cast<int>(bodies[slot].a), joints[slot].memory, true);
            add(static_cast<int>(bodies[slot].b), joints[slot].memory, false);
        }
    }
    bool isBond(const ContactMemory::Partner& partner) const;
    bool isBond(int slot) const { return byPatch && joints[slot].isBond(); }
    int valueCount(int slot) const;
    void writeValues(int slot, double* to) const;
    // Sums since the first step, of this rank: failures, energy that friction and dashpots took, that patches and bonds
    // did.
    std::array<double*, 5> sumsOfRun()
    {
        return { &failures, &pvector[slid], &pvector[damped], &pvector[changed], &pvector[broke] };
    }

private:
    static constexpr const char* style = "pair_style potential/particle"; // in messages
    static constexpr const char* memoryId = "POTENTIAL_PARTICLE_MEMORY";

    // The body of the lower ID is A, so that both ranks that compute a pair ask the same question.
    struct Bodies {
        uint32_t a, b;
    };
    struct Far {
        int a, b;
        double wake; // sum of both ways from which on the pair is looked at again
    };
    enum Sum { contacts, failed, elastic, slid, damped, changed, broke, bonds, fallbacks, sums };

    void allocate();
    void gatherPoses();
    bool fits(const ContactMemory::Partner& partner, int a, int b);
    void checkBonds(int before);
    void checkSkin();
    void checkTurns();
    double apart(int a, int b) const; // distance of their balls
    void solveNear();
    void lookAtFar();
    bool sleeps(const pp_contact& found, int a, int b) const;
    void addSlot(Bodies pair, const pp_pair_state& state, const pp_contact& found);
    void takeArrived(int where, int slot);
    void removeSlot(int slot);
    void fail(int a, int b, pp_status status);
    void applyLaw(int slot);
    void actInPoint(int slot);
    void actOnPatch(int slot);
    std::optional<PatchInStep> patchOf(int slot);
    JointHistory newJoint(const JointParameters& joint) const;
    bool isMoved(int i) const; // by forces
    double inverseMass(int i) const; // 0 of a body that no force moves
    JointBody bodyOf(int i) const;
    PosedShape posedShape(int i) const;
    void checkTimeSteps();
    void checkTimeStep(int a, int b, const JointForces& forces) const;
    void push(int i, const Eigen::Vector3d& force, const Eigen::Vector3d& torque);
    void count(int a, int b, const Eigen::Vector3d& onB, const JointEnergies& energies);

    FixShapes* shapes = nullptr;
    ContactMemory* memory_ = nullptr;
    pp_settings how;
    uint32_t threads = 1;
    bool stopAtFailure = true;
    std::vector<LawParameters> laws; // by types, (ntypes + 1)^2
    bool byPatch = false;
    double patchTolerance = 1e-4;
    LAMMPS_NS::bigint wholeBefore = 1; // contacts made before that step are whole
    bool makesBonds = false; // of those
    std::vector<JointParameters> jointLaws; // as `laws`
    int moving = 0; // FixNve::groups
    double checkedStep = -1; // time step that was found stable
    bool toldOfTurns = false, toldOfShapes = false;
    bool advance = true; // this step does not repeat the last one

    int local = 0; // atoms, when the list of neighbours was built
    std::vector<LAMMPS_NS::tagint> tags;
    std::vector<const pp_particle*> particles; // of all atoms, ghosts too
    std::vector<double> marks, radii, ways; // marks: of shapes; ways: come since the list was built
    std::vector<pp_pose> poses, last; // of this step and the last one
    std::vector<std::array<double, 3>> held; // positions when the list was built, where LAMMPS may let it grow old
    std::vector<Far> far;
    // Near pairs: one slot in each.
    std::vector<Bodies> bodies;
    std::vector<pp_pair_state> states;
    std::vector<pp_contact> answers;
    std::vector<ContactHistory> histories; // empty, if contacts act on patches
    std::vector<JointHistory> joints; // empty, if they do not
    // The same; since the last list of neighbours, so that all ranks and restarts have the same.
    std::vector<std::unique_ptr<KeptPatch>> patches;
    LAMMPS_NS::bigint atomsAtBuild = 0;
    std::vector<pp_status> statuses;
    double failures = 0;
};

} // namespace potential_particles
