// SPDX-License-Identifier: GPL-3.0-or-later
#include "registration/attributes.hpp"

#include "breakage.hpp"
#include "registration/python_bytes.hpp"
#include "registration/python_lock.hpp"
#include "shape/conic_potential_particle.hpp"

#include <Eigen/Eigenvalues>

#include <boost/python/import.hpp>
#include <boost/python/stl_iterator.hpp>

#include <cmath>
#include <functional>
#include <typeinfo>

namespace potential_particles {

Breakage::~Breakage() = default;

PP_CLASS_DEFINITIONS(Breakage)

int Breakage::getBaseClassNumber() const { return 1; }

namespace {

    constexpr double volumeOfUnitBall = 0.5235987755982988; // pi/6, of diameter 1

    [[noreturn]] void refuse(const std::string& why) { throw std::invalid_argument("Breakage: " + why); }

    // Uniform in (0, 1), of seed and id alone (Steele, Lea & Flood's splitmix64).
    double drawn(int seed, std::size_t id)
    {
        std::uint64_t bits = (static_cast<std::uint64_t>(seed) << 32) + id;
        for (int round = 0; round < 2; ++round) {
            bits += 0x9e3779b97f4a7c15u;
            bits = (bits ^ bits >> 30) * 0xbf58476d1ce4e5b9u;
            bits = (bits ^ bits >> 27) * 0x94d049bb133111ebu;
            bits ^= bits >> 31;
        }
        return (static_cast<double>(bits >> 11) + 0.5) * 0x1p-53;
    }

    py::object package() { return py::import("potential_particles.breakage"); }

} // namespace

void Breakage::action()
{
    requireUsable();
    if (scene->iter % iterPeriod != 0)
        return;
    sumForceMoments(*scene, sums);
    ids.clear();
    stresses.clear();
    const bool asksAll = tensileStrength == 0 && compressiveStrength == 0;
    for (const auto& body : scene->bodies->body) {
        if (!isCandidate(body))
            continue;
        const auto id = static_cast<std::size_t>(body->id);
        const double volume = volumeByMass(*body);
        const Tensor stress = (sums[id] + sums[id].transpose()) / (2 * volume);
        if (!asksAll && !reachesStrength(stress, id, volume))
            continue;
        ids.push_back(body->id);
        stresses.insert(stresses.end(), stress.data(), stress.data() + 9);
    }
    if (!ids.empty())
        cut();
}

void Breakage::requireUsable() const
{
    if (!(leastSize > 0))
        refuse("leastSize=" + text(leastSize)
               + " must be above 0: give the diameter of the largest ball in the smallest piece");
    if (tensileStrength == 0 && compressiveStrength == 0 && function.empty())
        refuse("tensileStrength=0 and compressiveStrength=0, and no function: nothing breaks; give one of them");
    if (weibullModulus > 0 && !(referenceVolume > 0))
        refuse("referenceVolume=" + text(referenceVolume) + " must be above 0 where weibullModulus is");
    if (seed >= 0 && weibullModulus == 0)
        refuse("seed=" + std::to_string(seed) + " scatters strengths by weibullModulus=0: give that, or seed=-1");
}

bool Breakage::isCandidate(const boost::shared_ptr<yade::Body>& body) const
{
    if (!body || !body->shape || !body->state || body->clumpId >= 0)
        return false;
    const yade::Shape& shape = *body->shape;
    if (typeid(shape) != typeid(ConicPotentialParticle))
        return false;
    constexpr unsigned all = 63;
    const auto& particle = static_cast<const ConicPotentialParticle&>(shape);
    if (particle.isBoundary || particle.k == 1 || (body->state->blockedDOFs & all) == all)
        return false;
    return volumeByMass(*body) > 2 * volumeOfUnitBall * std::pow(leastSize, 3) && whole.count(body->id) == 0;
}

bool Breakage::reachesStrength(const Tensor& stress, std::size_t id, double volume) const
{
    const double perTension = tensileStrength > 0 ? 1 / tensileStrength : 0,
                 perPressure = compressiveStrength > 0 ? 1 / compressiveStrength : 0;
    // No principal stress is above the norm, which takes no time.
    const double bound = stress.norm() * (perTension + perPressure);
    if (!(bound > 0))
        return false;
    const double factor = strengthFactor(id, volume);
    if (!(bound >= factor))
        return false;
    const Eigen::SelfAdjointEigenSolver<Tensor> solver(stress, Eigen::EigenvaluesOnly);
    const Eigen::Vector3d principal = solver.eigenvalues();
    return principal[2] * perTension - principal[0] * perPressure >= factor;
}

double Breakage::strengthFactor(std::size_t id, double volume) const
{
    if (weibullModulus == 0)
        return 1;
    const double share = seed >= 0 ? -std::log(drawn(seed, id)) : 1;
    return std::pow(referenceVolume / volume * share, 1 / weibullModulus);
}

double Breakage::pyStrengthFactor(int id) const
{
    const yade::Scene& present = *Singleton<yade::Omega>::instance().getScene();
    const auto place = static_cast<std::size_t>(id);
    if (id < 0 || place >= present.bodies->body.size() || !present.bodies->body[place])
        refuse("there is no body " + std::to_string(id));
    return strengthFactor(place, volumeByMass(*present.bodies->body[place]));
}

void Breakage::cut()
{
    const PythonLock lock;
    try {
        const auto self = boost::static_pointer_cast<Breakage>(shared_from_this());
        const py::object left = package().attr("cut")(self, bytes(ids), bytes(stresses));
        // What a function of the script says of a body may change.
        if (function.empty())
            whole.insert(py::stl_input_iterator<int>(left), py::stl_input_iterator<int>());
    } catch (const py::error_already_set&) {
        // The thread that steps has no one to raise it to.
        const PythonError error = takePythonError();
        throw std::runtime_error("Breakage: " + error.kind + ": " + error.message);
    }
    scene->doSort = true;
}

void Breakage::pySetAttr(const std::string& key, const py::object& value)
{
    std::function<void()> restore;
    eachAttribute([&](const char* name, auto member, const char*) {
        if (key == name)
            restore = [this, member, old = this->*member] { this->*member = old; };
    });
    const py::object given = key == "joints" || key == "function" ? package().attr(key.c_str())(value) : value;
    if (!setAttribute(*this, key, given)) {
        yade::GlobalEngine::pySetAttr(key, value);
        return;
    }
    whole.clear();
    const auto back = [&](const std::string& why) {
        restore();
        refuse(why);
    };
    for (const auto& [name, one] :
         { std::pair("tensileStrength", tensileStrength), std::pair("compressiveStrength", compressiveStrength),
           std::pair("weibullModulus", weibullModulus), std::pair("referenceVolume", referenceVolume),
           std::pair("leastSize", leastSize), std::pair("surfaceEnergy", surfaceEnergy) })
        if (one < 0)
            back(std::string(name) + "=" + text(one) + " must be 0 or above");
    if (iterPeriod < 1)
        back("iterPeriod=" + std::to_string(iterPeriod) + " must be 1 or above");
    if (pieces != 2 && pieces != 4 && pieces != 8)
        back("pieces=" + std::to_string(pieces) + " must be 2, 4 or 8");
    if (!(rounding > 0 && rounding < 0.5))
        back("rounding=" + text(rounding) + " must lie between 0 and 0.5");
}

py::dict Breakage::pyDict() const
{
    py::dict attributes = dictOfAttributes(*this);
    attributes.update(pyDictCustom());
    attributes.update(yade::GlobalEngine::pyDict());
    return attributes;
}

void Breakage::pyRegisterClass(py::object scope)
{
    checkPyClassRegistersItself(Entry<Breakage>::name);
    const py::scope inside(scope);
    const auto style = docstringStyle();
    auto registered = registerClass<Breakage, yade::GlobalEngine>();
    eachAttribute([&](const char* name, auto member, const char* text) {
        using Value = typename Pointed<decltype(member)>::type;
        registered.add_property(
            name, pythonFunction<Value, const Breakage&>([member](const Breakage& engine) { return engine.*member; }),
            pythonFunction<void, Breakage&, const py::object&>(
                [name](Breakage& engine, const py::object& value) { engine.pySetAttr(name, value); }),
            text);
    });
    const auto fromPackage = [&](const char* name, const char* text) {
        registered.add_property(name, pythonFunction<py::object, const py::object&>([name](const py::object& engine) {
                                    return package().attr(name)(engine);
                                }),
                                text);
    };
    fromPackage("history", "Structured array, one row for each body that broke: potential_particles.breakage.HISTORY.");
    fromPackage("parents", "{id of a piece: id of the body that broke}.");
    fromPackage("generations", "{id of a piece: how often what it was part of has broken}; others have none.");
    // YADE keeps each list that it makes of a vector: pieces are many, and go in and out as numbers.
    registered.def("addRecord",
                   pythonFunction<void, Breakage&, const py::object&>([](Breakage& engine, const py::object& row) {
                       engine.records.insert(engine.records.end(), py::stl_input_iterator<double>(row),
                                             py::stl_input_iterator<double>());
                   }),
                   "Adds a row of `history`.");
    const auto recordBytes = [](const Breakage& engine) { return bytes(engine.records); };
    registered.def("recordBytes", pythonFunction<py::object, const Breakage&>(recordBytes),
                   "The records as bytes, for numpy.");
    registered.def("strengthFactor", &Breakage::pyStrengthFactor, py::arg("id"),
                   "By what the strengths are multiplied for this body: size and scatter.");
}

template <class Archive> void Breakage::serialize(Archive& archive, unsigned version)
{
    requireReadable<Breakage>(version);
    serializeBase<yade::GlobalEngine>(archive, *this, "GlobalEngine");
    archiveAttributes(archive, *this, version);
}

} // namespace potential_particles

BOOST_CLASS_EXPORT_IMPLEMENT(potential_particles::Breakage)
