// SPDX-License-Identifier: GPL-3.0-or-later
//
// Indexable: the class number by which YADE's dispatchers find the functor for a pair of types.
#pragma once

#include "base.hpp"

namespace yade {

// None of its functions is exported; only classes with exported constructors are derived from.
class Indexable {
public:
    virtual void incrementMaxCurrentlyUsedClassIndexOfKin();
    virtual int& modifyClassIndex();
    virtual ~Indexable();
    virtual const int& getClassIndex() const;
    virtual const int& getBaseClassIndex(int depth) const;
    virtual const int& getMaxCurrentlyUsedClassIndexOfKin() const;
};
// The libraries export no virtual table of it to compare with.
PP_ABI_ASSERT(sizeof(Indexable) == 8, "size of Indexable");

} // namespace yade

// Order matters where these are new in the primary table, that is in the top classes (Shape, ...).
#define PP_ABI_INDEX_OVERRIDES                                                                                         \
    int& modifyClassIndex() override;                                                                                  \
    const int& getClassIndex() const override;                                                                         \
    const int& getBaseClassIndex(int depth) const override;

#define PP_ABI_TOP_INDEX_OVERRIDES                                                                                     \
    PP_ABI_INDEX_OVERRIDES                                                                                             \
    const int& getMaxCurrentlyUsedClassIndexOfKin() const override;                                                    \
    void incrementMaxCurrentlyUsedClassIndexOfKin() override;
