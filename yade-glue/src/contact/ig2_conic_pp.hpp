// SPDX-License-Identifier: GPL-3.0-or-later
//
// The contact functors: potential particles to ScGeom.
#pragma once

#include "abi/archive.hpp"
#include "abi/functor.hpp"
#include "contact_settings.hpp"
#include "counters.hpp"
#include "failure_report.hpp"
#include "registration/class_table.hpp"
#include "shape/published.hpp"

#include <atomic>
#include <boost/python/dict.hpp>
#include <boost/python/list.hpp>

namespace yade {
class ScGeom;
}

namespace potential_particles {

class Particle;
struct PairInScene;
class Step;
class BodyInStep;
struct PairInStep;

// For two ConicPotentialParticle shapes and, in the classes derived from it, for any two shapes that are particles.
// go() runs in many threads at once, without the lock of Python: it calls no Python, and no exception leaves it.
class Ig2_ConicPP_ConicPP_ScGeom : public yade::IGeomFunctor {
public:
    Ig2_ConicPP_ConicPP_ScGeom();
    ~Ig2_ConicPP_ConicPP_ScGeom() override;
    PP_ABI_SERIALIZABLE_OVERRIDES

    PP_FUNCTOR_2D_TYPES

    bool go(const boost::shared_ptr<yade::Shape>& shape1, const boost::shared_ptr<yade::Shape>& shape2,
            const yade::State& state1, const yade::State& state2, const yade::Vector3r& shift2, const bool& force,
            const boost::shared_ptr<yade::Interaction>& interaction) noexcept override;
    bool goReverse(const boost::shared_ptr<yade::Shape>& shape1, const boost::shared_ptr<yade::Shape>& shape2,
                   const yade::State& state1, const yade::State& state2, const yade::Vector3r& shift2,
                   const bool& force, const boost::shared_ptr<yade::Interaction>& interaction) noexcept override;

    // The same in a loop of our own outside of periodic cells, which has gathered the bodies; with flat boundaries
    // theirs.
    bool goInLoop(Step& step, Counters::Row& counts, BodyInStep& body1, BodyInStep& body2, PairInStep& pairInStep,
                  const boost::shared_ptr<yade::Interaction>& interaction) noexcept;
    // Where this thread counts.
    Counters::Row& counts() { return counters.ofThisThread(); }
    // What go() counts, for pairs that such a loop skips.
    static void countSleeping(Counters::Row& counts, std::uint64_t pairs);

protected:
    struct Posed {
        const Particle* particle;
        pp_pose pose;
    };

    // One call of go() or goInLoop(): `answer` takes what is known of the call, with the settings of this moment; what
    // it throws is reported, and the pair stays as it is. counts: null for this thread's.
    template <class Answer>
    bool served(const yade::State& state1, const yade::State& state2, const yade::Vector3r& shift2, bool force,
                const boost::shared_ptr<yade::Interaction>& interaction, Counters::Row* counts, Answer answer) noexcept;
    // Each ends the step for a pair; true if YADE is to go on with it. The first for one that does not touch, the
    // second for one of which that is not known.
    bool leaveApart(PairInScene& pair);
    bool keep(PairInScene& pair);
    // Area and points for KnKsPhys, if the pair has it. patchArea: 0 for a contact at its point.
    void fillPhysics(PairInScene& pair, const Posed& body1, const Posed& body2, const pp_contact& found,
                     double patchArea);
    // Point, normal and overlap of the patch instead of those of the point; false without a patch. `origin`: of its
    // positions; `sense`: -1 if its force, which is on its own second body, is on body 1.
    bool fillPatch(PairInScene& pair, pp_status status, const pp_patch& patch, const yade::Vector3r& origin,
                   double sense);
    static double areaAtPoint(const PairInScene& pair, const Posed& body1, const Posed& body2, const pp_contact& found);
    bool tracksEnergy() const;
    void fail(const PairInScene& pair, const std::string& why);
    void fail(const yade::Interaction& interaction, const yade::State& state1, const yade::State& state2,
              const yade::Vector3r& shift2, const char* why) noexcept;

    // Counts an overlap beyond the rounding radius, and says the first one on stderr.
    void lookAtDepth(const yade::Interaction& pair, double rounding, double overlap, Counters::Row& counts) noexcept;

    Published<AcceptedSettings> accepted;
    Counters counters;
    std::atomic<bool> saidDepth { false };

private:
    PP_ARCHIVED

    struct Pair; // the arguments of one call, put in order
    bool answer(Pair& pair);
    bool contact(Pair& pair);
    bool acrossGap(Pair& pair);
    pp_status detect(Pair& pair, pp_contact& found);
    void fill(Pair& pair, pp_contact& found);

    void settle();
    boost::python::list pyFailureReport() const;
    boost::python::dict pyAnswers() const;
    std::uint64_t pyRejected() const;
    std::uint64_t pySolved() const;
    double pySkippedShare() const;
    double pySeconds() const;
    double pyBusiestSeconds() const;
    void pyResetCounters();

    // Python and archives write `written`, with Python's lock; settle() checks and publishes it. go() reads `accepted`
    // alone, once, so that settings may change at any time: each answer belongs to one whole value of them.
    ContactSettings written;
    FailureReport failures;
};

// The same for every pair of potential particles, YADE's own PotentialParticle among them: takes
// the place of Ig2_PP_PP_ScGeom in a script. Particles of plain shapes come from the ParticleStore.
class Ig2_PP_PP_ScGeom_Conic final : public Ig2_ConicPP_ConicPP_ScGeom {
public:
    ~Ig2_PP_PP_ScGeom_Conic() override;
    PP_FUNCTOR_2D_OVERRIDES

private:
    PP_ARCHIVED
};

} // namespace potential_particles
