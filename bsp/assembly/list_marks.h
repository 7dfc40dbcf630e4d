// SPDX-License-Identifier: Apache-2.0
//
// ListMarks: marks of facets that leaves list whole.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include <trisect/bsp/assembly/parts/facet_marks.h>
#include <trisect/bsp/cells/cell.h>
#include <trisect/bsp/cells/cell_tree.h>
#include <trisect/kernel/support/pool_allocator.h>

namespace trisect::detail {

/// Lists of nothing but whole facets of one source are marked when all are there, by several
/// threads: what other leaves say of a facet makes no difference to it.
class ListMarks {
public:
    /// A leaf's list of facets of the source of `marks`, which is that of `table`. The list and the
    /// cell stay where they are until mark().
    void note(const PolygonList& polygons, const Cell& cell, bool complemented, std::size_t table,
              FacetMarks& marks);
    /// `tables` as they were noted.
    void mark(std::span<FacetMarks> tables, std::uint32_t threads) const;

private:
    struct Part {
        std::span<const std::uint32_t> facets;
        bool contained = false;  // in the cell of the leaf, so that no other leaf lists them
        const Cell* cell = nullptr;
        std::size_t table = 0;
        bool flipped = false;
    };
    template <bool Shared, bool Whole>
    static void mark(const Part& part, FacetMarks& marks);

    PoolVector<Part> parts_;
};

}  // namespace trisect::detail
