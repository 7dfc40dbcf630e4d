// SPDX-License-Identifier: Apache-2.0
//
// BlockPool: blocks of memory that serve again.
#pragma once

#include <cstddef>

namespace trisect::detail {

/// A piece of memory, aligned to pages.
struct MemoryBlock {
    std::byte* memory = nullptr;
    std::size_t size = 0;
};

/// Blocks for arrays of 8 kB and more. On Linux they are cut out of large pages, which are mapped
/// apart from the heap, and what is given back is joined with its free neighbours. A page that is
/// touched for the first time costs a fault and its clearing, which is most of the time that a
/// first import takes; a large page costs hardly more than a small one. Of free large pages
/// `ready_bytes` are kept as they are; what goes beyond goes back to the system. Elsewhere blocks
/// are those of the heap. Safe to use from many threads; a call takes a fraction of a microsecond.
class BlockPool {
public:
    static constexpr std::size_t ready_bytes = std::size_t{1} << 27;

    /// Sizes of blocks are multiples of this.
    static constexpr std::size_t granule = 4096;
    [[nodiscard]] static constexpr std::size_t rounded(std::size_t bytes) {
        return (bytes + granule - 1) & ~(granule - 1);
    }

    /// A block of rounded(bytes). \throw std::bad_alloc
    [[nodiscard]] static MemoryBlock take(std::size_t bytes);
    static void give_back(const MemoryBlock& block) noexcept;
};

}  // namespace trisect::detail
