// SPDX-License-Identifier: Apache-2.0
//
// BoundaryCells: cells of space by whether a boundary may be in them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include <trisect/bsp/cells/cell.h>
#include <trisect/bsp/many_meshes/outlines/outlined_solid.h>
#include <trisect/kernel/support/pool_allocator.h>

namespace trisect::detail {

/// A grid around a boundary, with a layer of cells around that which reaches as far as space does.
/// A cell that boxes of facets meet has 64 small ones, of which those are occupied that the boxes
/// meet. Cells and small cells that are not, and hang together by sides, are a part, if there is a
/// whole cell among them. All of a part is inside of what is bounded, or all of it is outside.
class BoundaryCells {
public:
    using Part = std::uint32_t;
    static constexpr Part occupied = 0;
    static constexpr Part outside = 1;  ///< the part that reaches far out

    /// Of a box of all facets; with some cells for each facet.
    BoundaryCells(const OutlineBox& all, std::size_t facets);
    void occupy(const OutlineBox& facet);
    /// To be called when all facets are there. O(n)
    void find_parts();
    [[nodiscard]] std::size_t part_count() const { return part_count_; }
    /// The part in which all of the box is; `occupied` where a facet may be in its cells, or a part
    /// has no whole cell.
    [[nodiscard]] Part part_of(const OutlineBox& box) const;

private:
    // Four along each axis, x first; a bit each.
    using SmallCells = std::uint64_t;
    // Small cells of one cell that hang together and are not occupied.
    struct Piece {
        SmallCells cells = 0;
        Part part = occupied;  // while parts are looked for: a number behind those of cells
    };
    struct Divided {
        SmallCells occupied = 0;
        std::size_t cell = 0;
        std::uint32_t first_piece = 0;
        std::uint32_t end_piece = 0;
    };
    // Of small cells.
    struct Range {
        std::array<std::size_t, 3> first{};
        std::array<std::size_t, 3> last{};
    };
    // A cell, and the numbers of cells before it along the axes.
    struct Open {
        std::size_t cell = 0;
        std::array<std::uint16_t, 3> at{};
    };
    class Unions;

    [[nodiscard]] std::size_t place(double at, std::size_t k) const;
    [[nodiscard]] Range range_of(const OutlineBox& box) const;
    template <class Each>
    bool for_each_cell(const Range& range, const Each& each) const;
    void fill(const Open& cell, Part part);
    void find_pieces(Divided& d);
    void unite_pieces(Unions& unions) const;
    void number_parts(Unions& unions);

    std::array<double, 3> low_{};
    std::array<double, 3> scale_{};  // of small cells
    std::array<std::size_t, 3> counts_{};
    PoolVector<Part> parts_;  // or the number of a divided cell, with a mark
    PoolVector<Divided> divided_;
    PoolVector<Piece> pieces_;
    PoolVector<Open> open_;
    Part part_count_ = 1;
};

/// A box that holds all points with such positions.
[[nodiscard]] OutlineBox outline_box(const Box& positions);

}  // namespace trisect::detail
