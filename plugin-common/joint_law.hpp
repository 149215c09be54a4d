// SPDX-License-Identifier: MIT OR Apache-2.0
//
// The law of joints: forces and moments of a contact patch, and of a bond. Derived in docs/joint_law.md.
#pragma once

#include "contact_patch.hpp"
#include "joint.hpp"
#include "strength.hpp"
#include "patch_rim.hpp"

namespace potential_particles {

// A joint in one step: step(), or a repetition of the last one.
class [[gnu::visibility("hidden")]] JointLaw
{
public:
    // sides: what else its bodies held in the last step. Where a body that moves has none known, which is so in the
    // first step of a joint, no dashpot acts.
    JointLaw(const JointParameters& joint, JointMemory& memory, const JointBody& one, const JointBody& other,
             const JointSides& sides, double dt)
        : joint(joint)
        , memory(memory)
        , one(one)
        , other(other)
        , sides(sides)
        , dt(dt)
    {
    }

    // One step. patch: none if the bodies are apart, or if the bond holds and the contact was not sought (not
    // mayEnd); motion(): of the patch; posed(1), posed(2): the shapes, for a patch that becomes a bond. Returns
    // whether a bond holds the bodies.
    template <class Motion, class Posed>
    bool step(const ContactPatch* patch, bool mayEnd, Motion&& motion, Posed&& posed)
    {
        if (memory.bondArea > 0 && holdAsBond(mayEnd))
            return true;
        if (!patch) {
            open();
            return false;
        }
        const JointMotion here = motion();
        holdAsPatch(*patch, here);
        // It shall become a bond.
        if (memory.bonded && !(memory.bondArea > 0))
            bond(*patch, here, posed(1), posed(2));
        return false;
    }

    const JointForces& forces() const { return all; }

    // The forces of the last step once more, for poses that have not changed: nothing is remembered, and dashpots do
    // what they did. Of a patch that became a bond in that step, those of the bond.
    void repeatAsBond(const Wrench& damping);
    void repeatAsPatch(const ContactPatch& patch, const JointMotion& motion, const Wrench& damping);

private:
    // A bond that reaches its strength holds for this step, in which the contact may not have been sought, and is
    // ended in the next one, as if `bonded` had been set to false. False when it is ended: what it held along the
    // joint is left to the springs of the patch, for open() or holdAsPatch() to continue with. mayEnd: the contact
    // was sought.
    bool holdAsBond(bool mayEnd);
    void holdAsPatch(const ContactPatch& patch, const JointMotion& motion);
    // The bodies are apart.
    void open();

    void bond(const ContactPatch& patch, const JointMotion& motion, const PosedShape& shape1, const PosedShape& shape2);

    // The springs along the joint: their extension, and turn about the normal.
    struct Springs {
        Eigen::Vector3d shear;
        double twist;
    };

    Wrench dashpotAcross(const ContactPatch& patch, const JointMotion& motion) const;
    Springs springsAlong(const JointMotion& motion);
    FrictionForce slip(const ContactPatch& patch, double pressing, Springs& springs);
    void dampAlong(const ContactPatch& patch, const JointMotion& motion, const FrictionForce& limit);
    Wrench dashpotOfBond(const BondStrain& strain) const;
    void takeStiffness(const ContactPatch& patch);
    void pushAsBond(const BondStrain& strain, const Wrench& damping);
    void push();
    // How the bodies as a whole oppose this joint in a direction: the mobilities of both at the centres of all that
    // they press on that side, each times the share of all that over this joint; nothing where a share is not
    // known.
    struct Opposed {
        double one = 0, other = 0;
        double both() const { return one + other; }
    };
    Opposed opposedAt(const Eigen::Vector3d& point, const Eigen::Vector3d& direction) const;
    double dashpotPerArea(double stiffness, double opposed, double area) const;
    struct Region;
    Region regionOf(const ContactPatch& patch, const Opposed& opposed, const Eigen::Vector3d& direction) const;
    void remember(const ContactPatch& patch, const JointMotion& motion);
    double energyAlong(const Springs& springs) const;
    double turning(const Eigen::Vector3d& normal) const { return (other.spin - one.spin).dot(normal); }

    const JointParameters& joint;
    JointMemory& memory;
    const JointBody &one, &other;
    const JointSides& sides;
    const double dt;
    bool bondEnded = false; // in this step: its springs along the joint are now those of the patch
    JointForces all;
};

} // namespace potential_particles
