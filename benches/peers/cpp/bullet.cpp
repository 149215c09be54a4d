// SPDX-License-Identifier: MIT OR Apache-2.0
// Bullet in double precision: its GJK detector with EPA, as its dispatcher calls them for convex hulls. Way: contact.
// Rounded bodies by Bullet's margin.
#include "server.hpp"

#include <btBulletCollisionCommon.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkPairDetector.h>

using namespace peers;

namespace {

btTransform transform(const Placement& at) {
    const auto& q = at.orientation;
    return btTransform(btQuaternion(q[1], q[2], q[3], q[0]).normalized(),
                       btVector3(at.position[0], at.position[1], at.position[2]));
}

std::array<double, 3> numbers(const btVector3& x) { return {x.x(), x.y(), x.z()}; }

// Takes the one point of the detector: on B, with the normal towards A.
struct Taken : btDiscreteCollisionDetectorInterface::Result {
    bool any = false;
    double depth = 0;
    btVector3 normal, on_b;
    void setShapeIdentifiersA(int, int) override {}
    void setShapeIdentifiersB(int, int) override {}
    void addContactPoint(const btVector3& towards_a, const btVector3& point, btScalar distance) override {
        any = true;
        depth = -distance;
        normal = towards_a;
        on_b = point;
    }
};

class Bullet : public Contestant {
public:
    Bullet(const Group& group) {
        for (const auto& x : group.corners) shape.addPoint(btVector3(x[0], x[1], x[2]), false);
        shape.setMargin(group.swept);
        shape.recalcLocalAabb();
        for (const auto& pair : group.pairs) {
            a.push_back(transform(pair.a));
            b.emplace_back();
            for (const auto& at : pair.b) b.back().push_back(transform(at));
            // The detector keeps the last separating axis of a pair, from which its next call starts.
            detectors.emplace_back(std::make_unique<btGjkPairDetector>(&shape, &shape, &simplex, &depth));
        }
    }

    void pass(std::size_t pose, bool warm) override {
        for (std::size_t i = 0; i < a.size(); ++i) {
            auto& detector = *detectors[i];
            if (!warm) detector.setCachedSeparatingAxis(btVector3(0, 1, 0)); // as a new one has it
            btDiscreteCollisionDetectorInterface::ClosestPointInput input;
            input.m_transformA = a[i];
            input.m_transformB = b[i][pose];
            input.m_maximumDistanceSquared = 4 * shape.getMargin() * shape.getMargin();
            Taken taken;
            detector.getClosestPoints(input, taken, nullptr);
            auto& answer = answers[i];
            answer.kind = taken.any && taken.depth >= 0 ? Kind::found : Kind::apart;
            answer.overlap = taken.depth;
            answer.point = numbers(taken.on_b + 0.5 * taken.depth * -taken.normal);
            answer.normal = numbers(-taken.normal);
        }
    }

private:
    btConvexHullShape shape;
    btVoronoiSimplexSolver simplex;
    btGjkEpaPenetrationDepthSolver depth;
    std::vector<btTransform> a;
    std::vector<std::vector<btTransform>> b;
    std::vector<std::unique_ptr<btGjkPairDetector>> detectors;
};

} // namespace

int main(int count, char** arguments) {
    return serve(count, arguments, [](const Group& group, const std::string& way) -> std::unique_ptr<Contestant> {
        if (way == "contact") return std::make_unique<Bullet>(group);
        return nullptr;
    });
}
