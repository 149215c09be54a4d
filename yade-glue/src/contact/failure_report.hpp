// SPDX-License-Identifier: GPL-3.0-or-later
//
// Pairs whose contact could not be found: said once each, kept for Python.
#pragma once

#include <potential_particles.h>

#include <mutex>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace potential_particles {

struct Failure {
    int id1, id2;
    pp_pose pose1, pose2;
    std::string message;
};

class FailureReport {
public:
    // The first failure of a pair is written to stderr and kept; later ones only count elsewhere.
    // Safe from any thread; never throws.
    void add(const Failure& failure) noexcept;
    std::vector<Failure> all() const;
    void clear();

private:
    // A scene that diverges fails everywhere: this many reports are enough.
    static constexpr std::size_t most = 1000;

    mutable std::mutex mutex;
    std::set<std::pair<int, int>> pairs;
    std::vector<Failure> failures;
};

} // namespace potential_particles
