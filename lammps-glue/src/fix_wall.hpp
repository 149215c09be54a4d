// SPDX-License-Identifier: GPL-2.0-or-later
//
// fix ID group wall/potential/particle KN KS FRICTION RESTITUTION
//     [plane X Y Z NX NY NZ] ... [stl FILE [scale S]] [flat EPS] [linear VX VY VZ] [rotate X Y Z AX AY AZ PERIOD]
//     [patch TOL [cohesion C] [residual FRICTION COHESION] [whole STEP]]
//
// Planes and one mesh, which may move together as one rigid body, from where the command says, from when it is given.
// Bodies are put into the frame of the wall, so that its triangles are sorted into cells once, and planes and triangles
// apart are skipped until the body has moved as far. As a vector: contacts, elastic energy, energy that friction and
// dashpots took, the force on the wall, and with `patch` the energy that patches took as they grew and shrank and that
// breaking took. Triangles then add up: each has the pressure that lies on it.
#pragma once

#include "carrying_fix.hpp"
#include "joint_history.hpp"
#include "mesh.hpp"

#include "plugin-common/point_law.hpp"
#include "plugin-common/seam.hpp"

#include <array>
#include <iterator>
#include <memory>
#include <vector>

namespace potential_particles {

class FixShapes;
struct Shape;

class FixWall : public CarryingFix {
public:
    FixWall(LAMMPS_NS::LAMMPS* lmp, int count, char** arguments);
    ~FixWall() override;

    int setmask() override;
    void init() override;
    void setup(int flags) override;
    void post_force(int) override;
    double compute_vector(int n) override;

    void grow_arrays(int most) override { around.resize(most); }
    void copy_arrays(int from, int to, int) override { around[to] = around[from]; }
    void set_arrays(int i) override { around[i] = {}; }
    void write_restart(FILE* file) override;
    void restart(char* saved) override;
    double memory_usage() override;

    bool actsOnPatches() const { return byPatch; }
    // Calls add(atom, load, true) for each joint.
    template <class Add> void eachLoad(Add&& add) const
    {
        for (int i = 0; i < atom->nlocal; ++i)
            for (const Known& one : around[i].known)
                add(i, one.joint.memory, true);
    }

private:
    // An element: a plane, or, from planes.size() on, a triangle.
    struct Known {
        int element = 0;
        bool touches = false; // has the contact here, and does not leave it to another at a seam
        ContactHistory history = {};
        pp_pair_state state = {}; // since the last list of neighbours, so that all ranks and restarts have the same
        // Of contacts by patch.
        JointHistory joint = {};
        std::shared_ptr<KeptPatch> patch = {}; // as `state`
    };
    // The arguments with which the library finds a patch, in the wall's frame.
    struct WallPatch {
        const pp_particle* particle;
        pp_pose pose;
        const Triangle* triangle; // none of a plane
        bool fromFront;
        pp_flat_contact found;
        std::shared_ptr<KeptPatch> kept;
    };
    struct Asleep {
        int element;
        double wake; // way of the body from which on it is looked at
    };
    // Of an atom: in the wall's frame.
    struct Surroundings {
        double mark = 0; // of the shape for which all this holds
        pp_pose last = {};
        double way = 0, limit = -1; // come since the elements were looked for; how far they reach
        std::vector<Asleep> elements;
        std::vector<Known> known; // those that touch, or nearly do
    };
    struct Touched {
        int element;
        pp_flat_contact found;
    };
    struct Plane {
        Eigen::Vector3d point, normal;
    };
    struct Frame { // of the wall now
        Eigen::Quaterniond turn; // from its own frame
        Eigen::Vector3d origin, velocity, angularVelocity; // of its centre of rotation
    };
    enum Sum { contacts, elastic, slid, damped, forceX, forceY, forceZ, changed, broke, sums };
    static constexpr Sum ofRun[] = { slid, damped, changed, broke }; // since the first step
    // What a restart file has of the wall as a whole.
    struct Saved {
        double format, mark, byPatch, motion[10], start, lastTime, contacts, sums[std::size(ofRun)];
    };

    int savedSize() const { return 1 + (byPatch ? countOfNumbers(JointHistory {}) : 9); } // of a contact

    Frame frameNow() const;
    double timeNow() const;
    void checkPlace() const;
    void checkTimeStep();
    void checkBorder() const;
    Eigen::Vector3d intoWall(const Frame& frame, const Eigen::Vector3d& x) const;
    void meet(int i, const Frame& frame, bool advance);
    void lookAround(Surroundings& here, double radius);
    double ballDistance(int element, const Eigen::Vector3d& position,
                        double radius) const; // of a body's ball to the plane of an element
    void solve(int i, const Shape& shape, Surroundings& here);
    bool leavesToAnother(const Touched& one, double radius) const; // at a seam
    void applyLaw(int i, const Frame& frame, bool advance, const pp_flat_contact& found, Known& contact,
                  Surroundings& here);
    void applyPatchLaw(int i, const Shape& shape, const Frame& frame, bool advance, const Touched& touch,
                       Known& contact, const pp_pose& pose);
    std::optional<PatchInStep> patchOn(int i, const Shape& shape, const Frame& frame, const Touched& touch,
                                       Known& contact, const pp_pose& pose);
    pp_status findPatch(const WallPatch& one, uint32_t withEnergy, pp_patch_state* state, pp_patch* patch) const;
    void push(int i, const Eigen::Vector3d& onWall, const Eigen::Vector3d& torque, const JointEnergies& energies);
    double mark() const; // of planes and triangles
    std::array<double, 10> motion() const;
    void forget(Surroundings& here); // and count what springs hold
    int touching(int i) const;
    int sizeOf(int i) const override { return withoutContacts + touching(i) * savedSize(); }
    int pack(int i, double* buffer) const override;
    int unpack(int i, const double* buffer) override;
    bool shareCorner(int element, int other) const;
    const Triangle* triangleOf(int element) const; // none of a plane

    FixShapes* shapes = nullptr;
    LawParameters law;
    double checkedStep = -1; // time step that was found stable
    bool byPatch = false;
    double patchTolerance = 1e-4;
    // Simulation times at which the wall was where the command says, and at which it was last moved. `reset_timestep`
    // shifts both.
    double start = 0, lastTime = 0;
    LAMMPS_NS::bigint wholeBefore = 1;
    JointParameters joint;
    pp_settings how;
    std::vector<Plane> planes;
    std::unique_ptr<Mesh> mesh;
    Eigen::Vector3d centre = Eigen::Vector3d::Zero(), linear = Eigen::Vector3d::Zero(), axis = Eigen::Vector3d::UnitZ();
    double rate = 0; // of rotation
    std::vector<Surroundings> around; // of atoms
    // Of the atom at work.
    std::vector<int> candidates;
    std::vector<Known> now;
    std::vector<Touched> touched;
    std::vector<int> slotOf; // in `now`, of each that touches
    std::vector<WallPatch> withoutEnergy; // patches of the step whose energies are not in `own` yet
    double own[sums] = {};
};

} // namespace potential_particles
