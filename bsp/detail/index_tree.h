// SPDX-License-Identifier: Apache-2.0
//
// IndexTree: the flat, refined form of a cell tree in which queries run.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <trisect/bsp/detail/index_grid.h>
#include <trisect/bsp/detail/index_point.h>
#include <trisect/bsp/detail/index_polygons.h>
#include <trisect/bsp/detail/solid_state.h>

namespace trisect::detail {

/// Nodes in one array, children side by side.
///
/// Two kinds of walls. *Inherited* ones come from the solid's cell tree; leaves on either side list
/// what meets their open cell, so a point on such a wall needs both sides. *Own* ones were added
/// below its leaves; their cells list every polygon that meets the closed cell, so for a point on
/// the wall either side will do.
///
/// Own walls are doubles, at odd multiples of 1/256 where the coordinates leave room for that.
///
/// Below a leaf of the cell tree with many polygons the first node is a grid, whose cells hold
/// their lower walls but not the upper ones.
class IndexTree {
public:
    using Id = IndexPolygons::Id;

    struct Node {
        static constexpr std::uint32_t leaf = 3;        // in the place of an axis
        static constexpr std::uint32_t inherited = 4;   // flag of a wall
        static constexpr std::uint32_t inside = 8;      // of an empty leaf
        static constexpr std::uint32_t grid_flag = 16;  // beside `leaf`: no leaf but a grid
        static constexpr std::uint32_t none = 0xffffffffU;

        /// An own wall in lattice units, or the bits of an inherited one's position (1/256 units).
        double wall = 0;
        /// The child below (the child above is next), or the number of a mixed leaf or grid, or
        /// `none`.
        std::uint32_t next = none;
        std::uint32_t flags = leaf;

        [[nodiscard]] bool has_wall() const { return (flags & 3U) != leaf; }
        [[nodiscard]] bool is_grid() const { return (flags & grid_flag) != 0; }
        [[nodiscard]] bool is_leaf() const { return !has_wall() && !is_grid(); }
        [[nodiscard]] std::size_t axis() const { return flags & 3U; }
        [[nodiscard]] bool is_inherited() const { return (flags & inherited) != 0; }
        [[nodiscard]] bool is_inside() const { return (flags & inside) != 0; }
        [[nodiscard]] bool is_mixed() const { return next != none; }  // of a leaf
        [[nodiscard]] std::int64_t position() const;
        [[nodiscard]] double rounded_wall() const;
    };

    /// A leaf that lists polygons.
    struct Leaf {
        FinePoint reference;
        std::uint32_t first = 0;  // of listed()
        std::uint32_t count = 0;
        std::int32_t winding = 0;  // at the reference
    };

    IndexTree() : nodes_(1) {}
    /// Numbers the polygons on the way. \pre the state is embedded.
    IndexTree(const SolidState& state, IndexPolygons& polygons);

    [[nodiscard]] std::span<const Node> nodes() const { return nodes_; }
    [[nodiscard]] const Node& node(std::uint32_t i) const { return nodes_[i]; }
    [[nodiscard]] const Leaf& leaf(std::uint32_t i) const { return leaves_[i]; }
    [[nodiscard]] std::span<const Leaf> leaves() const { return leaves_; }
    [[nodiscard]] std::span<const Id> listed(const Leaf& l) const {
        return std::span(listed_).subspan(l.first, l.count);
    }
    [[nodiscard]] const IndexGrid& grid(const Node& n) const { return grids_[n.next]; }
    /// IndexGrid::outside, IndexGrid::inside or a node.
    [[nodiscard]] std::uint32_t cell(const IndexGrid& g, std::size_t number) const {
        return cells_[g.first + number];
    }
    /// Contains the boundary; strictly outside of it everything has the membership `beyond`.
    [[nodiscard]] const std::array<double, 3>& lo() const { return lo_; }
    [[nodiscard]] const std::array<double, 3>& hi() const { return hi_; }
    [[nodiscard]] bool is_bounded() const { return bounded_; }
    [[nodiscard]] bool is_inside_beyond() const { return beyond_; }
    void set_inside_beyond(bool inside) { beyond_ = inside; }

    /// The node that stands for the empty cells of grids.
    [[nodiscard]] static const Node& empty_leaf(bool inside);

    /// Calls visit(node) for the leaves whose closed cells hold the point: one, or several when it
    /// lies on inherited walls.
    template <class Visit>
    void for_leaves_at(const IndexPoint& p, Visit&& visit) const;
    /// -1, 0, 1: the point below, on, above a node's wall.
    [[nodiscard]] static int side_of_wall(const Node& n, const IndexPoint& p) {
        return n.is_inherited() ? p.compare_fine(n.axis(), n.position())
                                : p.compare(n.axis(), n.wall);
    }

    /// Homogeneous leaves, cells of grids included.
    [[nodiscard]] std::size_t empty_leaves() const;
    [[nodiscard]] std::size_t depth() const { return depth_; }
    [[nodiscard]] std::size_t bytes() const;

private:
    friend class IndexTreeBuilder;

    std::vector<Node> nodes_;
    std::vector<Leaf> leaves_;
    std::vector<IndexGrid> grids_;
    std::vector<std::uint32_t> cells_;
    std::vector<Id> listed_;
    std::array<double, 3> lo_{};
    std::array<double, 3> hi_{};
    bool bounded_ = true;
    bool beyond_ = false;
    std::size_t depth_ = 0;
};

template <class Visit>
void IndexTree::for_leaves_at(const IndexPoint& p, Visit&& visit) const {
    std::vector<std::uint32_t> pending;  // allocates only where a point is on an inherited wall
    std::uint32_t at = 0;
    for (;;) {
        const Node& n = nodes_[at];
        if (n.has_wall()) {
            const int s = side_of_wall(n, p);
            at = n.next + (s > 0 ? 1U : 0U);
            if (s == 0 && n.is_inherited()) pending.push_back(n.next + 1);
            continue;
        }
        if (n.is_grid()) {
            const IndexGrid& g = grid(n);
            at = cell(g, g.cell(p));
            if (at < IndexGrid::outside) continue;
            visit(empty_leaf(at == IndexGrid::inside));
        } else {
            visit(n);
        }
        if (pending.empty()) return;
        at = pending.back();
        pending.pop_back();
    }
}

}  // namespace trisect::detail
