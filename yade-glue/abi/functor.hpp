// SPDX-License-Identifier: GPL-3.0-or-later
//
// Functor down to IGeomFunctor, IPhysFunctor and LawFunctor, which dispatchers call for a pair, and BoundFunctor, for
// one shape.
#pragma once

#include "bound.hpp"
#include "interaction.hpp"
#include "serializable.hpp"
#include "shape.hpp"
#include "state.hpp"

#include <boost/mpl/at.hpp>
#include <boost/mpl/vector.hpp>

namespace yade {

class TimingDeltas;
class Body;
class Material;
class IGeom;
class IPhys;

class Functor : public Serializable {
public:
    Functor()
        : scene(nullptr)
    {
    }
    ~Functor() override;
    PP_ABI_SERIALIZABLE_OVERRIDES
    virtual std::vector<std::string> getFunctorTypes() const;

    boost::shared_ptr<TimingDeltas> timingDeltas;
    Scene* scene; // set by the dispatcher before every loop
    std::string label;
};
PP_ABI_SIZE(Functor, 80);
PP_ABI_OFFSET(Functor, timingDeltas, 24);
PP_ABI_OFFSET(Functor, scene, 40);
PP_ABI_OFFSET(Functor, label, 48);

// The call interface for every number of arguments. The compiler writes this table itself (the
// library exports none for templates); the functions in it are the library's.
template <class Result, class Arguments> class FunctorWrapper {
    template <int n> using Argument = typename boost::mpl::at_c<Arguments, n>::type;
    using A1 = Argument<0>;
    using A2 = Argument<1>;
    using A3 = Argument<2>;
    using A4 = Argument<3>;
    using A5 = Argument<4>;
    using A6 = Argument<5>;
    using A7 = Argument<6>;

public:
    FunctorWrapper() { }
    virtual ~FunctorWrapper() { }
    virtual std::string checkOrder() const;
    virtual Result go(A1);
    virtual Result go(A1, A2);
    virtual Result go(A1, A2, A3);
    virtual Result go(A1, A2, A3, A4);
    virtual Result go(A1, A2, A3, A4, A5);
    virtual Result go(A1, A2, A3, A4, A5, A6);
    virtual Result go(A1, A2, A3, A4, A5, A6, A7);
    virtual Result goReverse(A1);
    virtual Result goReverse(A1, A2);
    virtual Result goReverse(A1, A2, A3);
    virtual Result goReverse(A1, A2, A3, A4);
    virtual Result goReverse(A1, A2, A3, A4, A5);
    virtual Result goReverse(A1, A2, A3, A4, A5, A6);
    virtual Result goReverse(A1, A2, A3, A4, A5, A6, A7);
};

template <class Dispatch1, class Dispatch2, class Result, class Arguments>
class Functor2D : public Functor, public FunctorWrapper<Result, Arguments> {
public:
    Functor2D() { }
    ~Functor2D() override { }
    std::string getBaseClassName(unsigned int index = 0) const override;
    int getBaseClassNumber() const override;
    std::string getClassName() const override;
    std::vector<std::string> getFunctorTypes() const override;
    virtual std::string get2DFunctorType1() const;
    virtual std::string get2DFunctorType2() const;
};

using IGeomArguments
    = boost::mpl::vector<const boost::shared_ptr<Shape>&, const boost::shared_ptr<Shape>&, const State&, const State&,
                         const Vector3r&, const bool&, const boost::shared_ptr<Interaction>&>;

class IGeomFunctor : public Functor2D<Shape, Shape, bool, IGeomArguments> {
public:
    IGeomFunctor() { }
    ~IGeomFunctor() override;
    PP_ABI_SERIALIZABLE_OVERRIDES
    virtual void preStep();
};
PP_ABI_SIZE(IGeomFunctor, 88);

using IPhysArguments = boost::mpl::vector<const boost::shared_ptr<Material>&, const boost::shared_ptr<Material>&,
                                          const boost::shared_ptr<Interaction>&>;

// Makes the physics of a new contact.
class IPhysFunctor : public Functor2D<Material, Material, void, IPhysArguments> {
public:
    IPhysFunctor() { }
    ~IPhysFunctor() override;
    PP_ABI_SERIALIZABLE_OVERRIDES
};
PP_ABI_SIZE(IPhysFunctor, 88);

using LawArguments = boost::mpl::vector<boost::shared_ptr<IGeom>&, boost::shared_ptr<IPhys>&, Interaction*>;

// The forces of a contact; false ends it.
class LawFunctor : public Functor2D<IGeom, IPhys, bool, LawArguments> {
public:
    LawFunctor() { }
    ~LawFunctor() override;
    PP_ABI_SERIALIZABLE_OVERRIDES
};
PP_ABI_SIZE(LawFunctor, 88);

template <class Dispatch, class Result, class Arguments>
class Functor1D : public Functor, public FunctorWrapper<Result, Arguments> {
public:
    Functor1D() { }
    ~Functor1D() override { }
    std::string getBaseClassName(unsigned int index = 0) const override;
    int getBaseClassNumber() const override;
    std::string getClassName() const override;
    virtual std::string get1DFunctorType1() const;
    std::vector<std::string> getFunctorTypes() const override;
};

using BoundArguments
    = boost::mpl::vector<const boost::shared_ptr<Shape>&, boost::shared_ptr<Bound>&, const Se3r&, const Body*>;

class BoundFunctor : public Functor1D<Shape, void, BoundArguments> {
public:
    BoundFunctor() { }
    ~BoundFunctor() override;
    PP_ABI_SERIALIZABLE_OVERRIDES
};
PP_ABI_SIZE(BoundFunctor, 88);

} // namespace yade
