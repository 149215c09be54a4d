// SPDX-License-Identifier: GPL-3.0-or-later
//
// An array that grows while many threads use it.
#pragma once

#include <atomic>
#include <cstddef>
#include <memory>

namespace potential_particles {

// Elements stay where they are. An element is made, with all of its block, at its first request, by any thread; beyond
// the last index, and where memory runs out, it is null.
template <class Element> class Blocks {
public:
    Blocks()
        : blocks(new std::atomic<Element*>[blockCount]())
    {
    }
    ~Blocks()
    {
        for (std::size_t i = 0; i < blockCount; ++i)
            delete[] blocks[i].load(std::memory_order_relaxed);
    }
    Blocks(const Blocks&) = delete;
    Blocks& operator=(const Blocks&) = delete;

    // Null when there is none.
    Element* at(std::size_t index)
    {
        const std::size_t block = index / blockSize;
        if (block >= blockCount)
            return nullptr;
        Element* elements = blocks[block].load(std::memory_order_acquire);
        if (!elements && !(elements = make(blocks[block])))
            return nullptr;
        return elements + index % blockSize;
    }

    // The same without making it.
    Element* find(std::size_t index) const
    {
        const std::size_t block = index / blockSize;
        Element* elements = block < blockCount ? blocks[block].load(std::memory_order_acquire) : nullptr;
        return elements ? elements + index % blockSize : nullptr;
    }

private:
    static constexpr std::size_t blockSize = 1024;
    static constexpr std::size_t blockCount = 1 << 16;

    static Element* make(std::atomic<Element*>& place)
    {
        std::unique_ptr<Element[]> made(new (std::nothrow) Element[blockSize]);
        Element* present = nullptr;
        if (made && place.compare_exchange_strong(present, made.get(), std::memory_order_acq_rel))
            return made.release();
        return present;
    }

    std::unique_ptr<std::atomic<Element*>[]> blocks;
};

} // namespace potential_particles
