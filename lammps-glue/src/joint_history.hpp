// SPDX-License-Identifier: GPL-2.0-or-later
//
// What a contact by its patch carries from step to step, and as numbers that migrate and restart. One
// step of such a contact, of two bodies or of a body and a wall.
#pragma once

#include "plugin-common/joint.hpp"
#include "plugin-common/joint_law.hpp"

#include <potential_particles.h>

#include <memory>
#include <optional>
#include <type_traits>

namespace potential_particles {

struct JointHistory {
    JointMemory memory;
    Eigen::Vector3d normal = Eigen::Vector3d::Zero(); // of the last step
    Wrench damping; // of dashpots in the last step
    bool touching = false;

    bool isBond() const { return memory.bondArea > 0; }
    bool lasts() const { return touching || isBond(); }

    // Calls `visit(double*, count)` for all that is one number or several, `visit(bool&)` for flags, and
    // `visit(std::vector<double>&)` for the rim, which is last.
    template <class History, class Visit> static void eachNumber(History& history, Visit&& visit)
    {
        auto& m = history.memory;
        visit(history.touching);
        visit(m.broken);
        visit(m.bonded);
        for (auto* vector : { &m.shearDisplacement, &history.normal, &history.damping.force, &history.damping.moment })
            visit(vector->data(), 3);
        visit(&m.twist, 1);
        visit(&m.energyAlong, 1);
        JointLoad::eachHeld<std::conditional_t<std::is_const_v<History>, const JointLoad, JointLoad>>(m, visit);
        visit(&m.bondArea, 1);
        if (!(m.bondArea > 0))
            return;
        visit(&m.damage, 1);
        for (auto* vector : { &m.bondMoments, &m.bondPoint1, &m.bondPoint2, &m.bondDisplacement, &m.bondRotation })
            visit(vector->data(), 3);
        for (auto* turn : { &m.bondTurn1, &m.bondTurn2 })
            visit(turn->coeffs().data(), 4);
        visit(m.bondRim);
    }
};

namespace joint_numbers {

    struct Count {
        int count = 0;
        void operator()(const bool&) { ++count; }
        void operator()(const double*, int n) { count += n; }
        void operator()(const std::vector<double>& list) { count += 1 + static_cast<int>(list.size()); }
    };

    struct Write {
        double* to;
        void operator()(const bool& flag) { *to++ = flag; }
        void operator()(const double* from, int n)
        {
            for (int i = 0; i < n; ++i)
                *to++ = from[i];
        }
        void operator()(const std::vector<double>& list)
        {
            *to++ = static_cast<double>(list.size());
            (*this)(list.data(), static_cast<int>(list.size()));
        }
    };

    struct Read {
        const double* from;
        void operator()(bool& flag) { flag = *from++ != 0; }
        void operator()(double* to, int n)
        {
            for (int i = 0; i < n; ++i)
                to[i] = *from++;
        }
        void operator()(std::vector<double>& list)
        {
            list.resize(static_cast<size_t>(*from++));
            (*this)(list.data(), static_cast<int>(list.size()));
        }
    };

} // namespace joint_numbers

inline int countOfNumbers(const JointHistory& history)
{
    joint_numbers::Count visit;
    JointHistory::eachNumber(history, visit);
    return visit.count;
}

inline double* writeNumbers(const JointHistory& history, double* to)
{
    joint_numbers::Write visit { to };
    JointHistory::eachNumber(history, visit);
    return visit.to;
}

inline JointHistory readNumbers(const double* from)
{
    JointHistory history;
    joint_numbers::Read visit { from };
    JointHistory::eachNumber(history, visit);
    return history;
}

// The energy of a patch takes ten times as long as its force. It has a memory of its own and is sought only where it is
// output, so that no force depends on how often that is.
struct KeptPatch {
    pp_patch_state ofForce = {};
    std::unique_ptr<pp_patch_state> ofEnergy;

    // find(with_energy, state, patch): a call of the library. 0 where it fails.
    template <class Find> double energy(Find&& find)
    {
        if (!ofEnergy)
            ofEnergy = std::make_unique<pp_patch_state>();
        pp_patch patch;
        return find(1, ofEnergy.get(), &patch) == PP_OK && patch.energy > 0 ? patch.energy : 0.0;
    }

    double bytes() const { return sizeof(*this) + (ofEnergy ? sizeof(*ofEnergy) : 0); }
};

constexpr double areaTolerance = 1e-6; // of a disc in the place of a patch

// here: none, where the bodies are apart. Where the step only repeats the last one (`advance` false, at the start of a
// run), the history stays as it is. posed(1), posed(2): the shapes, for a patch that becomes a bond.
template <class Posed>
JointForces jointForces(const JointParameters& joint, JointHistory& history, const JointBody& one,
                        const JointBody& other, const JointSides& sides, const std::optional<PatchInStep>& here,
                        double dt, bool advance, Posed&& posed)
{
    JointLaw law(joint, history.memory, one, other, sides, dt);
    const auto motionAt = [&](const PatchInStep& patch) {
        return JointMotion::of(one, other, patch.point, patch.normal, history.normal, dt);
    };
    if (!advance && history.lasts()) {
        if (history.isBond())
            law.repeatAsBond(history.damping);
        else if (here && here->patch.area > 0)
            law.repeatAsPatch(here->patch, motionAt(*here), history.damping);
        return law.forces();
    }
    law.step(
        here && here->patch.area > 0 ? &here->patch : nullptr, true, [&] { return motionAt(*here); }, posed);
    history.touching = here.has_value();
    if (here)
        history.normal = here->normal;
    history.damping = law.forces().damping;
    return law.forces();
}

} // namespace potential_particles
