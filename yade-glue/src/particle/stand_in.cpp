// SPDX-License-Identifier: GPL-3.0-or-later
#include "stand_in.hpp"

namespace potential_particles {

namespace {

    double roundingOf(const yade::Box& box) { return boxRounding * box.extents.minCoeff(); }

} // namespace

Definition definitionOf(const yade::Sphere& sphere) { return { {}, {}, {}, {}, sphere.radius, 1, sphere.radius }; }

Definition definitionOf(const yade::Box& box)
{
    const double r = roundingOf(box);
    const yade::Vector3r d = box.extents.array() - r;
    return { { 1, -1, 0, 0, 0, 0 }, { 0, 0, 1, -1, 0, 0 }, { 0, 0, 0, 0, 1, -1 }, { d[0], d[0], d[1], d[1], d[2], d[2] },
             r, 0, box.extents.norm() };
}

bool describes(const Definition& definition, const yade::Sphere& sphere)
{
    return definition.a.empty() && definition.k == 1 && sameBits(definition.R, sphere.radius)
        && sameBits(definition.r, sphere.radius);
}

bool describes(const Definition& definition, const yade::Box& box)
{
    const double r = roundingOf(box);
    if (definition.d.size() != 6 || definition.k != 0 || !sameBits(definition.r, r)
        || !sameBits(definition.R, box.extents.norm()))
        return false;
    for (int i = 0; i < 3; ++i)
        if (!sameBits(definition.d[static_cast<std::size_t>(2 * i)], box.extents[i] - r))
            return false;
    return true;
}

} // namespace potential_particles
