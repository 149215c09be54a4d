// SPDX-License-Identifier: GPL-3.0-or-later
//
// The contact functors' names, attributes, Python classes and archives.
#include "registration/definitions.hpp"

#include "counters.hpp"
#include "ig2_conic_pp.hpp"

#include <limits>

namespace potential_particles {

namespace {

    py::tuple pose(const pp_pose& given)
    {
        const auto& [x, y, z] = given.position;
        const auto& [qw, qx, qy, qz] = given.orientation;
        return py::make_tuple(py::make_tuple(x, y, z), py::make_tuple(qw, qx, qy, qz));
    }

} // namespace

Ig2_ConicPP_ConicPP_ScGeom::Ig2_ConicPP_ConicPP_ScGeom() { settle(); }

Ig2_ConicPP_ConicPP_ScGeom::~Ig2_ConicPP_ConicPP_ScGeom() = default;
Ig2_PP_PP_ScGeom_Conic::~Ig2_PP_PP_ScGeom_Conic() = default;

PP_FUNCTOR_2D_DEFINITIONS(Ig2_ConicPP_ConicPP_ScGeom)
int Ig2_ConicPP_ConicPP_ScGeom::getBaseClassNumber() const { return 1; }

PP_FUNCTOR_2D_DEFINITIONS(Ig2_PP_PP_ScGeom_Conic)
PP_PYTHON_AS_BASE(Ig2_PP_PP_ScGeom_Conic, Ig2_ConicPP_ConicPP_ScGeom)

void Ig2_ConicPP_ConicPP_ScGeom::settle()
{
    try {
        accepted.replace(std::make_shared<const AcceptedSettings>(written));
    } catch (const std::invalid_argument& error) {
        written = accepted.held()->given;
        throw std::invalid_argument(getClassName() + ": " + error.what());
    }
}

void Ig2_ConicPP_ConicPP_ScGeom::callPostLoad()
{
    IGeomFunctor::callPostLoad();
    settle();
}

void Ig2_ConicPP_ConicPP_ScGeom::pySetAttr(const std::string& key, const py::object& value)
{
    try {
        bool own = false;
        ContactSettings::eachAttribute([&](const char* name, auto member, const char*, unsigned = 0) {
            if (key != name)
                return;
            written.*member = py::extract<typename Pointed<decltype(member)>::type>(value)();
            own = true;
        });
        if (!own)
            IGeomFunctor::pySetAttr(key, value);
    } catch (...) {
        // updateAttrs sets one after the other and checks at its end, which it does not reach now.
        written = accepted.held()->given;
        throw;
    }
}

py::dict Ig2_ConicPP_ConicPP_ScGeom::pyDict() const
{
    py::dict attributes;
    ContactSettings::eachAttribute([&](const char* name, auto member, const char*, unsigned = 0) {
        attributes[name] = py::object(written.*member);
    });
    attributes.update(pyDictCustom());
    attributes.update(IGeomFunctor::pyDict());
    return attributes;
}

void Ig2_ConicPP_ConicPP_ScGeom::pyRegisterClass(py::object scope)
{
    checkPyClassRegistersItself(Entry<Ig2_ConicPP_ConicPP_ScGeom>::name);
    const py::scope inside(scope);
    const auto style = docstringStyle();
    using Functor = Ig2_ConicPP_ConicPP_ScGeom;
    auto registered = registerClass<Functor, yade::IGeomFunctor>();

    ContactSettings::eachAttribute([&](const char* name, auto member, const char* attributeDoc, unsigned = 0) {
        using Value = typename Pointed<decltype(member)>::type;
        registered.add_property(
            name,
            pythonFunction<Value, const Functor&>([member](const Functor& functor) { return functor.written.*member; }),
            pythonFunction<void, Functor&, const Value&>([member](Functor& functor, const Value& value) {
                functor.written.*member = value;
                functor.settle();
            }),
            attributeDoc);
    });

    const auto count = [&](const char* name, Count what, const char* attributeDoc) {
        registered.add_property(name, pythonFunction<std::uint64_t, const Functor&>([what](const Functor& functor) {
                                    return functor.counters.total(what);
                                }),
                                attributeDoc);
    };
    count("calls", Count::calls, "Calls so far, pairs of two boundaries excepted.");
    count("overlapping", Count::overlapping, "Pairs found in contact.");
    count("areas", Count::areas, "Contact areas computed.");
    count("patches", Count::patches, "Contacts that were given by their patch.");
    count("patchesCarried", Count::patchesCarried, "Those of them that follow from an earlier one by its stiffness.");
    count("doubtfulPatches", Count::doubtfulPatches,
          "Patches that were folded, reached into both cores, or missed patchTolerance.");
    count("patchFallbacks", Count::patchFallbacks,
          "Contacts that were given by their point although the patch was asked for: none was found.");
    count("deepOverlaps", Count::deepOverlaps,
          "Overlaps beyond the rounding radius r, where contacts are no springs; the first is said on stderr.");
    count("extended", Count::extended, "Pairs answered in extended precision, because doubles did not settle them.");
    count("failures", Count::failures,
          "Failed calls: no answer by the back end asked for, or no valid particle or pose.");
    registered
        .add_property(
            "answers", &Functor::pyAnswers,
            "How many pairs were answered in which way: without a solve, apart because their 'motion' was less than "
            "the distance that was between them, by bounding 'spheres', by a 'face', or by 'memory' of what "
            "separated them before; apart by a 'proof' that the solver met; 'carried' on from the contact of the last "
            "step; solved "
            "from the remembered point ('warm') or from nothing ('cold'); or by the 'cone_program' back end.")
        .add_property("rejected", &Functor::pyRejected, "Pairs proved separated without solving to the end.")
        .add_property("solved", &Functor::pySolved, "Pairs solved to the end; those carried on are not.")
        .add_property("skippedShare", &Functor::pySkippedShare,
                      "Share of the pairs that do not touch which were answered without a solve; NaN if all touch.")
        .add_property("seconds", &Functor::pySeconds,
                      "Time inside this functor, summed over threads, while measureTime was True.")
        .add_property("busiestSeconds", &Functor::pyBusiestSeconds,
                      "The same for the thread that spent most: how long the others may have waited for it.")
        .add_property("failureReport", &Functor::pyFailureReport,
                      "First failure of each pair: dicts of ids, poses ((position), (w, x, y, z)) and message.")
        .def("resetCounters", &Functor::pyResetCounters, "Sets all counters to 0 and empties failureReport.");
}

py::list Ig2_ConicPP_ConicPP_ScGeom::pyFailureReport() const
{
    py::list report;
    for (const Failure& failure : failures.all()) {
        py::dict entry;
        entry["id1"] = failure.id1;
        entry["id2"] = failure.id2;
        entry["pose1"] = pose(failure.pose1);
        entry["pose2"] = pose(failure.pose2);
        entry["message"] = failure.message;
        report.append(entry);
    }
    return report;
}

py::dict Ig2_ConicPP_ConicPP_ScGeom::pyAnswers() const
{
    py::dict answers;
    for (const AnswerPath& path : answerPaths)
        answers[path.name] = counters.total(path.count);
    return answers;
}

std::uint64_t Ig2_ConicPP_ConicPP_ScGeom::pyRejected() const
{
    return counters.total(Count::motion) + counters.total(Count::spheres) + counters.total(Count::face)
        + counters.total(Count::memory) + counters.total(Count::proof);
}

std::uint64_t Ig2_ConicPP_ConicPP_ScGeom::pySolved() const
{
    return counters.total(Count::warm) + counters.total(Count::cold) + counters.total(Count::coneProgram);
}

double Ig2_ConicPP_ConicPP_ScGeom::pySkippedShare() const
{
    std::uint64_t answered = 0, skipped = 0;
    for (const AnswerPath& path : answerPaths) {
        const std::uint64_t number = counters.total(path.count);
        answered += number;
        skipped += path.withoutSolve ? number : 0;
    }
    const std::uint64_t apart = answered - counters.total(Count::overlapping);
    return apart > 0 ? static_cast<double>(skipped) / static_cast<double>(apart)
                     : std::numeric_limits<double>::quiet_NaN();
}

double Ig2_ConicPP_ConicPP_ScGeom::pySeconds() const
{
    return 1e-9 * static_cast<double>(counters.total(Count::nanoseconds));
}

double Ig2_ConicPP_ConicPP_ScGeom::pyBusiestSeconds() const
{
    return 1e-9 * static_cast<double>(counters.largest(Count::nanoseconds));
}

void Ig2_ConicPP_ConicPP_ScGeom::pyResetCounters()
{
    counters.reset();
    failures.clear();
}

template <class Archive> void Ig2_ConicPP_ConicPP_ScGeom::serialize(Archive& archive, unsigned version)
{
    requireReadable<Ig2_ConicPP_ConicPP_ScGeom>(version);
    serializeBase<yade::IGeomFunctor>(archive, *this, "IGeomFunctor");
    ContactSettings::eachAttribute([&](const char* name, auto member, const char*, unsigned since = 0) {
        if (version >= since)
            archiveAttribute(archive, name, written.*member);
    });
    if (Archive::is_loading::value) {
        if (written.backEnd == "conic") // the name of files saved before it was changed
            written.backEnd = "cone_program";
        settle();
    }
}

// For the classes derived from it elsewhere.
template void Ig2_ConicPP_ConicPP_ScGeom::serialize(boost::archive::binary_iarchive&, unsigned);
template void Ig2_ConicPP_ConicPP_ScGeom::serialize(boost::archive::binary_oarchive&, unsigned);
template void Ig2_ConicPP_ConicPP_ScGeom::serialize(boost::archive::xml_iarchive&, unsigned);
template void Ig2_ConicPP_ConicPP_ScGeom::serialize(boost::archive::xml_oarchive&, unsigned);

PP_ARCHIVE_AS_BASE(Ig2_PP_PP_ScGeom_Conic, Ig2_ConicPP_ConicPP_ScGeom)

} // namespace potential_particles

BOOST_CLASS_EXPORT_IMPLEMENT(potential_particles::Ig2_ConicPP_ConicPP_ScGeom)
BOOST_CLASS_EXPORT_IMPLEMENT(potential_particles::Ig2_PP_PP_ScGeom_Conic)
