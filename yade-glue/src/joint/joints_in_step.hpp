// SPDX-License-Identifier: GPL-3.0-or-later
//
// The joints of each body of a scene as they were in the last step.
#pragma once

#include "abi/interaction.hpp"
#include "abi/scene.hpp"

#include "plugin-common/joint.hpp"
#include "plugin-common/joint_sides.hpp"

#include <atomic>
#include <cstdint>
#include <mutex>
#include <vector>

#include <boost/weak_ptr.hpp>

namespace potential_particles {

// Of the laws of joints of all loops, since a body may have joints by several. Members of a clump are one body.
class [[gnu::visibility("hidden")]] JointsInStep
{
public:
    static JointsInStep& all();

    // Call in each step before the others, from any thread: the first one takes in what the last step has noted, or,
    // after a step without joints or a load, what the joints themselves remember; the others wait for it.
    void refresh(const yade::Scene& scene);

    // On ranks, of which one holds all joints of its own bodies, but not of the others. Before the step `inStep`, while
    // no law acts: takes in what the joints here remember.
    void refreshOnRank(const yade::Scene& scene, long inStep);
    // What these bodies hold, as numbers; and what other ranks gave of theirs.
    std::vector<double> give(const yade::Scene& scene, const std::vector<int>& ids);
    void take(const yade::Scene& scene, const std::vector<int>& ids, const std::vector<double>& numbers);

    // Of which bodies a joint is. Bodies: the clumps, of members; -1 of one that no force moves: nobody asks for its
    // side.
    struct Key {
        int id1 = -1, id2 = -1, body1 = -1, body2 = -1;
        bool operator==(const Key& other) const
        {
            return id1 == other.id1 && id2 == other.id2 && body1 == other.body1 && body2 == other.body2;
        }
    };
    static Key keyOf(const yade::Scene& scene, const yade::Interaction& joint, bool isHeld1, bool isHeld2);

    // What the bodies of a joint hold beside it, whose load is still that of the last step. shift: of the periodic
    // image of body 2.
    JointSides sides(const Key& key, const JointLoad& load, const Eigen::Vector3d& shift) const
    {
        return { sideOf(key.body1, load, load.heldPoint, true),
                 sideOf(key.body2, load, load.heldPoint - shift, false) };
    }
    // After its step, with what it holds now. place: in YADE's list.
    void note(std::size_t place, long inStep, const Key& key, const JointLoad& load, const Eigen::Vector3d& shift);

private:
    struct Noted {
        long step = -1;
        Key key;
    };
    struct Row {
        JointLoad load;
        Eigen::Vector3d point2; // heldPoint as body 2 sees it, in its own place
    };
    // By the place of the joint in YADE's list.
    struct Rows {
        std::vector<Noted> noted; // most pairs are no joints
        std::vector<Row> rows;

        void resize(std::size_t size)
        {
            noted.resize(size);
            rows.resize(size);
        }
    };
    struct Entry {
        std::uint32_t place;
        bool outwards;
    };

    void begin(const yade::Scene& scene, long inStep, bool goesOn);
    void readFrom(const yade::Scene& scene, long inStep);
    bool isListed(long noted, std::size_t bodies);
    void list(std::size_t bodies);
    void addUp();
    int sumOfAll(const yade::Scene& scene, int id) const;
    JointSide sideOf(int body, const JointLoad& load, const Eigen::Vector3d& point, bool outwards) const;

    Rows now, last; // of this step and the last one
    // Of each body with several joints its entries, in the order of the other body. They last while the keys do.
    std::vector<Key> keys;
    std::vector<Entry> entries;
    std::vector<std::uint32_t> ends; // in `entries`, by sum
    std::vector<int> sumOf; // by body, in `sums`; -1 of a body with fewer joints than `least`
    int least = 2; // a joint that is alone has nothing beside it; 1 where other ranks may hold more of them
    std::vector<JointsOfBody> sums;
    std::vector<char> areShared; // by sum: some of its joints are on one side; else it is empty

    boost::weak_ptr<yade::Factorable> owner; // the scene; its address may be used again
    std::mutex mutex;
    std::atomic<long> step { -1 }; // written last and read first
    std::atomic<const yade::Scene*> seen { nullptr };
};

} // namespace potential_particles
