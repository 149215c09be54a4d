// SPDX-License-Identifier: GPL-3.0-or-later
#include "bonded_area.hpp"

namespace potential_particles {

using yade::Vector3r;

void bondPatch(ConicJointPhys& phys, const ContactPatch& patch, const PatchPlace& place, const Wrench& held, const MovingBody& one,
               const MovingBody& other)
{
    const PatchFrame frame(patch, place);
    const Vector3r& centroid = frame.centroid;
    const Eigen::Matrix3d& axes = frame.axes;
    const double alongY = frame.alongY, alongZ = frame.alongZ;

    phys.bonded = true;
    phys.broken = false;
    phys.damage = 0;
    phys.bondArea = patch.area;
    phys.bondMoments = Vector3r(alongY + alongZ, alongZ, alongY);
    const yade::Quaternionr turn(axes);
    phys.bondTurn1 = one.turn().conjugate() * turn;
    phys.bondTurn2 = other.turn().conjugate() * turn;
    phys.bondPoint1 = one.turn().conjugate() * (centroid - one.centre());
    phys.bondPoint2 = other.turn().conjugate() * (centroid - other.centre());

    const Vector3r force = axes.transpose() * held.force;
    const Vector3r moment = axes.transpose() * (held.moment + (place.point - centroid).cross(held.force));
    const auto over = [](double load, double stiffness) { return stiffness > 0 ? -load / stiffness : 0; };
    const double kn = phys.normalStiffness, ks = phys.shearStiffness;
    phys.bondDisplacement = Vector3r(over(force.x(), kn * patch.area), over(force.y(), ks * patch.area), over(force.z(), ks * patch.area));
    phys.bondRotation = Vector3r(over(moment.x(), ks * phys.bondMoments.x()), over(moment.y(), kn * phys.bondMoments.y()),
                                 over(moment.z(), kn * phys.bondMoments.z()));

    phys.bondRim.clear();
    for (const Eigen::Vector2d& corner : rimOf(patch, frame, one.posed(), other.posed()))
        phys.bondRim.insert(phys.bondRim.end(), { corner.x(), corner.y() });
}

} // namespace potential_particles
