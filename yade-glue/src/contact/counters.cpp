// SPDX-License-Identifier: GPL-3.0-or-later
#include "counters.hpp"

#include <algorithm>
#include <mutex>
#include <vector>

namespace potential_particles {

namespace {

    // Numbers of rows, lent to threads: the lowest free one, so that few are ever touched.
    class Lender {
    public:
        static Lender& instance()
        {
            // Never destroyed: OpenMP's threads may outlive the statics of this module.
            static Lender& lender = *new Lender;
            return lender;
        }

        std::size_t take(std::size_t limit)
        {
            const std::lock_guard<std::mutex> lock(mutex);
            for (std::size_t i = 0; i < taken.size(); ++i) {
                if (!taken[i]) {
                    taken[i] = true;
                    return i;
                }
            }
            if (taken.size() >= limit)
                return limit;
            taken.push_back(true);
            return taken.size() - 1;
        }

        void giveBack(std::size_t row)
        {
            const std::lock_guard<std::mutex> lock(mutex);
            if (row < taken.size())
                taken[row] = false;
        }

    private:
        std::mutex mutex;
        std::vector<bool> taken;
    };

    // The same number for all functors.
    struct Loan {
        explicit Loan(std::size_t limit)
            : row(Lender::instance().take(limit))
        {
        }
        ~Loan() { Lender::instance().giveBack(row); }
        Loan(const Loan&) = delete;
        Loan& operator=(const Loan&) = delete;

        const std::size_t row;
    };

} // namespace

// On the heap: Boost's archives make functors with plain operator new.
Counters::Counters()
    : rows(new Row[rowCount])
{
    rows[rowCount - 1].shared = true;
}

Counters::Row& Counters::ofThisThread()
{
    thread_local const Loan loan(rowCount - 1);
    return rows[loan.row];
}

std::uint64_t Counters::total(Count what) const
{
    std::uint64_t sum = 0;
    for (std::size_t i = 0; i < rowCount; ++i)
        sum += rows[i].cells[static_cast<std::size_t>(what)].load(std::memory_order_relaxed);
    return sum;
}

std::uint64_t Counters::largest(Count what) const
{
    std::uint64_t most = 0;
    for (std::size_t i = 0; i < rowCount; ++i)
        most = std::max(most, rows[i].cells[static_cast<std::size_t>(what)].load(std::memory_order_relaxed));
    return most;
}

void Counters::reset()
{
    for (std::size_t i = 0; i < rowCount; ++i)
        for (auto& cell : rows[i].cells)
            cell.store(0, std::memory_order_relaxed);
}

} // namespace potential_particles
