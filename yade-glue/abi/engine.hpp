// SPDX-License-Identifier: GPL-3.0-or-later
//
// Engine, what a scene runs in each step, down to InteractionLoop, the one that visits all interactions.
#pragma once

#include "serializable.hpp"

#include <utility>

namespace yade {

class TimingDeltas;
class IGeomDispatcher;
class IPhysDispatcher;
class LawDispatcher;
class IntrCallback;

class Engine : public Serializable {
public:
    Engine();
    ~Engine() override;
    PP_ABI_SERIALIZABLE_OVERRIDES
    virtual bool isActivated();
    virtual void action();

    Scene* scene; // set before each step
    struct {
        long nExec;
        unsigned long long nsec;
    } timingInfo;
    boost::shared_ptr<TimingDeltas> timingDeltas;
    bool dead;
    int ompThreads;
    std::string label;
};
PP_ABI_SIZE(Engine, 104);
PP_ABI_OFFSET(Engine, scene, 24);
PP_ABI_OFFSET(Engine, timingInfo, 32);
PP_ABI_OFFSET(Engine, timingDeltas, 48);
PP_ABI_OFFSET(Engine, dead, 64);
PP_ABI_OFFSET(Engine, ompThreads, 68);
PP_ABI_OFFSET(Engine, label, 72);

class GlobalEngine : public Engine {
public:
    GlobalEngine() { }
    ~GlobalEngine() override;
    PP_ABI_SERIALIZABLE_OVERRIDES
};
PP_ABI_SIZE(GlobalEngine, 104);

class InteractionLoop : public GlobalEngine {
public:
    InteractionLoop();
    ~InteractionLoop() override;
    PP_ABI_SERIALIZABLE_OVERRIDES
    void pyHandleCustomCtorArgs(boost::python::tuple& args, boost::python::dict& keywords) override;
    void action() override;

private:
    bool alreadyWarnedNoCollider;
    std::vector<std::vector<std::pair<int, int>>>
        eraseAfterLoopIds; // lists, one for each thread; of one size with this

public:
    boost::shared_ptr<IGeomDispatcher> geomDispatcher;
    boost::shared_ptr<IPhysDispatcher> physDispatcher;
    boost::shared_ptr<LawDispatcher> lawDispatcher;
    std::vector<boost::shared_ptr<IntrCallback>> callbacks;
    bool loopOnSortedInteractions;
};
PP_ABI_SIZE(InteractionLoop, 216);
PP_ABI_OFFSET(InteractionLoop, geomDispatcher, 136);
PP_ABI_OFFSET(InteractionLoop, loopOnSortedInteractions, 208);

} // namespace yade
