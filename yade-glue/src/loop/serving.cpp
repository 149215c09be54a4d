// SPDX-License-Identifier: GPL-3.0-or-later
#include "serving.hpp"

#include "abi/knksphys.hpp"
#include "abi/material.hpp"
#include "abi/scgeom.hpp"
#include "abi/shape.hpp"
#include "contact/ig2_flat_conic_pp.hpp"
#include "joint/law2_conic_joint.hpp"
#include "joint/joint_body.hpp"

#include <typeinfo>

namespace potential_particles {

using yade::Interaction;
using yade::Vector3r;

namespace {

    // The functor for a pair of classes, if the dispatcher has met the pair.
    template <class Functor>
    const boost::shared_ptr<Functor>* entry(const yade::FunctorMatrix<Functor>& matrix, int row, int column)
    {
        if (row < 0 || column < 0 || static_cast<std::size_t>(row) >= matrix.size()
            || static_cast<std::size_t>(column) >= matrix[static_cast<std::size_t>(row)].size())
            return nullptr;
        const auto& found = matrix[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)];
        return found ? &found : nullptr;
    }

    template <class Functor, class First, class Second>
    const boost::shared_ptr<Functor>* entryFor(const yade::FunctorMatrix<Functor>& matrix, const First& first,
                                               const Second& second)
    {
        return entry(matrix, first.getClassIndex(), second.getClassIndex());
    }

    // The indices of an object's class and of its base classes.
    template <class Object> std::vector<int> indices(const Object& object)
    {
        std::vector<int> found { object.getClassIndex() };
        for (int depth = 1; found.back() >= 0; ++depth)
            found.push_back(object.getBaseClassIndex(depth));
        found.pop_back();
        return found;
    }

    // Whether YADE could find a functor by the classes that these are derived from.
    template <class Functor, class First, class Second>
    bool hasInherited(const yade::FunctorMatrix<Functor>& matrix, const First& first, const Second& second)
    {
        for (const int row : indices(first))
            for (const int column : indices(second))
                if (entry(matrix, row, column))
                    return true;
        return false;
    }

    // A pointer to the class, of objects of just this class.
    template <class Class, class Object> Class* exactly(Object* object)
    {
        return typeid(*object) == typeid(Class) ? static_cast<Class*>(object) : nullptr;
    }

} // namespace

Serving::Serving(yade::Scene& scene, Step& step, const yade::InteractionLoop& loop, std::uint64_t listed)
    : scene(scene)
    , step(step)
    , geoms(*loop.geomDispatcher)
    , physics(*loop.physDispatcher)
    , laws(*loop.lawDispatcher)
    , pairs(scene.interactions->linIntrs)
    , listed(listed)
{
    for (const auto& functor : geoms.functors) {
        auto* const ours = dynamic_cast<Ig2_ConicPP_ConicPP_ScGeom*>(functor.get());
        functors.push_back({ functor.get(), ours, dynamic_cast<Ig2_Flat_ConicPP*>(ours) });
    }
    for (const auto& law : laws.functors) {
        Law known { law.get(), nullptr, nullptr, exactly<Law2_ScGeomConicPP_ConicJointPhys>(law.get()) };
        if (PP_YADE_LAWS_ARE_KNOWN) {
            known.cundallStrack = exactly<yade::Law2_ScGeom_FrictPhys_CundallStrack>(law.get());
            known.knKs = exactly<yade::Law2_SCG_KnKsPhys_KnKsLaw>(law.get());
        }
        knownLaws.push_back(known);
    }
}

Serving::Thread Serving::open() const
{
    Thread thread;
    for (const Functor& functor : functors)
        thread.counts.push_back(functor.ours ? &functor.ours->counts() : nullptr);
    return thread;
}

void Serving::serve(std::size_t place, Thread& thread)
{
    const boost::shared_ptr<Interaction>& pair = pairs[place];
    PairInStep* const found = step.pairAt(place);
    if (!found) { // no memory
        leave(place);
        return;
    }
    PairInStep& known = *found;
    step.fetchAhead(place);
    if (!known.isOf(pair)) {
        known.become(pair);
        if (ContactInStep* const contact = step.knownContactAt(place))
            contact->listedIn = 0;
    } else if (known.wakes > 0 && step.sleeps(known)) {
        ++thread.sleeping[known.functor];
        return;
    }
    try {
        serveAwake(place, known, thread);
    } catch (...) {
        const std::lock_guard<std::mutex> lock(mutex);
        if (!thrown)
            thrown = std::current_exception();
    }
}

void Serving::close(const Thread& thread)
{
    for (std::size_t i = 0; i < functors.size() && i < thread.sleeping.size() - 1; ++i)
        if (functors[i].ours && thread.sleeping[i + 1] > 0)
            Ig2_ConicPP_ConicPP_ScGeom::countSleeping(*thread.counts[i], thread.sleeping[i + 1]);
    if (thread.missing.empty())
        return;
    const std::lock_guard<std::mutex> lock(mutex);
    unlisted.insert(unlisted.end(), thread.missing.begin(), thread.missing.end());
}

void Serving::rethrow() const
{
    if (thrown)
        std::rethrow_exception(thrown);
}

void Serving::leave(std::size_t place)
{
    const std::lock_guard<std::mutex> lock(mutex);
    places.push_back(place);
}

yade::Body* Serving::bodyOf(int id) const
{
    return id >= 0 && static_cast<std::size_t>(id) < step.bodyCount() ? step.gathered(id).body : nullptr;
}

void Serving::serveAwake(std::size_t place, PairInStep& known, Thread& thread)
{
    const boost::shared_ptr<Interaction>& held = pairs[place];
    Interaction& pair = *held;
    if (!bodyOf(pair.id1) || !bodyOf(pair.id2)) {
        pair.reset();
        return;
    }
    {
        const BodyInStep &one = step.gathered(pair.id1), &other = step.gathered(pair.id2);
        // With several processes: between bodies of others.
        if (scene.subdomain != one.subdomain && scene.subdomain != other.subdomain) {
            pair.reset();
            return;
        }
        if (one.isClump || other.isClump || !pair.functorCache.geomExists || !one.hasShape || !other.hasShape)
            return;
    }
    if (!pair.functorCache.geom && !findGeomFunctor(place, pair))
        return;
    BodyInStep &one = step.gathered(pair.id1), &other = step.gathered(pair.id2);
    const bool wasReal = pair.hasGeomAndPhys();
    if (!pair.functorCache.phys) {
        const auto &material1 = one.body->material, &material2 = other.body->material;
        const auto* const functor
            = material1 && material2 ? entryFor(physics.callBacks, *material1, *material2) : nullptr;
        if (!functor) {
            leave(place);
            return;
        }
        pair.functorCache.phys = *functor;
    }

    const yade::IGeomFunctor* const functor = pair.functorCache.geom.get();
    const Functor* finder = nullptr;
    Counters::Row* counts = nullptr;
    for (std::size_t i = 0; i < functors.size() && i < thread.sleeping.size() - 1; ++i) {
        if (functors[i].functor == functor && functors[i].ours) {
            finder = &functors[i];
            counts = thread.counts[i];
            known.functor = static_cast<unsigned char>(i + 1);
        }
    }
    const bool touches = !finder ? pair.functorCache.geom->go(one.body->shape, other.body->shape, *one.body->state,
                                                              *other.body->state, Vector3r::Zero(), false, held)
        : finder->flat           ? finder->flat->goInLoop(step, *counts, one, other, known, held)
                                 : finder->ours->goInLoop(step, *counts, one, other, known, held);
    if (!touches) {
        if (wasReal)
            pair.reset();
        return;
    }
    pair.functorCache.phys->go(one.body->material, other.body->material, held);
    if (!wasReal)
        pair.iterMadeReal = scene.iter;
    if (!pair.functorCache.constLaw && !findLaw(pair)) {
        // As if it had not been met in this step.
        pair.reset();
        leave(place);
        return;
    }
    if (!push(place, known, pair, one, other, thread))
        pair.reset();
}

bool Serving::findGeomFunctor(std::size_t place, Interaction& pair)
{
    const yade::Shape &one = *step.gathered(pair.id1).body->shape, &other = *step.gathered(pair.id2).body->shape;
    const int row = one.getClassIndex(), column = other.getClassIndex();
    const auto* const functor = entry(geoms.callBacks, row, column);
    if (!functor) {
        if (hasInherited(geoms.callBacks, one, other))
            leave(place);
        else
            pair.functorCache.geomExists = false;
        return false;
    }
    if (geoms.callBacksInfo[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)])
        pair.swapOrder();
    pair.functorCache.geom = *functor;
    return true;
}

bool Serving::findLaw(Interaction& pair) const
{
    const auto* const functor = pair.phys ? entryFor(laws.callBacks, *pair.geom, *pair.phys) : nullptr;
    if (functor)
        pair.functorCache.constLaw = *functor;
    return functor;
}

bool Serving::push(std::size_t place, PairInStep& known, Interaction& pair, const BodyInStep& one,
                   const BodyInStep& other, Thread& thread)
{
    const yade::LawFunctor* const functor = pair.functorCache.constLaw.get();
    ContactInStep* const contact = step.contactAt(place);
    if (contact) {
        known.touching = true;
        contact->interaction = &pair;
        contact->geom = pair.geom.get();
        contact->phys = pair.phys.get();
    }
    Done done = Done::notKnown;
    for (const Law& law : knownLaws) {
        if (law.functor != functor || !contact)
            continue;
        if (law.knKs) {
            done = knKs(*law.knKs, scene, static_cast<yade::ScGeom&>(*pair.geom),
                        static_cast<yade::KnKsPhys&>(*pair.phys), one, other, thread.tangent, contact->push);
        } else if (law.cundallStrack) {
            done = cundallStrack(*law.cundallStrack, scene, static_cast<yade::ScGeom&>(*pair.geom),
                                 static_cast<yade::FrictPhys&>(*pair.phys), one, other, contact->push);
        } else if (law.joint) {
            BodyPush first, second;
            const bool lasts = law.joint->act(*pair.geom, *pair.phys, pair, &first, &second);
            if (first.any)
                contact->push = { first.force, first.torque, second.torque };
            else
                return lasts;
            done = lasts ? Done::pushed : Done::ended;
        }
    }
    if (done == Done::notKnown)
        return pair.functorCache.constLaw->go(pair.geom, pair.phys, &pair);
    if (done == Done::ended)
        return false;
    known.pushedIn = contact->pushedIn = step.number();
    contact->id1 = pair.id1;
    contact->id2 = pair.id2;
    if (contact->listedIn != listed)
        thread.missing.push_back(place);
    return true;
}

} // namespace potential_particles
