// SPDX-License-Identifier: GPL-3.0-or-later
#include "registration/definitions.hpp"

#include "flat_pair.hpp"
#include "ig2_wall_conic_pp.hpp"
#include "particle/ray.hpp"

#include "plugin-common/new_contact.hpp"

namespace potential_particles {

using yade::Vector3r;

Ig2_Wall_ConicPP_ScGeom::~Ig2_Wall_ConicPP_ScGeom() = default;
PP_FUNCTOR_2D_DEFINITIONS(Ig2_Wall_ConicPP_ScGeom)
PP_PYTHON_AS_BASE(Ig2_Wall_ConicPP_ScGeom, Ig2_ConicPP_ConicPP_ScGeom)
PP_ARCHIVE_AS_BASE(Ig2_Wall_ConicPP_ScGeom, Ig2_ConicPP_ConicPP_ScGeom)

// The wall's orientation does not count, in YADE neither.
BoundaryPoints Ig2_Wall_ConicPP_ScGeom::pointsOf(const FlatPair& pair) const
{
    const int axis = static_cast<const yade::Wall&>(pair.boundary).axis;
    if (axis < 0 || axis > 2)
        throw std::invalid_argument("Wall.axis = " + std::to_string(axis) + ": choose 0, 1 or 2");
    Vector3r foot = Vector3r::Zero();
    foot[axis] = pair.state1.se3.position[axis] - pair.centre()[axis];
    return { foot, foot, foot };
}

pp_status Ig2_Wall_ConicPP_ScGeom::detect(FlatPair& pair, const BoundaryPoints& points, pp_flat_contact& found)
{
    const auto& wall = static_cast<const yade::Wall&>(pair.boundary);
    const Vector3r normal = Vector3r::Unit(wall.axis) * (wall.sense < 0 ? -1 : 1);
    const pp_pose turn = pair.turn();
    const auto ask = [&] {
        return pp_contact_plane(pair.particle->handle(), &turn, points[0].data(), normal.data(), &pair.settings.library,
                                pair.state(), &found);
    };
    const pp_status status = fromNothingIfNew(ask(), found, pair.real, pair.state(), ask);
    if (status != PP_OK || found.kind != PP_OVERLAPPING || wall.sense == 0 || Vector3r(found.normal).dot(normal) < 0)
        return status;
    // The centre is behind a wall that pushes to one side only: the overlap is the particle's reach behind it.
    const Vector3r least(found.on_boundary);
    found.overlap = distanceToSurface(*pair.particle, turn, least, -normal);
    copyTo(found.normal, -normal);
    copyTo(found.on_particle, least - found.overlap * normal);
    copyTo(found.point, least - 0.5 * found.overlap * normal);
    copyTo(found.branch, least - 0.5 * found.overlap * normal);
    return status;
}

pp_status Ig2_Wall_ConicPP_ScGeom::findPatch(const FlatPair& pair, const BoundaryPoints&, const pp_flat_contact& found,
                                             pp_patch& patch) const
{
    const pp_pose turn = pair.turn();
    return pp_patch_on_plane(pair.particle->handle(), &turn, &found, pair.settings.given.patchTolerance, tracksEnergy(),
                             pair.lastPatch(), &patch, nullptr, 0, nullptr);
}

} // namespace potential_particles

BOOST_CLASS_EXPORT_IMPLEMENT(potential_particles::Ig2_Wall_ConicPP_ScGeom)
