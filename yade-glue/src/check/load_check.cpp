// SPDX-License-Identifier: GPL-3.0-or-later
//
// Each field that Python shows is written on one side and read on the other: set from Python (that is, by YADE's own
// code) to a value no other field has and read through our declaration, or, where Python may not set it, the other way
// round. Fields that Python does not show are covered by the sizes compared at build time.
#include "load_check.hpp"

#include "abi/dispatcher.hpp"
#include "abi/functor.hpp"
#include "abi/knksphys.hpp"
#include "abi/laws.hpp"
#include "abi/material.hpp"
#include "abi/primitives.hpp"
#include "abi/scene.hpp"
#include "abi/scgeom.hpp"
#include "abi/shape.hpp"

#include "bounds/bound_watch.hpp"
#include "table_check.hpp"

#include <boost/python/errors.hpp>
#include <boost/python/extract.hpp>
#include <boost/python/import.hpp>

#include <malloc.h>

#include <array>

namespace potential_particles {

namespace py = boost::python;
using namespace yade;

namespace {

    using Differences = std::vector<std::string>;

    std::string takePythonError()
    {
        PyObject *type = nullptr, *value = nullptr, *trace = nullptr;
        PyErr_Fetch(&type, &value, &trace);
        const py::handle<> text(py::allow_null(value ? PyObject_Str(value) : nullptr));
        std::string message = text ? py::extract<std::string>(py::object(text))() : "unknown Python error";
        Py_XDECREF(type);
        Py_XDECREF(value);
        Py_XDECREF(trace);
        PyErr_Clear();
        return message;
    }

    // Values, a new one at each call, as the type wants them.
    class Values {
    public:
        template <class Value> Value next();

    private:
        double number() { return 3.25 + ++counter; }
        int counter = 0;
    };
    template <> double Values::next() { return number(); }
    template <> int Values::next() { return 1000 + ++counter; }
    template <> long Values::next() { return 100000 + ++counter; }
    template <> std::string Values::next() { return "label" + std::to_string(++counter); }
    template <> Vector3r Values::next() { return Vector3r(number(), number(), number()); }
    template <> Vector3i Values::next() { return Vector3i::Constant(next<int>()) + Vector3i(0, 1000, 2000); }
    template <> Quaternionr Values::next() { return Quaternionr(number(), number(), number(), number()).normalized(); }
    template <> Cell::Matrix Values::next()
    {
        Cell::Matrix matrix = 100 * Cell::Matrix::Identity(); // the cell inverts it
        return matrix.colwise() + next<Vector3r>();
    }
    template <> std::vector<double> Values::next() { return { number(), number() }; }
    template <> std::vector<Vector3r> Values::next()
    {
        return { next<Vector3r>(), next<Vector3r>(), next<Vector3r>() };
    }

    // One object, made by YADE's Python, seen through our declaration of its class.
    template <class Class> class Probe {
    public:
        Probe(Differences& differences, const char* className)
            : differences(differences)
            , className(className)
            , object(py::import("yade.wrapper").attr(className)())
            , seen(py::extract<Class&>(object)())
        {
            // Only a lower bound: the allocator rounds up.
            if (const auto block = malloc_usable_size(&seen); block < sizeof(Class))
                differences.push_back(std::string(className) + ": YADE allocates " + std::to_string(block)
                                      + " bytes, declared are " + std::to_string(sizeof(Class)));
        }

        template <class Value> Probe& field(const char* name, Value Class::*member)
        {
            return field<Value>(name, [member](Class& seen) -> Value& { return seen.*member; });
        }

        template <class Value, class Access> Probe& field(const char* name, Access access)
        {
            if constexpr (std::is_same_v<Value, bool>) {
                // Twice, so that a constant byte in its place does not pass.
                (void)(compare<bool>(name, access, true) && compare<bool>(name, access, false));
            } else {
                compare<Value>(name, access, values.template next<Value>());
            }
            return *this;
        }

        // A shared pointer, to a new object of a class of YADE.
        template <class Value>
        Probe& pointer(const char* name, const char* ofClass, boost::shared_ptr<Value> Class::*member)
        {
            const py::object given = py::import("yade.wrapper").attr(ofClass)();
            object.attr(name) = given;
            if ((seen.*member).get() != &py::extract<Value&>(given)())
                differences.push_back(std::string(className) + "." + name
                                      + ": set from Python, not found at its declared place");
            return *this;
        }

        Class& instance() { return seen; }

    private:
        // False when it noted a difference.
        template <class Value, class Access> bool compare(const char* name, Access access, const Value& value)
        try {
            const std::string where = std::string(className) + "." + name;
            const py::object given(value);
            if (PyObject_SetAttrString(object.ptr(), name, given.ptr()) == 0) {
                if (access(seen) == value)
                    return true;
                differences.push_back(where + ": set from Python, not found at its declared place");
            } else {
                PyErr_Clear();
                access(seen) = value;
                // Compared as Python objects: an extracted copy looks uninitialised to GCC 14.
                const int same = PyObject_RichCompareBool(py::object(object.attr(name)).ptr(), given.ptr(), Py_EQ);
                if (same < 0)
                    py::throw_error_already_set();
                if (same)
                    return true;
                differences.push_back(where + ": written at its declared place, not seen from Python");
            }
            return false;
        } catch (const py::error_already_set&) {
            differences.push_back(std::string(className) + "." + name + ": " + takePythonError());
            return false;
        }

        Differences& differences;
        const char* className;
        py::object object;
        Class& seen;
        Values values;
    };

    void checkShape(Differences& found)
    {
        using P = PotentialParticle;
        Probe<P>(found, "PotentialParticle")
            .field<Vector3r>("color", [](P& p) -> Vector3r& { return p.color; })
            .field<bool>("wire", [](P& p) -> bool& { return p.wire; })
            .field<bool>("highlight", [](P& p) -> bool& { return p.highlight; })
            .field("id", &P::id)
            .field("isBoundary", &P::isBoundary)
            .field("fixedNormal", &P::fixedNormal)
            .field("boundaryNormal", &P::boundaryNormal)
            .field("AabbMinMax", &P::AabbMinMax)
            .field("minAabb", &P::minAabb)
            .field("maxAabb", &P::maxAabb)
            .field("minAabbRotated", &P::minAabbRotated)
            .field("maxAabbRotated", &P::maxAabbRotated)
            .field("r", &P::r)
            .field("R", &P::R)
            .field("k", &P::k)
            .field("vertices", &P::vertices)
            .field("a", &P::a)
            .field("b", &P::b)
            .field("c", &P::c)
            .field("d", &P::d);
    }

    void checkPrimitives(Differences& found)
    {
        Probe<yade::Sphere>(found, "Sphere").field("radius", &yade::Sphere::radius);
        Probe<yade::Cylinder>(found, "Cylinder")
            .field("length", &yade::Cylinder::length)
            .field("segment", &yade::Cylinder::segment);
        Probe<yade::Box>(found, "Box").field("extents", &yade::Box::extents);
        Probe<yade::Wall>(found, "Wall").field("sense", &yade::Wall::sense).field("axis", &yade::Wall::axis);
        Probe<yade::Facet> facet(found, "Facet");
        facet.field("normal", &yade::Facet::normal).field("area", &yade::Facet::area);
        // Python can set three vertices only, all of them at once.
        if (facet.instance().vertices.size() != 3)
            found.push_back("Facet.vertices: not found at its declared place");
        else
            facet.field("vertices", &yade::Facet::vertices);
    }

    void checkState(Differences& found)
    {
        Probe<State> probe(found, "State");
        probe.field<Vector3r>("pos", [](State& s) -> Vector3r& { return s.se3.position; })
            .field<Vector3r>("pos", [](State& s) -> Vector3r& { return s.pos; })
            .field<Quaternionr>("ori", [](State& s) -> Quaternionr& { return s.se3.orientation; })
            .field<Quaternionr>("ori", [](State& s) -> Quaternionr& { return s.ori; })
            .field("vel", &State::vel)
            .field("mass", &State::mass)
            .field("angVel", &State::angVel)
            .field("angMom", &State::angMom)
            .field("inertia", &State::inertia)
            .field("refPos", &State::refPos)
            .field("refOri", &State::refOri)
            .field("isDamped", &State::isDamped)
            .field("densityScaling", &State::densityScaling);
    }

    void checkGeometry(Differences& found)
    {
        using G = ScGeom;
        Probe<G>(found, "ScGeom")
            .field<Vector3r>("normal", [](G& g) -> Vector3r& { return g.normal; })
            .field<Vector3r>("contactPoint", [](G& g) -> Vector3r& { return g.contactPoint; })
            .field<double>("refR1", [](G& g) -> double& { return g.refR1; })
            .field<double>("refR2", [](G& g) -> double& { return g.refR2; })
            .field<double>("refR1", [](G& g) -> double& { return g.radius1; })
            .field<double>("refR2", [](G& g) -> double& { return g.radius2; })
            .field("penetrationDepth", &G::penetrationDepth)
            .field("shearInc", &G::shearInc);
    }

    void checkPhysics(Differences& found)
    {
        using P = KnKsPhys;
        Probe<P>(found, "KnKsPhys")
            .field<double>("kn", [](P& p) -> double& { return p.kn; })
            .field<Vector3r>("normalForce", [](P& p) -> Vector3r& { return p.normalForce; })
            .field<double>("ks", [](P& p) -> double& { return p.ks; })
            .field<Vector3r>("shearForce", [](P& p) -> Vector3r& { return p.shearForce; })
            .field<double>("tangensOfFrictionAngle", [](P& p) -> double& { return p.tangensOfFrictionAngle; })
#if PP_YADE_FRICT_PHYS_EXTRA
            .field<double>("frictDissip", [](P& p) -> double& { return p.frictDissip; })
#endif
            .field("frictionAngle", &P::frictionAngle)
            .field("viscousDamping", &P::viscousDamping)
            .field("maxClosure", &P::maxClosure)
            .field("u_elastic", &P::u_elastic)
            .field("brittleLength", &P::brittleLength)
            .field("knVol", &P::knVol)
            .field("ksVol", &P::ksVol)
            .field("kn_i", &P::kn_i)
            .field("ks_i", &P::ks_i)
            .field("normalViscous", &P::normalViscous)
            .field("shearViscous", &P::shearViscous)
            .field("intactRock", &P::intactRock)
            .field("jointType", &P::jointType)
            .field("shearDir", &P::shearDir)
            .field("prevNormal", &P::prevNormal)
            .field("warmstart", &P::warmstart)
            .field("ptOnP1", &P::ptOnP1)
            .field("ptOnP2", &P::ptOnP2)
            .field("cumulative_us", &P::cumulative_us)
            .field("mobilizedShear", &P::mobilizedShear)
            .field("contactArea", &P::contactArea)
            .field("prevSigma", &P::prevSigma)
            .field("jointLength", &P::jointLength)
            .field("shearIncrementForCD", &P::shearIncrementForCD)
            .field("useFaceProperties", &P::useFaceProperties)
            .field("cohesion", &P::cohesion)
            .field("tension", &P::tension)
            .field("cohesionBroken", &P::cohesionBroken)
            .field("tensionBroken", &P::tensionBroken)
            .field("phi_b", &P::phi_b)
            .field("phi_r", &P::phi_r)
            .field("u_cumulative", &P::u_cumulative)
            .field("initialShearDir", &P::initialShearDir)
            .field("effective_phi", &P::effective_phi)
            .field("isSliding", &P::isSliding);
    }

    void checkMaterial(Differences& found)
    {
        using M = yade::FrictMat;
        Probe<M>(found, "FrictMat")
            .field<int>("id", [](M& m) -> int& { return m.id; })
            .field<std::string>("label", [](M& m) -> std::string& { return m.label; })
            .field<double>("density", [](M& m) -> double& { return m.density; })
            .field<double>("young", [](M& m) -> double& { return m.young; })
            .field<double>("poisson", [](M& m) -> double& { return m.poisson; })
            .field("frictionAngle", &M::frictionAngle);
    }

    void checkInteraction(Differences& found)
    {
        using I = Interaction;
        Probe<I> probe(found, "Interaction");
        probe.field("isActive", &I::isActive)
            .field("id1", &I::id1)
            .field("id2", &I::id2)
            .field("iterMadeReal", &I::iterMadeReal)
            .field("cellDist", &I::cellDist)
            .field("iterBorn", &I::iterBorn);
        I& interaction = probe.instance();
        if (interaction.geom || interaction.phys || !interaction.functorCache.geomExists)
            found.push_back("Interaction: a new one does not look empty at geom, phys, functorCache");
    }

    void checkFunctor(Differences& found)
    {
        Probe<IGeomFunctor> probe(found, "Ig2_PP_PP_ScGeom");
        probe.field<std::string>("label", [](IGeomFunctor& f) -> std::string& { return f.label; });
        IGeomFunctor& builtin = probe.instance();
        const std::string first = builtin.get2DFunctorType1(), second = builtin.get2DFunctorType2();
        if (first != "PotentialParticle" || second != "PotentialParticle"
            || builtin.checkOrder() != first + " " + second)
            found.push_back("IGeomFunctor: virtual calls on Ig2_PP_PP_ScGeom do not answer as they should");
    }

    void checkBound(Differences& found)
    {
        Probe<Aabb>(found, "Aabb")
            .field<int>("lastUpdateIter", [](Aabb& b) -> int& { return b.lastUpdateIter; })
            .field<Vector3r>("refPos", [](Aabb& b) -> Vector3r& { return b.refPos; })
            .field<double>("sweepLength", [](Aabb& b) -> double& { return b.sweepLength; })
            .field<Vector3r>("color", [](Aabb& b) -> Vector3r& { return b.color; })
            .field<Vector3r>("min", [](Aabb& b) -> Vector3r& { return b.min; })
            .field<Vector3r>("max", [](Aabb& b) -> Vector3r& { return b.max; });
        Probe<BoundFunctor> probe(found, "PotentialParticle2AABB");
        probe.field<std::string>("label", [](BoundFunctor& f) -> std::string& { return f.label; });
        if (probe.instance().get1DFunctorType1() != "PotentialParticle")
            found.push_back("BoundFunctor: virtual calls on PotentialParticle2AABB do not answer as they should");
    }

    void checkEngine(Differences& found)
    {
        Probe<GlobalEngine> probe(found, "GlobalEngine");
        probe.field<bool>("dead", [](GlobalEngine& e) -> bool& { return e.dead; })
            .field<int>("ompThreads", [](GlobalEngine& e) -> int& { return e.ompThreads; })
            .field<long>("execCount", [](GlobalEngine& e) -> long& { return e.timingInfo.nExec; })
            .field<std::string>("label", [](GlobalEngine& e) -> std::string& { return e.label; });
        if (!probe.instance().isActivated())
            found.push_back("GlobalEngine: virtual calls do not answer as they should");
    }

    void checkLaws(Differences& found)
    {
        using Cundall = Law2_ScGeom_FrictPhys_CundallStrack;
        Probe<Cundall>(found, "Law2_ScGeom_FrictPhys_CundallStrack")
            .field("neverErase", &Cundall::neverErase)
            .field("sphericalBodies", &Cundall::sphericalBodies)
            .field("traceEnergy", &Cundall::traceEnergy);
        using KnKs = Law2_SCG_KnKsPhys_KnKsLaw;
        Probe<KnKs>(found, "Law2_SCG_KnKsPhys_KnKsLaw")
            .field("neverErase", &KnKs::neverErase)
            .field("traceEnergy", &KnKs::traceEnergy)
            .field("Talesnick", &KnKs::Talesnick)
            .field("allowBreakage", &KnKs::allowBreakage)
            .field("initialOverlapDistance", &KnKs::initialOverlapDistance)
            .field("allowViscousAttraction", &KnKs::allowViscousAttraction);
    }

    // A functor for two classes lies in the dispatcher's list, and in its matrix at their indices.
    template <class Dispatcher, class First, class Second>
    void checkDispatcher(Differences& found, const char* className, const char* functor, const char* first,
                         const char* second)
    {
        const py::object wrapper = py::import("yade.wrapper"), one = wrapper.attr(first)(),
                         other = wrapper.attr(second)();
        py::object dispatcher = wrapper.attr(className)();
        py::list functors;
        functors.append(wrapper.attr(functor)());
        dispatcher.attr("functors") = functors;
        const Dispatcher& seen = py::extract<Dispatcher&>(dispatcher)();
        const auto row = static_cast<std::size_t>(py::extract<const First&>(one)().getClassIndex());
        const auto column = static_cast<std::size_t>(py::extract<const Second&>(other)().getClassIndex());
        const bool listed = seen.functors.size() == 1 && seen.functors[0]
            && seen.functors[0]->getClassName() == functor;
        if (!listed || row >= seen.callBacks.size() || column >= seen.callBacks[row].size()
            || seen.callBacks[row][column] != seen.functors[0] || row >= seen.callBacksInfo.size()
            || column >= seen.callBacksInfo[row].size() || seen.callBacksInfo[row][column] != 0)
            found.push_back(std::string(className) + ": the functor of " + first + " and " + second
                            + " not found at its declared place");
    }

    void checkDispatchers(Differences& found)
    {
        checkDispatcher<IGeomDispatcher, Shape, Shape>(found, "IGeomDispatcher", "Ig2_PP_PP_ScGeom",
                                                       "PotentialParticle", "PotentialParticle");
        checkDispatcher<IPhysDispatcher, Material, Material>(found, "IPhysDispatcher", "Ip2_FrictMat_FrictMat_KnKsPhys",
                                                             "FrictMat", "FrictMat");
        checkDispatcher<LawDispatcher, IGeom, IPhys>(found, "LawDispatcher", "Law2_SCG_KnKsPhys_KnKsLaw", "ScGeom",
                                                     "KnKsPhys");
    }

    void checkBody(Differences& found)
    {
        Probe<Body>(found, "Body")
            .field("id", &Body::id)
            .field("mask", &Body::groupMask)
            .field("flags", &Body::flags)
            .field("subdomain", &Body::subdomain)
            .pointer("state", "State", &Body::state)
            .pointer("shape", "PotentialParticle", &Body::shape)
            .pointer("bound", "Aabb", &Body::bound)
            .field("clumpId", &Body::clumpId)
            .field("iterBorn", &Body::iterBorn)
            .field("timeBorn", &Body::timeBorn);
    }

    void checkScene(Differences& found)
    {
        using S = Scene;
        Probe<Scene> probe(found, "Scene");
        probe.field("dt", &S::dt)
            .field("iter", &S::iter)
            .field("time", &S::time)
            .field("isPeriodic", &S::isPeriodic)
            .field("trackEnergy", &S::trackEnergy)
            .field("doSort", &S::doSort)
            .field("selectedBody", &S::selectedBody)
            .field("subdomain", &S::subdomain);
        Probe<Cell>(found, "Cell")
            .field("hSize", &Cell::hSize)
            .field("shearTrsf", &Cell::shearTrsf)
            .field("unshearTrsf", &Cell::unshearTrsf);
        // What Python does not show is asked of YADE's own functions.
        S& scene = probe.instance();
        if (!scene.cell || scene.cell->getClassName() != "Cell")
            found.push_back("Scene.cell: not found at its declared place");
        if (!scene.energy || scene.energy->getClassName() != "EnergyTracker")
            found.push_back("Scene.energy: not found at its declared place");
        if (scene.forces().getNumAllocatedThreads()
            != py::extract<int>(py::import("yade.wrapper").attr("Omega")().attr("numThreads"))())
            found.push_back("Scene.forces: not found at its declared place");
        if (!scene.bodies || scene.bodies->getClassName() != "BodyContainer") {
            found.push_back("Scene.bodies: not found at its declared place");
            return;
        }
        const auto body = boost::shared_ptr<Body>(new Body);
        scene.bodies->body.push_back(body);
        if (Body::byId(0, &scene) != body)
            found.push_back("BodyContainer.body: not found at its declared place");
        if (!scene.interactions || scene.interactions->getClassName() != "InteractionContainer") {
            found.push_back("Scene.interactions: not found at its declared place");
            return;
        }
        InteractionContainer& pairs = *scene.interactions;
        if (!pairs.linIntrs.empty() || pairs.currSize != 0 || pairs.serializeSorted || pairs.iterColliderLastRun != -1)
            found.push_back("InteractionContainer: a new one does not look empty at linIntrs, currSize, "
                            "serializeSorted, iterColliderLastRun");
        const auto engine = boost::shared_ptr<Engine>(new BoundWatch);
        scene.engines.push_back(engine);
        if (scene.engineByName("BoundWatch") != engine)
            found.push_back("Scene.engines: not found at its declared place");
    }

} // namespace

std::vector<std::string> differencesOfLayout()
{
    Differences found;
    const std::array checks = { checkShape,    checkPrimitives,  checkState,   checkGeometry, checkPhysics,
                                checkMaterial, checkInteraction, checkFunctor, checkBound,    checkEngine,
                                checkLaws,     checkDispatchers, checkBody,    checkScene,    checkTables };
    for (const auto check : checks) {
        try {
            check(found);
        } catch (const py::error_already_set&) {
            found.push_back("a class that is needed cannot be used from Python: " + takePythonError());
        }
    }
    return found;
}

} // namespace potential_particles
