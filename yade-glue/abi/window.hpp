// SPDX-License-Identifier: GPL-3.0-or-later
//
// What YADE's 3-D window draws with: a functor for each class of shape, and the renderer that dispatches to them.
#pragma once

#include "engine.hpp"
#include "functor.hpp"

namespace yade {

struct GLViewInfo;

using GlShapeArguments
    = boost::mpl::vector<const boost::shared_ptr<Shape>&, const boost::shared_ptr<State>&, bool, const GLViewInfo&>;

class GlShapeFunctor : public Functor1D<Shape, void, GlShapeArguments> {
public:
    GlShapeFunctor() { }
    ~GlShapeFunctor() override;
    PP_ABI_SERIALIZABLE_OVERRIDES
    virtual std::string renders() const;
    virtual void initgl();
};
PP_ABI_SIZE(GlShapeFunctor, 88);

// Only found as a part of the renderer (src/drawing/window.cpp), and used through Python. Of the classes between Engine
// and it nothing is needed.
class GlShapeDispatcher : public Engine {
public:
    GlShapeDispatcher() = delete;
    ~GlShapeDispatcher() override;

    std::byte behind[72];
};
// The libraries export no virtual table of it to compare with.
PP_ABI_ASSERT(sizeof(GlShapeDispatcher) == 176, "size of GlShapeDispatcher");

// Its beginning. No contact depends on the window, so that check_abi.py need not compare the whole: whether the
// dispatcher lies where it is declared is found out before it is touched.
class OpenGLRenderer : public Serializable {
public:
    OpenGLRenderer() = delete;
    ~OpenGLRenderer() override;

    std::byte before[680];
    GlShapeDispatcher shapeDispatcher;
};
PP_ABI_OFFSET(OpenGLRenderer, shapeDispatcher, 704);

} // namespace yade
