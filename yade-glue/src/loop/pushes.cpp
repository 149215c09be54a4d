// SPDX-License-Identifier: GPL-3.0-or-later
#include "pushes.hpp"

#include <algorithm>

namespace potential_particles {

using yade::Vector3r;

void Pushes::makeLists(Step& step, std::size_t pairs, std::size_t bodies)
{
    ++lists;
    begins.assign(bodies + 1, 0);
    const auto each = [&](auto visit) {
        for (std::size_t place = 0; place < pairs; ++place)
            if (const PairInStep* pair = step.knownPairAt(place); pair && pair->pushedIn > 0 && pair->pushedIn + late >= step.number())
                visit(static_cast<std::uint32_t>(place), static_cast<std::size_t>(pair->id1), static_cast<std::size_t>(pair->id2));
    };
    each([&](std::uint32_t place, std::size_t id1, std::size_t id2) {
        ++begins[id1 + 1];
        ++begins[id2 + 1];
        step.contactAt(place)->listedIn = lists;
    });
    for (std::size_t id = 0; id < bodies; ++id)
        begins[id + 1] += begins[id];
    entries.resize(begins[bodies]);
    filled.assign(begins.begin(), begins.end() - 1);
    each([&](std::uint32_t place, std::size_t id1, std::size_t id2) {
        entries[filled[id1]++] = { static_cast<int>(id2), place };
        entries[filled[id2]++] = { static_cast<int>(id1), place | second };
    });
    for (std::size_t id = 0; id < bodies; ++id)
        std::sort(entries.begin() + begins[id], entries.begin() + begins[id + 1],
                  [](const Entry& one, const Entry& other) { return one.other < other.other; });
}

void Pushes::add(const Step& step, yade::ForceContainer& forces, std::size_t body) const
{
    Vector3r force = Vector3r::Zero(), torque = Vector3r::Zero();
    bool any = false;
    for (std::size_t i = begins[body]; i < begins[body + 1]; ++i) {
        const bool isSecond = entries[i].place & second;
        const ContactInStep& contact = *step.knownContactAt(entries[i].place & ~second);
        if (contact.pushedIn != step.number())
            continue;
        any = true;
        if (isSecond) {
            force += -contact.push.force;
            torque += contact.push.torque2;
        } else {
            force += contact.push.force;
            torque += contact.push.torque1;
        }
    }
    if (!any)
        return;
    const int id = static_cast<int>(body);
    forces.addForce(id, force);
    forces.addTorque(id, torque);
}

} // namespace potential_particles
