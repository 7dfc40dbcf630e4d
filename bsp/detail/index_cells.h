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

/// A cell of a grid that is the node of `cell`.
[[nodiscard]] DoubleBox grid_cell(const DoubleBox& cell, const IndexGrid& g, std::uint32_t x,
                                  std::uint32_t y, std::uint32_t z);

[[nodiscard]] IndexCell cell_at(const IndexBase& index, const IndexPoint& point);

/// Calls visit(node, cell) for all leaves in whose cells enter(cell) holds; it must not hold for a
/// cell when it does not for a larger one. The node may be IndexTree::empty_leaf.
template <class Enter, class Visit>
void for_leaves(const IndexTree& tree, const Enter& enter, const Visit& visit) {
    struct Pending {
        std::uint32_t node = 0;
        DoubleBox cell;
    };
    std::vector<Pending> pending{{0, root_cell()}};
    // Layers, rows and cells of a grid.
    const auto visit_grid = [&](const IndexGrid& g, const DoubleBox& cell) {
        for (std::uint32_t z = 0; z < g.n[2]; ++z) {
            DoubleBox layer = cell;
            const DoubleBox layer_cell = grid_cell(cell, g, 0, 0, z);
            layer.lo[2] = layer_cell.lo[2];
            layer.hi[2] = layer_cell.hi[2];
            if (!enter(layer)) continue;
            for (std::uint32_t y = 0; y < g.n[1]; ++y) {
                DoubleBox row = layer;
                const DoubleBox row_cell = grid_cell(cell, g, 0, y, z);
                row.lo[1] = row_cell.lo[1];
                row.hi[1] = row_cell.hi[1];
                if (!enter(row)) continue;
                for (std::uint32_t x = 0; x < g.n[0]; ++x) {
                    const std::uint32_t at = tree.cell(g, g.number(x, y, z));
                    const DoubleBox box = grid_cell(cell, g, x, y, z);
                    if (at < IndexGrid::outside) {
                        pending.push_back({at, box});
                    } else if (enter(box)) {
                        visit(IndexTree::empty_leaf(at == IndexGrid::inside), box);
                    }
                }
            }
        }
    };
    while (!pending.empty()) {
        const Pending at = pending.back();
        pending.pop_back();
        const IndexTree::Node& n = tree.node(at.node);
        if (!enter(at.cell)) continue;
        if (n.is_grid()) {
            visit_grid(tree.grid(n), at.cell);
        } else if (n.is_leaf()) {
            visit(n, at.cell);
        } else {
            pending.push_back({n.next + 1, child_cell(at.cell, n, true)});
            pending.push_back({n.next, child_cell(at.cell, n, false)});
        }
    }
}

}  // namespace trisect::detail
