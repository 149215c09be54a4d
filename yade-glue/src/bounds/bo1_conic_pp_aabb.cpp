// SPDX-License-Identifier: GPL-3.0-or-later
#include "registration/archives.hpp"

#include "abi/registry.hpp"
#include "bo1_conic_pp_aabb.hpp"
#include "bound_watch.hpp"
#include "bounding_box.hpp"
#include "registration/class_versions.hpp"
#include "registration/python_class.hpp"

#include <boost/make_shared.hpp>
#include <boost/serialization/base_object.hpp>

#include <algorithm>
#include <limits>

namespace potential_particles {

using yade::Vector3r;

namespace {

    constexpr char doc[]
        = "Box of a ConicPotentialParticle as it is turned, for a collider with a BoundWatch before it. Without one, or when it\n"
          "is dead, the box of the ball in which the particle turns: larger, and right for any turn too.\n"
          "A box that the script gave (automaticBox = False) is turned as it is.";
    constexpr char plainDoc[]
        = "As Bo1_ConicPP_Aabb, for every PotentialParticle, plain ones too: put it in the place of PotentialParticle2AABB.\n"
          "A plain shape keeps the box that it has (AabbMinMax).";

} // namespace

Bo1_ConicPP_Aabb::~Bo1_ConicPP_Aabb() = default;
Bo1_PP_Aabb_Conic::~Bo1_PP_Aabb_Conic() = default;

std::string Bo1_ConicPP_Aabb::getClassName() const { return "Bo1_ConicPP_Aabb"; }
std::string Bo1_ConicPP_Aabb::getBaseClassName(unsigned int index) const { return index == 0 ? "BoundFunctor" : ""; }
std::string Bo1_ConicPP_Aabb::get1DFunctorType1() const { return "ConicPotentialParticle"; }

std::string Bo1_PP_Aabb_Conic::getClassName() const { return "Bo1_PP_Aabb_Conic"; }
std::string Bo1_PP_Aabb_Conic::getBaseClassName(unsigned int index) const { return index == 0 ? "Bo1_ConicPP_Aabb" : ""; }
std::string Bo1_PP_Aabb_Conic::get1DFunctorType1() const { return "PotentialParticle"; }

namespace {

    // The dispatcher widens a box by as much as the body is likely to move until targetInterv steps from now, which it
    // takes from the way of its centre since the last box: of a body that turns in one place, nothing. This moves the
    // centre's last place so far away as the sides of the box have moved. The dispatcher overwrites it a moment later.
    void countTurning(yade::Bound& bound, const Box& box, const Vector3r& centre)
    {
        const Vector3r sweep = Vector3r::Constant(bound.sweepLength);
        const double way = std::max((box.lower - bound.min - sweep).cwiseAbs().maxCoeff(),
                                    (box.upper - bound.max + sweep).cwiseAbs().maxCoeff());
        if (way > (centre - bound.refPos).cwiseAbs().maxCoeff())
            bound.refPos = centre - Vector3r(way, 0, 0);
    }

} // namespace

// In many threads at once; no exception may leave it.
void Bo1_ConicPP_Aabb::go(const boost::shared_ptr<yade::Shape>& shape, boost::shared_ptr<yade::Bound>& bound,
                          const yade::Se3r& at, const yade::Body*)
{
    try {
        if (!bound)
            bound = boost::make_shared<yade::Aabb>();
        // Not `scene`: a shape keeps the functor that first served it, also when it goes into another scene, and that one's pointer
        // is to a scene that may be gone.
        const yade::Scene& stepping = *Singleton<yade::Omega>::instance().getScene();
        const Box box
            = BoundWatch::guards(stepping) ? boxAsTurned(shape, at, stepping) : boxOfAnyTurn(shape, at, stepping);
        countTurning(*bound, box, at.position);
        bound->min = box.lower;
        bound->max = box.upper;
    } catch (...) {
        // Out of memory. A box that is too large misses nothing; a body that has none yet is tried again when the collider runs next.
        if (!bound)
            return;
        bound->max.setConstant(std::numeric_limits<double>::max());
        bound->min = -bound->max;
    }
}

void Bo1_ConicPP_Aabb::pyRegisterClass(py::object scope)
{
    checkPyClassRegistersItself("Bo1_ConicPP_Aabb");
    const py::scope inside(scope);
    const auto style = docstringStyle();
    registerClass<Bo1_ConicPP_Aabb, yade::BoundFunctor>("Bo1_ConicPP_Aabb", doc);
}

void Bo1_PP_Aabb_Conic::pyRegisterClass(py::object scope)
{
    checkPyClassRegistersItself("Bo1_PP_Aabb_Conic");
    const py::scope inside(scope);
    const auto style = docstringStyle();
    registerClass<Bo1_PP_Aabb_Conic, Bo1_ConicPP_Aabb>("Bo1_PP_Aabb_Conic", plainDoc);
}

template <class Archive> void Bo1_ConicPP_Aabb::serialize(Archive& archive, unsigned version)
{
    requireReadable<Bo1_ConicPP_Aabb>(version);
    serializeBase<yade::BoundFunctor>(archive, *this, "BoundFunctor");
}

template <class Archive> void Bo1_PP_Aabb_Conic::serialize(Archive& archive, unsigned version)
{
    requireReadable<Bo1_PP_Aabb_Conic>(version);
    archive& BOOST_SERIALIZATION_BASE_OBJECT_NVP(Bo1_ConicPP_Aabb);
}

} // namespace potential_particles

BOOST_CLASS_EXPORT(potential_particles::Bo1_ConicPP_Aabb)
BOOST_CLASS_EXPORT(potential_particles::Bo1_PP_Aabb_Conic)
