// SPDX-License-Identifier: GPL-2.0-or-later
#include "mesh.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <sstream>
#include <stdexcept>

namespace potential_particles {
namespace {

using Corner = std::array<float, 3>;

std::vector<Corner> binaryCorners(const std::string& bytes, uint32_t count)
{
    std::vector<Corner> read(3 * static_cast<size_t>(count));
    for (uint32_t t = 0; t < count; ++t)
        std::memcpy(&read[3 * static_cast<size_t>(t)], bytes.data() + 84 + 50 * static_cast<size_t>(t) + 12, 36);
    return read;
}

std::vector<Corner> textCorners(const std::string& bytes, const std::string& path)
{
    std::vector<Corner> read;
    std::istringstream words(bytes);
    for (std::string word; words >> word;)
        if (word == "vertex") {
            Corner corner;
            if (!(words >> corner[0] >> corner[1] >> corner[2]))
                throw std::runtime_error(path + ": vertex " + std::to_string(read.size() + 1) + " is not three numbers");
            read.push_back(corner);
        }
    return read;
}

} // namespace

Mesh::Mesh(const std::string& bytes, const std::string& path, double scale)
{
    uint32_t count = 0;
    if (bytes.size() >= 84)
        std::memcpy(&count, bytes.data() + 80, 4);
    // A binary file may begin with "solid" too: its size tells.
    const std::vector<Corner> read
        = bytes.size() == 84 + 50 * static_cast<size_t>(count) ? binaryCorners(bytes, count) : textCorners(bytes, path);
    if (read.empty() || read.size() % 3)
        throw std::runtime_error(path + ": " + std::to_string(read.size()) + " vertices: an STL file has three for each triangle, and one triangle at least");
    std::map<Corner, int> known;
    for (size_t n = 0; n < read.size(); ++n) {
        for (float x : read[n])
            if (!std::isfinite(x))
                throw std::runtime_error(path + ": triangle " + std::to_string(n / 3 + 1) + " has a vertex that is not finite");
        const auto [at, isNew] = known.emplace(read[n], static_cast<int>(vertices.size()));
        if (isNew)
            vertices.push_back(scale * Eigen::Vector3d(read[n][0], read[n][1], read[n][2]));
        if (n % 3 == 0)
            corners.emplace_back();
        corners.back()[n % 3] = at->second;
    }
    sortIntoCells();
}

std::array<double, 9> Mesh::points(int t) const
{
    std::array<double, 9> nine;
    for (int i = 0; i < 3; ++i)
        std::copy_n(vertices[corners[t][i]].data(), 3, &nine[3 * i]);
    return nine;
}

Eigen::Array3i Mesh::cellOf(const Eigen::Vector3d& x) const
{
    const Eigen::Array3d at = ((x - lowest) / cellSize).array().floor();
    return at.max(0).min((cells - 1).cast<double>()).cast<int>();
}

void Mesh::sortIntoCells()
{
    lowest = highest = vertices[0];
    for (const Eigen::Vector3d& x : vertices) {
        lowest = lowest.cwiseMin(x);
        highest = highest.cwiseMax(x);
    }
    // As large as a triangle on the average, and not many more cells than triangles.
    double sides = 0;
    for (const auto& t : corners)
        sides += (vertices[t[0]] - vertices[t[1]]).norm() + (vertices[t[1]] - vertices[t[2]]).norm();
    const Eigen::Array3d extent = (highest - lowest).array();
    cellSize = std::max(0.5 * sides / corners.size(), extent.maxCoeff() / std::cbrt(8.0 * corners.size()));
    cells = (extent / cellSize).floor().cast<int>() + 1;
    inCell.resize(static_cast<size_t>(cells.prod()));
    for (size_t t = 0; t < corners.size(); ++t) {
        const Eigen::Vector3d &a = vertices[corners[t][0]], &b = vertices[corners[t][1]], &c = vertices[corners[t][2]];
        const Eigen::Array3i low = cellOf(a.cwiseMin(b).cwiseMin(c)), high = cellOf(a.cwiseMax(b).cwiseMax(c));
        for (int x = low[0]; x <= high[0]; ++x)
            for (int y = low[1]; y <= high[1]; ++y)
                for (int z = low[2]; z <= high[2]; ++z)
                    inCell[(static_cast<size_t>(x) * cells[1] + y) * cells[2] + z].push_back(static_cast<int>(t));
    }
}

void Mesh::near(const Eigen::Vector3d& centre, double radius, std::vector<int>& found) const
{
    found.clear();
    const Eigen::Vector3d reach = Eigen::Vector3d::Constant(radius);
    if (((centre + reach).array() < lowest.array()).any() || ((centre - reach).array() > highest.array()).any())
        return;
    const Eigen::Array3i low = cellOf(centre - reach), high = cellOf(centre + reach);
    for (int x = low[0]; x <= high[0]; ++x)
        for (int y = low[1]; y <= high[1]; ++y)
            for (int z = low[2]; z <= high[2]; ++z) {
                const auto& here = inCell[(static_cast<size_t>(x) * cells[1] + y) * cells[2] + z];
                found.insert(found.end(), here.begin(), here.end());
            }
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
}

} // namespace potential_particles
