// SPDX-License-Identifier: GPL-3.0-or-later
//
// The library's particle that belongs to a YADE shape; poses as the library has them.
#pragma once

#include "abi/base.hpp"
#include "abi/shape.hpp"
#include "abi/state.hpp"

#include "support.hpp"

#include <potential_particles.h>

#include <cstdint>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

namespace potential_particles {

// NaN is itself, and -0 is not 0.
inline bool sameBits(double left, double right) { return std::memcmp(&left, &right, sizeof left) == 0; }
inline bool sameBits(const std::vector<double>& left, const std::vector<double>& right)
{
    return left.size() == right.size()
        && (left.empty() || std::memcmp(left.data(), right.data(), left.size() * sizeof(double)) == 0);
}

// The attributes of a shape that say which particle it is.
struct Definition {
    std::vector<double> a, b, c, d;
    double r, k, R;

    static Definition of(const yade::PotentialParticle& shape);

    // Bit for bit, so that a NaN equals itself.
    bool describes(const yade::PotentialParticle& shape) const;
    // r, k and R alone.
    bool roughlyDescribes(const yade::PotentialParticle& shape) const;
    bool sameAs(const Definition& other) const;
    std::size_t hash() const;
    bool listsAgree() const;
};

// A definition and what the library made of it. Never changes, so threads may share it.
class Particle {
public:
    // Never null. A definition that the library refuses gives a particle without handle.
    static std::shared_ptr<const Particle> make(Definition definition);

    // Null when refused or pending.
    const pp_particle* handle() const { return owned.get(); }
    // Lists of different lengths: a script is about to set the other lists.
    bool pending() const { return !definition.listsAgree(); }
    // Why there is no handle, as a sentence; empty when there is one.
    const std::string& refusal() const { return whyNot; }
    // What is valid and seldom meant, as a sentence; empty when there is nothing to remark.
    const std::string& remark() const { return seldomMeant; }
    // Throws std::invalid_argument with the refusal when there is no handle.
    const pp_particle* require() const;
    double boundingRadius() const { return radius; }
    // Beyond an overlap of this a contact is no spring: r, or the radius of a ball.
    double rounding() const { return definition.k < 1 ? definition.r : definition.R; }
    const Support& support() const { return reaches; }

    const Definition definition;
    // No other particle of this process has it, before or after: an address may be used again.
    const std::uint64_t serial;

private:
    struct Release {
        void operator()(pp_particle* particle) const { pp_particle_free(particle); }
    };

    explicit Particle(Definition given);

    std::unique_ptr<pp_particle, Release> owned;
    std::string whyNot;
    std::string seldomMeant;
    double radius;
    Support reaches;
};

// Throws std::invalid_argument with the library's sentence unless the status is PP_OK.
void requireOk(pp_status status);

// Distance from `point` (world, inside) to the surface along the unit vector `direction`; 0 when
// the point lies on the surface or, by rounding, outside.
double distanceToSurface(const Particle& particle, const pp_pose& pose, const yade::Vector3r& point,
                         const yade::Vector3r& direction);

// Of local axes.
constexpr pp_pose identity = { { 0, 0, 0 }, { 1, 0, 0, 0 } };

// shift: of the periodic image in which the body is met.
inline pp_pose poseOf(const yade::State& state, const yade::Vector3r& shift)
{
    const yade::Vector3r at = state.se3.position + shift;
    const yade::Quaternionr& turn = state.se3.orientation;
    return { { at.x(), at.y(), at.z() }, { turn.w(), turn.x(), turn.y(), turn.z() } };
}

} // namespace potential_particles
