// SPDX-License-Identifier: GPL-3.0-or-later
//
// One step of a loop of our own, as its threads share it.
#pragma once

#include "abi/dispatcher.hpp"
#include "abi/scene.hpp"
#include "contact/ig2_conic_pp.hpp"
#include "known_laws.hpp"
#include "step.hpp"

#include <array>
#include <exception>
#include <mutex>
#include <vector>

namespace potential_particles {

class Ig2_Flat_ConicPP;
class Law2_ScGeomConicPP_ConicJointPhys;

class Serving {
public:
    // listed: the number of the lists of contacts (Pushes).
    Serving(yade::Scene& scene, Step& step, const yade::InteractionLoop& loop, std::uint64_t listed);

    // What a thread keeps from pair to pair.
    struct Thread {
        LastTangent tangent;
        std::array<std::uint64_t, 256> sleeping {}; // pairs, by functor
        std::vector<Counters::Row*> counts {}; // of each functor of ours
        std::vector<std::size_t> missing {}; // places of contacts that are in no list of Pushes
    };

    Thread open() const;
    // The pair at that place of YADE's list.
    void serve(std::size_t place, Thread& thread);
    // Takes in what the thread has counted and found.
    void close(const Thread& thread);

    // Places of pairs for which YADE's loop must find a functor.
    const std::vector<std::size_t>& left() const { return places; }
    // Places of contacts that push and are in no list.
    const std::vector<std::size_t>& missing() const { return unlisted; }
    // Throws what a functor has thrown.
    void rethrow() const;

private:
    struct Functor {
        const yade::IGeomFunctor* functor;
        Ig2_ConicPP_ConicPP_ScGeom* ours; // null: go() is called
        Ig2_Flat_ConicPP* flat; // the same, if it is one
    };
    struct Law {
        const yade::LawFunctor* functor;
        yade::Law2_ScGeom_FrictPhys_CundallStrack* cundallStrack;
        yade::Law2_SCG_KnKsPhys_KnKsLaw* knKs;
        Law2_ScGeomConicPP_ConicJointPhys* joint;
    };

    void serveAwake(std::size_t place, PairInStep& known, Thread& thread);
    // False where there is none, or where that is left to YADE's loop.
    bool findGeomFunctor(std::size_t place, yade::Interaction& pair);
    bool findLaw(yade::Interaction& pair) const;
    // False when the contact is over.
    bool push(std::size_t place, PairInStep& known, yade::Interaction& pair, const BodyInStep& one,
              const BodyInStep& other, Thread& thread);
    void leave(std::size_t place);
    yade::Body* bodyOf(int id) const;

    yade::Scene& scene;
    Step& step;
    const yade::IGeomDispatcher& geoms;
    const yade::IPhysDispatcher& physics;
    const yade::LawDispatcher& laws;
    const std::vector<boost::shared_ptr<yade::Interaction>>& pairs;
    const std::uint64_t listed;
    std::vector<Functor> functors; // numbered from 1 in PairInStep
    std::vector<Law> knownLaws;

    std::mutex mutex; // of these
    std::vector<std::size_t> places, unlisted;
    std::exception_ptr thrown;
};

} // namespace potential_particles
