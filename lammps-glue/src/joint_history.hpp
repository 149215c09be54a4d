// SPDX-License-Identifier: GPL-2.0-or-later
//
// What a contact by its patch carries from step to step, and as numbers that migrate and restart.
#pragma once

#include "plugin-common/joint.hpp"

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

} // namespace potential_particles
