// SPDX-License-Identifier: GPL-2.0-or-later
//
// Triangles of an STL file, and which of them are near a place.
#pragma once

#include "plugin-common/seam.hpp"

#include <string>
#include <vector>

namespace potential_particles {

class Mark;

class Mesh {
public:
    // Text or binary STL, from its bytes; `path` is for messages. Coordinates are multiplied by `scale`.
    // Throws std::runtime_error.
    Mesh(const std::string& bytes, const std::string& path, double scale);

    size_t repeated() const { return dropped; } // triangles that the file has twice
    const Triangle& triangle(int t) const { return triangles[t]; }
    const Eigen::Vector3d& low() const { return lowest; } // of the box around all vertices
    const Eigen::Vector3d& high() const { return highest; }

    void addTo(Mark& mark) const;

    // Triangles whose boxes may meet the box about a centre; each once, in ascending order.
    void near(const Eigen::Vector3d& centre, double radius, std::vector<int>& found) const;

private:
    void dropRepeated();
    void sortIntoCells();
    Eigen::Array3i cellOf(const Eigen::Vector3d& x) const;

    std::vector<Triangle> triangles;
    Eigen::Vector3d lowest, highest;
    Eigen::Array3i cells;
    double cellSize = 1;
    size_t dropped = 0;
    std::vector<std::vector<int>> inCell;
};

} // namespace potential_particles
