// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where YADE keeps its classes: the factory that makes them and the table that Python asks.
#pragma once

#include "serializable.hpp"

// In the global namespace, as YADE has it.
template <class T> class Singleton {
public:
    static T& instance();
};

namespace yade {

class Scene;

// Only reached through Singleton<...>::instance(); never made or copied here, so no field of
// either is declared.
class ClassFactory {
public:
    using MakeRaw = Factorable* (*)();
    using MakeShared = boost::shared_ptr<Factorable> (*)();
    using MakePure = void* (*)();

    ClassFactory() = delete;
    // False when the name is taken.
    bool registerFactorable(std::string name, MakeRaw raw, MakeShared shared, MakePure pure);
    // A new object of that class. Throws std::runtime_error for a name that is not known.
    boost::shared_ptr<Factorable> createShared(std::string name);
};

class Omega {
public:
    Omega() = delete;
    // Enters the classes into YADE's table and calls pyRegisterClass of each on yade.wrapper.
    // Python errors in there are printed, not passed on.
    void buildDynlibDatabase(const std::vector<std::string>& classNames);
    // The scene that steps.
    const boost::shared_ptr<Scene>& getScene() const;
};

} // namespace yade
