// SPDX-License-Identifier: Apache-2.0
//
// Lists of the polygons in each cell of a grid.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <trisect/bsp/query/index/index_grid.h>
#include <trisect/bsp/query/index/index_windings.h>

namespace trisect::detail {

/// The undivided cells of a grid with their lists and the winding numbers at their lower corners,
/// kept until all cells are divided. Lists are sorted by counting.
class IndexGridLists {
public:
    using Id = IndexPolygons::Id;

    /// `margin`: by how much cells are enlarged, in lattice units. The polygons must outlive the
    /// lists.
    IndexGridLists(const IndexPolygons& polygons, const IndexGrid& grid, double margin);

    /// False when a corner lies on a polygon. Small polygons go to all cells that their box meets,
    /// large triangles to those that they may meet themselves.
    [[nodiscard]] bool list(std::span<const Id> ids);
    [[nodiscard]] std::span<const Id> in(std::size_t cell) const {
        return std::span(listed_).subspan(begin_[cell], begin_[cell + 1] - begin_[cell]);
    }
    [[nodiscard]] IndexWindings& windings() { return windings_; }
    [[nodiscard]] const IndexWindings& windings() const { return windings_; }
    /// All cells together.
    [[nodiscard]] std::size_t listed() const { return listed_.size(); }
    [[nodiscard]] std::size_t bytes() const;

private:
    struct Range {
        std::array<std::uint16_t, 3> lo{};
        std::array<std::uint16_t, 3> hi{};
    };
    [[nodiscard]] BlockItem item(Id id) const;
    [[nodiscard]] Range range_of(const BlockItem& item) const;
    [[nodiscard]] static bool is_large(const Range& r);
    void list_large(const BlockItem& item, const Range& r);
    template <class F>
    void for_range(const Range& r, const F& f) const;

    const IndexPolygons& polygons_;
    IndexGrid grid_;
    IndexBlock block_;
    std::array<double, 3> scale_{};
    std::array<double, 3> margin_{};  // in cells
    IndexWindings windings_;
    std::vector<Range> ranges_;
    std::vector<std::pair<std::uint32_t, Id>> large_;  // cell, polygon
    std::vector<std::uint32_t> begin_;
    std::vector<Id> listed_;
};

}  // namespace trisect::detail
