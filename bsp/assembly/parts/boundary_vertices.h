// SPDX-License-Identifier: Apache-2.0
//
// BoundaryVertices: one number for every vertex of a boundary.
// A vertex is a point of the workbench or a corner of an unmodified facet.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include <trisect/bsp/assembly/parts/boundary_parts.h>
#include <trisect/kernel/support/pool_allocator.h>

namespace trisect::detail {

/// Corners of equal coordinates get one number, whichever source or index they have. Numbers count
/// up in the order of first use.
class BoundaryVertices {
public:
    using Index = std::uint32_t;
    static constexpr Index none = std::numeric_limits<Index>::max();

    explicit BoundaryVertices(const BoundaryParts& parts);

    /// Of a point that represents all equal ones (as in the edges of `parts`).
    Index of_point(PointId p);
    /// Of a vertex of source number `table`.
    Index of_corner(std::size_t table, std::uint32_t vertex);

    [[nodiscard]] std::size_t size() const { return vertices_.size(); }
    /// The point that stands for a vertex in the workbench, or -1 when it has none.
    [[nodiscard]] PointId point(Index v) const { return vertices_[v].point; }
    void set_point(Index v, PointId p) { vertices_[v].point = p; }
    /// Exact coordinates.
    [[nodiscard]] Point exact(Index v) const {
        const Vertex& it = vertices_[v];
        return it.point >= 0 ? parts_.bench.point(it.point) : Point(it.corner);
    }

private:
    struct Vertex {
        PointId point = -1;
        LatticePoint corner;
    };
    Index find_or_add(const LatticePoint& p);
    void rehash(std::size_t size);
    [[nodiscard]] std::size_t slot_of(const LatticePoint& p) const;

    const BoundaryParts& parts_;
    std::vector<Vertex> vertices_;
    PoolVector<Index> of_point_;
    std::vector<PoolVector<Index>> of_corner_;  // by source
    PoolVector<Index> slots_;                   // corners by coordinates, open addressing
    std::size_t used_ = 0;
};

}  // namespace trisect::detail
