// SPDX-License-Identifier: GPL-2.0-or-later
//
// Triangles of an STL file, and which of them are near a place.
#pragma once

#include <Eigen/Core>

#include <array>
#include <string>
#include <vector>

namespace potential_particles {

class Mesh {
public:
    // Text or binary STL, from its bytes; `path` is for messages. Coordinates are multiplied by `scale`.
    // Throws std::runtime_error.
    Mesh(const std::string& bytes, const std::string& path, double scale);

    size_t size() const { return corners.size(); }
    const std::array<int, 3>& triangle(int t) const { return corners[t]; } // indices of vertices, which triangles share
    const Eigen::Vector3d& vertex(int v) const { return vertices[v]; }
    const Eigen::Vector3d& low() const { return lowest; } // of the box around all vertices
    const Eigen::Vector3d& high() const { return highest; }
    // Nine numbers, as the library takes them.
    std::array<double, 9> points(int t) const;

    // Triangles whose boxes may meet the box about a centre; each once, in ascending order.
    void near(const Eigen::Vector3d& centre, double radius, std::vector<int>& found) const;

private:
    void sortIntoCells();
    Eigen::Array3i cellOf(const Eigen::Vector3d& x) const;

    std::vector<Eigen::Vector3d> vertices;
    std::vector<std::array<int, 3>> corners;
    Eigen::Vector3d lowest, highest;
    Eigen::Array3i cells;
    double cellSize = 1;
    std::vector<std::vector<int>> inCell;
};

} // namespace potential_particles
