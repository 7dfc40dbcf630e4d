// SPDX-License-Identifier: Apache-2.0
//
// The leaves of an index as boxes.
#pragma once

#include <array>
#include <vector>

#include <trisect/bsp/detail/index_core.h>

namespace trisect::detail {

/// A closed box of doubles; its ends may be infinite.
struct DoubleBox {
    std::array<double, 3> lo{};
    std::array<double, 3> hi{};
    [[nodiscard]] bool overlaps(const DoubleBox& b) const {
        for (std::size_t k = 0; k < 3; ++k)
            if (lo[k] > b.hi[k] || hi[k] < b.lo[k]) return false;
        return true;
    }
};

/// Contain a box of lattice points, and a segment.
[[nodiscard]] DoubleBox to_doubles(const Box& box);
[[nodiscard]] DoubleBox hull(const Point& a, const Point& b);
/// Everything.
[[nodiscard]] DoubleBox root_cell();
/// The cells of a node's children. Rounded where an inherited wall is no double.
[[nodiscard]] DoubleBox child_cell(const DoubleBox& cell, const IndexTree::Node& n, bool above);

[[nodiscard]] IndexCell cell_at(const IndexBase& index, const IndexPoint& point);

/// Calls visit(node, cell) for all leaves whose cells overlap a box; descends only where
/// enter(cell) holds.
template <class Enter, class Visit>
void for_leaves(const IndexTree& tree, const Enter& enter, const Visit& visit) {
    struct Pending {
        std::uint32_t node = 0;
        DoubleBox cell;
    };
    std::vector<Pending> pending{{0, root_cell()}};
    while (!pending.empty()) {
        const Pending at = pending.back();
        pending.pop_back();
        const IndexTree::Node& n = tree.node(at.node);
        if (!enter(at.cell)) continue;
        if (n.is_leaf()) {
            visit(n, at.cell);
            continue;
        }
        pending.push_back({n.next + 1, child_cell(at.cell, n, true)});
        pending.push_back({n.next, child_cell(at.cell, n, false)});
    }
}

}  // namespace trisect::detail
