// SPDX-License-Identifier: GPL-3.0-or-later
//
// Laws that a loop of our own computes by itself: to the last bit what their functors compute, without a virtual call,
// a power or a tangent for each contact.
#pragma once

#include "abi/laws.hpp"
#include "in_step.hpp"

#include <cmath>
#include <limits>

namespace yade {
class ScGeom;
class FrictPhys;
class KnKsPhys;
}

namespace potential_particles {

// What a law did.
enum class Done {
    pushed,
    ended, // the contact is over
    notKnown, // nothing: its functor must be called
};

// Law2_ScGeom_FrictPhys_CundallStrack with sphericalBodies=False.
Done cundallStrack(yade::Law2_ScGeom_FrictPhys_CundallStrack& law, yade::Scene& scene, const yade::ScGeom& geom,
                   yade::FrictPhys& phys, const BodyInStep& one, const BodyInStep& other, Push& push);

// The tangent of the last angle, since most contacts have one and the same.
class LastTangent {
public:
    double of(double degrees)
    {
        if (degrees != angle) {
            angle = degrees;
            tangent = std::tan(degrees / 180.0 * M_PI);
        }
        return tangent;
    }

private:
    double angle = std::numeric_limits<double>::quiet_NaN(), tangent = 0;
};

// Law2_SCG_KnKsPhys_KnKsLaw of joints that have no closure (jointType 3) and of rock that is not intact.
Done knKs(yade::Law2_SCG_KnKsPhys_KnKsLaw& law, yade::Scene& scene, const yade::ScGeom& geom, yade::KnKsPhys& phys,
          const BodyInStep& one, const BodyInStep& other, LastTangent& tangent, Push& push);

} // namespace potential_particles
