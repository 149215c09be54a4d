// SPDX-License-Identifier: GPL-2.0-or-later
//
// Identifies what a memory belongs to: a number from all that it depends on, sent to other ranks and saved with it.
// Where the number differs now, the memory does not fit.
#pragma once

#include <cstdint>
#include <cstring>

namespace potential_particles {

class Mark {
public:
    // FNV-1a of the bits of numbers.
    void add(const double* numbers, size_t count)
    {
        for (size_t n = 0; n < count; ++n) {
            uint64_t bits;
            std::memcpy(&bits, &numbers[n], sizeof bits);
            for (int byte = 0; byte < 8; ++byte)
                sum = (sum ^ (bits >> 8 * byte & 255)) * 0x100000001b3u;
        }
    }

    // A whole number that a double holds, with room for markOfBoth.
    double value() const { return static_cast<double>(sum >> 13); }

private:
    uint64_t sum = 0xcbf29ce484222325u;
};

// In their order; exact.
inline double markOfBoth(double a, double b) { return 2 * a + b; }

// The first number of what fixes write into restart files: files of plugins that knew no marks begin with a sum of
// energy.
constexpr double savedFormat = -3;

} // namespace potential_particles
