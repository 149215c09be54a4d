// SPDX-License-Identifier: GPL-3.0-or-later
#include "failure_report.hpp"

#include <cstdio>

namespace potential_particles {

namespace {
    // All digits, so that the pair can be posed again.
    std::string text(const pp_pose& pose)
    {
        char buffer[256];
        const auto& [x, y, z] = pose.position;
        const auto& [qw, qx, qy, qz] = pose.orientation;
        std::snprintf(buffer, sizeof buffer,
                      "position (%.17g, %.17g, %.17g) orientation (w %.17g, x %.17g, y %.17g, z %.17g)", x, y, z, qw,
                      qx, qy, qz);
        return buffer;
    }
}

void FailureReport::add(const Failure& failure) noexcept
{
    try {
        const std::lock_guard<std::mutex> lock(mutex);
        if (failures.size() >= most || !pairs.insert({ failure.id1, failure.id2 }).second)
            return;
        failures.push_back(failure);
        std::fprintf(stderr,
                     "potential_particles: no contact found for bodies %d and %d: %s\n  body %d: %s\n  body %d: %s\n%s",
                     failure.id1, failure.id2, failure.message.c_str(), failure.id1, text(failure.pose1).c_str(),
                     failure.id2, text(failure.pose2).c_str(),
                     failures.size() == most ? "  (further pairs are counted, not reported)\n" : "");
    } catch (...) {
        // Out of memory, in the middle of a parallel loop: the failure is counted all the same.
    }
}

std::vector<Failure> FailureReport::all() const
{
    const std::lock_guard<std::mutex> lock(mutex);
    return failures;
}

void FailureReport::clear()
{
    const std::lock_guard<std::mutex> lock(mutex);
    pairs.clear();
    failures.clear();
}

} // namespace potential_particles
