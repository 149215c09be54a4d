// SPDX-License-Identifier: GPL-3.0-or-later
#include "registration/definitions.hpp"

#include "sc_geom_conic_pp.hpp"

#include <boost/serialization/binary_object.hpp>

#include <algorithm>
#include <cstring>

namespace potential_particles {

namespace {
    constexpr char digits[] = "0123456789abcdef";
    // The remembered solution in files: of class version 0 it is all, since then room follows, written as 0 and not
    // read.
    constexpr std::size_t solutionSize = sizeof(pp_pair_state::solution), sizeInFiles = 128;
    static_assert(solutionSize == 64);
}

ScGeomConicPP::ScGeomConicPP() = default;
ScGeomConicPP::~ScGeomConicPP() = default;

PP_CLASS_DEFINITIONS(ScGeomConicPP)
int ScGeomConicPP::getBaseClassNumber() const { return 1; }
void ScGeomConicPP::callPostLoad() { ScGeom::callPostLoad(); }

// In hexadecimal digits: the library may keep bit patterns in it that no decimal number carries.
std::string ScGeomConicPP::pyMemory() const
{
    const auto* bytes = reinterpret_cast<const unsigned char*>(state.solution);
    std::string text;
    for (std::size_t i = 0; i < solutionSize; ++i) {
        text += digits[bytes[i] >> 4];
        text += digits[bytes[i] & 15];
    }
    return text;
}

void ScGeomConicPP::pySetMemory(const std::string& hexadecimal)
{
    if (hexadecimal.size() != 2 * solutionSize && hexadecimal.size() != 2 * sizeInFiles)
        throw std::invalid_argument("memory: " + std::to_string(hexadecimal.size()) + " hexadecimal digits given, not "
                                    + std::to_string(2 * solutionSize));
    unsigned char bytes[sizeInFiles];
    for (std::size_t i = 0; i < hexadecimal.size() / 2; ++i) {
        unsigned byte = 0;
        for (std::size_t j = 0; j < 2; ++j) {
            const auto* digit = std::find(digits, digits + 16, hexadecimal[2 * i + j]);
            if (digit == digits + 16)
                throw std::invalid_argument(std::string("memory: '") + hexadecimal[2 * i + j]
                                            + "' is no hexadecimal digit");
            byte = 16 * byte + static_cast<unsigned>(digit - digits);
        }
        bytes[i] = static_cast<unsigned char>(byte);
    }
    std::memcpy(state.solution, bytes, solutionSize);
    forgetUnsaved();
}

void ScGeomConicPP::pySetAttr(const std::string& key, const py::object& value)
{
    if (key == "memory")
        pySetMemory(py::extract<std::string>(value));
    else
        ScGeom::pySetAttr(key, value);
}

py::dict ScGeomConicPP::pyDict() const
{
    py::dict attributes;
    attributes["memory"] = pyMemory();
    attributes.update(pyDictCustom());
    attributes.update(ScGeom::pyDict());
    return attributes;
}

void ScGeomConicPP::pyRegisterClass(py::object scope)
{
    checkPyClassRegistersItself(Entry<ScGeomConicPP>::name);
    const py::scope inside(scope);
    const auto style = docstringStyle();
    auto registered = registerClass<ScGeomConicPP, yade::ScGeom>();
    registered.add_property("memory", &ScGeomConicPP::pyMemory, &ScGeomConicPP::pySetMemory,
                            "The library's memory of the pair, as hexadecimal digits.");
    // What a functor with patch=True found; read only, since each step makes it anew.
    const auto ofPatch = [&](const char* name, auto member, const char* text) {
        using Value = typename Pointed<decltype(member)>::type;
        registered.add_property(name, pythonFunction<Value, const ScGeomConicPP&>([member](const ScGeomConicPP& geom) {
                                    return Value(geom.patch().*member);
                                }),
                                text);
    };
    ofPatch("contactArea", &ContactPatch::area, "Area of the contact patch, m^2; 0 without one.");
    ofPatch("couple", &ContactPatch::couple,
            "Couple of the pressure on body 2 about the normal, over the stiffness per area, m^4.");
    ofPatch("twistLever", &ContactPatch::twistLever,
            "Lever of friction against twist, m: it holds up to friction * normal force * lever.");
    ofPatch("polarMoment", &ContactPatch::polarMoment, "Polar moment of the patch's area about contactPoint, m^4.");
    ofPatch("largestDepth", &ContactPatch::largestDepth,
            "Largest depth on the patch, m: pressure over stiffness per area.");
    ofPatch("patchEnergy", &ContactPatch::energy,
            "Elastic energy over the stiffness per area, m^4; computed if O.trackEnergy.");
    ofPatch("centroid", &ContactPatch::centroid, "Centroid of the patch, from contactPoint, m.");
    ofPatch("secondMoment", &ContactPatch::secondMoment, "Second moments of the patch's area about its centroid, m^4.");
    ofPatch("patchOfPoint", &ContactPatch::ofPoint,
            "Whether no patch was found in the last step, and the contact point stands in for it.");
}

template <class Archive> void ScGeomConicPP::serialize(Archive& archive, unsigned version)
{
    requireReadable<ScGeomConicPP>(version);
    serializeBase<yade::ScGeom>(archive, *this, "ScGeom");
    char place[sizeInFiles] = {};
    std::memcpy(place, state.solution, solutionSize);
    auto bytes = boost::serialization::make_binary_object(place, version == 0 ? solutionSize : sizeInFiles);
    archive& boost::serialization::make_nvp("memory", bytes);
    if (Archive::is_loading::value)
        std::memcpy(state.solution, place, solutionSize);
    saved.store(Archive::is_saving::value, std::memory_order_relaxed);
}

} // namespace potential_particles

BOOST_CLASS_EXPORT_IMPLEMENT(potential_particles::ScGeomConicPP)
