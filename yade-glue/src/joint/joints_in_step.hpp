// SPDX-License-Identifier: GPL-3.0-or-later
//
// The joints of each body of a scene as they were in the last step.
#pragma once

#include "abi/interaction.hpp"
#include "abi/scene.hpp"

#include "plugin-common/joint.hpp"
#include "plugin-common/joint_sides.hpp"

#include <atomic>
#include <mutex>
#include <vector>

#include <boost/weak_ptr.hpp>

namespace potential_particles {

// Of the laws of joints of all loops, since a body may have joints by several. Members of a clump are one body.
class JointsInStep {
public:
    static JointsInStep& all();

    // Call in each step before the others, from any thread: the first one takes in what the last step has noted, or,
    // after a step without joints or a load, what the joints themselves remember; the others wait for it.
    void refresh(const yade::Scene& scene);

    // What the bodies of a joint hold beside it, whose load is still that of the last step. shift: of the periodic
    // image of body 2. isHeld1, isHeld2: no force moves the body, and nobody asks for its side.
    JointSides sides(const yade::Scene& scene, const yade::Interaction& joint, const JointLoad& load,
                     const Eigen::Vector3d& shift, bool isHeld1, bool isHeld2) const;
    // After its step, with what it holds now.
    void note(const yade::Scene& scene, const yade::Interaction& joint, const JointLoad& load,
              const Eigen::Vector3d& shift, bool isHeld1, bool isHeld2);

private:
    struct Row {
        int body, part, other; // part: the member, of a clump
        bool outwards;
        JointLoad load;
    };

    bool isOfLastStep(const yade::Scene& scene) const;
    void readFrom(const yade::Scene& scene);
    void build(std::size_t bodies);
    JointSide side(int body, const JointLoad& load, bool outwards) const;

    std::vector<std::vector<Row>> noted; // in this step, by thread
    std::vector<Row> rows; // of the last step; used while they are sorted
    std::vector<std::uint32_t> first, order; // by body, in `order`: places in `rows`
    std::vector<int> sumOf; // by body, in `sums`; -1 of a body with one joint at most
    std::vector<JointsOfBody> sums;

    boost::weak_ptr<yade::Factorable> owner; // the scene; its address may be used again
    std::mutex mutex;
    std::atomic<long> step { -1 }; // written last and read first
    std::atomic<const yade::Scene*> seen { nullptr };
};

} // namespace potential_particles
