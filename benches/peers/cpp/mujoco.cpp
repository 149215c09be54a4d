// SPDX-License-Identifier: MIT OR Apache-2.0
// MuJoCo: GJK and EPA of two convex meshes, as mj_geomDistance gives them: a signed distance and the points at its
// ends. It has no meshes with a rounded surface, and no memory from call to call. The time step of a simulation, which
// limits itself to bodies that are near and makes several points of faces on each other, is another work, and is not
// measured.
#include "server.hpp"

#include <mujoco/mujoco.h>

using namespace peers;

namespace {

constexpr double reach = 1e3; // the largest distance that is asked for, where it is

struct Model {
    mjModel* model;
    mjData* data;

    explicit Model(const Group& group) {
        std::ostringstream text;
        text.precision(17);
        text << "<mujoco><asset><mesh name='body' vertex='";
        for (const auto& x : group.corners) text << x[0] << ' ' << x[1] << ' ' << x[2] << ' ';
        text << "'/></asset><worldbody><body><geom type='mesh' mesh='body'/></body><body><geom type='mesh' "
                "mesh='body'/></body></worldbody></mujoco>";
        char error[1000] = "";
        mjSpec* spec = mj_parseXMLString(text.str().c_str(), nullptr, error, sizeof error);
        if (!spec) throw std::runtime_error(error);
        model = mj_compile(spec, nullptr);
        if (!model) throw std::runtime_error(mjs_getError(spec));
        mj_deleteSpec(spec);
        data = mj_makeData(model);
    }

    ~Model() {
        mj_deleteData(data);
        mj_deleteModel(model);
    }
};

// Of a mesh, which MuJoCo has in a frame of its own, at a pose of the body.
struct At {
    std::array<double, 3> position;
    std::array<double, 9> axes;
};

At place(const mjModel* model, int geom, const Placement& at) {
    At placed;
    double turn[4], length = 0;
    for (double q : at.orientation) length += q * q;
    for (int i = 0; i < 4; ++i) turn[i] = at.orientation[i] / std::sqrt(length);
    mju_rotVecQuat(placed.position.data(), model->geom_pos + 3 * geom, turn);
    for (int i = 0; i < 3; ++i) placed.position[i] += at.position[i];
    double both[4];
    mju_mulQuat(both, turn, model->geom_quat + 4 * geom);
    mju_quat2Mat(placed.axes.data(), both);
    return placed;
}

class Distances : public Contestant {
public:
    Distances(const Group& group, bool touching) : of(group), most(touching ? 0.0 : reach) {
        for (const auto& pair : group.pairs) {
            a.push_back(place(of.model, 0, pair.a));
            b.emplace_back();
            for (const auto& at : pair.b) b.back().push_back(place(of.model, 1, at));
        }
    }

    void pass(std::size_t pose, bool) override {
        for (std::size_t i = 0; i < a.size(); ++i) {
            put(0, a[i]);
            put(1, b[i][pose]);
            double ends[6];
            const double distance = mj_geomDistance(of.model, of.data, 0, 1, most, ends);
            auto& answer = answers[i];
            // What is farther than asked for is answered by that.
            if (most == 0.0 && !(distance < 0.0)) {
                answer.kind = Kind::apart;
                continue;
            }
            answer.overlap = -distance;
            double length = 0;
            for (int j = 0; j < 3; ++j) {
                answer.point[j] = 0.5 * (ends[j] + ends[3 + j]);
                answer.normal[j] = (ends[3 + j] - ends[j]) * (distance < 0 ? -1.0 : 1.0);
                length += answer.normal[j] * answer.normal[j];
            }
            for (double& n : answer.normal) n /= std::sqrt(length);
            answer.kind = std::isfinite(distance) && length > 0 ? Kind::found : Kind::failed;
        }
    }

private:
    void put(int geom, const At& at) {
        std::copy(at.position.begin(), at.position.end(), of.data->geom_xpos + 3 * geom);
        std::copy(at.axes.begin(), at.axes.end(), of.data->geom_xmat + 9 * geom);
    }

    Model of;
    double most;
    std::vector<At> a;
    std::vector<std::vector<At>> b;
};

} // namespace

int main(int count, char** arguments) {
    return serve(count, arguments, [](const Group& group, const std::string& way) -> std::unique_ptr<Contestant> {
        if (way == "contact" || way == "distance") return std::make_unique<Distances>(group, way == "contact");
        return nullptr;
    });
}
