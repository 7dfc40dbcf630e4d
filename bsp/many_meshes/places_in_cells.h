// SPDX-License-Identifier: Apache-2.0
//
// PlacesInCells: facets of two solids by cells of a grid.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include <trisect/bsp/leaf/doubles/single_box.h>
#include <trisect/bsp/many_meshes/outlines/outlined_solid.h>
#include <trisect/kernel/support/pool_allocator.h>

namespace trisect::detail {

/// Of many facets that lie all over a place: a few thousand in a cell. Two boxes that meet are in
/// one cell at least. Takes a number for each facet in a cell, where cells that are divided step by
/// step would list boxes. GridCounters has how often.
class PlacesInCells {
public:
    /// A facet of a cell; whether another cell may have it, too.
    class Entry {
    public:
        Entry() = default;
        Entry(std::uint32_t place, bool is_shared) : bits_(place << 1 | (is_shared ? 1U : 0U)) {}
        [[nodiscard]] std::uint32_t place() const { return bits_ >> 1; }
        [[nodiscard]] bool is_shared() const { return (bits_ & 1U) != 0; }

    private:
        std::uint32_t bits_ = 0;  // there are fewer than 2^31
    };
    using Places = std::array<std::span<const std::uint32_t>, 2>;

    /// Of those at `places`, in their order. O(n)
    PlacesInCells(const std::array<const OutlinedSolid*, 2>& solids, const Places& places,
                  const SinglePlace& place);

    [[nodiscard]] std::size_t cell_count() const { return cell_count_; }
    [[nodiscard]] SingleBox bounds(std::size_t cell) const;
    [[nodiscard]] std::span<const Entry> of(std::size_t solid, std::size_t cell) const {
        const PoolVector<std::uint32_t>& first = first_[solid];
        return std::span(entries_[solid]).subspan(first[cell], first[cell + 1] - first[cell]);
    }

private:
    static constexpr std::size_t most_along = 8;
    // Cells along each axis, from the first one to the last one.
    struct Range {
        std::array<std::uint8_t, 3> first{};
        std::array<std::uint8_t, 3> last{};
    };
    void set_grid(const SingleBox& all, std::size_t facets);
    [[nodiscard]] Range range_of(const SingleBox& box) const;
    template <class Each>
    void for_each_cell(const Range& range, const Each& each) const;
    void list(std::size_t solid, std::span<const Range> ranges,
              std::span<const std::uint32_t> places);

    std::array<std::size_t, 3> counts_{};
    std::array<std::array<float, most_along - 1>, 3> planes_{};  // between cells
    std::size_t cell_count_ = 0;
    std::array<PoolVector<std::uint32_t>, 2> first_;  // by cell, and the end
    std::array<PoolVector<Entry>, 2> entries_;
};

}  // namespace trisect::detail
