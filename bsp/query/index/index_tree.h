// SPDX-License-Identifier: Apache-2.0
//
// IndexTree: the flat, refined form of a cell tree for queries.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include <trisect/bsp/cells/solid_state.h>
#include <trisect/bsp/query/index/index_grid.h>
#include <trisect/bsp/query/index/index_leaf.h>
#include <trisect/bsp/query/index/index_point.h>
#include <trisect/bsp/query/index/index_polygons.h>
#include <trisect/kernel/support/growing_array.h>

namespace trisect::detail {

/// What the cells of grids are made of. They are divided when a query first comes to them, so the
/// arrays grow while others read.
struct IndexCells {
    using Id = IndexPolygons::Id;

    GrowingArray<std::uint32_t> slots;  // of bricks, see IndexSlot
    GrowingArray<IndexBrick> bricks;
    GrowingArray<IndexLeaf> leaves;
    GrowingArray<Id> listed;
    GrowingArray<float> planes;
    /// Bytes that the leaves made so far may take together, if corners are what makes them larger.
    double room = 0;

    [[nodiscard]] std::size_t bytes() const {
        return slots.bytes() + bricks.bytes() + leaves.bytes() + listed.bytes() + planes.bytes();
    }
};

/// The cells of grids that are still to be divided.
class IndexDivision;

/// Nodes in one array, children side by side; leaves of the cell tree with many polygons become
/// grids (IndexGrid).
///
/// The splitting planes of nodes are *inherited* from the solid's cell tree; leaves on either side
/// list what meets their open cell, so a point on such a splitting plane needs both sides. Cells of
/// a grid list every polygon that meets the cell, a little enlarged (by 2^-10 of its size at
/// least), so a point on one of their splitting planes needs one cell only, and a ray those that it
/// comes through up to rounding.
class IndexTree {
public:
    using Id = IndexPolygons::Id;

    struct Node {
        static constexpr std::uint32_t leaf = 3;        // in the place of an axis
        static constexpr std::uint32_t inside = 8;      // of an empty leaf
        static constexpr std::uint32_t grid_flag = 16;  // beside `leaf`: no leaf but a grid
        static constexpr std::uint32_t none = 0xffffffffU;

        /// The splitting plane's position, 1/192 units; the number of a mixed leaf's reference.
        std::int64_t position = 0;
        /// The child below (the child above is next), or the number of a mixed leaf or grid, or
        /// `none`.
        std::uint32_t next = none;
        std::uint32_t flags = leaf;

        [[nodiscard]] bool has_splitter() const { return (flags & 3U) != leaf; }
        [[nodiscard]] bool is_grid() const { return (flags & grid_flag) != 0; }
        [[nodiscard]] bool is_leaf() const { return !has_splitter() && !is_grid(); }
        [[nodiscard]] std::size_t axis() const { return flags & 3U; }
        [[nodiscard]] bool is_inside() const { return (flags & inside) != 0; }
        [[nodiscard]] bool is_mixed() const { return next != none; }  // of a leaf
        [[nodiscard]] double rounded_splitter() const { return detail::rounded_position(position); }
    };

    /// Where a descent ends: a mixed leaf or an empty cell.
    struct Cell {
        static constexpr std::uint32_t none = 0xffffffffU;

        std::uint32_t leaf = none;
        bool inside = false;              ///< of an empty cell
        const IndexGrid* grid = nullptr;  ///< whose cell it is, or null
        unsigned shift = 0;               ///< its edge is 2^shift finest cells of the grid
        std::uint32_t reference = none;   ///< of a mixed leaf that is none of a grid

        [[nodiscard]] bool is_mixed() const { return leaf != none; }
        [[nodiscard]] bool is_inside() const { return inside; }
    };

    IndexTree();
    ~IndexTree();
    IndexTree(IndexTree&&) noexcept;
    IndexTree& operator=(IndexTree&&) noexcept;
    /// Numbers the polygons on the way; they must stay where they are. \pre the state is embedded.
    IndexTree(const SolidState& state, IndexPolygons& polygons);

    [[nodiscard]] std::span<const Node> nodes() const { return nodes_; }
    [[nodiscard]] const Node& node(std::uint32_t i) const { return nodes_[i]; }
    [[nodiscard]] const IndexLeaf& leaf(std::uint32_t i) const { return cells_->leaves[i]; }
    /// How many there are now; all of them after divide_all().
    [[nodiscard]] std::uint32_t leaf_count() const { return cells_->leaves.end(); }
    [[nodiscard]] std::span<const Id> listed(const IndexLeaf& l) const {
        return {&cells_->listed[l.first], l.count};
    }
    /// \pre the leaf has them.
    [[nodiscard]] LeafPlanes planes(const IndexLeaf& l) const {
        return {&cells_->planes[l.planes], LeafPlanes::stride_of(l.count)};
    }
    /// \pre the leaf has them.
    [[nodiscard]] const float* corners(const IndexLeaf& l) const {
        return &cells_->planes[l.planes] + std::size_t{4} * LeafPlanes::stride_of(l.count);
    }
    /// Asks for the memory that a point in the leaf will need.
    void prefetch(const IndexLeaf& l) const {
        if (!l.has_planes()) return;
        const float* p = &cells_->planes[l.planes];
        const std::uint32_t n = 4 * l.count + (l.has_corners() ? LeafCorners::floats(l.count) : 0);
        for (std::uint32_t i = 0; i < n; i += 16) __builtin_prefetch(p + i);
    }
    [[nodiscard]] const IndexGrid& grid(const Node& n) const { return grids_[n.next]; }
    [[nodiscard]] const IndexBrick& brick(std::uint32_t slot) const {
        return cells_->bricks[IndexSlot::number(slot)];
    }
    /// Of a brick's cell.
    [[nodiscard]] std::uint32_t slot(std::uint32_t i) const { return cells_->slots[i]; }
    /// Of a grid's cell, which is divided now if that has not happened yet.
    [[nodiscard]] std::uint32_t slot(const IndexGrid& g, std::size_t cell) const {
        const std::uint32_t s =
            std::atomic_ref(roots_[g.first + cell]).load(std::memory_order_acquire);
        return s == IndexSlot::pending ? divide(g, cell) : s;
    }
    /// Whether a grid's cell is known to be empty; it is not divided for that.
    [[nodiscard]] bool is_empty(const IndexGrid& g, std::size_t cell) const {
        return IndexSlot::is_empty(
            std::atomic_ref(roots_[g.first + cell]).load(std::memory_order_relaxed));
    }
    /// Does now what queries would do when they come to a cell.
    void divide_all() const;
    /// Of a mixed cell: the known point of its leaf.
    [[nodiscard]] FinePoint reference(const Cell& c, const IndexGrid::Position& at) const;
    /// Contains the boundary; strictly outside of it everything has the membership `beyond`.
    [[nodiscard]] const std::array<double, 3>& lo() const { return lo_; }
    [[nodiscard]] const std::array<double, 3>& hi() const { return hi_; }
    [[nodiscard]] bool is_bounded() const { return bounded_; }
    [[nodiscard]] bool is_inside_beyond() const { return beyond_; }
    void set_inside_beyond(bool inside) { beyond_ = inside; }

    /// Calls visit(cell, position) for the leaves whose closed cells hold the point: one, or
    /// several when it lies on inherited splitting planes. The position is the one in the cell's
    /// grid.
    template <class Visit>
    void for_leaves_at(const IndexPoint& p, Visit&& visit) const;
    /// -1, 0, 1: the point below, on, above a node's splitting plane.
    [[nodiscard]] static int side_of_splitter(const Node& n, const IndexPoint& p) {
        return p.compare_fine(n.axis(), n.position);
    }
    /// The cell of a grid that holds a point.
    [[nodiscard]] Cell cell_at(const IndexGrid& g, const IndexGrid::Position& at) const;

    struct Stats {
        std::size_t nodes = 0;    ///< and cells of grids and bricks
        std::size_t mixed = 0;    ///< leaves
        std::size_t empty = 0;    ///< homogeneous leaves, cells of grids included
        std::size_t pending = 0;  ///< cells of grids that are not divided yet
        std::size_t listed = 0;
        std::size_t depth = 0;
        std::size_t bytes = 0;
    };
    /// As far as cells are divided.
    [[nodiscard]] Stats stats() const;

private:
    friend class IndexTreeBuilder;

    std::vector<Node> nodes_;
    std::vector<IndexGrid> grids_;
    [[nodiscard]] std::uint32_t divide(const IndexGrid& g, std::size_t cell) const;

    std::vector<FinePoint> references_;         // of leaves that are none of a grid
    mutable std::vector<std::uint32_t> roots_;  // slots of grids' cells
    std::unique_ptr<IndexCells> cells_;
    std::vector<std::unique_ptr<IndexDivision>> divisions_;  // by grid
    std::unique_ptr<std::mutex> dividing_;
    std::array<double, 3> lo_{};
    std::array<double, 3> hi_{};
    bool bounded_ = true;
    bool beyond_ = false;
    std::size_t depth_ = 0;  // of nodes
};

inline IndexTree::Cell IndexTree::cell_at(const IndexGrid& g, const IndexGrid::Position& at) const {
    Cell c;
    c.grid = &g;
    c.shift = g.shift();
    std::uint32_t s =
        slot(g, g.cell(at.fine[0] >> c.shift, at.fine[1] >> c.shift, at.fine[2] >> c.shift));
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

template <class Visit>
void IndexTree::for_leaves_at(const IndexPoint& p, Visit&& visit) const {
    std::vector<std::uint32_t> pending;  // allocates only for points on inherited planes
    std::uint32_t at = 0;
    for (;;) {
        const Node& n = nodes_[at];
        if (n.has_splitter()) {
            const int s = side_of_splitter(n, p);
            at = n.next + (s > 0 ? 1U : 0U);
            if (s == 0) pending.push_back(n.next + 1);
            continue;
        }
        if (n.is_grid()) {
            const IndexGrid& g = grid(n);
            const IndexGrid::Position position = g.position(p);
            visit(cell_at(g, position), position);
        } else {
            Cell c;
            c.leaf = n.next;
            c.inside = n.is_inside();
            c.reference = static_cast<std::uint32_t>(n.position);
            visit(c, IndexGrid::Position{});
        }
        if (pending.empty()) return;
        at = pending.back();
        pending.pop_back();
    }
}

}  // namespace trisect::detail
