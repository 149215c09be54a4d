// SPDX-License-Identifier: GPL-3.0-or-later
//
// InteractionContainer: all pairs of a scene. Never made here.
#pragma once

#include "interaction.hpp"

#include <mutex>

namespace yade {

class Body;

class InteractionContainer : public Serializable {
public:
    InteractionContainer() = delete;
    ~InteractionContainer() override;
    std::string getBaseClassName(unsigned int index = 0) const override;
    int getBaseClassNumber() const override;
    std::string getClassName() const override;
    void pySetAttr(const std::string& key, const boost::python::object& value) override;
    boost::python::dict pyDict() const override;
    void callPostLoad() override;

    std::vector<boost::shared_ptr<Interaction>> linIntrs; // each knows its place here as linIx
    std::vector<boost::shared_ptr<Interaction>> sortedIntrs;
    const std::vector<boost::shared_ptr<Body>>* bodies;
    std::size_t currSize;
    boost::shared_ptr<Interaction> empty;
    std::vector<boost::shared_ptr<Interaction>> interaction;
    bool dirty;
    std::mutex drawloopmutex;
    bool serializeSorted;
    long iterColliderLastRun; // -1 with the colliders that end pairs themselves
};
PP_ABI_SIZE(InteractionContainer, 192);
PP_ABI_OFFSET(InteractionContainer, linIntrs, 24);
PP_ABI_OFFSET(InteractionContainer, currSize, 80);
PP_ABI_OFFSET(InteractionContainer, serializeSorted, 176);
PP_ABI_OFFSET(InteractionContainer, iterColliderLastRun, 184);

} // namespace yade
