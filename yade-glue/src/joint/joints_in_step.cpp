// SPDX-License-Identifier: GPL-3.0-or-later
#include "joints_in_step.hpp"

#include "conic_joint.hpp"
#include "joint_body.hpp"

#include <omp.h>

#include <algorithm>
#include <tuple>

namespace potential_particles {

using yade::Vector3r;

namespace {

    // The body that moves: the clump, of a member.
    int moverOf(const yade::Scene& scene, int id)
    {
        const yade::Body& body = *scene.bodies->body[static_cast<std::size_t>(id)];
        return body.clumpId >= 0 ? body.clumpId : id;
    }

    // As body 2 sees it, in its own place.
    JointLoad shifted(const JointLoad& load, const Vector3r& shift)
    {
        JointLoad own = load;
        own.heldPoint -= shift;
        return own;
    }

} // namespace

JointsInStep& JointsInStep::all()
{
    static JointsInStep joints;
    return joints;
}

bool JointsInStep::isOfLastStep(const yade::Scene& scene) const
{
    return step.load(std::memory_order_relaxed) + 1 == scene.iter && owner.lock().get() == &scene;
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
    rows.clear();
    if (isOfLastStep(scene)) {
        if (!noted.empty())
            rows.swap(noted[0]);
        for (auto ofThread = noted.begin() + (noted.empty() ? 0 : 1); ofThread != noted.end(); ++ofThread)
            rows.insert(rows.end(), ofThread->begin(), ofThread->end());
    } else {
        readFrom(scene);
    }
    noted.resize(static_cast<std::size_t>(std::max(omp_get_max_threads(), omp_get_num_threads())));
    for (auto& ofThread : noted)
        ofThread.clear();
    build(scene.bodies->body.size());
    owner = const_cast<yade::Scene&>(scene).weak_from_this();
    seen.store(&scene, std::memory_order_release);
    step.store(scene.iter, std::memory_order_release);
}

void JointsInStep::readFrom(const yade::Scene& scene)
{
    noted.resize(1);
    noted[0].clear();
    const auto& bodies = scene.bodies->body;
    const auto exists = [&](int id) {
        return id >= 0 && static_cast<std::size_t>(id) < bodies.size() && bodies[static_cast<std::size_t>(id)];
    };
    for (std::size_t i = 0; i < scene.interactions->currSize; ++i) {
        const yade::Interaction& joint = *scene.interactions->linIntrs[i];
        const auto* const phys = dynamic_cast<const ConicJointPhys*>(joint.phys.get());
        if (!phys || !(phys->heldStiffness > 0) || !exists(joint.id1) || !exists(joint.id2))
            continue;
        const Vector3r shift = scene.isPeriodic ? Vector3r(scene.cell->hSize * joint.cellDist.cast<double>())
                                                : Vector3r(Vector3r::Zero());
        note(scene, joint, *phys, shift, false, false);
    }
    rows.swap(noted[0]);
}

void JointsInStep::build(std::size_t bodies)
{
    first.assign(bodies + 1, 0);
    sumOf.assign(bodies, -1);
    const auto end = std::remove_if(rows.begin(), rows.end(),
                                    [&](const Row& row) { return static_cast<std::size_t>(row.body) >= bodies; });
    rows.erase(end, rows.end());
    for (const Row& row : rows)
        ++first[static_cast<std::size_t>(row.body) + 1];
    for (std::size_t body = 0; body < bodies; ++body)
        first[body + 1] += first[body];
    order.resize(rows.size());
    for (std::uint32_t i = static_cast<std::uint32_t>(rows.size()); i-- > 0;) // each body's range is filled from its end
        order[--first[static_cast<std::size_t>(rows[i].body) + 1]] = i;
    // Now first[body + 1] is where a body begins, and the next one where it ends.
    std::size_t count = 0;
    for (std::size_t body = 0; body < bodies; ++body) {
        const auto begin = order.begin() + first[body + 1];
        const auto stop = body + 2 <= bodies ? order.begin() + first[body + 2] : order.end();
        if (stop - begin < 2)
            continue;
        // Threads note them in any order.
        std::sort(begin, stop, [&](std::uint32_t a, std::uint32_t b) {
            return std::tie(rows[a].other, rows[a].part) < std::tie(rows[b].other, rows[b].part);
        });
        if (sums.size() == count)
            sums.emplace_back();
        JointsOfBody& sum = sums[count];
        sum.clear();
        for (auto at = begin; at != stop; ++at)
            sum.add(rows[*at].load, rows[*at].outwards);
        sumOf[body] = static_cast<int>(count++);
    }
}

JointSide JointsInStep::side(int body, const JointLoad& load, bool outwards) const
{
    const auto id = static_cast<std::size_t>(body);
    if (!(load.heldStiffness > 0) || id >= sumOf.size() || sumOf[id] < 0) {
        JointSide alone;
        alone.known = load.heldStiffness > 0;
        return alone;
    }
    return sums[static_cast<std::size_t>(sumOf[id])].without(load, outwards);
}

JointSides JointsInStep::sides(const yade::Scene& scene, const yade::Interaction& joint, const JointLoad& load,
                               const Vector3r& shift, bool isHeld1, bool isHeld2) const
{
    JointSides sides;
    if (!isHeld1)
        sides.one = side(moverOf(scene, joint.id1), load, true);
    if (!isHeld2)
        sides.other = side(moverOf(scene, joint.id2), shifted(load, shift), false);
    return sides;
}

void JointsInStep::note(const yade::Scene& scene, const yade::Interaction& joint, const JointLoad& load,
                        const Vector3r& shift, bool isHeld1, bool isHeld2)
{
    if (!(load.heldStiffness > 0))
        return;
    const auto thread = static_cast<std::size_t>(omp_get_thread_num());
    auto& rowsOfThread = noted[thread < noted.size() ? thread : 0];
    if (!isHeld1)
        rowsOfThread.push_back({ moverOf(scene, joint.id1), joint.id1, joint.id2, true, load });
    if (!isHeld2)
        rowsOfThread.push_back({ moverOf(scene, joint.id2), joint.id2, joint.id1, false, shifted(load, shift) });
}

} // namespace potential_particles
