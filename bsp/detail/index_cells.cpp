// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/detail/index_cells.h>

#include <algorithm>
#include <limits>

namespace trisect::detail {

DoubleBox to_doubles(const Box& box) {
    DoubleBox b;
    for (std::size_t k = 0; k < 3; ++k) {
        b.lo[k] = static_cast<double>(box.lo[k]);
        b.hi[k] = static_cast<double>(box.hi[k]);
    }
    return b;
}

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
    (above ? c.lo : c.hi)[n.axis()] = n.rounded_wall();
    return c;
}

IndexCell cell_at(const IndexBase& index, const IndexPoint& point) {
    DoubleBox box = root_cell();
    const IndexTree::Node* n = &index.tree.node(0);
    while (!n->is_leaf()) {
        const bool above = IndexTree::side_of_wall(*n, point) > 0;
        box = child_cell(box, *n, above);
        n = &index.tree.node(n->next + (above ? 1U : 0U));
    }
    IndexCell cell{box.lo, box.hi, 0, n->is_inside()};
    if (n->is_mixed()) cell.polygons = index.tree.leaf(n->next).count;
    return cell;
}

}  // namespace trisect::detail
