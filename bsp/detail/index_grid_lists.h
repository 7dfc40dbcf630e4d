// SPDX-License-Identifier: Apache-2.0
//
// Which polygons lie in which cells of a grid.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <trisect/bsp/detail/index_item.h>

namespace trisect::detail {

/// A grid over a box with lists of the items in its cells, for the time in which an index is built.
/// There are about as many cells as items: most cells are then empty and most others hold a
/// handful. The last cells along an axis take the rest of the box.
class IndexGridLists {
public:
    /// `finest`: walls are odd multiples of it where floats have the bits. The arguments must
    /// outlive the lists.
    IndexGridLists(const std::array<double, 3>& middle, const FloatBox& box,
                   const std::vector<IndexItem>& items, const IndexPolygons& polygons,
                   float finest);

    [[nodiscard]] const std::array<std::uint32_t, 3>& n() const { return n_; }
    [[nodiscard]] float size() const { return size_; }
    [[nodiscard]] const std::array<float, 3>& origin() const { return origin_; }
    [[nodiscard]] std::size_t cell_count() const { return std::size_t{n_[0]} * n_[1] * n_[2]; }
    [[nodiscard]] std::size_t number(std::uint32_t x, std::uint32_t y, std::uint32_t z) const {
        return (std::size_t{z} * n_[1] + y) * n_[0] + x;
    }
    [[nodiscard]] std::array<std::uint32_t, 3> place_of(std::size_t cell) const {
        return {static_cast<std::uint32_t>(cell % n_[0]),
                static_cast<std::uint32_t>(cell / n_[0] % n_[1]),
                static_cast<std::uint32_t>(cell / n_[0] / n_[1])};
    }
    [[nodiscard]] FloatBox box_of(std::uint32_t x, std::uint32_t y, std::uint32_t z) const;

    /// Fills the lists. Small items go to all cells that their box meets, large triangles to those
    /// that they may meet themselves.
    void list();
    [[nodiscard]] std::span<const std::uint32_t> items_in(std::size_t cell) const {
        return std::span(listed_).subspan(begin_[cell], begin_[cell + 1] - begin_[cell]);
    }

private:
    struct Range {
        std::array<std::uint32_t, 3> lo{};
        std::array<std::uint32_t, 3> hi{};
    };
    [[nodiscard]] Range range_of(const IndexItem& item) const;
    [[nodiscard]] static bool is_large(const Range& r);
    template <class F>
    void for_range(const Range& r, const F& f) const;
    void list_large(std::uint32_t i, const Range& r,
                    std::vector<std::pair<std::uint32_t, std::uint32_t>>& out) const;

    const std::array<double, 3>& middle_;
    FloatBox whole_;
    const std::vector<IndexItem>& items_;
    const IndexPolygons& polygons_;
    float size_ = 1;
    std::array<float, 3> origin_{};
    std::array<std::uint32_t, 3> n_{};
    std::vector<std::uint32_t> begin_;
    std::vector<std::uint32_t> listed_;
};

}  // namespace trisect::detail
