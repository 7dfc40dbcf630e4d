// SPDX-License-Identifier: Apache-2.0
//
// Leaves of an index as boxes.
#pragma once

#include <array>
#include <vector>

#include <trisect/bsp/query/index/double_box.h>
#include <trisect/bsp/query/index/index_core.h>

namespace trisect::detail {

/// Contains a segment.
[[nodiscard]] DoubleBox hull(const Point& a, const Point& b);
/// Everything.
[[nodiscard]] DoubleBox root_cell();
/// The cells of a node's children. Rounded where an inherited splitting plane is no double.
[[nodiscard]] DoubleBox child_cell(const DoubleBox& cell, const IndexTree::Node& n, bool above);

/// A cell of a block that fills `cell`: the first and last cells reach as far as that.
[[nodiscard]] DoubleBox block_cell(const DoubleBox& cell, const IndexBlock& block, std::uint32_t x,
                                   std::uint32_t y, std::uint32_t z);

[[nodiscard]] IndexCell cell_at(const IndexBase& index, const IndexPoint& point);

/// The slots of a grid or a brick one by one, layers and rows of which the box must be entered:
/// visit(slot, box, place) with the number of the cell along each axis.
template <class Slot, class Enter, class Visit>
void for_block_cells(const IndexBlock& block, const DoubleBox& cell, const Slot& slot,
                     const Enter& enter, const Visit& visit) {
    for (std::uint32_t z = 0; z < block.n[2]; ++z) {
        DoubleBox layer = cell;
        const DoubleBox layer_cell = block_cell(cell, block, 0, 0, z);
        layer.lo[2] = layer_cell.lo[2];
        layer.hi[2] = layer_cell.hi[2];
        if (!enter(layer)) continue;
        for (std::uint32_t y = 0; y < block.n[1]; ++y) {
            DoubleBox row = layer;
            const DoubleBox row_cell = block_cell(cell, block, 0, y, z);
            row.lo[1] = row_cell.lo[1];
            row.hi[1] = row_cell.hi[1];
            if (!enter(row)) continue;
            for (std::uint32_t x = 0; x < block.n[0]; ++x) {
                const DoubleBox box = block_cell(cell, block, x, y, z);
                if (enter(box)) visit(slot(x, y, z), box, std::array{x, y, z});
            }
        }
    }
}

/// The slot of a cell of a brick, IndexSlot::inside or outside for an empty one.
[[nodiscard]] inline std::uint32_t slot_in(const IndexTree& tree, const IndexBrick& brick,
                                           unsigned bit) {
    if (brick.is_mixed(bit)) return tree.slot(brick.slot(bit));
    return brick.is_inside(bit) ? IndexSlot::inside : IndexSlot::outside;
}

/// Calls visit(cell, box) for all leaves in whose boxes enter(box) holds; it must not hold for a
/// box when it does not for a larger one.
template <class Enter, class Visit>
void for_leaves(const IndexTree& tree, const Enter& enter, const Visit& visit) {
    struct Pending {
        std::uint32_t node = 0;  // or a slot of a grid
        DoubleBox cell;
        const IndexGrid* grid = nullptr;
        std::array<std::uint32_t, 3> low{};
        int level = 0;
    };
    std::vector<Pending> pending{{0, root_cell()}};
    const auto visit_block = [&](const Pending& at, const IndexBlock& block, const auto& slot) {
        const unsigned shift = 2U * static_cast<unsigned>(at.level - 1);
        for_block_cells(block, at.cell, slot, enter,
                        [&](std::uint32_t s, const DoubleBox& box, const auto& place) {
                            Pending next{s, box, at.grid, at.low, at.level - 1};
                            for (std::size_t k = 0; k < 3; ++k) next.low[k] += place[k] << shift;
                            pending.push_back(next);
                        });
    };
    while (!pending.empty()) {
        const Pending at = pending.back();
        pending.pop_back();
        if (!enter(at.cell)) continue;
        if (at.grid != nullptr) {
            if (IndexSlot::is_brick(at.node)) {
                const IndexBrick& b = tree.brick(at.node);
                visit_block(at, at.grid->brick(at.low, at.level),
                            [&](std::uint32_t x, std::uint32_t y, std::uint32_t z) {
                                return slot_in(tree, b, IndexBrick::bit(x, y, z));
                            });
                continue;
            }
            IndexTree::Cell c;
            c.inside = at.node == IndexSlot::inside;
            if (!IndexSlot::is_empty(at.node)) c.leaf = at.node;
            visit(c, at.cell);
            continue;
        }
        const IndexTree::Node& n = tree.node(at.node);
        if (n.is_grid()) {
            const IndexGrid& g = tree.grid(n);
            visit_block({0, at.cell, &g, {}, g.levels + 1}, g.block(),
                        [&](std::uint32_t x, std::uint32_t y, std::uint32_t z) {
                            return tree.slot(g, g.cell(x, y, z));
                        });
        } else if (n.is_leaf()) {
            IndexTree::Cell c;
            c.leaf = n.next;
            c.inside = n.is_inside();
            visit(c, at.cell);
        } else {
            pending.push_back({n.next + 1, child_cell(at.cell, n, true)});
            pending.push_back({n.next, child_cell(at.cell, n, false)});
        }
    }
}

/// Calls visit(leaf, lo, hi) for all mixed leaves of a grid that the line may meet for t from `lo`
/// to `hi`, front to back but for a few; see for_cells_along.
template <class More, class Visit>
void for_grid_leaves_along(const IndexTree& tree, const IndexGrid& g, const ApproximateLine& line,
                           double lo, double hi, const More& more, const Visit& visit) {
    const auto descend = [&](const auto& self, std::uint32_t slot,
                             const std::array<std::uint32_t, 3>& low, int level, double from,
                             double to) -> void {
        if (IndexSlot::is_empty(slot)) return;
        if (!IndexSlot::is_brick(slot)) {
            visit(slot, from, to);
            return;
        }
        const IndexBrick& b = tree.brick(slot);
        const unsigned shift = 2U * static_cast<unsigned>(level - 1);
        for_cells_along(
            g.brick(low, level), line, from, to, more,
            [&](std::uint32_t x, std::uint32_t y, std::uint32_t z, double t0, double t1) {
                const unsigned bit = IndexBrick::bit(x, y, z);
                if (!b.is_mixed(bit)) return;
                self(self, tree.slot(b.slot(bit)),
                     {low[0] + (x << shift), low[1] + (y << shift), low[2] + (z << shift)},
                     level - 1, t0, t1);
            });
    };
    const unsigned shift = g.shift();
    for_cells_along(g.block(), line, lo, hi, more,
                    [&](std::uint32_t x, std::uint32_t y, std::uint32_t z, double t0, double t1) {
                        descend(descend, tree.slot(g, g.cell(x, y, z)),
                                {x << shift, y << shift, z << shift}, g.levels, t0, t1);
                    });
}

}  // namespace trisect::detail
