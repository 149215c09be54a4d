// SPDX-License-Identifier: GPL-3.0-or-later
#include "particle.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <iterator>
#include <limits>
#include <mutex>
#include <stdexcept>
#include <unordered_map>

namespace potential_particles {

namespace {

    // All seven attributes, of a Definition or a shape.
    template <class Other> bool sameAttributes(const Definition& one, const Other& other)
    {
        return sameBits(one.r, other.r) && sameBits(one.k, other.k) && sameBits(one.R, other.R)
            && sameBits(one.a, other.a) && sameBits(one.b, other.b) && sameBits(one.c, other.c)
            && sameBits(one.d, other.d);
    }

    std::uint64_t nextSerial()
    {
        static std::atomic<std::uint64_t> last { 0 };
        return ++last;
    }

    std::string lengths(const Definition& definition)
    {
        return "the planes are incomplete: a, b, c, d have " + std::to_string(definition.a.size()) + ", "
            + std::to_string(definition.b.size()) + ", " + std::to_string(definition.c.size()) + " and "
            + std::to_string(definition.d.size())
            + " entries; set all four to one length, or use shape.planes = [(a, b, c, d), ...]";
    }

} // namespace

Definition Definition::of(const yade::PotentialParticle& shape)
{
    return { shape.a, shape.b, shape.c, shape.d, shape.r, shape.k, shape.R };
}

bool Definition::describes(const yade::PotentialParticle& shape) const { return sameAttributes(*this, shape); }

bool Definition::roughlyDescribes(const yade::PotentialParticle& shape) const
{
    return sameBits(r, shape.r) && sameBits(k, shape.k) && sameBits(R, shape.R);
}

bool Definition::sameAs(const Definition& other) const { return sameAttributes(*this, other); }

std::size_t Definition::hash() const
{
    std::size_t sum = a.size();
    const auto add = [&sum](double value) {
        std::uint64_t bits;
        std::memcpy(&bits, &value, sizeof bits);
        sum = (sum ^ bits) * 0x9e3779b97f4a7c15u;
        sum ^= sum >> 32;
    };
    for (const auto* list : { &a, &b, &c, &d })
        for (const double value : *list)
            add(value);
    for (const double value : { r, k, R })
        add(value);
    return sum;
}

bool Definition::listsAgree() const { return a.size() == b.size() && a.size() == c.size() && a.size() == d.size(); }

// One particle for all bodies of one shape: the planes of a scene then stay in the caches. Shapes are compared bit for
// bit.
std::shared_ptr<const Particle> Particle::make(Definition definition)
{
    static std::mutex& mutex = *new std::mutex;
    static auto& known = *new std::unordered_multimap<std::size_t, std::weak_ptr<const Particle>>;
    static std::size_t sweepAt = 64;

    const std::size_t key = definition.hash();
    {
        const std::lock_guard<std::mutex> lock(mutex);
        const auto [first, last] = known.equal_range(key);
        for (auto entry = first; entry != last; ++entry)
            if (auto particle = entry->second.lock(); particle && particle->definition.sameAs(definition))
                return particle;
    }
    // Made outside the lock: two threads may both make one, which is waste and no error.
    const std::shared_ptr<const Particle> made(new Particle(std::move(definition)));
    const std::lock_guard<std::mutex> lock(mutex);
    if (known.size() >= sweepAt) {
        for (auto entry = known.begin(); entry != known.end();)
            entry = entry->second.expired() ? known.erase(entry) : std::next(entry);
        sweepAt = std::max<std::size_t>(64, 2 * known.size());
    }
    known.emplace(key, made);
    return made;
}

Particle::Particle(Definition given)
    : definition(std::move(given))
    , serial(nextSerial())
    , radius(std::numeric_limits<double>::quiet_NaN())
{
    if (pending()) {
        whyNot = lengths(definition);
        return;
    }
    std::vector<double> rows;
    rows.reserve(4 * definition.a.size());
    for (std::size_t i = 0; i < definition.a.size(); ++i)
        rows.insert(rows.end(), { definition.a[i], definition.b[i], definition.c[i], definition.d[i] });

    pp_particle* made = nullptr;
    char message[PP_MESSAGE_SIZE] = "";
    const pp_status status = pp_particle_new(rows.data(), definition.a.size(), definition.r, definition.k, definition.R,
                                             &made, message, sizeof message);
    if (status != PP_OK) {
        whyNot = message[0] ? message : pp_status_message(status);
        return;
    }
    owned.reset(made);
    requireOk(pp_particle_bounding_radius(made, &radius));
    reaches = Support(definition, made, radius);

    int32_t enclose = 1;
    if (!definition.a.empty() && definition.k < 1)
        requireOk(pp_particle_planes_enclose(made, &enclose));
    if (!enclose)
        seldomMeant = "the " + std::to_string(definition.a.size())
            + " planes enclose no volume, so that only the shadow sphere bounds the particle, at R/sqrt(k) = "
            + std::to_string(definition.R / std::sqrt(definition.k)) + ": is a plane missing?";
}

const pp_particle* Particle::require() const
{
    if (!owned)
        throw std::invalid_argument(whyNot);
    return owned.get();
}

void requireOk(pp_status status)
{
    if (status != PP_OK)
        throw std::invalid_argument(pp_status_message(status));
}

// s = sqrt(S) is a norm of non-negative convex functions, hence convex along the ray, and the ray
// starts where s < 1. Newton's method for s = 1, begun outside the particle, therefore comes down
// to the root from above without ever crossing it: no bracket is needed, and the first step that
// does not lessen t is rounding.
double distanceToSurface(const Particle& particle, const pp_pose& pose, const yade::Vector3r& point,
                         const yade::Vector3r& direction)
{
    const yade::Vector3r centre(pose.position);
    const double outside = (point - centre).norm() + particle.boundingRadius();
    double t = outside;
    for (int step = 0; step < 100; ++step) {
        const yade::Vector3r at = point + t * direction;
        yade::Vector3r gradient;
        double f;
        requireOk(pp_particle_potential(particle.handle(), &pose, at.data(), &f, gradient.data()));
        const double s = std::sqrt(f + 1);
        const double slope = gradient.dot(direction) / (2 * s);
        const double next = t - (s - 1) / slope;
        if (!(next < t) || !(slope > 0))
            break;
        t = std::max(next, 0.0);
        if (t == 0 || (s - 1) / slope < std::numeric_limits<double>::epsilon() * outside)
            break;
    }
    return t;
}

} // namespace potential_particles
