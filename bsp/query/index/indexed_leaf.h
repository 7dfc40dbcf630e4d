// SPDX-License-Identifier: Apache-2.0
//
// IndexedLeaf: a leaf of a cell tree, refined for queries.
#pragma once

#include <array>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include <trisect/bsp/cells/cell_tree.h>
#include <trisect/bsp/cells/node_fact.h>
#include <trisect/bsp/query/index/index_grid.h>
#include <trisect/bsp/query/index/index_leaf.h>
#include <trisect/bsp/query/index/index_point.h>
#include <trisect/bsp/query/index/index_polygons.h>
#include <trisect/kernel/support/growing_array.h>

namespace trisect::detail {

/// What the cells of a grid are made of. They are divided when a query first comes to them, so the
/// arrays grow while others read.
struct IndexCells {
    using Id = IndexPolygons::Id;

    /// For about so many polygons.
    explicit IndexCells(std::size_t polygons);

    // In the order in which most points of small grids come to them.
    GrowingArray<IndexLeaf> leaves;
    GrowingArray<float> planes;
    GrowingArray<IndexBrick> bricks;
    GrowingArray<std::uint32_t> slots;  // of bricks, see IndexSlot
    GrowingArray<Id> listed;
    /// Bytes that the leaves made so far may take together, if corners are what makes them larger.
    double room = 0;

    [[nodiscard]] std::size_t bytes() const {
        return slots.bytes() + bricks.bytes() + leaves.bytes() + listed.bytes() + planes.bytes();
    }
};

/// The cells of a grid that are still to be divided.
class IndexDivision;

/// The polygons that a leaf of the cell tree lists, in a grid over their box whose cells are
/// divided when a query first comes to them; few polygons remain a list.
///
/// A fact of the leaf: it says nothing of what is beyond the leaf's cell, and a complement reads it
/// with inside and outside exchanged. Leaves on either side of a splitting plane list what meets
/// their open cell, so a point on such a plane needs both. Cells of a grid list every polygon that
/// meets the cell, a little enlarged (by 2^-10 of its size at least), so a point on one of their
/// splitting planes needs one cell only, and a ray those that it comes through up to rounding.
///
/// Safe to use from many threads.
class alignas(64) IndexedLeaf final : public NodeFact {
public:
    using Id = IndexPolygons::Id;

    /// Where a descent ends: a mixed leaf of the index or an empty cell.
    struct Cell {
        static constexpr std::uint32_t none = 0xffffffffU;

        std::uint32_t leaf = none;
        bool inside = false;              ///< of an empty cell
        const IndexGrid* grid = nullptr;  ///< whose cell it is; null for a list
        unsigned shift = 0;               ///< its edge is 2^shift finest cells of the grid

        [[nodiscard]] bool is_mixed() const { return leaf != none; }
        [[nodiscard]] bool is_inside() const { return inside; }
    };

    /// \pre the node is a leaf and fills `cell`.
    IndexedLeaf(const CellNode& node, const detail::Cell& cell);
    ~IndexedLeaf() override;

    [[nodiscard]] const IndexPolygons& polygons() const { return polygons_; }
    /// Whether the grid or list is there. What only looks at all polygons needs none.
    [[nodiscard]] bool is_divided() const { return divided_.load(std::memory_order_acquire); }
    /// Makes the grid or list. To be called before all that follows.
    const IndexedLeaf& divided() const {
        if (!is_divided()) build();
        return *this;
    }

    /// Null for a list, which is leaf 0, and for a cell that no polygon meets.
    [[nodiscard]] const IndexGrid* grid() const { return grid_ ? &*grid_ : nullptr; }
    /// Of a list: its cell.
    [[nodiscard]] Cell whole() const;
    /// The leaf's reference point, on no polygon, and its winding number.
    [[nodiscard]] const FinePoint& reference() const { return reference_; }
    [[nodiscard]] std::int32_t winding() const { return winding_; }

    /// Of a point of the cell that is beyond all polygons along an axis: whether it is inside.
    /// Nothing for other points.
    [[nodiscard]] std::optional<bool> beyond(const std::array<double, 3>& p, double error) const {
        for (std::size_t k = 0; k < 3; ++k) {
            if (p[k] + error < below_[k]) return side_is_inside(2 * k);
            if (p[k] - error > above_[k]) return side_is_inside(2 * k + 1);
        }
        return std::nullopt;
    }

    [[nodiscard]] const IndexLeaf& leaf(std::uint32_t i) const { return cells_.leaves[i]; }
    /// How many there are now; all of them after divide_all().
    [[nodiscard]] std::uint32_t leaf_count() const { return cells_.leaves.end(); }
    [[nodiscard]] std::span<const Id> listed(const IndexLeaf& l) const {
        return {&cells_.listed[l.first], l.count};
    }
    /// \pre the leaf has them.
    [[nodiscard]] LeafPlanes planes(const IndexLeaf& l) const {
        return {&cells_.planes[l.planes], LeafPlanes::stride_of(l.count)};
    }
    /// \pre the leaf has them.
    [[nodiscard]] const float* corners(const IndexLeaf& l) const {
        return &cells_.planes[l.planes] + std::size_t{4} * LeafPlanes::stride_of(l.count);
    }
    /// Asks for the memory that a point in the leaf will need.
    void prefetch(const IndexLeaf& l) const {
        if (!l.has_planes()) return;
        const float* p = &cells_.planes[l.planes];
        const std::uint32_t n = 4 * l.count + (l.has_corners() ? LeafCorners::floats(l.count) : 0);
        for (std::uint32_t i = 0; i < n; i += 16) __builtin_prefetch(p + i);
    }
    /// Asks for the memory in which a point finds its cell.
    void prefetch() const {
        const char* const first = reinterpret_cast<const char*>(this);
        for (std::size_t line = 0; line < 3; ++line) __builtin_prefetch(first + 64 * line);
    }
    /// Asks for the memory that a point between the polygons needs next.
    void prefetch_cells() const {
        __builtin_prefetch(&cells_.leaves);
        __builtin_prefetch(&cells_.bricks);
    }
    /// Asks for the slot of a grid's cell. \pre grid() != nullptr
    void prefetch_root(const IndexGrid::Position& at) const {
        const unsigned shift = grid_->shift();
        __builtin_prefetch(
            &roots_[grid_->cell(at.fine[0] >> shift, at.fine[1] >> shift, at.fine[2] >> shift)]);
    }
    [[nodiscard]] const IndexBrick& brick(std::uint32_t slot) const {
        return cells_.bricks[IndexSlot::number(slot)];
    }
    /// Of a brick's cell.
    [[nodiscard]] std::uint32_t slot(std::uint32_t i) const { return cells_.slots[i]; }
    /// Of a grid's cell, which is divided now if that has not happened yet.
    [[nodiscard]] std::uint32_t grid_slot(std::size_t cell) const {
        const std::uint32_t s = std::atomic_ref(roots_[cell]).load(std::memory_order_acquire);
        return s == IndexSlot::pending ? divide(cell) : s;
    }
    /// Whether a grid's cell is known to be empty; it is not divided for that.
    [[nodiscard]] bool is_empty(std::size_t cell) const {
        return IndexSlot::is_empty(std::atomic_ref(roots_[cell]).load(std::memory_order_relaxed));
    }
    /// Does now what queries would do when they come to a cell.
    void divide_all() const;
    /// Of a mixed cell: a known point of it.
    [[nodiscard]] FinePoint reference(const Cell& c, const IndexGrid::Position& at) const;
    /// The cell of the grid that holds a point. \pre grid() != nullptr
    [[nodiscard]] Cell cell_at(const IndexGrid::Position& at) const;

    struct Stats {
        std::size_t nodes = 0;    ///< cells of the grid and of bricks
        std::size_t mixed = 0;    ///< leaves
        std::size_t empty = 0;    ///< homogeneous cells
        std::size_t pending = 0;  ///< cells of the grid that are not divided yet
        std::size_t listed = 0;
        std::size_t depth = 0;
        std::size_t bytes = 0;
    };
    /// As far as cells are divided.
    [[nodiscard]] Stats stats() const;

private:
    friend class IndexedLeafBuilder;

    void build() const;
    [[nodiscard]] std::uint32_t divide(std::size_t cell) const;
    [[nodiscard]] std::mutex& dividing() const;
    [[nodiscard]] bool side_is_inside(std::size_t side) const {
        const std::int8_t known = sides_[side].load(std::memory_order_relaxed);
        return known >= 0 ? known != 0 : find_side(side);
    }
    [[nodiscard]] bool find_side(std::size_t side) const;

    // Points meet the members in this order: the first 64 bytes are what decides beyond all
    // polygons, the next what finds a cell.
    //
    // Strictly beyond these, along their axis, the cell has no polygons; infinite where the cell
    // ends before. What is there: 0 outside, 1 inside, -1 not known yet; below and above by axis.
    std::array<double, 3> below_{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    std::array<double, 3> above_{HUGE_VAL, HUGE_VAL, HUGE_VAL};
    mutable std::array<std::atomic<std::int8_t>, 6> sides_{-1, -1, -1, -1, -1, -1};
    mutable std::atomic<bool> divided_{false};  // all but the last three is made by build()
    std::optional<IndexGrid> grid_;
    mutable std::vector<std::uint32_t> roots_;  // slots of the grid's cells
    mutable IndexCells cells_;
    std::unique_ptr<IndexDivision> division_;
    IndexPolygons polygons_;
    FinePoint reference_;
    std::int32_t winding_ = 0;
};

inline IndexedLeaf::Cell IndexedLeaf::cell_at(const IndexGrid::Position& at) const {
    const IndexGrid& g = *grid_;
    Cell c;
    c.grid = &g;
    c.shift = g.shift();
    std::uint32_t s =
        grid_slot(g.cell(at.fine[0] >> c.shift, at.fine[1] >> c.shift, at.fine[2] >> c.shift));
    while (IndexSlot::is_brick(s)) {
        const IndexBrick& b = brick(s);
        c.shift -= 2;
        const unsigned bit =
            IndexBrick::bit(at.fine[0] >> c.shift, at.fine[1] >> c.shift, at.fine[2] >> c.shift);
        if (!b.is_mixed(bit)) {
            c.inside = b.is_inside(bit);
            return c;
        }
        s = slot(b.slot(bit));
    }
    if (IndexSlot::is_empty(s)) {
        c.inside = s == IndexSlot::inside;
    } else {
        c.leaf = s;
    }
    return c;
}

/// The index of a leaf of the cell tree, made when it is first needed, perhaps without a grid.
[[nodiscard]] const IndexedLeaf& listed_leaf(const CellNode& leaf, const Cell& cell);
/// The same, divided.
[[nodiscard]] inline const IndexedLeaf& indexed_leaf(const CellNode& leaf, const Cell& cell) {
    return listed_leaf(leaf, cell).divided();
}

}  // namespace trisect::detail
