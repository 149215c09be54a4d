// SPDX-License-Identifier: GPL-3.0-or-later
//
// The extension module potential_particles._glue, and the entry of our classes into YADE. The package's __init__.py
// decides what to call.
#include "abi/registry.hpp"

#include "breakage/force_moments.hpp"
#include "check/load_check.hpp"
#include "class_table.hpp"
#include "drawing/gl1_potential_particle_conic.hpp"
#include "joint/conic_joint.hpp"
#include "joint/joints_in_step.hpp"
#include "joint/patch_surface.hpp"
#include "mesh/obstacles.hpp"
#include "particle/particle_store.hpp"
#include "python_bytes.hpp"
#include "shape/conic_potential_particle.hpp"
#include "shape/plane_lists.hpp"

#include <boost/archive/basic_archive.hpp>
#include <boost/python/def.hpp>
#include <boost/python/dict.hpp>
#include <boost/python/list.hpp>
#include <boost/python/module.hpp>
#include <boost/python/scope.hpp>

namespace py = boost::python;
namespace pp = potential_particles;

namespace {

py::list differencesOfLayout()
{
    py::list sentences;
    for (const std::string& sentence : pp::differencesOfLayout())
        sentences.append(sentence);
    return sentences;
}

std::size_t storedParticles() { return pp::ParticleStore::instance().size(); }

// For plain shapes, whose own properties know no lock.
void setListOf(yade::PotentialParticle& shape, const std::string& name, const py::object& value)
{
    if (!pp::setList(shape, name, value))
        throw std::invalid_argument("PotentialParticle has no list '" + name + "'");
}

// On ranks; see joints_in_step.hpp. ids: int32 a row, as bytes; so are the numbers.
const yade::Scene& scene() { return *Singleton<yade::Omega>::instance().getScene(); }
void refreshJoints(long inStep) { pp::JointsInStep::all().refreshOnRank(scene(), inStep); }
py::object giveJoints(const py::object& ids)
{
    return pp::bytes(pp::JointsInStep::all().give(scene(), pp::rowsOf<int>(ids)));
}
void takeJoints(const py::object& ids, const py::object& numbers)
{
    pp::JointsInStep::all().take(scene(), pp::rowsOf<int>(ids), pp::rowsOf<double>(numbers));
}

// Of all bodies, 9 numbers each, in the order of ids, row by row.
py::object forceMoments()
{
    std::vector<pp::Tensor> sums;
    pp::sumForceMoments(scene(), sums);
    std::vector<double> rows;
    for (const pp::Tensor& sum : sums)
        for (int i = 0; i < 9; ++i)
            rows.push_back(sum(i / 3, i % 3));
    return pp::bytes(rows);
}

// Enters our classes into YADE's factory, class table and Python module yade.wrapper, in the order of class_table.inc.
// Throws std::runtime_error when a name is taken.
void registerClasses()
{
    // Their class indices must exist before any dispatcher sizes its table.
    const pp::ConicPotentialParticle shape;
    const pp::ConicJointMat material;
    const pp::ConicJointPhys physics;

#define PP_CLASS(Name, Base, First, Second, Version, Doc) pp::enterInFactory<pp::Name>();
#include "class_table.inc"

    // The list of plugins is read once, when YADE starts; this enters classes later than that.
    std::vector<std::string> names;
#define PP_CLASS(Name, Base, First, Second, Version, Doc) names.push_back(#Name);
#include "class_table.inc"
    Singleton<yade::Omega>::instance().buildDynlibDatabase(names);
}

} // namespace

BOOST_PYTHON_MODULE(_glue)
{
    // Of the class table: the names, and the two shapes that each contact functor serves.
    py::list names;
    py::dict pairs;
#define PP_CLASS(Name, Base, First, Second, Version, Doc)                                                              \
    names.append(#Name);                                                                                               \
    if (*Second)                                                                                                       \
        pairs[#Name] = py::make_tuple(First, Second);
#include "class_table.inc"
    py::scope().attr("class_names") = names;
    py::scope().attr("served_pairs") = pairs;
    py::scope().attr("header_version") = py::make_tuple(PP_VERSION_MAJOR, PP_VERSION_MINOR, PP_VERSION_PATCH);
    py::scope().attr("header_abi") = PP_ABI_VERSION;

    py::scope().attr("built_for_yade") = PP_YADE_NAME;
    py::scope().attr("built_for_yade_number") = PP_YADE_VERSION;
    py::scope().attr("archive_version") = static_cast<unsigned>(boost::archive::BOOST_ARCHIVE_VERSION());

    py::def("library_version", &pp_version);
    py::def("library_abi", &pp_abi_version);
    py::def("differences_of_layout", &differencesOfLayout);
    py::def("register_classes", &registerClasses);
    py::def("stored_particles", &storedParticles);
    py::def("retired_count", &pp::retiredCount);
    py::def("set_list", &setListOf);
    py::def("refresh_joints", &refreshJoints);
    py::def("give_joints", &giveJoints);
    py::def("take_joints", &takeJoints);
    py::def("force_moments", &forceMoments);
    py::def("surface_mesh", &pp::surfaceMesh);
    py::def("patch_surface", &pp::patchSurface);
    py::def("bodies_near", &pp::bodiesNear);
    py::def("definition_of", &pp::definitionOf);
    py::def("window_dispatcher", &pp::windowDispatcher);
}
