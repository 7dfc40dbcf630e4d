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
/// The cell in doubles, infinite where it has no end. Rounded where a splitting plane is no double.
[[nodiscard]] DoubleBox box_of(const Cell& cell);

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
[[nodiscard]] inline std::uint32_t slot_in(const IndexedLeaf& leaf, const IndexBrick& brick,
                                           unsigned bit) {
    if (brick.is_mixed(bit)) return leaf.slot(brick.slot(bit));
    return brick.is_inside(bit) ? IndexSlot::inside : IndexSlot::outside;
}

/// A leaf of the cell tree, met on a walk from the root.
struct LeafInTree {
    const CellNode& node;
    Cell cell;
    bool turned = false;
    /// Made now if need be. \pre the leaf lists something.
    [[nodiscard]] const IndexedLeaf& index() const { return indexed_leaf(node, cell); }
};

/// Calls visit(leaf) for all leaves of the cell tree in whose boxes enter(box) holds; it must not
/// hold for a box when it does not for a larger one.
template <class Enter, class Visit>
void for_tree_leaves(const IndexBase& base, const Enter& enter, const Visit& visit) {
    struct Pending {
        const CellNode* node;
        Cell cell;
        bool turned;
    };
    std::vector<Pending> pending{{base.root().node.get(), Cell{}, base.root().complemented}};
    while (!pending.empty()) {
        const Pending at = pending.back();
        pending.pop_back();
        if (!enter(box_of(at.cell))) continue;
        const CellNode& n = refined(*at.node);
        if (n.is_leaf()) {
            visit(LeafInTree{n, at.cell, at.turned});
            continue;
        }
        for (int i = 1; i >= 0; --i) {
            const CellRef& c = n.child(i);
            pending.push_back({c.node.get(),
                               i == 0 ? at.cell.below(n.axis(), n.splitter())
                                      : at.cell.above(n.axis(), n.splitter()),
                               at.turned != c.complemented});
        }
    }
}

/// Calls visit(cell, box) for the cells of a leaf's index in whose boxes enter(box) holds.
template <class Enter, class Visit>
void for_cells_of(const IndexedLeaf& leaf, const DoubleBox& whole, const Enter& enter,
                  const Visit& visit) {
    const IndexGrid* const grid = leaf.grid();
    if (grid == nullptr) {
        visit(leaf.whole(), whole);
        return;
    }
    struct Pending {
        std::uint32_t slot = 0;
        DoubleBox cell;
        std::array<std::uint32_t, 3> low{};
        int level = 0;
    };
    std::vector<Pending> pending;
    const auto visit_block = [&](const Pending& at, const IndexBlock& block, const auto& slot) {
        const unsigned shift = 2U * static_cast<unsigned>(at.level - 1);
        for_block_cells(block, at.cell, slot, enter,
                        [&](std::uint32_t s, const DoubleBox& box, const auto& place) {
                            Pending next{s, box, at.low, at.level - 1};
                            for (std::size_t k = 0; k < 3; ++k) next.low[k] += place[k] << shift;
                            pending.push_back(next);
                        });
    };
    visit_block({0, whole, {}, grid->levels + 1}, grid->block(),
                [&](std::uint32_t x, std::uint32_t y, std::uint32_t z) {
                    return leaf.grid_slot(grid->cell(x, y, z));
                });
    while (!pending.empty()) {
        const Pending at = pending.back();
        pending.pop_back();
        if (IndexSlot::is_brick(at.slot)) {
            const IndexBrick& b = leaf.brick(at.slot);
            visit_block(at, grid->brick(at.low, at.level),
                        [&](std::uint32_t x, std::uint32_t y, std::uint32_t z) {
                            return slot_in(leaf, b, IndexBrick::bit(x, y, z));
                        });
            continue;
        }
        IndexedLeaf::Cell c;
        c.inside = at.slot == IndexSlot::inside;
        if (!IndexSlot::is_empty(at.slot)) c.leaf = at.slot;
        visit(c, at.cell);
    }
}

/// Calls visit(leaf, cell) for the mixed cells whose closed cells hold a point.
template <class Visit>
void for_mixed_cells_at(const IndexBase& base, const IndexPoint& p, const Visit& visit) {
    for_leaves_at(base, p, [&](const LeafPlace& place) {
        if (place.leaf == nullptr) return;
        const IndexGrid* const grid = place.leaf->grid();
        const IndexedLeaf::Cell c =
            grid != nullptr ? place.leaf->cell_at(grid->position(p)) : place.leaf->whole();
        if (c.is_mixed()) visit(*place.leaf, c);
    });
}

/// Calls visit(leaf, cell, box) for the mixed cells of all leaves in whose boxes enter(box) holds.
template <class Enter, class Visit>
void for_mixed_cells(const IndexBase& base, const Enter& enter, const Visit& visit) {
    for_tree_leaves(base, enter, [&](const LeafInTree& leaf) {
        if (leaf.node.size() == 0) return;
        const IndexedLeaf& index = leaf.index();
        for_cells_of(index, box_of(leaf.cell), enter,
                     [&](const IndexedLeaf::Cell& c, const DoubleBox& box) {
                         if (c.is_mixed()) visit(leaf, c, box);
                     });
    });
}

/// The polygons that are listed in such cells, each once for each leaf that lists it.
template <class Enter>
[[nodiscard]] std::vector<PolygonId> polygons_in(const IndexBase& base, const Enter& enter) {
    std::vector<PolygonId> out;
    for_mixed_cells(base, enter,
                    [&](const LeafInTree& leaf, const IndexedLeaf::Cell& c, const DoubleBox&) {
                        const IndexedLeaf& index = leaf.index();
                        for (const IndexedLeaf::Id id : index.listed(index.leaf(c.leaf)))
                            out.push_back({&index, id, leaf.turned});
                    });
    sort_unique(out);
    return out;
}

/// Calls visit(leaf, lo, hi) for all mixed leaves of a grid that the line may meet for t from `lo`
/// to `hi`, front to back but for a few; see for_cells_along.
template <class More, class Visit>
void for_grid_leaves_along(const IndexedLeaf& index, const ApproximateLine& line, double lo,
                           double hi, const More& more, const Visit& visit) {
    const IndexGrid& g = *index.grid();
    const auto descend = [&](const auto& self, std::uint32_t slot,
                             const std::array<std::uint32_t, 3>& low, int level, double from,
                             double to) -> void {
        if (IndexSlot::is_empty(slot)) return;
        if (!IndexSlot::is_brick(slot)) {
            visit(slot, from, to);
            return;
        }
        const IndexBrick& b = index.brick(slot);
        const unsigned shift = 2U * static_cast<unsigned>(level - 1);
        for_cells_along(
            g.brick(low, level), line, from, to, more,
            [&](std::uint32_t x, std::uint32_t y, std::uint32_t z, double t0, double t1) {
                const unsigned bit = IndexBrick::bit(x, y, z);
                if (!b.is_mixed(bit)) return;
                self(self, index.slot(b.slot(bit)),
                     {low[0] + (x << shift), low[1] + (y << shift), low[2] + (z << shift)},
                     level - 1, t0, t1);
            });
    };
    const unsigned shift = g.shift();
    for_cells_along(g.block(), line, lo, hi, more,
                    [&](std::uint32_t x, std::uint32_t y, std::uint32_t z, double t0, double t1) {
                        descend(descend, index.grid_slot(g.cell(x, y, z)),
                                {x << shift, y << shift, z << shift}, g.levels, t0, t1);
                    });
}

}  // namespace trisect::detail
