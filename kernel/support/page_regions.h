// SPDX-License-Identifier: Apache-2.0
//
// PageRegions: blocks of memory that are cut out of large pages.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include <trisect/kernel/support/block_pool.h>

namespace trisect::detail {

/// Regions of whole large pages. A block is the beginning of the smallest free span that is large
/// enough, the first one of these, so that memory which is in use stays together. Free spans that
/// touch are one. One thread at a time.
class PageRegions {
public:
    static constexpr std::size_t large_page = std::size_t{1} << 21;

    /// Keeps that many bytes of free large pages ready.
    explicit PageRegions(std::size_t ready_bytes) : most_ready_(ready_bytes / large_page) {}
    PageRegions(const PageRegions&) = delete;
    PageRegions& operator=(const PageRegions&) = delete;
    ~PageRegions();

    struct Taken {
        MemoryBlock block;
        /// Whether its pages may have memory already; else make_ready() serves, which several
        /// threads may call at once.
        bool is_ready = false;
    };
    /// A block of `size` bytes, a positive multiple of BlockPool::granule. \throw std::bad_alloc
    [[nodiscard]] Taken take(std::size_t size);
    void give_back(const MemoryBlock& block) noexcept;

    /// In bytes: of regions, and of free large pages that are ready.
    [[nodiscard]] std::size_t mapped() const { return mapped_; }
    [[nodiscard]] std::size_t ready() const { return ready_ * large_page; }

private:
    struct LargePage {
        std::uint32_t used = 0;  ///< bytes of blocks
        bool is_ready = false;   ///< it may have memory
    };
    struct Region {
        std::byte* begin = nullptr;
        std::size_t size = 0;
        std::vector<LargePage> pages;
    };
    using Regions = std::map<std::byte*, Region>;
    using Free = std::map<std::byte*, std::size_t>;

    void add_region(std::size_t size);
    [[nodiscard]] bool use(Region& region, const MemoryBlock& block);
    void leave(Region& region, const MemoryBlock& block) noexcept;
    void add_free(const Region& region, const MemoryBlock& span);
    void change_free(Free::iterator span, const MemoryBlock& now) noexcept;
    void remove_free(Free::iterator span) noexcept;
    void drop_if_unused(Regions::iterator region) noexcept;
    [[nodiscard]] Regions::iterator region_of(std::byte* memory);

    std::size_t most_ready_;
    std::size_t mapped_ = 0;
    std::size_t ready_ = 0;  ///< free large pages that are ready
    Regions regions_;        ///< by their beginning
    Free free_;              ///< by their beginning
    std::set<std::pair<std::size_t, std::byte*>> by_size_;
};

}  // namespace trisect::detail
