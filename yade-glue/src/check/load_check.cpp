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
#include "registration/python_lock.hpp"

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

        // access: from the object to the field.
        template <class Access> Probe& field(const char* name, Access access)
        {
            using Value = std::decay_t<decltype(access(seen))>;
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
            differences.push_back(std::string(className) + "." + name + ": " + takePythonError().message);
            return false;
        }

        Differences& differences;
        const char* className;
        py::object object;
        Class& seen;
        Values values;
    };

// A field that Python has by its own name, and one that it has by another.
#define PP_FIELD(name)                                                                                                 \
    .field(                                                                                                            \
        #name, [](auto& seen) -> auto& { return seen.name; })
#define PP_FIELD_AT(name, place)                                                                                       \
    .field(                                                                                                            \
        #name, [](auto& seen) -> auto& { return seen.place; })

    void checkShape(Differences& found)
    {
        Probe<PotentialParticle>(found, "PotentialParticle") PP_FIELD(color) PP_FIELD(wire) PP_FIELD(highlight)
            PP_FIELD(id) PP_FIELD(isBoundary) PP_FIELD(fixedNormal) PP_FIELD(boundaryNormal) PP_FIELD(AabbMinMax)
                PP_FIELD(minAabb) PP_FIELD(maxAabb) PP_FIELD(minAabbRotated) PP_FIELD(maxAabbRotated) PP_FIELD(r)
                    PP_FIELD(R) PP_FIELD(k) PP_FIELD(vertices) PP_FIELD(a) PP_FIELD(b) PP_FIELD(c) PP_FIELD(d);
    }

    void checkPrimitives(Differences& found)
    {
        Probe<yade::Sphere>(found, "Sphere") PP_FIELD(radius);
        Probe<yade::Cylinder>(found, "Cylinder") PP_FIELD(length) PP_FIELD(segment);
        Probe<yade::Box>(found, "Box") PP_FIELD(extents);
        Probe<yade::Wall>(found, "Wall") PP_FIELD(sense) PP_FIELD(axis);
        Probe<yade::Facet> facet(found, "Facet");
        facet PP_FIELD(normal) PP_FIELD(area);
        // Python can set three vertices only, all of them at once.
        if (facet.instance().vertices.size() != 3)
            found.push_back("Facet.vertices: not found at its declared place");
        else
            facet PP_FIELD(vertices);
    }

    void checkState(Differences& found)
    {
        Probe<State> probe(found, "State");
        probe PP_FIELD_AT(pos, se3.position) PP_FIELD(pos) PP_FIELD_AT(ori, se3.orientation) PP_FIELD(ori) PP_FIELD(vel)
            PP_FIELD(mass) PP_FIELD(angVel) PP_FIELD(angMom) PP_FIELD(inertia) PP_FIELD(refPos) PP_FIELD(refOri)
                PP_FIELD(isDamped) PP_FIELD(densityScaling);
    }

    void checkGeometry(Differences& found)
    {
        Probe<ScGeom>(found, "ScGeom") PP_FIELD(normal) PP_FIELD(contactPoint) PP_FIELD(refR1) PP_FIELD(refR2)
            PP_FIELD_AT(refR1, radius1) PP_FIELD_AT(refR2, radius2) PP_FIELD(penetrationDepth) PP_FIELD(shearInc);
    }

    void checkPhysics(Differences& found)
    {
        Probe<KnKsPhys>(found, "KnKsPhys") PP_FIELD(kn) PP_FIELD(normalForce) PP_FIELD(ks) PP_FIELD(shearForce)
            PP_FIELD(tangensOfFrictionAngle)
#if PP_YADE_FRICT_PHYS_EXTRA
                PP_FIELD(frictDissip)
#endif
                    PP_FIELD(frictionAngle) PP_FIELD(viscousDamping) PP_FIELD(maxClosure) PP_FIELD(u_elastic)
                        PP_FIELD(brittleLength) PP_FIELD(knVol) PP_FIELD(ksVol) PP_FIELD(kn_i) PP_FIELD(ks_i)
                            PP_FIELD(normalViscous) PP_FIELD(shearViscous) PP_FIELD(intactRock) PP_FIELD(jointType)
                                PP_FIELD(shearDir) PP_FIELD(prevNormal) PP_FIELD(warmstart) PP_FIELD(ptOnP1)
                                    PP_FIELD(ptOnP2) PP_FIELD(cumulative_us) PP_FIELD(mobilizedShear)
                                        PP_FIELD(contactArea) PP_FIELD(prevSigma) PP_FIELD(jointLength)
                                            PP_FIELD(shearIncrementForCD) PP_FIELD(useFaceProperties) PP_FIELD(cohesion)
                                                PP_FIELD(tension) PP_FIELD(cohesionBroken) PP_FIELD(tensionBroken)
                                                    PP_FIELD(phi_b) PP_FIELD(phi_r) PP_FIELD(u_cumulative)
                                                        PP_FIELD(initialShearDir) PP_FIELD(effective_phi)
                                                            PP_FIELD(isSliding);
    }

    void checkMaterial(Differences& found)
    {
        Probe<yade::FrictMat>(found, "FrictMat") PP_FIELD(id) PP_FIELD(label) PP_FIELD(density) PP_FIELD(young)
            PP_FIELD(poisson) PP_FIELD(frictionAngle);
    }

    void checkInteraction(Differences& found)
    {
        using I = Interaction;
        Probe<I> probe(found, "Interaction");
        probe PP_FIELD(isActive) PP_FIELD(id1) PP_FIELD(id2) PP_FIELD(iterMadeReal) PP_FIELD(cellDist)
            PP_FIELD(iterBorn);
        I& interaction = probe.instance();
        if (interaction.geom || interaction.phys || !interaction.functorCache.geomExists)
            found.push_back("Interaction: a new one does not look empty at geom, phys, functorCache");
    }

    void checkFunctor(Differences& found)
    {
        Probe<IGeomFunctor> probe(found, "Ig2_PP_PP_ScGeom");
        probe PP_FIELD(label);
        IGeomFunctor& builtin = probe.instance();
        const std::string first = builtin.get2DFunctorType1(), second = builtin.get2DFunctorType2();
        if (first != "PotentialParticle" || second != "PotentialParticle"
            || builtin.checkOrder() != first + " " + second)
            found.push_back("IGeomFunctor: virtual calls on Ig2_PP_PP_ScGeom do not answer as they should");
    }

    void checkBound(Differences& found)
    {
        Probe<Aabb>(found, "Aabb") PP_FIELD(lastUpdateIter) PP_FIELD(refPos) PP_FIELD(sweepLength) PP_FIELD(color)
            PP_FIELD(min) PP_FIELD(max);
        Probe<BoundFunctor> probe(found, "PotentialParticle2AABB");
        probe PP_FIELD(label);
        if (probe.instance().get1DFunctorType1() != "PotentialParticle")
            found.push_back("BoundFunctor: virtual calls on PotentialParticle2AABB do not answer as they should");
    }

    void checkEngine(Differences& found)
    {
        Probe<GlobalEngine> probe(found, "GlobalEngine");
        probe PP_FIELD(dead) PP_FIELD(ompThreads) PP_FIELD_AT(execCount, timingInfo.nExec) PP_FIELD(label);
        if (!probe.instance().isActivated())
            found.push_back("GlobalEngine: virtual calls do not answer as they should");
    }

    void checkLaws(Differences& found)
    {
        using Cundall = Law2_ScGeom_FrictPhys_CundallStrack;
        Probe<Cundall>(found, "Law2_ScGeom_FrictPhys_CundallStrack") PP_FIELD(neverErase) PP_FIELD(sphericalBodies)
            PP_FIELD(traceEnergy);
        using KnKs = Law2_SCG_KnKsPhys_KnKsLaw;
        Probe<KnKs>(found, "Law2_SCG_KnKsPhys_KnKsLaw") PP_FIELD(neverErase) PP_FIELD(traceEnergy) PP_FIELD(Talesnick)
            PP_FIELD(allowBreakage) PP_FIELD(initialOverlapDistance) PP_FIELD(allowViscousAttraction);
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
        const bool listed
            = seen.functors.size() == 1 && seen.functors[0] && seen.functors[0]->getClassName() == functor;
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
        Probe<Body>(found, "Body") PP_FIELD(id) PP_FIELD_AT(mask, groupMask) PP_FIELD(flags) PP_FIELD(subdomain)
            .pointer("state", "State", &Body::state)
            .pointer("shape", "PotentialParticle", &Body::shape)
            .pointer("bound", "Aabb", &Body::bound) PP_FIELD(clumpId) PP_FIELD(iterBorn) PP_FIELD(timeBorn);
    }

    void checkScene(Differences& found)
    {
        Probe<Scene> probe(found, "Scene");
        probe PP_FIELD(dt) PP_FIELD(iter) PP_FIELD(time) PP_FIELD(isPeriodic) PP_FIELD(trackEnergy) PP_FIELD(doSort)
            PP_FIELD(selectedBody) PP_FIELD(subdomain);
        Probe<Cell>(found, "Cell") PP_FIELD(hSize) PP_FIELD(shearTrsf) PP_FIELD(unshearTrsf);
        // What Python does not show is asked of YADE's own functions.
        Scene& scene = probe.instance();
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
            found.push_back("a class that is needed cannot be used from Python: " + takePythonError().message);
        }
    }
    return found;
}

} // namespace potential_particles
