// SPDX-License-Identifier: GPL-3.0-or-later
#include "registration/definitions.hpp"

#include "bo1_conic_pp_aabb.hpp"
#include "bound_watch.hpp"
#include "bounding_box.hpp"

#include <boost/make_shared.hpp>

#include <algorithm>
#include <limits>

namespace potential_particles {

using yade::Vector3r;

Bo1_ConicPP_Aabb::~Bo1_ConicPP_Aabb() = default;
Bo1_PP_Aabb_Conic::~Bo1_PP_Aabb_Conic() = default;

PP_FUNCTOR_1D_DEFINITIONS(Bo1_ConicPP_Aabb)
PP_FUNCTOR_1D_DEFINITIONS(Bo1_PP_Aabb_Conic)

namespace {

    // The dispatcher widens a box by the expected motion of the body in the next targetInterv steps, from the way of
    // its centre since the last box: 0 for a body that turns in one place. This moves the centre's last place as far
    // away as the sides of the box have moved. The dispatcher overwrites it soon after.
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
        // Not `scene`: a shape keeps the functor that first served it, even in another scene, and that functor's
        // pointer may be to a scene that is gone.
        const yade::Scene& stepping = *Singleton<yade::Omega>::instance().getScene();
        const Box box
            = BoundWatch::guards(stepping) ? boxAsTurned(shape, at, stepping) : boxOfAnyTurn(shape, at, stepping);
        countTurning(*bound, box, at.position);
        bound->min = box.lower;
        bound->max = box.upper;
    } catch (...) {
        // Out of memory. A box that is too large misses nothing; a body that has none yet is tried again when the
        // collider runs next.
        if (!bound)
            return;
        bound->max.setConstant(std::numeric_limits<double>::max());
        bound->min = -bound->max;
    }
}

PP_PYTHON_AS_BASE(Bo1_ConicPP_Aabb, yade::BoundFunctor)
PP_PYTHON_AS_BASE(Bo1_PP_Aabb_Conic, Bo1_ConicPP_Aabb)

template <class Archive> void Bo1_ConicPP_Aabb::serialize(Archive& archive, unsigned version)
{
    requireReadable<Bo1_ConicPP_Aabb>(version);
    serializeBase<yade::BoundFunctor>(archive, *this, "BoundFunctor");
}

PP_ARCHIVE_AS_BASE(Bo1_PP_Aabb_Conic, Bo1_ConicPP_Aabb)

} // namespace potential_particles

BOOST_CLASS_EXPORT_IMPLEMENT(potential_particles::Bo1_ConicPP_Aabb)
BOOST_CLASS_EXPORT_IMPLEMENT(potential_particles::Bo1_PP_Aabb_Conic)
