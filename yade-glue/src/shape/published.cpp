// SPDX-License-Identifier: GPL-3.0-or-later
#include "abi/base.hpp"

#include "published.hpp"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <mutex>
#include <vector>

#include <boost/python/errors.hpp>
#include <boost/python/extract.hpp>
#include <boost/python/import.hpp>
#include <boost/python/object.hpp>

namespace py = boost::python;

namespace potential_particles {

namespace {

    struct Replaced {
        std::uint64_t change; // of O.iter, the last one seen when it was handed over
        std::shared_ptr<const void> what;
    };

    class Retired {
    public:
        static Retired& instance()
        {
            // Never destroyed: OpenMP threads may outlive the statics of this module.
            static Retired& retired = *new Retired;
            return retired;
        }

        void add(std::shared_ptr<const void> old)
        {
            // What was handed over before has been replaced by now, in memory too, before YADE is asked.
            std::atomic_thread_fence(std::memory_order_seq_cst);
            const bool asked = PyGILState_Check();
            const Step step = asked ? Step::now() : Step {};

            const std::lock_guard<std::mutex> lock(mutex);
            if (asked)
                free(step);
            held.push_back({ change, std::move(old) });
        }

        std::size_t size()
        {
            const std::lock_guard<std::mutex> lock(mutex);
            return held.size();
        }

    private:
        // Where YADE is in its steps.
        struct Step {
            bool inProgress = true;
            long number = -1;

            // With Python's lock. By way of Python because the place of these fields in YADE's Scene differs by
            // version.
            static Step now()
            {
                try {
                    const py::object omega = py::import("yade.wrapper").attr("Omega")();
                    return { py::extract<int>(omega.attr("subStep"))() != -1, py::extract<long>(omega.attr("iter"))() };
                } catch (const py::error_already_set&) {
                    PyErr_Clear();
                    return {};
                }
            }
        };

        void free(const Step& step)
        {
            if (!step.inProgress) {
                held.clear();
                return;
            }
            if (step.number != seen) {
                seen = step.number;
                ++change;
            }
            held.erase(held.begin(), std::find_if(held.begin(), held.end(), [this](const Replaced& one) {
                           return one.change + 2 > change;
                       }));
        }

        std::mutex mutex;
        std::vector<Replaced> held; // in the order in which they came
        long seen = -1;
        std::uint64_t change = 0;
    };

} // namespace

void retire(std::shared_ptr<const void> old) { Retired::instance().add(std::move(old)); }

std::size_t retiredCount() { return Retired::instance().size(); }

} // namespace potential_particles
