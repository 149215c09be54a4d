// SPDX-License-Identifier: MIT OR Apache-2.0
// What the C++ contestants share: the file of pairs of pairs.py, and the server that times one pass over a group on
// request; the same protocol as rust/src/server.rs, where it is described.
#pragma once

#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <functional>
#include <iostream>
#include <limits>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace peers {

struct Placement {
    std::array<double, 3> position;
    std::array<double, 4> orientation; // w, x, y, z
};

struct Pair {
    Placement a;
    std::vector<Placement> b; // from time to time
};

struct Group {
    std::string name;
    double r, k, shadow;
    double swept; // radius of the ball that sweeps the hull of the corners
    std::vector<std::array<double, 4>> planes;
    std::vector<std::array<double, 3>> corners;
    std::vector<std::array<unsigned, 3>> triangles;
    std::vector<Pair> pairs;
};

enum class Kind { failed, apart, found };

struct Answer {
    Kind kind = Kind::failed;
    double overlap = std::numeric_limits<double>::quiet_NaN(); // < 0: minus the distance
    std::array<double, 3> point{}, normal{};
};

// A contestant, ready for one group.
class Contestant {
public:
    virtual ~Contestant() = default;
    // All pairs at the pose of that number; warm: from what the pass before left.
    virtual void pass(std::size_t pose, bool warm) = 0;
    std::vector<Answer> answers;
};

using Maker = std::function<std::unique_ptr<Contestant>(const Group&, const std::string& way)>;

template <typename Row>
std::vector<Row> rows(std::istream& in, std::size_t count) {
    std::vector<Row> all(count);
    for (auto& row : all)
        for (auto& value : row) in >> value;
    return all;
}

inline Placement placement(std::istream& in) {
    Placement one;
    for (auto& value : one.position) in >> value;
    for (auto& value : one.orientation) in >> value;
    return one;
}

inline std::vector<Group> read(const char* path) {
    std::ifstream in(path);
    std::size_t count = 0;
    in >> count;
    std::vector<Group> groups(count);
    for (auto& group : groups) {
        std::size_t planes, corners, triangles, pairs, poses;
        in >> group.name >> group.r >> group.k >> group.shadow >> group.swept;
        in >> planes >> corners >> triangles >> pairs >> poses;
        group.planes = rows<std::array<double, 4>>(in, planes);
        group.corners = rows<std::array<double, 3>>(in, corners);
        group.triangles = rows<std::array<unsigned, 3>>(in, triangles);
        group.pairs.resize(pairs);
        for (auto& pair : group.pairs) {
            pair.a = placement(in);
            for (std::size_t i = 0; i < poses; ++i) pair.b.push_back(placement(in));
        }
    }
    if (!in) throw std::runtime_error(std::string(path) + " cannot be read, or ends too early");
    return groups;
}

// Seconds a call. The first walk through the poses, untimed, brings code and data into the caches and fills the
// memories.
inline double time(Contestant& contestant, std::size_t poses, std::size_t pairs, bool warm, double least) {
    using Clock = std::chrono::steady_clock;
    auto walk = [&] {
        for (std::size_t pose = 0; pose < poses; ++pose) contestant.pass(pose, warm);
        for (std::size_t pose = poses - 2; pose > 0; --pose) contestant.pass(pose, warm);
        return pairs * (2 * poses - 2);
    };
    walk();
    const auto begin = Clock::now();
    for (std::size_t calls = 0;;) {
        calls += walk();
        const double seconds = std::chrono::duration<double>(Clock::now() - begin).count();
        if (seconds >= least) return seconds / double(calls);
    }
}

inline void print(const std::vector<Answer>& answers) {
    std::printf(">[");
    const char* comma = "";
    for (const auto& answer : answers) {
        std::printf("%s", comma);
        comma = ", ";
        const auto &p = answer.point, &n = answer.normal;
        if (answer.kind == Kind::failed) std::printf("null");
        else if (answer.kind == Kind::apart) std::printf("[]");
        else
            std::printf("[%.17g, %.17g, %.17g, %.17g, %.17g, %.17g, %.17g]", answer.overlap, p[0], p[1], p[2], n[0],
                        n[1], n[2]);
    }
    std::printf("]\n");
}

inline int serve(int count, char** arguments, const Maker& make) try {
    if (count != 2) throw std::runtime_error("give the file of pairs as the only argument");
    const auto groups = read(arguments[1]);
    std::string kept, line;
    std::unique_ptr<Contestant> contestant;
    while (std::getline(std::cin, line)) {
        std::istringstream words(line);
        std::string request, name, way, warmth;
        double least = 0;
        words >> request >> name >> way >> warmth >> least;
        const Group* group = nullptr;
        for (const auto& one : groups)
            if (one.name == name) group = &one;
        if (!group) throw std::runtime_error("no group " + name);
        if (kept != name + " " + way) {
            contestant = make(*group, way);
            if (!contestant) throw std::runtime_error("no way " + way);
            contestant->answers.assign(group->pairs.size(), Answer());
            kept = name + " " + way;
        }
        const bool warm = warmth == "warm";
        const std::size_t poses = group->pairs[0].b.size();
        if (request == "time") {
            std::printf(">%.17g\n", time(*contestant, poses, group->pairs.size(), warm, least));
        } else {
            for (std::size_t pose = 0; pose < poses; ++pose) contestant->pass(pose, warm);
            print(contestant->answers);
        }
        std::fflush(stdout);
    }
    return 0;
} catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
}

} // namespace peers
