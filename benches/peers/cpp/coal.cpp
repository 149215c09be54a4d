// SPDX-License-Identifier: MIT OR Apache-2.0
// Coal (formerly HPP-FCL): GJK, and EPA where the cores meet. Ways: contact, contact-nesterov, distance,
// distance-nesterov; contact@1e-3 sets both tolerances. Rounded bodies by Coal's swept sphere.
#include "server.hpp"

#include <coal/collision.h>
#include <coal/distance.h>
#include <coal/shape/convex.h>

using namespace peers;
using coal::Triangle;

namespace {

coal::Transform3s transform(const Placement& at) {
    const auto& q = at.orientation;
    const Eigen::Quaterniond turn(q[0], q[1], q[2], q[3]);
    return {turn.normalized().toRotationMatrix(), coal::Vec3s(at.position[0], at.position[1], at.position[2])};
}

std::unique_ptr<coal::Convex<Triangle>> hull(const Group& group) {
    auto corners = std::make_shared<std::vector<coal::Vec3s>>();
    for (const auto& x : group.corners) corners->emplace_back(x[0], x[1], x[2]);
    auto faces = std::make_shared<std::vector<Triangle>>();
    for (const auto& t : group.triangles) faces->emplace_back(t[0], t[1], t[2]);
    auto shape = std::make_unique<coal::Convex<Triangle>>(corners, unsigned(corners->size()), faces,
                                                          unsigned(faces->size()));
    shape->computeLocalAABB();
    if (group.swept > 0) shape->setSweptSphereRadius(group.swept);
    return shape;
}

std::array<double, 3> numbers(const coal::Vec3s& x) { return {x[0], x[1], x[2]}; }

template <typename Request>
class Coal : public Contestant {
public:
    Coal(const Group& group, bool nesterov, double tolerance) : shape(hull(group)) {
        cold.gjk_variant = nesterov ? coal::GJKVariant::NesterovAcceleration : coal::GJKVariant::DefaultGJK;
        cold.gjk_initial_guess = coal::GJKInitialGuess::DefaultGuess;
        if (tolerance > 0) cold.gjk_tolerance = cold.epa_tolerance = tolerance;
        Request follows = cold;
        follows.gjk_initial_guess = coal::GJKInitialGuess::CachedGuess;
        for (const auto& pair : group.pairs) {
            a.push_back(transform(pair.a));
            b.emplace_back();
            for (const auto& at : pair.b) b.back().push_back(transform(at));
            warm_requests.push_back(follows);
        }
    }

protected:
    std::unique_ptr<coal::Convex<Triangle>> shape;
    Request cold;
    std::vector<Request> warm_requests; // one for each pair: they hold the guess
    std::vector<coal::Transform3s> a;
    std::vector<std::vector<coal::Transform3s>> b;
};

class Contacts : public Coal<coal::CollisionRequest> {
public:
    Contacts(const Group& group, bool nesterov, double tolerance)
        : Coal(group, nesterov, tolerance)
        , collide(shape.get(), shape.get())
    {
        // Nothing is asked about pairs that are apart, so that GJK may stop at the first separating plane.
        cold.distance_upper_bound = 0;
        for (auto& request : warm_requests) request.distance_upper_bound = 0;
    }

    void pass(std::size_t pose, bool warm) override {
        for (std::size_t i = 0; i < a.size(); ++i) {
            const auto& request = warm ? warm_requests[i] : cold;
            result.clear();
            collide(a[i], b[i][pose], request, result);
            if (warm) request.updateGuess(result);
            auto& answer = answers[i];
            if (!result.isCollision()) {
                answer.kind = Kind::apart;
                continue;
            }
            const auto& contact = result.getContact(0);
            answer.kind = std::isfinite(contact.penetration_depth) && contact.normal.allFinite() ? Kind::found
                                                                                                 : Kind::failed;
            answer.overlap = -contact.penetration_depth; // negative inside
            answer.point = numbers(contact.pos);
            answer.normal = numbers(contact.normal);
        }
    }

private:
    coal::ComputeCollision collide;
    coal::CollisionResult result;
};

class Distances : public Coal<coal::DistanceRequest> {
public:
    Distances(const Group& group, bool nesterov, double tolerance)
        : Coal(group, nesterov, tolerance)
        , measure(shape.get(), shape.get())
    {
    }

    void pass(std::size_t pose, bool warm) override {
        for (std::size_t i = 0; i < a.size(); ++i) {
            const auto& request = warm ? warm_requests[i] : cold;
            result.clear();
            const double distance = measure(a[i], b[i][pose], request, result);
            if (warm) request.updateGuess(result);
            auto& answer = answers[i];
            answer.kind = std::isfinite(distance) ? Kind::found : Kind::failed;
            answer.overlap = -distance;
            answer.point = numbers(0.5 * (result.nearest_points[0] + result.nearest_points[1]));
            answer.normal = numbers(result.normal);
        }
    }

private:
    coal::ComputeDistance measure;
    coal::DistanceResult result;
};

} // namespace

int main(int count, char** arguments) {
    return serve(count, arguments, [](const Group& group, const std::string& way) -> std::unique_ptr<Contestant> {
        const auto at = way.find('@');
        const double tolerance = at == std::string::npos ? 0 : std::stod(way.substr(at + 1));
        const auto name = way.substr(0, at);
        const bool nesterov = name.size() > 9 && name.substr(name.size() - 9) == "-nesterov";
        const auto what = name.substr(0, name.find('-'));
        if (what == "contact") return std::make_unique<Contacts>(group, nesterov, tolerance);
        if (what == "distance") return std::make_unique<Distances>(group, nesterov, tolerance);
        return nullptr;
    });
}
