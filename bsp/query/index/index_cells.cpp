// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/query/index/index_cells.h>

#include <algorithm>
#include <limits>

namespace trisect::detail {

DoubleBox hull(const Point& a, const Point& b) {
    DoubleBox box;
    const Approximation& p = a.approximation();
    const Approximation& q = b.approximation();
    for (std::size_t k = 0; k < 3; ++k) {
        box.lo[k] = std::min(p.c[k], q.c[k]) - 2 * (p.error + q.error);
        box.hi[k] = std::max(p.c[k], q.c[k]) + 2 * (p.error + q.error);
    }
    return box;
}

DoubleBox box_of(const Cell& cell) {
    constexpr double infinite = std::numeric_limits<double>::infinity();
    DoubleBox box;
    for (std::size_t k = 0; k < 3; ++k) {
        box.lo[k] = cell.lo[k] <= -universe_limit ? -infinite : rounded_position(cell.lo[k]);
        box.hi[k] = cell.hi[k] >= universe_limit ? infinite : rounded_position(cell.hi[k]);
    }
    return box;
}

DoubleBox block_cell(const DoubleBox& cell, const IndexBlock& block, std::uint32_t x,
                     std::uint32_t y, std::uint32_t z) {
    const std::array<std::uint32_t, 3> at{x, y, z};
    DoubleBox c = cell;
    for (std::size_t k = 0; k < 3; ++k) {
        if (at[k] != 0) c.lo[k] = block.splitter(k, at[k]);
        if (at[k] + 1 != block.n[k]) c.hi[k] = block.splitter(k, at[k] + 1);
    }
    return c;
}

IndexCell cell_at(const IndexBase& index, const IndexPoint& point) {
    const CellNode* node = &refined(*index.root().node);
    bool turned = index.root().complemented;
    Cell place;
    while (!node->is_leaf()) {
        const int side =
            point.compare_fine(static_cast<std::size_t>(node->axis()), node->splitter()) > 0 ? 1
                                                                                             : 0;
        place = side == 0 ? place.below(node->axis(), node->splitter())
                          : place.above(node->axis(), node->splitter());
        turned = turned != node->child(side).complemented;
        node = &refined(*node->child(side).node);
    }
    const DoubleBox box = box_of(place);
    IndexCell out{box.lo, box.hi, 0, (node->winding() > 0) != turned};
    if (node->size() == 0) return out;
    const IndexedLeaf& leaf = indexed_leaf(*node, place);
    IndexedLeaf::Cell cell = leaf.whole();
    if (const IndexGrid* const g = leaf.grid()) {
        const IndexGrid::Position at = g->position(point);
        cell = leaf.cell_at(at);
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t i = at.fine[k] >> cell.shift;
            if (i != 0) out.lo[k] = g->splitter(k, i << cell.shift);
            if ((i + 1) << cell.shift != g->n[k] << g->shift())
                out.hi[k] = g->splitter(k, (i + 1) << cell.shift);
        }
    }
    if (cell.is_mixed()) {
        out.polygons = leaf.leaf(cell.leaf).count;
        out.inside = false;
    } else {
        out.inside = cell.is_inside() != turned;
    }
    return out;
}

}  // namespace trisect::detail
