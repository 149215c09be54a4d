// SPDX-License-Identifier: GPL-3.0-or-later
#include "registration/definitions.hpp"

#include "conic_interaction_loop.hpp"
#include "serving.hpp"

#include <omp.h>

#include <algorithm>

namespace potential_particles {

using yade::Interaction;

ConicInteractionLoop::ConicInteractionLoop() = default;
ConicInteractionLoop::~ConicInteractionLoop() = default;

PP_CLASS_DEFINITIONS(ConicInteractionLoop)
PP_PYTHON_AS_BASE(ConicInteractionLoop, yade::InteractionLoop)

namespace {

    // What YADE's loop does to its dispatchers before each step.
    template <class Dispatcher> void seeScene(Dispatcher& dispatcher, yade::Scene* scene)
    {
        dispatcher.scene = scene;
        for (const auto& functor : dispatcher.functors)
            functor->scene = scene;
    }

} // namespace

// The other colliders than InsertionSortCollider leave it to the loop to end pairs.
bool ConicInteractionLoop::isOurs() const
{
    return !scene->isPeriodic && callbacks.empty() && scene->interactions->iterColliderLastRun < 0;
}

void ConicInteractionLoop::action()
{
    const Step::Running running(step);
    const auto& bodies = scene->bodies->body;
    const std::size_t pairs = scene->interactions->currSize, count = bodies.size();
    const int most = omp_get_max_threads(), threads = ompThreads > 0 ? std::min(ompThreads, most) : most;
    std::atomic<bool> gathered { isOurs() };
    if (gathered) {
        step.begin(count);
        const long each = static_cast<long>(count);
#pragma omp parallel for schedule(static) num_threads(threads)
        for (long id = 0; id < each; ++id)
            if (!step.gather(static_cast<std::size_t>(id), bodies[static_cast<std::size_t>(id)].get()))
                gathered.store(false, std::memory_order_relaxed);
    }
    if (!gathered) {
        InteractionLoop::action();
        return;
    }
    seeScene(*geomDispatcher, scene);
    seeScene(*physDispatcher, scene);
    seeScene(*lawDispatcher, scene);

    Serving serving(*scene, step, *this, pushes.number());
#pragma omp parallel num_threads(threads)
    {
        Serving::Thread thread = serving.open();
        const long each = static_cast<long>(pairs);
#pragma omp for schedule(guided)
        for (long place = 0; place < each; ++place)
            serving.serve(static_cast<std::size_t>(place), thread);
        serving.close(thread);
    }
    pushes.list(serving.missing(), step, pairs, count);
    const long each = static_cast<long>(count);
#pragma omp parallel for schedule(static) num_threads(threads)
    for (long body = 0; body < each; ++body)
        pushes.add(step, scene->forces(), static_cast<std::size_t>(body));
    if (!serving.left().empty())
        serveRest(serving.left());
    serving.rethrow();
}

// By YADE's loop, which skips pairs marked as without a functor. In one thread and in the order of ids, so that forces
// are added up as by this one.
void ConicInteractionLoop::serveRest(const std::vector<std::size_t>& left)
{
    struct Passed {
        ConicInteractionLoop& loop;
        const bool sorted = loop.loopOnSortedInteractions;
        const int threads = loop.ompThreads;
        std::vector<Interaction*> pairs {};

        ~Passed()
        {
            for (Interaction* const pair : pairs)
                pair->functorCache.geomExists = true;
            loop.loopOnSortedInteractions = sorted;
            loop.ompThreads = threads;
        }
    } passed { *this };
    std::vector<std::size_t> places(left);
    std::sort(places.begin(), places.end());
    const auto& pairs = scene->interactions->linIntrs;
    passed.pairs.reserve(pairs.size());
    auto next = places.begin();
    for (std::size_t place = 0; place < pairs.size(); ++place) {
        if (next != places.end() && *next == place) {
            ++next;
            continue;
        }
        if (pairs[place]->functorCache.geomExists) {
            pairs[place]->functorCache.geomExists = false;
            passed.pairs.push_back(pairs[place].get());
        }
    }
    loopOnSortedInteractions = true;
    ompThreads = 1;
    InteractionLoop::action();
}

template <class Archive> void ConicInteractionLoop::serialize(Archive& archive, unsigned version)
{
    requireReadable<ConicInteractionLoop>(version);
    serializeBase<yade::InteractionLoop>(archive, *this, "InteractionLoop");
}

} // namespace potential_particles

BOOST_CLASS_EXPORT_IMPLEMENT(potential_particles::ConicInteractionLoop)
