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
/// Cells that boxes of facets meet are occupied; others that hang together, by sides, are a part.
/// All of a part is inside of what is bounded, or all of it is outside.
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
    /// The part in which all of the box is; `occupied` where a facet may be in its cells.
    [[nodiscard]] Part part_of(const OutlineBox& box) const;

private:
    [[nodiscard]] std::size_t place(double at, std::size_t k) const;
    void fill(std::size_t cell, Part part);

    std::array<double, 3> low_{};
    std::array<double, 3> scale_{};
    std::array<std::size_t, 3> counts_{};
    PoolVector<Part> parts_;
    PoolVector<std::size_t> open_;
    Part part_count_ = 1;
};

/// A box that holds all points with such positions.
[[nodiscard]] OutlineBox outline_box(const Box& positions);

}  // namespace trisect::detail
