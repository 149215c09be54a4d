// SPDX-License-Identifier: GPL-3.0-or-later
//
// The shape: YADE's PotentialParticle that carries the library's particle.
#pragma once

#include "abi/archive.hpp"
#include "particle/particle.hpp"
#include "published.hpp"

#include <boost/python/list.hpp>

#include <optional>

namespace potential_particles {

// Being a PotentialParticle, it works with YADE's bounds functor, recorder, display and law.
//
// When the library's particle is made anew: every way by which Python or an archive changes a, b,
// c, d, r, k, R ends in settle(), because this class replaces those properties of its base by its
// own. go() therefore finds the particle ready and only compares r, k and R (a few loads) against
// code that writes the base's fields past this class; if those differ it asks the ParticleStore,
// which compares everything.
class ConicPotentialParticle final : public yade::PotentialParticle {
public:
    ConicPotentialParticle();
    ~ConicPotentialParticle() override;
    PP_ABI_SERIALIZABLE_OVERRIDES
    PP_ABI_INDEX_OVERRIDES

    // For the contact functor; any thread. Null when the fields differ from what it was made of.
    const Particle* particle() const;

    // Makes the particle of the present attributes. An invalid set of attributes is replaced by
    // the last valid one and reported as std::invalid_argument (ValueError in Python).
    void settle();

    // While true, the box of the bounds functor (AabbMinMax, min/maxAabb, min/maxAabbRotated,
    // vertices) is the library's; giving any of them turns it off.
    bool automaticBox = true;

private:
    PP_ARCHIVED

    // For Python: the particle, or std::invalid_argument saying why there is none.
    const pp_particle* require() const;
    void setAttribute(const std::string& key, const boost::python::object& value);
    // Sets the fields that say which particle it is.
    void give(const Definition& definition);
    void fillBox();

    boost::python::list pyPlanes() const;
    void pySetPlanes(const boost::python::object& rows);
    void pySetAutomaticBox(bool automatic);
    boost::python::tuple pyMassProperties(double tolerance) const;
    double pyVolume() const;
    yade::Vector3r pyCentroid() const;
    Eigen::Matrix3d pyInertia() const;
    double pyBoundingRadius() const;
    double pyPotential(const yade::Vector3r& point) const;
    boost::python::list pySurfaceDistance(const boost::python::object& directions) const;

    Published<Particle> made;
    Definition accepted;
    // What the group of attributes that is being set says about the box; see callPostLoad().
    bool boxGiven = false;
    std::optional<bool> automaticBoxGiven;
};

} // namespace potential_particles
