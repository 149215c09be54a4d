// SPDX-License-Identifier: GPL-3.0-or-later
//
// YADE's own shapes that a potential particle can touch.
#pragma once

#include "shape.hpp"

namespace yade {

class Sphere : public Shape {
public:
    ~Sphere() override;
    PP_ABI_SERIALIZABLE_OVERRIDES
    PP_ABI_INDEX_OVERRIDES

    Real radius;
};
PP_ABI_SIZE(Sphere, 104);
PP_ABI_OFFSET(Sphere, radius, 96);

// The points within the radius of the segment from the body's position to its end.
class Cylinder : public Sphere {
public:
    ~Cylinder() override;
    PP_ABI_SERIALIZABLE_OVERRIDES
    PP_ABI_INDEX_OVERRIDES

    Real length; // of the segment, for YADE's own functors
    Vector3r segment; // local axes
};
PP_ABI_SIZE(Cylinder, 136);
PP_ABI_OFFSET(Cylinder, length, 104);
PP_ABI_OFFSET(Cylinder, segment, 112);

class Box : public Shape {
public:
    ~Box() override;
    PP_ABI_SERIALIZABLE_OVERRIDES
    PP_ABI_INDEX_OVERRIDES

    Vector3r extents; // half of its size
};
PP_ABI_SIZE(Box, 120);
PP_ABI_OFFSET(Box, extents, 96);

// A plane through the body's position; its orientation is disregarded.
class Wall : public Shape {
public:
    ~Wall() override;
    PP_ABI_SERIALIZABLE_OVERRIDES
    PP_ABI_INDEX_OVERRIDES

    int sense; // the side to which it pushes: -1, +1, or 0 for that on which the other body is
    int axis; // of the normal: 0, 1 or 2
};
PP_ABI_SIZE(Wall, 104);
PP_ABI_OFFSET(Wall, sense, 92);
PP_ABI_OFFSET(Wall, axis, 96);

class Facet : public Shape {
public:
    ~Facet() override;
    PP_ABI_SERIALIZABLE_OVERRIDES
    PP_ABI_INDEX_OVERRIDES

    std::byte derived[176]; // what YADE makes of the vertices
    std::vector<Vector3r> vertices; // three, local axes
    Vector3r normal;
    Real area;
};
PP_ABI_SIZE(Facet, 328);
PP_ABI_OFFSET(Facet, vertices, 272);
PP_ABI_OFFSET(Facet, normal, 296);
PP_ABI_OFFSET(Facet, area, 320);

} // namespace yade
