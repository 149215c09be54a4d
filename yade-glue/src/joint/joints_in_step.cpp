// SPDX-License-Identifier: GPL-3.0-or-later
#include "joints_in_step.hpp"

#include "conic_joint.hpp"
#include "joint_body.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>

namespace potential_particles {

using yade::Vector3r;

JointsInStep& JointsInStep::all()
{
    static JointsInStep joints;
    return joints;
}

void JointsInStep::refresh(const yade::Scene& scene)
{
    const auto isSeen = [&] {
        return step.load(std::memory_order_acquire) == scene.iter && seen.load(std::memory_order_acquire) == &scene;
    };
    if (isSeen())
        return;
    const std::lock_guard<std::mutex> lock(mutex);
    if (isSeen())
        return;
    const bool goesOn = step.load(std::memory_order_relaxed) + 1 == scene.iter && owner.lock().get() == &scene;
    begin(scene, scene.iter, goesOn);
}

void JointsInStep::begin(const yade::Scene& scene, long inStep, bool goesOn)
{
    const std::size_t places = scene.interactions->currSize, bodies = scene.bodies->body.size();
    long noted = inStep - 1;
    if (!goesOn) {
        noted = inStep;
        now = Rows();
        now.resize(places);
        readFrom(scene, noted);
        last = Rows();
    }
    std::swap(now, last);
    now.resize(places);
    if (!isListed(noted, bodies))
        list(bodies);
    addUp();
    owner = const_cast<yade::Scene&>(scene).weak_from_this();
    seen.store(&scene, std::memory_order_release);
    step.store(inStep, std::memory_order_release);
}

void JointsInStep::refreshOnRank(const yade::Scene& scene, long inStep)
{
    if (least != 1) {
        least = 1;
        sumOf.clear();
    }
    begin(scene, inStep, false);
}

std::vector<double> JointsInStep::give(const yade::Scene& scene, const std::vector<int>& ids)
{
    std::vector<double> numbers(JointsOfBody::numbers * ids.size());
    for (std::size_t i = 0; i < ids.size(); ++i)
        if (const int sum = sumOfAll(scene, ids[i]); sum >= 0)
            sums[static_cast<std::size_t>(sum)].write(&numbers[JointsOfBody::numbers * i]);
    return numbers;
}

void JointsInStep::take(const yade::Scene& scene, const std::vector<int>& ids, const std::vector<double>& numbers)
{
    if (numbers.size() != JointsOfBody::numbers * ids.size())
        throw std::invalid_argument("what other ranks hold of " + std::to_string(ids.size()) + " bodies has "
                                    + std::to_string(numbers.size()) + " numbers");
    for (std::size_t i = 0; i < ids.size(); ++i)
        if (const int sum = sumOfAll(scene, ids[i]); sum >= 0) {
            sums[static_cast<std::size_t>(sum)].read(&numbers[JointsOfBody::numbers * i]);
            areShared[static_cast<std::size_t>(sum)] = true;
        }
}

// The sum of the body, or the clump it is of; -1 where it has no joint here.
int JointsInStep::sumOfAll(const yade::Scene& scene, int id) const
{
    const auto& bodies = scene.bodies->body;
    const auto place = static_cast<std::size_t>(id);
    if (id < 0 || place >= bodies.size() || !bodies[place])
        return -1;
    const int clump = bodies[place]->clumpId;
    const auto mover = static_cast<std::size_t>(clump >= 0 ? clump : id);
    return mover < sumOf.size() ? sumOf[mover] : -1;
}

void JointsInStep::readFrom(const yade::Scene& scene, long inStep)
{
    const auto& bodies = scene.bodies->body;
    const auto exists = [&](int id) {
        return id >= 0 && static_cast<std::size_t>(id) < bodies.size() && bodies[static_cast<std::size_t>(id)];
    };
    for (std::size_t i = 0; i < scene.interactions->currSize; ++i) {
        const yade::Interaction& joint = *scene.interactions->linIntrs[i];
        const auto* const phys = dynamic_cast<const ConicJointPhys*>(joint.phys.get());
        if (!phys || !exists(joint.id1) || !exists(joint.id2))
            continue;
        const Vector3r shift = scene.isPeriodic ? Vector3r(scene.cell->hSize * joint.cellDist.cast<double>())
                                                : Vector3r(Vector3r::Zero());
        note(i, inStep, keyOf(scene, joint, false, false), *phys, shift);
    }
}

// Whether the joints are those of the lists.
bool JointsInStep::isListed(long noted, std::size_t bodies)
{
    bool same = keys.size() == last.noted.size() && sumOf.size() == bodies;
    keys.resize(last.noted.size());
    for (std::size_t i = 0; i < keys.size(); ++i) {
        const Key key = last.noted[i].step == noted ? last.noted[i].key : Key();
        same = same && keys[i] == key;
        keys[i] = key;
    }
    return same;
}

void JointsInStep::list(std::size_t bodies)
{
    struct Place {
        int body, other, part; // part: the member, of a clump
        Entry entry;
    };
    std::vector<Place> places;
    const auto enter = [&](int body, int other, int part, Entry entry) {
        if (body >= 0 && static_cast<std::size_t>(body) < bodies)
            places.push_back({ body, other, part, entry });
    };
    for (std::size_t i = 0; i < keys.size(); ++i) {
        const Key& key = keys[i];
        enter(key.body1, key.id2, key.id1, { static_cast<std::uint32_t>(i), true });
        enter(key.body2, key.id1, key.id2, { static_cast<std::uint32_t>(i), false });
    }
    // YADE may list them in any order.
    std::sort(places.begin(), places.end(), [](const Place& a, const Place& b) {
        return std::tie(a.body, a.other, a.part) < std::tie(b.body, b.other, b.part);
    });
    sumOf.assign(bodies, -1);
    entries.clear();
    ends.clear();
    for (auto begin = places.begin(), end = begin; begin != places.end(); begin = end) {
        end = std::find_if(begin, places.end(), [&](const Place& place) { return place.body != begin->body; });
        if (end - begin < least)
            continue;
        sumOf[static_cast<std::size_t>(begin->body)] = static_cast<int>(ends.size());
        std::for_each(begin, end, [&](const Place& place) { entries.push_back(place.entry); });
        ends.push_back(static_cast<std::uint32_t>(entries.size()));
    }
    sums.resize(ends.size());
    areShared.resize(ends.size());
}

void JointsInStep::addUp()
{
    const auto normalOf = [&](const Entry& entry) {
        const JointLoad& load = last.rows[entry.place].load;
        return entry.outwards ? load.heldNormal : Vector3r(-load.heldNormal);
    };
    // Blocks between blocks mostly have one joint on each side.
    constexpr std::ptrdiff_t few = 6;
    const auto share = [&](auto begin, auto end) {
        for (auto one = begin; one != end; ++one)
            for (auto other = begin; other != one; ++other)
                if (JointsOfBody::share(normalOf(*one), normalOf(*other)))
                    return true;
        return false;
    };
    auto entry = entries.begin();
    for (std::size_t i = 0; i < ends.size(); ++i) {
        const auto end = entries.begin() + ends[i];
        sums[i].clear();
        areShared[i] = end - entry > few || share(entry, end);
        if (areShared[i])
            std::for_each(entry, end, [&](const Entry& one) {
                const Row& row = last.rows[one.place];
                sums[i].add(row.load, one.outwards ? row.load.heldPoint : row.point2, one.outwards);
            });
        entry = end;
    }
}

JointsInStep::Key JointsInStep::keyOf(const yade::Scene& scene, const yade::Interaction& joint, bool isHeld1,
                                      bool isHeld2)
{
    const auto moverOf = [&](int id) {
        const yade::Body& body = *scene.bodies->body[static_cast<std::size_t>(id)];
        return body.clumpId >= 0 ? body.clumpId : id;
    };
    return { joint.id1, joint.id2, isHeld1 ? -1 : moverOf(joint.id1), isHeld2 ? -1 : moverOf(joint.id2) };
}

JointSide JointsInStep::sideOf(int body, const JointLoad& load, const Vector3r& point, bool outwards) const
{
    const auto id = static_cast<std::size_t>(body);
    if (body >= 0 && load.heldStiffness > 0 && id < sumOf.size() && sumOf[id] >= 0)
        if (const auto sum = static_cast<std::size_t>(sumOf[id]); areShared[sum])
            return sums[sum].without(load, point, outwards);
    JointSide alone;
    alone.known = body >= 0 && load.heldStiffness > 0;
    return alone;
}

void JointsInStep::note(std::size_t place, long inStep, const Key& key, const JointLoad& load, const Vector3r& shift)
{
    if (!(load.heldStiffness > 0) || place >= now.rows.size())
        return;
    now.noted[place] = { inStep, key };
    now.rows[place] = { load, load.heldPoint - shift };
}

} // namespace potential_particles
