// SPDX-License-Identifier: Apache-2.0
//
// KeptVector: memory that one evaluation leaves to the next one.
#pragma once

#include <cstddef>
#include <memory>
#include <new>
#include <vector>

#include <trisect/kernel/support/stack_arena.h>

namespace trisect::detail {

/// Takes all but small blocks from the BlockPool: an evaluation of many meshes fills megabytes, and
/// fresh pages would take as long as what is written there.
template <class T>
class KeptAllocator {
public:
    using value_type = T;

    KeptAllocator() = default;
    template <class U>
    KeptAllocator(const KeptAllocator<U>&) noexcept {}  // NOLINT(google-explicit-constructor)

    [[nodiscard]] T* allocate(std::size_t n) {
        if (n < least) return std::allocator<T>().allocate(n);
        if (n > most) throw std::bad_array_new_length();
        const MemoryBlock block = BlockPool::take(n * sizeof(T) + header);
        ::new (block.memory) MemoryBlock(block);
        return reinterpret_cast<T*>(block.memory + header);
    }
    void deallocate(T* p, std::size_t n) noexcept {
        if (n < least) {
            std::allocator<T>().deallocate(p, n);
            return;
        }
        // The block may be larger than requested, and stores its size in front.
        const auto* const front = reinterpret_cast<const std::byte*>(p) - header;
        BlockPool::give_back(*std::launder(reinterpret_cast<const MemoryBlock*>(front)));
    }

    friend bool operator==(const KeptAllocator&, const KeptAllocator&) { return true; }

private:
    static constexpr std::size_t header = 64;
    static_assert(sizeof(MemoryBlock) <= header && alignof(T) <= header);
    static constexpr std::size_t least = (std::size_t{1} << 13) / sizeof(T);
    static constexpr std::size_t most = (std::size_t{1} << 62) / sizeof(T);
};

template <class T>
using KeptVector = std::vector<T, KeptAllocator<T>>;

}  // namespace trisect::detail
