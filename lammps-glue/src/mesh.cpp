// SPDX-License-Identifier: GPL-2.0-or-later
#include "mesh.hpp"
#include "entered.hpp"
#include "mark.hpp"

#include "plugin-common/welder.hpp"

#include <potential_particles.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <memory>
#include <set>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace potential_particles {
namespace {

    using Corner = std::array<float, 3>;

    constexpr double mostCells = 64; // for a triangle, on the average

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
        bool ends = false;
        for (std::string word; words >> word; ends |= word == "endsolid")
            if (word == "vertex") {
                Corner corner;
                for (float& x : corner) {
                    const double number = words >> word ? numberOf(word) : NAN;
                    if (std::isnan(number))
                        throw std::runtime_error(path + ": vertex " + std::to_string(read.size() + 1)
                                                 + " is not three numbers");
                    x = static_cast<float>(number);
                }
                read.push_back(corner);
            }
        if (!ends)
            throw std::runtime_error(
                path
                + ": it is no whole STL file: a text ends with endsolid, a binary file has 84 bytes "
                  "and 50 for each triangle");
        return read;
    }

    // Whether the library takes a triangle: it is asked with a ball, before any body comes.
    class TriangleCheck {
    public:
        TriangleCheck()
        {
            pp_particle* made = nullptr;
            if (pp_particle_new(nullptr, 0, 1, 1, 1, &made, nullptr, 0) == PP_OK)
                ball.reset(made, pp_particle_free);
        }

        bool takes(const Triangle& triangle) const
        {
            const Eigen::Vector3d& at = triangle[0];
            const pp_pose pose { { at[0], at[1], at[2] }, { 1, 0, 0, 0 } };
            pp_flat_contact found;
            const pp_status status
                = pp_contact_triangle(ball.get(), &pose, numbersOf(triangle), nullptr, nullptr, &found);
            return status != PP_BAD_POINT && status != PP_DEGENERATE_TRIANGLE;
        }

    private:
        std::shared_ptr<const pp_particle> ball;
    };

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
        throw std::runtime_error(path + ": " + std::to_string(read.size())
                                 + " vertices: an STL file has three for each triangle, and one triangle at least");
    triangles.resize(read.size() / 3);
    const TriangleCheck check;
    for (size_t n = 0; n < read.size(); ++n) {
        for (float x : read[n])
            if (!(std::abs(scale * x) <= bearable))
                throw std::runtime_error(path + ": triangle " + std::to_string(n / 3 + 1)
                                         + " has a vertex that is not finite, or beyond 1e100 when scaled: mend the "
                                           "file, or give a smaller scale");
        triangles[n / 3][n % 3] = scale * Eigen::Vector3d(read[n][0], read[n][1], read[n][2]);
        if (n % 3 == 2 && !check.takes(triangles[n / 3]))
            throw std::runtime_error(path + ": triangle " + std::to_string(n / 3 + 1)
                                     + " has no area to rounding: remove it from the mesh");
    }
    dropRepeated();
    sortIntoCells();
}

// A triangle with the corners of another one, in whatever order, would push twice.
void Mesh::dropRepeated()
{
    double largest = 0;
    for (const Triangle& triangle : triangles)
        largest = std::max(largest, weldOf(triangle));
    Welder welder(largest);
    std::set<std::array<int, 3>> known;
    const auto isKnown = [&](const Triangle& triangle) {
        const double weld = weldOf(triangle);
        if (!isUsable(triangle, weld))
            return false;
        std::array<int, 3> corners;
        for (size_t i = 0; i < 3; ++i)
            corners[i] = welder.numberOf(triangle[i], weld);
        std::sort(corners.begin(), corners.end());
        return !known.insert(corners).second;
    };
    const size_t before = triangles.size();
    triangles.erase(std::remove_if(triangles.begin(), triangles.end(), isKnown), triangles.end());
    dropped = before - triangles.size();
}

Eigen::Array3i Mesh::cellOf(const Eigen::Vector3d& x) const
{
    const Eigen::Array3d at = ((x - lowest) / cellSize).array().floor();
    return at.max(0).min((cells - 1).cast<double>()).cast<int>();
}

void Mesh::addTo(Mark& mark) const
{
    for (const Triangle& triangle : triangles)
        mark.add(numbersOf(triangle), 9);
}

void Mesh::sortIntoCells()
{
    lowest = highest = triangles[0][0];
    for (const Triangle& triangle : triangles)
        for (const Eigen::Vector3d& x : triangle) {
            lowest = lowest.cwiseMin(x);
            highest = highest.cwiseMax(x);
        }
    // As large as a triangle on the average, and not many more cells than triangles.
    double sides = 0;
    for (const auto& [a, b, c] : triangles)
        sides += (a - b).norm() + (b - c).norm();
    const Eigen::Array3d extent = (highest - lowest).array();
    cellSize = std::max(0.5 * sides / triangles.size(), extent.maxCoeff() / std::cbrt(8.0 * triangles.size()));
    const auto cellsOf = [this](const Triangle& triangle) {
        const auto& [a, b, c] = triangle;
        return std::pair(cellOf(a.cwiseMin(b).cwiseMin(c)), cellOf(a.cwiseMax(b).cwiseMax(c)));
    };
    // Few large triangles among many small ones would lie in too many cells.
    for (double entries = INFINITY; entries > mostCells * triangles.size();
         cellSize *= entries > mostCells * triangles.size() ? 2 : 1) {
        cells = (extent / cellSize).floor().cast<int>() + 1;
        entries = 0;
        for (const Triangle& t : triangles) {
            const auto [low, high] = cellsOf(t);
            entries += (high - low + 1).cast<double>().prod();
        }
    }
    inCell.resize(static_cast<size_t>(cells.prod()));
    for (size_t t = 0; t < triangles.size(); ++t) {
        const auto [low, high] = cellsOf(triangles[t]);
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
