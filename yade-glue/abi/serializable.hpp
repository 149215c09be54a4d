// SPDX-License-Identifier: GPL-3.0-or-later
//
// Factorable and Serializable: the two roots of every class that Python and the archives can see.
#pragma once

#include "base.hpp"

#include <boost/enable_shared_from_this.hpp>
#include <boost/python/dict.hpp>
#include <boost/python/object.hpp>
#include <boost/python/tuple.hpp>

namespace yade {

class Factorable : public boost::enable_shared_from_this<Factorable> {
public:
    Factorable() { }
    virtual ~Factorable();
    virtual std::string getBaseClassName(unsigned int index = 0) const;
    virtual int getBaseClassNumber() const;
    virtual std::string getClassName() const;
};
PP_ABI_SIZE(Factorable, 24);

class Serializable : public Factorable {
public:
    Serializable() { }
    ~Serializable() override;
    std::string getBaseClassName(unsigned int index = 0) const override;
    int getBaseClassNumber() const override;
    std::string getClassName() const override;
    // One attribute by name; the innermost class that knows the name takes it, else AttributeError.
    virtual void pySetAttr(const std::string& key, const boost::python::object& value);
    virtual boost::python::dict pyDict() const;
    virtual boost::python::dict pyDictCustom() const;
    // Called once after a group of attributes was set, and after a keyword constructor.
    virtual void callPostLoad();
    virtual void checkPyClassRegistersItself(const std::string& className) const;
    virtual void pyRegisterClass(boost::python::object scope);
    virtual void pyHandleCustomCtorArgs(boost::python::tuple& args, boost::python::dict& keywords);

    // Calls pySetAttr for each item, then callPostLoad.
    void pyUpdateAttrs(const boost::python::dict& attributes);
};
PP_ABI_SIZE(Serializable, 24);

} // namespace yade

// The functions that every concrete class of YADE overrides.
#define PP_ABI_SERIALIZABLE_OVERRIDES                                                                                  \
    std::string getBaseClassName(unsigned int index = 0) const override;                                               \
    int getBaseClassNumber() const override;                                                                           \
    std::string getClassName() const override;                                                                         \
    void pySetAttr(const std::string& key, const boost::python::object& value) override;                               \
    boost::python::dict pyDict() const override;                                                                       \
    void callPostLoad() override;                                                                                      \
    void pyRegisterClass(boost::python::object scope) override;
