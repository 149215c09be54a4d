// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a functor counts while many threads run it.
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>

namespace potential_particles {

enum class Count { calls, solved, rejected, fellBack, failures, nanoseconds, number };

// A row of counters for each of the threads (more threads than rows share rows, which is slower
// and still right), on cache lines of their own.
class Counters {
public:
    Counters() : rows(new Row[rowCount]) { }

    void add(Count what, std::uint64_t amount = 1)
    {
        cell(rows[rowOfThisThread()], what).fetch_add(amount, std::memory_order_relaxed);
    }

    std::uint64_t total(Count what) const
    {
        std::uint64_t sum = 0;
        for (std::size_t row = 0; row < rowCount; ++row)
            sum += cell(rows[row], what).load(std::memory_order_relaxed);
        return sum;
    }

    void reset()
    {
        for (std::size_t row = 0; row < rowCount; ++row)
            for (auto& value : rows[row].values)
                value.store(0, std::memory_order_relaxed);
    }

private:
    static constexpr std::size_t rowCount = 64;
    using Cell = std::atomic<std::uint64_t>;
    struct alignas(64) Row {
        Cell values[static_cast<std::size_t>(Count::number)] = {};
    };

    static Cell& cell(Row& row, Count what) { return row.values[static_cast<std::size_t>(what)]; }

    static std::size_t rowOfThisThread()
    {
        static std::atomic<std::size_t> threads { 0 };
        thread_local const std::size_t row = threads.fetch_add(1) % rowCount;
        return row;
    }

    // On the heap: Boost's archives make functors with plain operator new, which would not honour
    // the alignment of a member.
    std::unique_ptr<Row[]> rows;
};

// Adds the time from here to the end of the scope, if asked.
class Stopwatch {
public:
    Stopwatch(Counters& counters, bool running) : counters(running ? &counters : nullptr)
    {
        if (running)
            begin = Clock::now();
    }
    ~Stopwatch()
    {
        if (counters)
            counters->add(Count::nanoseconds, static_cast<std::uint64_t>(
                std::chrono::duration_cast<std::chrono::nanoseconds>(Clock::now() - begin).count()));
    }
    Stopwatch(const Stopwatch&) = delete;
    Stopwatch& operator=(const Stopwatch&) = delete;

private:
    using Clock = std::chrono::steady_clock;
    Counters* counters;
    Clock::time_point begin;
};

} // namespace potential_particles
