// SPDX-License-Identifier: GPL-3.0-or-later
//
// The contact functors between YADE's own shapes and potential particles: what is common to them, and those of shapes that
// are particles themselves.
#pragma once

#include "ig2_conic_pp.hpp"

namespace potential_particles {

// Body 1 has YADE's shape, body 2 the potential particle, YADE's own or ours. An interaction that has them the other way
// round is swapped, as by YADE's functors of two kinds of shapes.
class Ig2_Other_ConicPP : public Ig2_ConicPP_ConicPP_ScGeom {
public:
    std::string getBaseClassName(unsigned int index = 0) const override;
    std::string get2DFunctorType2() const override;
    std::string checkOrder() const override;
    bool goReverse(const boost::shared_ptr<yade::Shape>& shape1, const boost::shared_ptr<yade::Shape>& shape2,
                   const yade::State& state1, const yade::State& state2, const yade::Vector3r& shift2,
                   const bool& force, const boost::shared_ptr<yade::Interaction>& interaction) noexcept override;
};

#define PP_IG2_OVERRIDES                                                                           \
    std::string getClassName() const override;                                                     \
    void pyRegisterClass(boost::python::object scope) override;                                    \
    std::string get2DFunctorType1() const override;

class Ig2_Sphere_ConicPP_ScGeom final : public Ig2_Other_ConicPP {
public:
    ~Ig2_Sphere_ConicPP_ScGeom() override;
    PP_IG2_OVERRIDES

private:
    friend class boost::serialization::access;
    template <class Archive> void serialize(Archive& archive, unsigned);
};

class Ig2_Box_ConicPP_ScGeom final : public Ig2_Other_ConicPP {
public:
    ~Ig2_Box_ConicPP_ScGeom() override;
    PP_IG2_OVERRIDES

private:
    friend class boost::serialization::access;
    template <class Archive> void serialize(Archive& archive, unsigned);
};

} // namespace potential_particles
