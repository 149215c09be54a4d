// SPDX-License-Identifier: MIT OR Apache-2.0
//
// What a body holds by its other joints on the side of one of them: a boundary that is cut into tiles is one
// boundary.
#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cstddef>

namespace potential_particles {

// What a joint held in its last step, as the other joints of its bodies see it. World axes.
struct JointLoad {
    double heldStiffness = 0; // across it, force/length; 0: nothing is known
    double heldForce = 0; // of its springs across it
    Eigen::Vector3d heldNormal = Eigen::Vector3d::Zero(); // from body 1 to body 2
    Eigen::Vector3d heldPoint = Eigen::Vector3d::Zero(); // centre of pressure
    Eigen::Vector3d heldCentroid = Eigen::Vector3d::Zero(); // from there
    // Second moments about the centroid over the area: xx, yy, zz and yz, zx, xy.
    Eigen::Vector3d heldSpread = Eigen::Vector3d::Zero(), heldSpreadAcross = Eigen::Vector3d::Zero();

    void setSpread(const Eigen::Matrix3d& spread)
    {
        heldSpread = spread.diagonal();
        heldSpreadAcross = { spread(1, 2), spread(2, 0), spread(0, 1) };
    }
    Eigen::Matrix3d spread() const
    {
        Eigen::Matrix3d matrix;
        matrix << heldSpread[0], heldSpreadAcross[2], heldSpreadAcross[1], heldSpreadAcross[2], heldSpread[1],
            heldSpreadAcross[0], heldSpreadAcross[1], heldSpreadAcross[0], heldSpread[2];
        return matrix;
    }

    // Calls `visit(double*, count)` for all numbers.
    template <class Load, class Visit> static void eachHeld(Load& load, Visit&& visit)
    {
        visit(&load.heldStiffness, 1);
        visit(&load.heldForce, 1);
        for (auto* vector : { &load.heldNormal, &load.heldPoint, &load.heldCentroid, &load.heldSpread,
                              &load.heldSpreadAcross })
            visit(vector->data(), 3);
    }
};

// The other joints of a body on one side of it, of the last step: each counts by the square of the cosine between its
// normal and that of this joint, and not at all beyond a right angle. Places from the centre of pressure of this one.
struct JointSide {
    bool known = false; // no joint is in its first step
    double stiffness = 0, force = 0; // over those of this joint; 0: it is alone
    Eigen::Vector3d centroid = Eigen::Vector3d::Zero(), point = Eigen::Vector3d::Zero();
    Eigen::Matrix3d spread = Eigen::Matrix3d::Zero(); // second moments about that centroid over the stiffness
};

struct JointSides {
    JointSide one, other; // of body 1, of body 2
};

// All joints of a body. Those of one normal, as of the tiles of a face, are added up; of a body with many faces,
// the later ones with that of the nearest normal.
class JointsOfBody {
public:
    // outwards: the normal of the load points away from the body.
    void add(const JointLoad& load, bool outwards)
    {
        if (!(load.heldStiffness > 0))
            return;
        if (count == 0)
            origin = load.heldPoint;
        const Sum one = sumOf(load);
        const Eigen::Vector3d normal = outwards ? load.heldNormal : Eigen::Vector3d(-load.heldNormal);
        Face* const face = faceOf(normal);
        if (count == 0 || (count < most && face->normal.dot(normal) < 1 - sameNormal))
            faces[static_cast<std::size_t>(count++)] = { normal, one };
        else
            face->sum += one;
    }

    // What is left without this one, which has been added.
    JointSide without(const JointLoad& load, bool outwards) const
    {
        JointSide side;
        if (!(load.heldStiffness > 0))
            return side;
        side.known = true;
        const Eigen::Vector3d normal = outwards ? load.heldNormal : Eigen::Vector3d(-load.heldNormal);
        Sum rest;
        const Face* const mine = faceOf(normal);
        for (const Face* face = faces.data(); face != faces.data() + count; ++face) {
            const double cosine = face->normal.dot(normal);
            if (!(cosine > 0))
                continue;
            const double share = std::min(1.0, cosine * cosine);
            if (face == mine && face->sum.count == 1) // it is this one
                continue;
            rest.add(share, face->sum);
            if (face == mine)
                rest.add(-share, sumOf(load));
        }
        if (!(rest.stiffness > rounding * load.heldStiffness))
            return side;
        side.stiffness = rest.stiffness / load.heldStiffness;
        side.force = load.heldForce > 0 ? std::max(0.0, rest.force) / load.heldForce : 0;
        const Eigen::Vector3d here = load.heldPoint - origin, centroid = rest.first / rest.stiffness;
        side.centroid = centroid - here;
        side.spread = rest.second / rest.stiffness - centroid * centroid.transpose();
        side.point = rest.force > rounding * load.heldForce ? Eigen::Vector3d(rest.pressed / rest.force - here)
                                                       : side.centroid;
        return side;
    }

    void clear() { count = 0; }
    bool isOne() const { return count == 0 || (count == 1 && faces[0].sum.count == 1); }

    // As numbers, for another process.
    static constexpr int numbers = 1 + 3 + 6 * 21;
    void write(double* to)
    {
        *to++ = count;
        each([&](double& number) { *to++ = number; });
    }
    void read(const double* from)
    {
        count = static_cast<int>(*from++);
        each([&](double& number) { number = *from++; });
    }

private:
    static constexpr int most = 6;
    static constexpr double sameNormal = 1e-8; // 1 - cosine
    static constexpr double rounding = 1e-12; // of what is left of a difference

    // About `origin`.
    struct Sum {
        double stiffness = 0, force = 0, count = 0;
        Eigen::Vector3d first = Eigen::Vector3d::Zero(), pressed = Eigen::Vector3d::Zero();
        Eigen::Matrix3d second = Eigen::Matrix3d::Zero();

        void add(double share, const Sum& other)
        {
            stiffness += share * other.stiffness;
            force += share * other.force;
            first += share * other.first;
            pressed += share * other.pressed;
            second += share * other.second;
        }
        void operator+=(const Sum& other)
        {
            add(1, other);
            count += other.count;
        }
    };
    struct Face {
        Eigen::Vector3d normal;
        Sum sum;
    };

    Sum sumOf(const JointLoad& load) const
    {
        const Eigen::Vector3d point = load.heldPoint - origin, centroid = point + load.heldCentroid;
        return { load.heldStiffness,
                 load.heldForce,
                 1,
                 load.heldStiffness * centroid,
                 load.heldForce * point,
                 load.heldStiffness * (load.spread() + centroid * centroid.transpose()) };
    }

    // The face that a joint with this normal is of: the one with the nearest normal; none, before there is one.
    Face* faceOf(const Eigen::Vector3d& normal)
    {
        return const_cast<Face*>(static_cast<const JointsOfBody&>(*this).faceOf(normal));
    }
    const Face* faceOf(const Eigen::Vector3d& normal) const
    {
        return std::max_element(faces.data(), faces.data() + count, [&](const Face& one, const Face& other) {
            return one.normal.dot(normal) < other.normal.dot(normal);
        });
    }
    template <class Visit> void each(Visit&& visit)
    {
        const auto all = [&](auto& values) { std::for_each(values.data(), values.data() + values.size(), visit); };
        all(origin);
        for (int i = 0; i < count; ++i) {
            Face& face = faces[static_cast<std::size_t>(i)];
            for (double* number : { &face.sum.stiffness, &face.sum.force, &face.sum.count })
                visit(*number);
            all(face.normal);
            all(face.sum.first);
            all(face.sum.pressed);
            all(face.sum.second);
        }
    }

    std::array<Face, most> faces;
    int count = 0;
    Eigen::Vector3d origin = Eigen::Vector3d::Zero();
};

} // namespace potential_particles
