// SPDX-License-Identifier: MIT OR Apache-2.0
//
// A bond: an area that stays with both bodies and holds them together by springs, against opening, bending, shear and
// twist.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <cmath>
#include <vector>

namespace potential_particles {

// The bond has an end on each body, with a point and axes (x along the normal, y and z the principal axes of the area)
// that coincided when it was made. u is the displacement of end 2 from end 1 in axes midway between both, t the
// rotation vector from the axes of end 1 to those of end 2. With the area A and its second moments, plus what the joint
// held when it was bonded, u0 and t0,
//
//     W = 1/2 kn (A u_x^2 + By t_y^2 + Bz t_z^2) + 1/2 ks (A (u_y^2 + u_z^2) + J t_x^2),    u + u0 for u, t + t0 for t
//
// Force and torques are minus its derivatives. u and t only change sign when the bodies are exchanged, and rigid
// motions of both change neither.
struct Bond {
    bool bonded = false; // or, without an area yet, shall be
    double damage = 0; // share of the stiffness that softening has taken, 0 to 1
    double bondArea = 0; // 0: there is none
    Eigen::Vector3d bondMoments = Eigen::Vector3d::Zero(); // J, and the second moments against bending about y and z
    Eigen::Vector3d bondPoint1 = Eigen::Vector3d::Zero(),
                    bondPoint2 = Eigen::Vector3d::Zero(); // of the ends, from the centres, local axes
    Eigen::Quaterniond bondTurn1 = Eigen::Quaterniond::Identity(), bondTurn2 = Eigen::Quaterniond::Identity();
    Eigen::Vector3d bondDisplacement = Eigen::Vector3d::Zero(), bondRotation = Eigen::Vector3d::Zero(); // u0, t0
    std::vector<double> bondRim; // corners, y and z in turn

    void endBond()
    {
        bonded = false;
        damage = bondArea = 0;
        bondMoments = bondPoint1 = bondPoint2 = bondDisplacement = bondRotation = Eigen::Vector3d::Zero();
        bondTurn1 = bondTurn2 = Eigen::Quaterniond::Identity();
        bondRim.clear();
    }
};

// A body as its bond sees it.
struct BondedBody {
    const Eigen::Vector3d& position;
    const Eigen::Quaterniond& turn;
};

// Stiffnesses of the bond per area.
struct BondStiffness {
    double normal, shear;
};

// On body 2, about a point that is said with it.
struct Wrench {
    Eigen::Vector3d force { 0, 0, 0 }, moment { 0, 0, 0 };
};

// How the ends of a bond lie to each other now.
class BondStrain {
public:
    BondStrain(const Bond& bond, const BondedBody& one, const BondedBody& other);

    double energy(const BondStiffness& stiffness, double damage) const;

    // Force on end 2, and the torques on both ends about their own points, world axes.
    struct Reaction {
        Eigen::Vector3d force, torque1, torque2;
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

    const Eigen::Vector3d& point1() const { return end1; }
    const Eigen::Vector3d& point2() const { return end2; }
    Eigen::Vector3d middle() const { return 0.5 * (end1 + end2); }
    Eigen::Vector3d normal() const { return axes.col(0); }
    // Displacement along the joint, world axes, and rotation about its normal.
    Eigen::Vector3d slip() const { return axes.col(1) * displacement.y() + axes.col(2) * displacement.z(); }
    double twist() const { return rotation.x(); }

    // Of dashpots over the area, perArea across and along it, at middle(). velocity, spin: of body 2 against body 1.
    Wrench dashpot(const BondStiffness& perArea, const Eigen::Vector3d& velocity, const Eigen::Vector3d& spin) const;

private:
    using Matrix = Eigen::Matrix3d;

    const Bond& bond;
    Eigen::Vector3d end1, end2;
    Matrix axes; // midway
    Eigen::Vector3d displacement, rotation;
    Matrix ofRotation; // d rotation = ofRotation (spin of body 2 less that of body 1), midway axes
    Eigen::Vector3d axisPart; // axis times tan(angle / 4), world axes
};

} // namespace potential_particles
