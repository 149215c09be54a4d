// SPDX-License-Identifier: MIT OR Apache-2.0
//
// What a body holds by its other joints on the side of one of them: a boundary that is cut into tiles is one
// boundary.
#pragma once

#include <Eigen/Core>

#include <algorithm>

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

    void setSpread(const Eigen::Matrix3d& moments, double area)
    {
        const double over = 1 / area;
        for (int i = 0; i < 3; ++i) {
            heldSpread[i] = over * moments(i, i);
            heldSpreadAcross[i] = over * moments((i + 1) % 3, (i + 2) % 3);
        }
    }

    // Calls `visit(double*, count)` for all numbers.
    template <class Load, class Visit> static void eachHeld(Load& load, Visit&& visit)
    {
        visit(&load.heldStiffness, 1);
        visit(&load.heldForce, 1);
        for (auto* vector :
             { &load.heldNormal, &load.heldPoint, &load.heldCentroid, &load.heldSpread, &load.heldSpreadAcross })
            visit(vector->data(), 3);
    }
};

// The other joints of a body on one side of it, of the last step: each counts by the square of the cosine between its
// normal and that of this joint, and not at all beyond a right angle. Moments about the centre of pressure of this one.
struct JointSide {
    bool known = false; // no joint is in its first step
    double stiffness = 0, force = 0; // over those of this joint; 0: it is alone
    // First moments of the stiffness and the force, and second ones of the stiffness as in heldSpread.
    Eigen::Vector3d first { 0, 0, 0 }, pressed { 0, 0, 0 }, second { 0, 0, 0 }, secondAcross { 0, 0, 0 };
};

struct JointSides {
    JointSide one, other; // of body 1, of body 2
};

// All joints of a body. Those of one normal, as of the tiles of a face, are added up; of a body with many faces,
// the later ones with that of the nearest normal.
class JointsOfBody {
public:
    // point: load.heldPoint as the body sees it; outwards: the normal of the load points away from the body.
    void add(const JointLoad& load, const Eigen::Vector3d& point, bool outwards)
    {
        if (!(load.heldStiffness > 0))
            return;
        if (count == 0)
            origin = point;
        const Eigen::Vector3d normal = outwards ? load.heldNormal : Eigen::Vector3d(-load.heldNormal);
        const Nearest nearest = nearestTo(normal);
        if (count == 0 || (count < most && nearest.cosines[nearest.face] < 1 - sameNormal)) {
            faces[count].normal = normal;
            faces[count].count = 1;
            faces[count++].sum.set(load, point - origin);
        } else {
            faces[nearest.face].sum.add(1, load, point - origin);
            ++faces[nearest.face].count;
        }
    }

    // What is left without this one, which has been added.
    JointSide without(const JointLoad& load, const Eigen::Vector3d& point, bool outwards) const
    {
        JointSide alone;
        alone.known = load.heldStiffness > 0;
        if (!(alone.known && count > 0))
            return alone;
        const Nearest nearest = nearestTo(outwards ? load.heldNormal : Eigen::Vector3d(-load.heldNormal));
        const Eigen::Vector3d here = point - origin;
        double shares[most] = {};
        bool isAlone = true;
        for (int i = 0; i < count; ++i)
            if (const double cosine = nearest.cosines[i];
                cosine > leastCosine && !(i == nearest.face && faces[i].count == 1)) {
                shares[i] = std::min(1.0, cosine * cosine);
                isAlone = false;
            }
        if (isAlone)
            return alone;
        Sum rest;
        rest.set(shares[0], faces[0].sum);
        for (int i = 1; i < count; ++i)
            if (shares[i] > 0)
                rest.add(shares[i], faces[i].sum);
        if (const double own = shares[nearest.face]; own > 0)
            rest.add(-own, load, here);
        if (rest.stiffness() > rounding * load.heldStiffness)
            return sideOf(rest, load, here);
        return alone;
    }

    void clear() { count = 0; }

    // Whether two joints are on one side of a body at all, by their normals; where not, nothing need be added.
    static bool share(const Eigen::Vector3d& one, const Eigen::Vector3d& other) { return one.dot(other) > leastCosine; }

    // As numbers, for another process.
    static constexpr int numbers = 1 + 3 + 6 * 18;
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
    static constexpr double leastCosine = 1e-6; // faces at right angles are that to rounding
    static constexpr double rounding = 1e-12; // of what is left of a difference

    // About `origin`. Numbers in a row, which the compiler adds up in one loop.
    struct Sum {
        static constexpr int size = 14;
        double all[size];

        double stiffness() const { return all[0]; }
        double force() const { return all[1]; }
        double first(int i) const { return all[2 + i]; }
        double pressed(int i) const { return all[5 + i]; }
        double second(int i) const { return all[8 + i]; }
        double secondAcross(int i) const { return all[11 + i]; }

        void set(double share, const Sum& other)
        {
            for (int i = 0; i < size; ++i)
                all[i] = share * other.all[i];
        }
        void add(double share, const Sum& other)
        {
            for (int i = 0; i < size; ++i)
                all[i] += share * other.all[i];
        }
        void set(const JointLoad& load, const Eigen::Vector3d& point)
        {
            each(1, load, point, [](double& sum, double number) { sum = number; });
        }
        void add(double share, const JointLoad& load, const Eigen::Vector3d& point)
        {
            each(share, load, point, [](double& sum, double number) { sum += number; });
        }

    private:
        // One by one: what has just been written one by one is slow to read in pairs.
        template <class Visit>
        void each(double share, const JointLoad& load, const Eigen::Vector3d& point, Visit&& visit)
        {
            const double k = share * load.heldStiffness, f = share * load.heldForce;
            const double x = point[0] + load.heldCentroid[0], y = point[1] + load.heldCentroid[1],
                         z = point[2] + load.heldCentroid[2];
            const double kx = k * x, ky = k * y, kz = k * z;
            visit(all[0], k);
            visit(all[1], f);
            visit(all[2], kx);
            visit(all[3], ky);
            visit(all[4], kz);
            visit(all[5], f * point[0]);
            visit(all[6], f * point[1]);
            visit(all[7], f * point[2]);
            visit(all[8], k * load.heldSpread[0] + kx * x);
            visit(all[9], k * load.heldSpread[1] + ky * y);
            visit(all[10], k * load.heldSpread[2] + kz * z);
            visit(all[11], k * load.heldSpreadAcross[0] + ky * z);
            visit(all[12], k * load.heldSpreadAcross[1] + kz * x);
            visit(all[13], k * load.heldSpreadAcross[2] + kx * y);
        }
    };
    struct Face {
        Sum sum;
        Eigen::Vector3d normal;
        double count; // of joints
    };

    // The face that a joint with this normal is of: the one with the nearest normal.
    struct Nearest {
        double cosines[most];
        int face = 0;
    };
    Nearest nearestTo(const Eigen::Vector3d& normal) const
    {
        Nearest nearest;
        for (int i = 0; i < count; ++i) {
            nearest.cosines[i] = faces[i].normal.dot(normal);
            if (nearest.cosines[i] > nearest.cosines[nearest.face])
                nearest.face = i;
        }
        return nearest;
    }
    static JointSide sideOf(const Sum& rest, const JointLoad& load, const Eigen::Vector3d& here)
    {
        JointSide side;
        side.known = true;
        const double over = 1 / load.heldStiffness;
        side.stiffness = rest.stiffness() * over;
        for (int i = 0; i < 3; ++i)
            side.first[i] = (rest.first(i) - rest.stiffness() * here[i]) * over;
        const auto secondAbout = [&](double second, int i, int j) {
            return (second - here[i] * rest.first(j)) * over - here[j] * side.first[i];
        };
        side.second = { secondAbout(rest.second(0), 0, 0), secondAbout(rest.second(1), 1, 1),
                        secondAbout(rest.second(2), 2, 2) };
        side.secondAcross = { secondAbout(rest.secondAcross(0), 1, 2), secondAbout(rest.secondAcross(1), 2, 0),
                              secondAbout(rest.secondAcross(2), 0, 1) };
        if (rest.force() > rounding * load.heldForce && load.heldForce > 0) {
            const double overForce = 1 / load.heldForce;
            side.force = rest.force() * overForce;
            for (int i = 0; i < 3; ++i)
                side.pressed[i] = (rest.pressed(i) - rest.force() * here[i]) * overForce;
        }
        return side;
    }
    template <class Visit> void each(Visit&& visit)
    {
        std::for_each(origin.data(), origin.data() + 3, visit);
        for (int i = 0; i < count; ++i) {
            std::for_each(faces[i].sum.all, faces[i].sum.all + Sum::size, visit);
            std::for_each(faces[i].normal.data(), faces[i].normal.data() + 3, visit);
            visit(faces[i].count);
        }
    }

    int count = 0; // first: of most bodies nothing else is read
    Eigen::Vector3d origin = Eigen::Vector3d::Zero();
    Face faces[most];
};

} // namespace potential_particles
