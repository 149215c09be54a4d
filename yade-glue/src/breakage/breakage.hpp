// SPDX-License-Identifier: GPL-3.0-or-later
//
// The engine that breaks bodies by the stress in them: which ones, here; how they are cut, in breakage.py of the
// package.
#pragma once

#include "abi/archive.hpp"
#include "abi/scene.hpp"

#include "force_moments.hpp"
#include "registration/class_table.hpp"

#include <cstdint>
#include <string>
#include <unordered_set>
#include <vector>

namespace potential_particles {

class Breakage final : public yade::GlobalEngine {
public:
    ~Breakage() override;
    PP_CLASS_OVERRIDES
    int getBaseClassNumber() const override;
    void pySetAttr(const std::string& key, const boost::python::object& value) override;
    boost::python::dict pyDict() const override;

    void action() override;

    int iterPeriod = 20;
    double tensileStrength = 0, compressiveStrength = 0;
    double weibullModulus = 0, referenceVolume = 0;
    int seed = -1;
    int pieces = 2;
    double leastSize = 0;
    double rounding = 0.2;
    double surfaceEnergy = 0;
    std::vector<double> joints;
    std::string function;
    std::vector<double> records;

    template <class Visit> static void eachAttribute(Visit&& visit)
    {
        using B = Breakage;
        visit("iterPeriod", &B::iterPeriod, "Bodies are looked at in each step whose number this divides.");
        visit("tensileStrength", &B::tensileStrength,
              "Largest principal stress, tension, at which a body of the reference volume breaks, Pa; 0: none.");
        visit("compressiveStrength", &B::compressiveStrength,
              "Uniaxial compression at which it breaks, Pa; 0: none. With both strengths it breaks by Mohr-Coulomb, "
              "where s1/tensileStrength - s3/compressiveStrength reaches 1 (s1 > s3, tension positive).");
        visit("weibullModulus", &B::weibullModulus,
              "m of Weibull: a body of volume V has (referenceVolume/V)^(1/m) times these strengths; 0: all have the "
              "same.");
        visit("referenceVolume", &B::referenceVolume, "Volume to which the strengths belong, length^3.");
        visit("seed", &B::seed,
              "0 or above: strengths scatter by Weibull's distribution, drawn from seed and id of a body; a body of "
              "the reference volume has survived tensileStrength with probability exp(-1). -1: no scatter.");
        visit("pieces", &B::pieces, "2, 4 or 8: cuts across the largest, the middle and the least principal stress.");
        visit("leastSize", &B::leastSize,
              "Diameter of the largest ball in the smallest piece, length: a cut that would make a smaller one is left "
              "out.");
        visit("rounding", &B::rounding,
              "Pieces have the rounding radius of the body that broke, but at most this share of their own size.");
        visit("surfaceEnergy", &B::surfaceEnergy, "Energy of a cut per area, J/m^2, for `history`.");
        visit("joints", &B::joints,
              "Normals of planes in the axes of a body: it breaks along these, through its centroid. Three numbers "
              "each, or rows of three.");
        visit("function", &B::function,
              "Function of the script, or its name with its module's, of a body and its stress (Matrix3, Pa, tension "
              "positive): whether it breaks, or rows of planes, world axes: normals, through the centroid, or a, b, c, "
              "d with a x + b y + c z = d. Without strengths it is asked for each body, else for those that reach "
              "them.");
        visit("records", &B::records, "What `history` shows, as it is saved.");
    }

private:
    PP_ARCHIVED

    void requireUsable() const;
    bool isCandidate(const boost::shared_ptr<yade::Body>& body) const;
    bool reachesStrength(const Tensor& stress, std::size_t id, double volume) const;
    double strengthFactor(std::size_t id, double volume) const;
    double pyStrengthFactor(int id) const;
    void cut();

    // Of this step.
    std::vector<Tensor> sums;
    std::vector<int> ids;
    std::vector<double> stresses; // 9 each
    // Those that reach their strength and are too small: not asked again in this run.
    std::unordered_set<int> whole;
};

} // namespace potential_particles
