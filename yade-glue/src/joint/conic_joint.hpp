// SPDX-License-Identifier: GPL-3.0-or-later
//
// Joints between potential particles: the material, the physics, and the functor from the one to the other.
#pragma once

#include "abi/archive.hpp"
#include "abi/functor.hpp"
#include "abi/knksphys.hpp"
#include "abi/material.hpp"

#include "registration/class_table.hpp"

#include "plugin-common/joint.hpp"

namespace potential_particles {

class ConicJointMat final : public yade::FrictMat {
public:
    ConicJointMat();
    ~ConicJointMat() override;
    PP_ABI_SERIALIZABLE_OVERRIDES
    PP_ABI_INDEX_OVERRIDES

    double normalStiffness = 0;
    double shearStiffness = 0;
    double restitution = 1;
    double cohesion = 0;
    double tensileStrength = 0;
    double residualFrictionAngle = -1;
    double residualCohesion = 0;
    double softening = 0;

    template <class Visit> static void eachAttribute(Visit&& visit)
    {
        using M = ConicJointMat;
        visit(
            "normalStiffness", &M::normalStiffness,
            "Normal stiffness per area, N/m^3; 0: young over twice the bounding radius of the body. A joint takes the "
            "harmonic mean of its two bodies.");
        visit("shearStiffness", &M::shearStiffness,
              "Shear stiffness per area, N/m^3; 0: poisson times the normal one.");
        visit("restitution", &M::restitution,
              "Coefficient of restitution of a head-on impact, 0.01 to 1; a joint takes the smaller one of its two "
              "bodies. 1: no dashpot.");
        // A joint takes the smaller value of its two bodies, as of frictionAngle.
        visit("cohesion", &M::cohesion, "Shear strength without pressure, Pa.", 1);
        visit("tensileStrength", &M::tensileStrength, "Tensile strength of bonds, Pa.", 1);
        visit("residualFrictionAngle", &M::residualFrictionAngle,
              "Friction angle of a joint that has broken, radians; -1: frictionAngle.", 1);
        visit("residualCohesion", &M::residualCohesion, "Cohesion of a joint that has broken, Pa.", 1);
        visit("softening", &M::softening,
              "Opening or slip, m, over which the stress in a bond falls from the strength to 0; 0: bonds are brittle.",
              1);
    }

private:
    PP_ARCHIVED
};

// kn and ks of its bases are those of the whole patch, N/m; normalForce and shearForce act on body 2.
class ConicJointPhys final : public yade::FrictPhys, public JointMemory {
public:
    ConicJointPhys();
    ~ConicJointPhys() override;
    PP_ABI_SERIALIZABLE_OVERRIDES
    PP_ABI_INDEX_OVERRIDES

    double normalStiffness = 0;
    double shearStiffness = 0;
    double dampingRatio = 0;
    double twistStiffness = 0;
    double twistMoment = 0;
    double couple = 0;
    bool isSliding = false;
    double cohesion = 0;
    double residualCohesion = 0;
    double tangensOfResidualFrictionAngle = 0;
    double tensileStrength = 0;
    double softening = 0;
    yade::Vector3r bendingMoment = yade::Vector3r::Zero();

    JointParameters parameters() const
    {
        return { normalStiffness, shearStiffness,  tangensOfFrictionAngle,         dampingRatio,
                 cohesion,        tensileStrength, tangensOfResidualFrictionAngle, residualCohesion,
                 softening };
    }
    // What the springs along the joint hold, as scripts and files have it.
    void rememberEnergyAlong()
    {
        energyAlong = 0.5 * (ks * shearDisplacement.squaredNorm() + twistStiffness * twist * twist);
    }
    void take(const JointForces& forces);

    template <class Visit> static void eachAttribute(Visit&& visit)
    {
        using P = ConicJointPhys;
        visit("normalStiffness", &P::normalStiffness, "Normal stiffness per area, N/m^3.");
        visit("shearStiffness", &P::shearStiffness, "Shear stiffness per area, N/m^3.");
        visit("dampingRatio", &P::dampingRatio,
              "Dashpot over the critical one, from the restitution of the materials.");
        visit("shearDisplacement", &P::shearDisplacement,
              "Elastic part of the displacement of body 2 against body 1 along the joint, world axes, m.");
        visit("twist", &P::twist, "Elastic part of the turn of body 2 against body 1 about the normal, radians.");
        visit("twistStiffness", &P::twistStiffness,
              "Stiffness against it, N m: shear stiffness per area times the polar moment.");
        visit("twistMoment", &P::twistMoment, "Moment of friction on body 2 about the normal, N m.");
        visit("couple", &P::couple, "Moment of the pressure on body 2 about the normal, N m.");
        visit("isSliding", &P::isSliding, "Whether friction was at its limit in the last step.");
        visit("cohesion", &P::cohesion, "Shear strength without pressure, Pa.", 1);
        visit("residualCohesion", &P::residualCohesion, "The same once the joint has broken, Pa.", 1);
        visit("tangensOfResidualFrictionAngle", &P::tangensOfResidualFrictionAngle,
              "Tangent of the friction angle once it has broken.", 1);
        visit("tensileStrength", &P::tensileStrength, "Tensile strength of the bond, Pa.", 1);
        visit("softening", &P::softening,
              "Opening or slip over which the stress in the bond falls to 0, m; 0: brittle.", 1);
        visit("broken", &P::broken,
              "Whether the joint has the residual values: it has slipped, opened, or was made later.", 1);
        visit("bonded", &P::bonded,
              "Whether the bodies are bonded. Set to True, the patch of the next step becomes a bond; set to False, "
              "the bond ends.",
              1);
        visit("damage", &P::damage, "Share of the stiffness that softening has taken from the bond, 0 to 1.", 1);
        visit("bondArea", &P::bondArea, "Area of the bond, m^2; 0 without one.", 1);
        visit("bondMoments", &P::bondMoments,
              "Polar moment of the bonded area about its centroid, and its second moments against bending about y and "
              "z of the bond, m^4.",
              1);
        visit("bondPoint1", &P::bondPoint1, "Centroid of the bonded area, axes of body 1, from its centre, m.", 1);
        visit("bondPoint2", &P::bondPoint2, "The same of body 2.", 1);
        visit("bondTurn1", &P::bondTurn1,
              "Axes of the bond in those of body 1: x is the normal, y and z principal axes of the area.", 1);
        visit("bondTurn2", &P::bondTurn2, "The same in those of body 2.", 1);
        visit("bondDisplacement", &P::bondDisplacement,
              "Displacement of its springs when it was made, axes of the bond, m.", 1);
        visit("bondRotation", &P::bondRotation, "Rotation of its springs when it was made, axes of the bond, radians.",
              1);
        visit("bondRim", &P::bondRim, "Corners of the bonded area: y and z in turn, axes of the bond, m.", 1);
        visit("bendingMoment", &P::bendingMoment,
              "Moment of the bond on body 2 across the normal, about the centroid, N m.", 1);
        visit(
            "heldStiffness", &P::heldStiffness,
            "What the other joints of its bodies take from this one in the next step: its stiffness across, N/m; 0: it "
            "is new.",
            2);
        visit("heldForce", &P::heldForce, "The same: force of the springs across it, N.", 2);
        visit("heldNormal", &P::heldNormal, "The same: normal from body 1 to body 2.", 2);
        visit("heldPoint", &P::heldPoint, "The same: centre of pressure, m.", 2);
        visit("heldCentroid", &P::heldCentroid, "The same: centroid from there, m.", 2);
        visit("heldSpread", &P::heldSpread,
              "The same: second moments xx, yy, zz about the centroid over the area, m^2.", 2);
        visit("heldSpreadAcross", &P::heldSpreadAcross, "The same: yz, zx, xy.", 2);
    }

private:
    PP_ARCHIVED
};

class Ip2_ConicJointMat_ConicJointMat_ConicJointPhys final : public yade::IPhysFunctor {
public:
    ~Ip2_ConicJointMat_ConicJointMat_ConicJointPhys() override;
    PP_ABI_SERIALIZABLE_OVERRIDES

    PP_FUNCTOR_2D_TYPES

    void go(const boost::shared_ptr<yade::Material>& material1, const boost::shared_ptr<yade::Material>& material2,
            const boost::shared_ptr<yade::Interaction>& interaction) override;

    bool bonds = false;
    long cohesiveTresholdIteration = 1;

    template <class Visit> static void eachAttribute(Visit&& visit)
    {
        using Ip2 = Ip2_ConicJointMat_ConicJointMat_ConicJointPhys;
        visit("bonds", &Ip2::bonds, "Whether joints made before cohesiveTresholdIteration are bonded.", 1);
        visit("cohesiveTresholdIteration", &Ip2::cohesiveTresholdIteration,
              "Joints made before this step are whole; later ones have the residual values from the start.", 1);
    }

private:
    PP_ARCHIVED
};

} // namespace potential_particles
