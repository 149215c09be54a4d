// SPDX-License-Identifier: MIT OR Apache-2.0
#include "joint_law.hpp"

#include "strength.hpp"

#include <algorithm>
#include <cmath>

namespace potential_particles {

using Eigen::Vector3d;

namespace {

    // A symmetric matrix without its diagonal, given as yz, zx, xy, times a vector.
    Vector3d timesAcross(const Vector3d& across, const Vector3d& vector)
    {
        return { across.z() * vector.y() + across.y() * vector.z(), across.z() * vector.x() + across.x() * vector.z(),
                 across.y() * vector.x() + across.x() * vector.y() };
    }

} // namespace

// A body swings on all joints of one side at once, of the stiffness K_b, with the circular frequency w,
//
//     w^2 = sum over both bodies of K_b u_b,    u_b the mobility at the centre of what it presses there,
//
// and dashpots of the ratio z to the critical one are 2 z/w times the springs. K_b is that of this joint now times what
// it was of it in the last step: so that all dashpots of a side together never exceed those of one joint, whatever
// comes and goes between two steps.
JointLaw::Opposed JointLaw::opposedAt(const Vector3d& point, const Vector3d& direction) const
{
    bool known = true;
    const auto of = [&](const JointBody& body, const JointSide& side) {
        const double mobility
            = body.mobility(side.force > 0 ? Vector3d(point + 1 / (1 + side.force) * side.pressed) : point, direction);
        known = known && (side.known || !(mobility > 0));
        return mobility * (1 + side.stiffness);
    };
    const Opposed opposed { of(one, sides.one), of(other, sides.other) };
    return known ? opposed : Opposed {};
}

// 2 z/w times their stiffness per area.
double JointLaw::dashpotPerArea(double stiffness, double opposed, double area) const
{
    return opposed > 0 ? 2 * joint.dampingRatio * std::sqrt(stiffness / (opposed * area)) : 0;
}

// All that the bodies press on that side, over what this joint is of it: from its centre of pressure.
struct JointLaw::Region {
    double area, force;
    Vector3d centroid, point;
    Vector3d moved; // second moments about the centroid over the area, times a direction
};

JointLaw::Region JointLaw::regionOf(const ContactPatch& patch, const Opposed& opposed, const Vector3d& direction) const
{
    Region region { 1, 1, patch.centroid, { 0, 0, 0 }, 1 / patch.area * (patch.secondMoment * direction) };
    if (!(sides.one.stiffness > 0 || sides.other.stiffness > 0))
        return region;
    region.moved += patch.centroid * patch.centroid.dot(direction);
    const auto add = [&](const JointSide& side, double share) {
        region.area += share * side.stiffness;
        region.force += share * side.force;
        region.centroid += share * side.first;
        region.point += share * side.pressed;
        region.moved += share * (side.second.cwiseProduct(direction) + timesAcross(side.secondAcross, direction));
    };
    const double over = 1 / opposed.both();
    add(sides.one, opposed.one * over);
    add(sides.other, opposed.other * over);
    const double overArea = 1 / region.area;
    region.centroid *= overArea;
    region.point *= 1 / region.force;
    region.moved = region.moved * overArea - region.centroid * region.centroid.dot(direction);
    return region;
}

// For the other joints of its bodies in the next step.
void JointLaw::remember(const ContactPatch& patch, const JointMotion& motion)
{
    memory.heldStiffness = joint.normalStiffness * patch.area;
    memory.heldForce = joint.normalStiffness * patch.force;
    memory.heldNormal = motion.normal;
    memory.heldPoint = motion.point;
    memory.heldCentroid = patch.centroid;
    memory.setSpread(patch.secondMoment, patch.area);
}

double JointLaw::energyAlong(const Springs& springs) const
{
    return 0.5
        * (all.shearStiffness * springs.shear.squaredNorm() + all.twistStiffness * springs.twist * springs.twist);
}

void JointLaw::takeStiffness(const ContactPatch& patch)
{
    all.normalStiffness = joint.normalStiffness * patch.area;
    all.shearStiffness = joint.shearStiffness * patch.area;
    all.twistStiffness = joint.shearStiffness * patch.polarMoment;
}

// The springs along the patch go with it.
void JointLaw::open()
{
    if (!bondEnded) // else its energy is counted
        all.energies.area = memory.energyAlong;
    memory.shearDisplacement = Vector3d::Zero();
    memory.twist = memory.energyAlong = 0;
    memory.broken = true;
    static_cast<JointLoad&>(memory) = {};
}

bool JointLaw::holdAsBond(bool mayEnd)
{
    const BondStrain strain(memory, { one.centre, one.turn }, { other.centre, other.turn });
    const BondStiffness stiffness { joint.normalStiffness, joint.shearStiffness };
    const double before = strain.energy(stiffness, memory.damage), left = 1 - memory.damage;
    if (!memory.bonded && mayEnd) {
        memory.shearDisplacement = left * strain.slip();
        memory.twist = left * strain.twist();
        memory.endBond();
        memory.broken = true;
        all.energies.breaking = before;
        bondEnded = true;
        return false;
    }
    const double damage = memory.bonded ? damageOf(joint, memory, strain) : 0;
    if (damage >= 1)
        memory.bonded = false;
    else
        memory.damage = std::max(memory.damage, damage);
    all.energies.elastic = strain.energy(stiffness, memory.damage);
    all.energies.breaking = before - all.energies.elastic;
    Wrench damping;
    if (joint.dampingRatio > 0) {
        damping = dashpotOfBond(strain);
        const Vector3d velocity = other.velocityAt(strain.middle()) - one.velocityAt(strain.middle());
        all.energies.viscous = -dt * (damping.force.dot(velocity) + damping.moment.dot(other.spin - one.spin));
    }
    pushAsBond(strain, damping);
    memory.heldStiffness = all.normalStiffness;
    memory.heldForce = std::max(0.0, all.normalForce.dot(all.normal));
    memory.heldNormal = all.normal;
    memory.heldPoint = all.point;
    memory.heldCentroid = Vector3d::Zero();
    const Eigen::Matrix3d axes = (one.turn * memory.bondTurn1).toRotationMatrix();
    const Vector3d moments(0, memory.bondMoments.z(), memory.bondMoments.y());
    memory.setSpread(axes * moments.asDiagonal() * axes.transpose(), memory.bondArea);
    return true;
}

Wrench JointLaw::dashpotOfBond(const BondStrain& strain) const
{
    const Vector3d n = strain.normal(), middle = strain.middle();
    const auto perArea = [&](const Vector3d& direction, double springs) {
        return dashpotPerArea(springs, opposedAt(middle, direction).both(), memory.bondArea);
    };
    return strain.dashpot({ perArea(n, joint.normalStiffness), perArea(n.unitOrthogonal(), joint.shearStiffness) },
                          other.velocityAt(middle) - one.velocityAt(middle), other.spin - one.spin);
}

void JointLaw::pushAsBond(const BondStrain& strain, const Wrench& damping)
{
    const Vector3d n = strain.normal(), middle = strain.middle();
    const BondStrain::Reaction reaction = strain.reaction({ joint.normalStiffness, joint.shearStiffness });
    const Vector3d force = reaction.force + damping.force, moment = reaction.torque2 + damping.moment;
    all.point = middle;
    all.normal = n;
    all.damping = damping;
    all.normalStiffness = joint.normalStiffness * memory.bondArea;
    all.shearStiffness = joint.shearStiffness * memory.bondArea;
    all.twistStiffness = joint.shearStiffness * memory.bondMoments.x();
    all.normalForce = force.dot(n) * n;
    all.shearForce = force - all.normalForce;
    all.twistMoment = moment.dot(n);
    all.bendingMoment = moment - all.twistMoment * n;
    const Vector3d arm1 = strain.point1() - one.centre, arm2 = strain.point2() - other.centre;
    all.onOne
        = { -force,
            reaction.torque1 - damping.moment - (middle - strain.point1()).cross(damping.force) - arm1.cross(force) };
    all.onOther
        = { force,
            reaction.torque2 + damping.moment + (middle - strain.point2()).cross(damping.force) + arm2.cross(force) };
}

void JointLaw::repeatAsBond(const Wrench& damping)
{
    const BondStrain strain(memory, { one.centre, one.turn }, { other.centre, other.turn });
    all.energies.elastic = strain.energy({ joint.normalStiffness, joint.shearStiffness }, memory.damage);
    pushAsBond(strain, damping);
}

// The patch as it is; the springs of the bond begin with what those of the joint hold.
void JointLaw::bond(const ContactPatch& patch, const JointMotion& motion, const PosedShape& shape1,
                    const PosedShape& shape2)
{
    const Vector3d& n = motion.normal;
    const PatchFrame frame(patch, { motion.point, n });
    memory.broken = false;
    memory.damage = 0;
    memory.bondArea = patch.area;
    memory.bondMoments = Vector3d(frame.alongY + frame.alongZ, frame.alongZ, frame.alongY);
    const Eigen::Quaterniond turn(frame.axes);
    memory.bondTurn1 = one.turn.conjugate() * turn;
    memory.bondTurn2 = other.turn.conjugate() * turn;
    memory.bondPoint1 = one.turn.conjugate() * (frame.centroid - one.centre);
    memory.bondPoint2 = other.turn.conjugate() * (frame.centroid - other.centre);

    const double kn = joint.normalStiffness, ks = joint.shearStiffness;
    const Vector3d held = kn * patch.force * n - all.shearStiffness * memory.shearDisplacement;
    const Vector3d force = frame.axes.transpose() * held;
    const Vector3d moment = frame.axes.transpose()
        * ((kn * patch.couple - all.twistStiffness * memory.twist) * n + (motion.point - frame.centroid).cross(held));
    const auto over = [](double load, double stiffness) { return stiffness > 0 ? -load / stiffness : 0; };
    memory.bondDisplacement = Vector3d(over(force.x(), kn * patch.area), over(force.y(), ks * patch.area),
                                       over(force.z(), ks * patch.area));
    memory.bondRotation
        = Vector3d(over(moment.x(), ks * memory.bondMoments.x()), over(moment.y(), kn * memory.bondMoments.y()),
                   over(moment.z(), kn * memory.bondMoments.z()));
    memory.bondRim.clear();
    for (const Eigen::Vector2d& corner : rimOf(patch, frame, shape1, shape2))
        memory.bondRim.insert(memory.bondRim.end(), { corner.x(), corner.y() });

    // About the middle of the bond, as of the steps that follow.
    all.damping.moment += (motion.point - frame.centroid).cross(all.damping.force);
    memory.shearDisplacement = Vector3d::Zero();
    memory.twist = memory.energyAlong = 0;
    const double energy
        = BondStrain(memory, { one.centre, one.turn }, { other.centre, other.turn }).energy({ kn, ks }, 0);
    all.energies.area += all.energies.elastic - energy;
    all.energies.elastic = energy;
}

// What pressure, springs and dashpots do, which are in `all`.
void JointLaw::push()
{
    const Vector3d force = all.normalForce + all.shearForce;
    const Vector3d moment = (all.couple + all.twistMoment) * all.normal + all.bendingMoment;
    all.onOne = { -force, -((all.point - one.centre).cross(force) + moment) };
    all.onOther = { force, (all.point - other.centre).cross(force) + moment };
}

void JointLaw::holdAsPatch(const ContactPatch& patch, const JointMotion& motion)
{
    const Vector3d& n = motion.normal;
    all.point = motion.point;
    all.normal = n;
    if (joint.dampingRatio > 0)
        all.damping = dashpotAcross(patch, motion);
    const double pressing = joint.normalStiffness * patch.force + all.damping.force.dot(n);
    const double elasticPressure = joint.normalStiffness * patch.energy;
    if (bondEnded)
        all.energies.breaking -= elasticPressure;
    takeStiffness(patch);
    Springs springs = springsAlong(motion);
    const FrictionForce limit = slip(patch, pressing, springs);
    memory.shearDisplacement = springs.shear;
    memory.twist = springs.twist;
    memory.energyAlong = energyAlong(springs);
    all.normalForce = pressing * n;
    all.shearForce = -all.shearStiffness * springs.shear;
    all.twistMoment = -all.twistStiffness * springs.twist;
    all.couple = joint.normalStiffness * patch.couple;
    all.bendingMoment = all.damping.moment;
    all.energies.elastic = elasticPressure + memory.energyAlong;
    if (joint.dampingRatio > 0) {
        all.energies.viscous = -dt
            * (all.damping.force.dot(other.velocityAt(motion.point) - one.velocityAt(motion.point))
               + all.damping.moment.dot(other.spin - one.spin));
        if (!all.slides)
            dampAlong(patch, motion, limit);
    }
    remember(patch, motion);
    push();
}

void JointLaw::repeatAsPatch(const ContactPatch& patch, const JointMotion& motion, const Wrench& damping)
{
    const Vector3d& n = motion.normal;
    all.point = motion.point;
    all.normal = n;
    all.damping = damping;
    takeStiffness(patch);
    const Vector3d shear = memory.shearDisplacement - memory.shearDisplacement.dot(n) * n;
    const Vector3d along = damping.force - damping.force.dot(n) * n;
    const double twisting = damping.moment.dot(n);
    all.normalForce = (joint.normalStiffness * patch.force + damping.force.dot(n)) * n;
    all.shearForce = along - all.shearStiffness * shear;
    all.twistMoment = twisting - all.twistStiffness * memory.twist;
    all.couple = joint.normalStiffness * patch.couple;
    all.bendingMoment = damping.moment - twisting * n;
    all.energies.elastic = joint.normalStiffness * patch.energy + memory.energyAlong;
    push();
}

// The resistance of dashpots to the approach of the bodies, at the centre of pressure. Half of them act at each edge of
// the region that the bodies press on this side, not spread over it, so that a body that lands on a face is pushed at
// the edge that lands, as in Housner. The edges: of the direction g in which the approach changes, sqrt(3) times the
// radius of gyration from the centroid, those of a rectangle along a side of it,
//
//     y = -+ sqrt(3) G g / sqrt(g.G g),
//
// with G the second moments of the region over its area. Neither edge is pulled more than the springs push there: what
// springs and dashpots do together lies within the region. Both edges together are a pressure that is linear over the
// region, of which this joint bears its part.
Wrench JointLaw::dashpotAcross(const ContactPatch& patch, const JointMotion& motion) const
{
    const Vector3d& n = motion.normal;
    const Opposed opposed = opposedAt(motion.point, n);
    if (!(opposed.both() > 0))
        return {};
    const Vector3d gradient = n.cross(other.spin - one.spin);
    const Region region = regionOf(patch, opposed, gradient);
    const double half
        = 0.5 * dashpotPerArea(joint.normalStiffness, opposed.both(), patch.area) * patch.area * region.area;
    const Vector3d centre = motion.point + region.centroid;
    const double opening = (other.velocityAt(centre) - one.velocityAt(centre)).dot(n);
    const double squared = gradient.dot(region.moved), scale = squared > 0 ? std::sqrt(3 / squared) : 0;
    const Vector3d edge = scale * region.moved;
    const double reach = edge.squaredNorm();
    const double off = reach > 0 ? std::clamp((region.point - region.centroid).dot(edge) / reach, -1.0, 1.0) : 0;
    const double spring = 0.5 * joint.normalStiffness * patch.force * region.force, tilting = gradient.dot(edge);
    const double above = std::max(-half * (opening + tilting), -spring * (1 + off));
    const double below = std::max(-half * (opening - tilting), -spring * (1 - off));
    // Per area of this joint over that of the region: the mean, and the slope along g.
    const double mean = (above + below) / region.area, slope = (above - below) / region.area * scale;
    const Vector3d ofPatch = slope / patch.area * (patch.secondMoment * gradient);
    const Vector3d force = (mean + slope * gradient.dot(patch.centroid - region.centroid)) * n;
    return { force, ofPatch.cross(n) + patch.centroid.cross(force) };
}

// The springs of the joint carry what they hold, and are stretched by the motion of this step; where the patch grows or
// shrinks, springs join and leave.
JointLaw::Springs JointLaw::springsAlong(const JointMotion& motion)
{
    const Vector3d& n = motion.normal;
    Springs springs { memory.shearDisplacement, memory.twist };
    if (const double length = springs.shear.norm(); length > 0) {
        if (!bondEnded)
            motion.carry(springs.shear);
        springs.shear -= springs.shear.dot(n) * n;
        if (const double left = springs.shear.norm(); left > 0)
            springs.shear *= length / left;
    }
    const double energyWithArea = energyAlong(springs);
    if (bondEnded) {
        all.energies.breaking -= energyWithArea;
    } else {
        all.energies.area = memory.energyAlong - energyWithArea;
        springs.shear += motion.shearIncrement;
        springs.twist += turning(n) * dt;
    }
    return springs;
}

// Lets the springs slip where they hold more than friction and cohesion can; a joint that slips for the first time
// breaks. Returns what these can hold after that.
FrictionForce JointLaw::slip(const ContactPatch& patch, double pressing, Springs& springs)
{
    auto& [shear, twist] = springs;
    const FrictionForce trial { all.shearStiffness * shear.norm(), all.twistStiffness * std::abs(twist) };
    const double trialEnergy = energyAlong(springs);
    const auto limitNow = [&] { return limitOf(joint, memory.broken, patch, std::max(0.0, pressing)); };
    const auto held = [&](const FrictionForce& limit) {
        return returned(trial, limit, patch, shear, all.shearStiffness, all.twistStiffness);
    };
    FrictionForce limit = limitNow(), left = held(limit);
    all.slides = left.shear < trial.shear || left.twist < trial.twist;
    if (!all.slides)
        return limit;
    const bool breaks = !memory.broken;
    if (breaks) {
        memory.broken = true;
        limit = limitNow();
        left = held(limit);
    }
    const double shearLeft = trial.shear > 0 ? left.shear / trial.shear : 0,
                 twistLeft = trial.twist > 0 ? left.twist / trial.twist : 0;
    all.energies.friction
        = left.shear * (1 - shearLeft) * shear.norm() + left.twist * (1 - twistLeft) * std::abs(twist);
    shear *= shearLeft;
    twist *= twistLeft;
    // The strength above the residual one is lost at once; friction does work over the slip.
    if (breaks)
        all.energies.breaking += trialEnergy - energyAlong(springs) - all.energies.friction;
    return limit;
}

// While it sticks, the joint is damped along its plane as it is across it; spring and dashpot together hold no more
// than the limit.
void JointLaw::dampAlong(const ContactPatch& patch, const JointMotion& motion, const FrictionForce& limit)
{
    const Vector3d& increment = motion.shearIncrement;
    const double spin = turning(motion.normal);
    const double length = increment.norm();
    const Vector3d direction = length > 0 ? Vector3d(1 / length * increment) : motion.normal.unitOrthogonal();
    const double perArea = dashpotPerArea(joint.shearStiffness, opposedAt(motion.point, direction).both(), patch.area);
    Vector3d total = all.shearForce - perArea * patch.area / dt * increment;
    double totalTwist = all.twistMoment - perArea * patch.polarMoment * spin;
    const double share = allowedShare({ total.norm(), std::abs(totalTwist) }, limit);
    total *= share;
    totalTwist *= share;
    const Vector3d force = total - all.shearForce;
    const double moment = totalTwist - all.twistMoment;
    all.energies.viscous -= force.dot(increment) + moment * spin * dt;
    all.shearForce = total;
    all.twistMoment = totalTwist;
    all.damping.force += force;
    all.damping.moment += moment * motion.normal;
}

} // namespace potential_particles
