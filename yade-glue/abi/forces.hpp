// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where a law puts forces and energies: ForceContainer and EnergyTracker, both of a Scene and never made here.
#pragma once

#include "serializable.hpp"

namespace yade {

// Reached only through Scene::forces, so no field of it is declared. Adding is safe in many threads at once.
class ForceContainer {
public:
    ForceContainer() = delete;
    ForceContainer(const ForceContainer&) = delete;
    void addForce(int id, const Vector3r& force);
    void addTorque(int id, const Vector3r& torque); // about the body's position
    // Sums of what all threads have added, to be read after sync().
    void sync();
    const Vector3r& getForce(int id);
    const Vector3r& getTorque(int id);
    int getNumAllocatedThreads() const;
};

class EnergyTracker : public Serializable {
public:
    EnergyTracker() = delete;
    ~EnergyTracker() override;
    PP_ABI_SERIALIZABLE_OVERRIDES

    // Adds to the energy of that name; `number`, -1 before the first call, becomes the place where it is kept.
    // `ofStep`: it begins from 0 in each step.
    void add(const Real& value, const std::string& name, int& number, bool ofStep);
};

} // namespace yade
