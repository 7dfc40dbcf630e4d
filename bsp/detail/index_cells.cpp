// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/detail/index_cells.h>

#include <limits>

namespace trisect::detail {

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
