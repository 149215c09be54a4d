// SPDX-License-Identifier: GPL-3.0-or-later
#include "registration/definitions.hpp"

#include "conic_potential_particle.hpp"
#include "plane_lists.hpp"
#include "particle/particle.hpp"
#include "registration/python_lock.hpp"

#include <algorithm>
#include <array>

namespace potential_particles {

using yade::Vector3r;

namespace {

    // The attributes of the base that PotentialParticle2AABB reads.
    constexpr std::array<const char*, 6> boxAttributes
        = { "AabbMinMax", "minAabb", "maxAabb", "minAabbRotated", "maxAabbRotated", "vertices" };

    // YADE's defaults mean "nothing given", which matters for attributes copied from a plain shape.
    bool saysSomething(const yade::PotentialParticle& shape, const std::string& boxAttribute)
    {
        if (boxAttribute == "AabbMinMax")
            return shape.AabbMinMax;
        if (boxAttribute == "vertices")
            return !shape.vertices.empty();
        const Vector3r& corner = boxAttribute == "minAabb" ? shape.minAabb
            : boxAttribute == "maxAabb"                    ? shape.maxAabb
            : boxAttribute == "minAabbRotated"             ? shape.minAabbRotated
                                                           : shape.maxAabbRotated;
        return !corner.isZero(0);
    }

} // namespace

ConicPotentialParticle::ConicPotentialParticle()
    : accepted(Definition::of(*this))
{
    takeClassIndex(*this);
}

ConicPotentialParticle::~ConicPotentialParticle() = default;

PP_CLASS_DEFINITIONS(ConicPotentialParticle)
int ConicPotentialParticle::getBaseClassNumber() const { return 1; }

PP_INDEX_DEFINITIONS(ConicPotentialParticle, yade::PotentialParticle)

// --- the particle ---------------------------------------------------------------------------

namespace {
    // A shape is made by Python or by an archive, which may not hold Python's lock.
    void warn(const std::string& sentence)
    {
        const bool raised = [&] {
            const PythonLock lock;
            return PyErr_WarnEx(PyExc_UserWarning, sentence.c_str(), 1) != 0;
        }();
        if (raised) // warnings are errors here
            py::throw_error_already_set();
    }
}

const Particle* ConicPotentialParticle::particle() const
{
    const Particle* particle = made.get();
    return particle && particle->definition.roughlyDescribes(*this) ? particle : nullptr;
}

const pp_particle* ConicPotentialParticle::require() const
{
    if (!made.held())
        throw std::logic_error("ConicPotentialParticle was made without its constructor from Python");
    return made.held()->require();
}

void ConicPotentialParticle::settle()
{
    if (!made.held() || !made.held()->definition.describes(*this)) {
        const auto next = Particle::make(Definition::of(*this));
        if (!next->handle() && !next->pending()) {
            give(accepted);
            throw std::invalid_argument("ConicPotentialParticle: " + next->refusal());
        }
        accepted = next->definition;
        made.replace(next);
        if (!next->remark().empty())
            warn("ConicPotentialParticle: " + next->remark());
    }
    if (automaticBox)
        fillBox();
}

void ConicPotentialParticle::give(const Definition& definition)
{
    using Base = yade::PotentialParticle;
    setList(*this, &Base::a, definition.a);
    setList(*this, &Base::b, definition.b);
    setList(*this, &Base::c, definition.c);
    setList(*this, &Base::d, definition.d);
    r = definition.r;
    k = definition.k;
    R = definition.R;
}

void ConicPotentialParticle::fillBox()
{
    const pp_particle* particle = made.held()->handle();
    if (!particle)
        return;
    std::size_t count = 0;
    const pp_status sized = pp_particle_corners(particle, nullptr, 0, &count);
    if (sized != PP_BUFFER_TOO_SMALL)
        requireOk(sized);
    std::vector<Vector3r> corners(count);
    if (count > 0)
        requireOk(pp_particle_corners(particle, corners.front().data(), count, &count));
    Vector3r lower, upper;
    requireOk(pp_particle_box(particle, &identity, lower.data(), upper.data()));

    setVertices(*this, std::move(corners));
    minAabb = minAabbRotated = -lower;
    maxAabb = maxAabbRotated = upper;
    AabbMinMax = true;
}

// --- Python ---------------------------------------------------------------------------------

void ConicPotentialParticle::pySetAttr(const std::string& key, const py::object& value)
{
    try {
        setAttribute(key, value);
    } catch (...) {
        // One of a group, of which no more will come: what was set before it must not stay behind,
        // since settle() would never see it.
        give(accepted);
        boxGiven = false;
        automaticBoxGiven.reset();
        throw;
    }
}

void ConicPotentialParticle::setAttribute(const std::string& key, const py::object& value)
{
    if (key == "planes") {
        pySetPlanes(value);
    } else if (key == "automaticBox") {
        automaticBoxGiven = py::extract<bool>(value)();
    } else {
        if (!setList(*this, key, value))
            PotentialParticle::pySetAttr(key, value);
        if (std::find(boxAttributes.begin(), boxAttributes.end(), key) != boxAttributes.end())
            boxGiven = boxGiven || saysSomething(*this, key);
    }
}

py::dict ConicPotentialParticle::pyDict() const
{
    py::dict attributes;
    attributes["automaticBox"] = automaticBox;
    attributes.update(pyDictCustom());
    attributes.update(PotentialParticle::pyDict());
    return attributes;
}

void ConicPotentialParticle::callPostLoad()
{
    PotentialParticle::callPostLoad();
    // An explicit choice wins over what the presence of a box suggests: a copy of a shape carries
    // both the box and the information whose it is.
    if (automaticBoxGiven)
        automaticBox = *automaticBoxGiven;
    else if (boxGiven)
        automaticBox = false;
    automaticBoxGiven.reset();
    boxGiven = false;
    settle();
}

// --- archives -------------------------------------------------------------------------------

template <class Archive> void ConicPotentialParticle::serialize(Archive& archive, unsigned version)
{
    requireReadable<ConicPotentialParticle>(version);
    serializeBase<yade::PotentialParticle>(archive, *this, "PotentialParticle");
    archive& boost::serialization::make_nvp("automaticBox", automaticBox);
    if (Archive::is_loading::value)
        settle();
}

} // namespace potential_particles

BOOST_CLASS_EXPORT_IMPLEMENT(potential_particles::ConicPotentialParticle)
