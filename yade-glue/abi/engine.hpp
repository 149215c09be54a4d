// SPDX-License-Identifier: GPL-3.0-or-later
//
// Engine: what a scene runs in each step, in the order of its list.
#pragma once

#include "serializable.hpp"

namespace yade {

class TimingDeltas;

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

} // namespace yade
