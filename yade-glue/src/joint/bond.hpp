// SPDX-License-Identifier: GPL-3.0-or-later
//
// A bond: an area that stays with both bodies and holds them together by springs, against opening, bending, shear and twist.
#pragma once

#include "abi/base.hpp"

#include <cmath>
#include <vector>

namespace potential_particles {

// The bond has an end on each body, with a point and axes (x along the normal, y and z the principal axes of the area) that
// coincided when it was made. u is the displacement of end 2 from end 1 in axes midway between both, t the rotation vector from the
// axes of end 1 to those of end 2. With the area A and its second moments, plus what the joint held when it was bonded, u0 and t0,
//
//     W = 1/2 kn (A u_x^2 + By t_y^2 + Bz t_z^2) + 1/2 ks (A (u_y^2 + u_z^2) + J t_x^2),    u + u0 for u, t + t0 for t
//
// Force and torques are minus its derivatives. u and t only change sign when the bodies are exchanged, and rigid motions of both
// change neither.
struct Bond {
    bool bonded = false;
    double damage = 0;
    double bondArea = 0; // 0: there is none
    yade::Vector3r bondMoments = yade::Vector3r::Zero();
    yade::Vector3r bondPoint1 = yade::Vector3r::Zero(), bondPoint2 = yade::Vector3r::Zero();
    yade::Quaternionr bondTurn1 = yade::Quaternionr::Identity(), bondTurn2 = yade::Quaternionr::Identity();
    yade::Vector3r bondDisplacement = yade::Vector3r::Zero(), bondRotation = yade::Vector3r::Zero();
    std::vector<double> bondRim;
    yade::Vector3r bendingMoment = yade::Vector3r::Zero();

    template <class Visit> static void eachAttribute(Visit&& visit)
    {
        using B = Bond;
        visit("bonded", &B::bonded,
              "Whether the bodies are bonded. Set to True, the patch of the next step becomes a bond; set to False, the bond ends.", 1);
        visit("damage", &B::damage, "Share of the stiffness that softening has taken from the bond, 0 to 1.", 1);
        visit("bondArea", &B::bondArea, "Area of the bond, m^2; 0 without one.", 1);
        visit("bondMoments", &B::bondMoments,
              "Polar moment of the bonded area about its centroid, and its second moments against bending about y and z of the "
              "bond, m^4.", 1);
        visit("bondPoint1", &B::bondPoint1, "Centroid of the bonded area, axes of body 1, from its centre, m.", 1);
        visit("bondPoint2", &B::bondPoint2, "The same of body 2.", 1);
        visit("bondTurn1", &B::bondTurn1, "Axes of the bond in those of body 1: x is the normal, y and z principal axes of the area.", 1);
        visit("bondTurn2", &B::bondTurn2, "The same in those of body 2.", 1);
        visit("bondDisplacement", &B::bondDisplacement, "Displacement of its springs when it was made, axes of the bond, m.", 1);
        visit("bondRotation", &B::bondRotation, "Rotation of its springs when it was made, axes of the bond, radians.", 1);
        visit("bondRim", &B::bondRim, "Corners of the bonded area: y and z in turn, axes of the bond, m.", 1);
        visit("bendingMoment", &B::bendingMoment, "Moment of the bond on body 2 across the normal, about the centroid, N m.", 1);
    }

    void endBond()
    {
        bonded = false;
        damage = bondArea = 0;
        bondMoments = bondPoint1 = bondPoint2 = bondDisplacement = bondRotation = bendingMoment = yade::Vector3r::Zero();
        bondTurn1 = bondTurn2 = yade::Quaternionr::Identity();
        bondRim.clear();
    }
};

// A body as its bond sees it.
struct BondedBody {
    const yade::Vector3r& position;
    const yade::Quaternionr& turn;
};

// Stiffnesses of the bond per area.
struct BondStiffness {
    double normal, shear;
};

// On body 2, about a point that is said with it.
struct Wrench {
    yade::Vector3r force, moment;
};

// How the ends of a bond lie to each other now.
class BondStrain {
public:
    BondStrain(const Bond& bond, const BondedBody& one, const BondedBody& other);

    double energy(const BondStiffness& stiffness, double damage) const;

    // Force on end 2, and the torques on both ends about their own points, world axes.
    struct Reaction {
        yade::Vector3r force, torque1, torque2;
    };
    Reaction reaction(const BondStiffness& stiffness) const;

    // At a point of the bonded area, without the loss by damage: opening, and the size of the slip.
    struct Gap {
        double opening, slip;
    };
    Gap gap(double y, double z) const
    {
        return { displacement.x() + rotation.y() * z - rotation.z() * y,
                 std::hypot(displacement.y() - rotation.x() * z, displacement.z() + rotation.x() * y) };
    }

    const yade::Vector3r& point1() const { return end1; }
    const yade::Vector3r& point2() const { return end2; }
    yade::Vector3r middle() const { return 0.5 * (end1 + end2); }
    yade::Vector3r normal() const { return axes.col(0); }
    // Displacement along the joint, world axes, and rotation about its normal.
    yade::Vector3r slip() const { return axes.col(1) * displacement.y() + axes.col(2) * displacement.z(); }
    double twist() const { return rotation.x(); }

    // Of dashpots over the area, so much per area across and along it, at middle(). velocity, spin: of body 2 against body 1.
    Wrench dashpot(const BondStiffness& perArea, const yade::Vector3r& velocity, const yade::Vector3r& spin) const;

private:
    using Matrix = Eigen::Matrix3d;

    const Bond& bond;
    yade::Vector3r end1, end2;
    Matrix axes; // midway
    yade::Vector3r displacement, rotation;
    Matrix ofRotation; // d rotation = ofRotation (spin of body 2 less that of body 1), midway axes
    yade::Vector3r axisPart; // axis times tan(angle / 4), world axes
};

} // namespace potential_particles
