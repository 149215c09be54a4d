// SPDX-License-Identifier: GPL-3.0-or-later
#include "pushes.hpp"

#include <algorithm>

namespace potential_particles {

using yade::Vector3r;

void Pushes::list(const std::vector<std::size_t>& missing, Step& step, std::size_t pairs, std::size_t bodies)
{
    bool fits = ends.size() == bodies;
    for (std::size_t i = 0; fits && i < missing.size(); ++i) {
        ContactInStep& contact = *step.contactAt(missing[i]);
        const auto place = static_cast<std::uint32_t>(missing[i]);
        fits = enter(contact.id1, { contact.id2, place }) && enter(contact.id2, { contact.id1, place });
        contact.listedIn = lists;
    }
    if (!fits)
        makeAnew(step, pairs, bodies);
}

// False when there is no room for it.
bool Pushes::enter(int body, Entry entry)
{
    const auto id = static_cast<std::size_t>(body);
    const auto begin = entries.begin() + begins[id], end = entries.begin() + ends[id];
    const auto at = std::lower_bound(begin, end, entry,
                                     [](const Entry& one, const Entry& other) { return one.other < other.other; });
    if (at != end && at->other == entry.other) {
        *at = entry;
        return true;
    }
    if (ends[id] == begins[id + 1])
        return false;
    std::move_backward(at, end, end + 1);
    *at = entry;
    ++ends[id];
    return true;
}

void Pushes::makeAnew(Step& step, std::size_t pairs, std::size_t bodies)
{
    ++lists;
    const auto each = [&](auto visit) {
        for (std::size_t place = 0; place < pairs; ++place) {
            const PairInStep* const pair = step.knownPairAt(place);
            if (!pair || pair->pushedIn == 0 || pair->pushedIn + late < step.number())
                continue;
            ContactInStep& contact = *step.contactAt(place);
            if (static_cast<std::size_t>(contact.id1) < bodies && static_cast<std::size_t>(contact.id2) < bodies)
                visit(static_cast<std::uint32_t>(place), contact);
        }
    };
    begins.assign(bodies + 1, spare);
    begins[0] = 0;
    each([&](std::uint32_t, const ContactInStep& contact) {
        ++begins[static_cast<std::size_t>(contact.id1) + 1];
        ++begins[static_cast<std::size_t>(contact.id2) + 1];
    });
    for (std::size_t id = 0; id < bodies; ++id)
        begins[id + 1] += begins[id];
    entries.resize(begins[bodies]);
    ends.assign(begins.begin(), begins.end() - 1);
    each([&](std::uint32_t place, ContactInStep& contact) {
        enter(contact.id1, { contact.id2, place });
        enter(contact.id2, { contact.id1, place });
        contact.listedIn = lists;
    });
}

void Pushes::add(const Step& step, yade::ForceContainer& forces, std::size_t body) const
{
    const int id = static_cast<int>(body);
    Vector3r force = Vector3r::Zero(), torque = Vector3r::Zero();
    bool any = false;
    for (std::size_t i = begins[body]; i < ends[body]; ++i) {
        if (i + ahead < entries.size())
            fetch(step.knownContactAt(entries[i + ahead].place), sizeof(ContactInStep));
        const ContactInStep& contact = *step.knownContactAt(entries[i].place);
        if (contact.pushedIn != step.number())
            continue;
        const int other = entries[i].other;
        if (contact.id1 == id && contact.id2 == other) {
            force += contact.push.force;
            torque += contact.push.torque1;
        } else if (contact.id2 == id && contact.id1 == other) {
            force += -contact.push.force;
            torque += contact.push.torque2;
        } else {
            continue;
        }
        any = true;
    }
    if (!any)
        return;
    forces.addForce(id, force);
    forces.addTorque(id, torque);
}

} // namespace potential_particles
