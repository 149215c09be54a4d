// SPDX-License-Identifier: GPL-2.0-or-later
//
// Shapes of a file: planes, r, k, R, and what follows from them.
#pragma once

#include <potential_particles.h>

#include <Eigen/Core>

#include <memory>
#include <string>
#include <vector>

namespace potential_particles {

struct Shape {
    std::string name;
    std::shared_ptr<const pp_particle> particle;
    double radius; // of a ball about the centre that holds it
    double volume;
    double mark; // of what the file says of it
    Eigen::Vector3d moments; // of inertia for density 1, about the axes of the local frame, which are principal
};

// What is further apart than this share of a size sleeps until it can have met; what is nearer would wake too often.
constexpr double farShare = 1e-3;

// Text of a file of shapes; `path` is for messages alone. A shape is
//     shape NAME
//     r 0.01
//     k 0
//     R 0.1
//     plane A B C D      (as many as there are)
//     end
// with '#' before comments. Its centre of mass is the origin, and its axes are principal.
// Throws std::runtime_error, whose text has file, line, value and remedy.
std::vector<Shape> readShapes(const std::string& text, const std::string& path);

} // namespace potential_particles
