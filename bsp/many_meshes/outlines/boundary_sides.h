// SPDX-License-Identifier: Apache-2.0
//
// BoundarySides: the side of a boundary that boxes lie on.
#pragma once

#include <cstddef>
#include <cstdint>

#include <trisect/bsp/many_meshes/outlines/boundary_cells.h>
#include <trisect/bsp/many_meshes/outlines/outlined_solid.h>
#include <trisect/kernel/support/pool_allocator.h>

namespace trisect::detail {

/// Of a set that leaves some of space open.
enum class OutlineSide : std::uint8_t { Unknown, Open, Closed };

/// By cells around the boundary: each part of them, which hangs together and has no boundary in it,
/// is on one side. Safe to read from many threads.
class BoundarySides {
public:
    using Part = BoundaryCells::Part;

    /// Of a solid without settled parts. What is outside of all has the side of what is far out;
    /// other sides are unknown at first. O(n)
    explicit BoundarySides(const OutlinedSolid& solid);

    [[nodiscard]] std::size_t part_count() const { return cells_.part_count(); }
    /// BoundaryCells::occupied where the boundary may be.
    [[nodiscard]] Part part_of(const OutlineBox& box) const { return cells_.part_of(box); }
    [[nodiscard]] OutlineSide side_of(Part part) const { return sides_[part]; }
    void set(Part part, OutlineSide side) { sides_[part] = side; }
    /// Unknown where the boundary may be.
    [[nodiscard]] OutlineSide side_of(const OutlineBox& box) const { return sides_[part_of(box)]; }

private:
    BoundaryCells cells_;
    PoolVector<OutlineSide> sides_;  // by part
};

}  // namespace trisect::detail
