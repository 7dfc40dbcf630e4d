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

DoubleBox root_cell() {
    constexpr double infinite = std::numeric_limits<double>::infinity();
    return {{-infinite, -infinite, -infinite}, {infinite, infinite, infinite}};
}

DoubleBox child_cell(const DoubleBox& cell, const IndexTree::Node& n, bool above) {
    DoubleBox c = cell;
    (above ? c.lo : c.hi)[n.axis()] = n.rounded_splitter();
    return c;
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
    const IndexTree& tree = index.tree;
    DoubleBox box = root_cell();
    const IndexTree::Node* n = &tree.node(0);
    while (n->has_splitter()) {
        const bool above = IndexTree::side_of_splitter(*n, point) > 0;
        box = child_cell(box, *n, above);
        n = &tree.node(n->next + (above ? 1U : 0U));
    }
    IndexCell out{box.lo, box.hi, 0, n->is_inside()};
    if (n->is_leaf()) {
        if (n->is_mixed()) out.polygons = tree.leaf(n->next).count;
        return out;
    }
    const IndexGrid& g = tree.grid(*n);
    const IndexGrid::Position at = g.position(point);
    const IndexTree::Cell cell = tree.cell_at(g, at);
    for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t i = at.fine[k] >> cell.shift;
        if (i != 0) out.lo[k] = g.splitter(k, i << cell.shift);
        if ((i + 1) << cell.shift != g.n[k] << g.shift())
            out.hi[k] = g.splitter(k, (i + 1) << cell.shift);
    }
    out.inside = cell.is_inside();
    if (cell.is_mixed()) out.polygons = tree.leaf(cell.leaf).count;
    return out;
}

}  // namespace trisect::detail
