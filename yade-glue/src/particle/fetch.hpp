// SPDX-License-Identifier: GPL-3.0-or-later
//
// Memory asked for before its use.
#pragma once

#include <cstddef>

namespace potential_particles {

constexpr std::size_t lineSize = 64;

// `size` bytes from `offset` on; null and freed memory do no harm.
inline void fetch(const void* place, std::size_t size, std::size_t offset = 0)
{
    if (!place)
        return;
    // GCC 12 takes a function of __builtin_prefetch alone for one without effect, and drops it.
    const auto* const bytes = static_cast<const char*>(place) + offset;
    for (std::size_t i = 0; i < size; i += lineSize)
        asm volatile("prefetcht0 (%0)" : : "r"(bytes + i));
    // YADE's objects begin anywhere in a line, and end in one more.
    asm volatile("prefetcht0 (%0)" : : "r"(bytes + size - 1));
}

} // namespace potential_particles
