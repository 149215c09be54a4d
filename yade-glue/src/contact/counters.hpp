// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a functor counts while many threads run it, and the ways in which a pair may be answered.
#pragma once

#include <potential_particles.h>

#include <array>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>

namespace potential_particles {

// The first ones, up to `coneProgram`, are the ways in which a pair may be answered (AnswerPath).
enum class Count {
    motion,
    spheres,
    face,
    memory,
    proof,
    carried,
    warm,
    cold,
    coneProgram,
    calls,
    overlapping,
    areas,
    patches,
    patchesCarried,
    doubtfulPatches,
    patchFallbacks,
    extended,
    failures,
    deepOverlaps,
    nanoseconds,
    number
};

// A row of counters for each thread, on cache lines of its own. YADE runs every O.run in threads
// that are new, so a thread gives its row back when it ends.
class Counters {
public:
    Counters();

    class Row {
    public:
        void add(Count what, std::uint64_t amount = 1)
        {
            auto& cell = cells[static_cast<std::size_t>(what)];
            // An increment that no other thread can come between is ten times as fast as an atomic one.
            if (shared)
                cell.fetch_add(amount, std::memory_order_relaxed);
            else
                cell.store(cell.load(std::memory_order_relaxed) + amount, std::memory_order_relaxed);
        }

    private:
        friend class Counters;
        std::array<std::atomic<std::uint64_t>, static_cast<std::size_t>(Count::number)> cells {};
        bool shared = false;
        char apart[128]; // no two rows in one cache line, nor in two that are fetched together
    };

    Row& ofThisThread();
    std::uint64_t total(Count what) const;
    // Of the thread with the most: since threads may follow each other, of its row.
    std::uint64_t largest(Count what) const;
    // Between steps only: a count that is under way may survive it.
    void reset();

private:
    // The last row is for all further threads.
    static constexpr std::size_t rowCount = 256;
    std::unique_ptr<Row[]> rows;
};

// Adds the time from here to the end of the scope, if asked.
class Stopwatch {
public:
    Stopwatch(Counters::Row& row, bool running)
        : row(running ? &row : nullptr)
    {
        if (running)
            begin = Clock::now();
    }
    ~Stopwatch()
    {
        if (row)
            row->add(Count::nanoseconds,
                     static_cast<std::uint64_t>(
                         std::chrono::duration_cast<std::chrono::nanoseconds>(Clock::now() - begin).count()));
    }
    Stopwatch(const Stopwatch&) = delete;
    Stopwatch& operator=(const Stopwatch&) = delete;

private:
    using Clock = std::chrono::steady_clock;
    Counters::Row* row;
    Clock::time_point begin;
};

struct AnswerPath {
    Count count;
    const char* name; // in Python
    bool withoutSolve; // answered apart and no solver was started
};

// Cheapest first.
constexpr AnswerPath answerPaths[] = {
    { Count::motion, "motion", true }, // apart: they have moved less than the distance that was between them
    { Count::spheres, "spheres", true }, // apart: so are the balls around them
    { Count::face, "face", true }, // apart: one lies beyond a face of the other
    { Count::memory, "memory", true }, // apart: what separated them in the last step still does
    { Count::proof, "proof",
      false }, // apart: the solver met a proof on its way, or what it knew of the last step is carried on
    { Count::carried, "carried", false }, // touching: the contact of the last step, carried on
    { Count::warm, "warm", false }, // solved from the remembered point
    { Count::cold, "cold", false }, // solved cold
    { Count::coneProgram, "cone_program", false }, // solved as a cone program
};

inline Count pathOf(const pp_contact& found)
{
    if (found.flags & PP_FLAG_BY_SPHERES)
        return Count::spheres;
    if (found.flags & PP_FLAG_BY_FACE)
        return Count::face;
    if (found.flags & PP_FLAG_BY_MEMORY)
        return Count::memory;
    if (found.back_end == PP_CONE_PROGRAM)
        return Count::coneProgram;
    if (found.flags & PP_FLAG_REJECTED)
        return Count::proof;
    if (found.flags & PP_FLAG_CARRIED)
        return Count::carried;
    return found.flags & PP_FLAG_WARM ? Count::warm : Count::cold;
}

} // namespace potential_particles
