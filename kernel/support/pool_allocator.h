// SPDX-License-Identifier: Apache-2.0
//
// PoolAllocator: memory for the vectors of one assembly or one leaf.
#pragma once

#include <cstddef>
#include <limits>
#include <memory>
#include <new>
#include <vector>

#include <trisect/kernel/support/ready_memory.h>
#include <trisect/kernel/support/stack_arena.h>

namespace trisect::detail {

/// Takes blocks of medium size from the BlockPool. What lies at the end of the heap is given back
/// to the system whenever it is freed, and a small result then pays for the same pages each time, a
/// twentieth of its whole time, that of a larger one up to a third. Small blocks stay in the heap
/// anyway. The largest ones are given back, and are made ready before values are moved into them
/// (ready_memory.h).
template <class T>
class PoolAllocator {
public:
    using value_type = T;

    PoolAllocator() = default;
    template <class U>
    PoolAllocator(const PoolAllocator<U>&) noexcept {}  // NOLINT(google-explicit-constructor)

    [[nodiscard]] T* allocate(std::size_t n) {
        if (!is_pooled(n)) {
            T* const p = std::allocator<T>().allocate(n);
            make_ready(static_cast<void*>(p), n * sizeof(T));
            return p;
        }
        const MemoryBlock block = BlockPool::take(n * sizeof(T) + header);
        ::new (block.memory) MemoryBlock(block);
        return reinterpret_cast<T*>(block.memory + header);
    }
    void deallocate(T* p, std::size_t n) noexcept {
        if (!is_pooled(n)) {
            std::allocator<T>().deallocate(p, n);
            return;
        }
        // The block may be larger than requested, and stores its size in front.
        const auto* const front = reinterpret_cast<const std::byte*>(p) - header;
        BlockPool::give_back(*std::launder(reinterpret_cast<const MemoryBlock*>(front)));
    }

    friend bool operator==(const PoolAllocator&, const PoolAllocator&) { return true; }

private:
    static constexpr std::size_t header = 64;
    static_assert(sizeof(MemoryBlock) <= header && alignof(T) <= header);
    static constexpr std::size_t least = std::size_t{1} << 13;
    static constexpr std::size_t most = (std::size_t{1} << 24) - header;

    [[nodiscard]] static constexpr bool is_pooled(std::size_t n) {
        return n >= least / sizeof(T) && n <= most / sizeof(T);
    }
};

/// A vector that may become large and does not live long.
template <class T>
using PoolVector = std::vector<T, PoolAllocator<T>>;

}  // namespace trisect::detail
