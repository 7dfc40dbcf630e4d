// SPDX-License-Identifier: Apache-2.0
//
// TriangleTree: a hierarchy of axis-aligned boxes for the searches of validation.
//
// Boxes of long slanted triangles overlap where the triangles are far apart. A search for pairs
// that comes to a node again and again gives it a box that is turned with its triangles
// (oriented_box.h); most meshes never need one.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <trisect/brep/validate/oriented_box.h>
#include <trisect/brep/validate/sheets.h>
#include <trisect/kernel/lattice_point.h>
#include <trisect/kernel/stop_scope.h>

namespace trisect::detail {

/// Closed boxes with lattice corners: exact.
struct LatticeBox {
    LatticePoint low{coordinate_limit, coordinate_limit, coordinate_limit};
    LatticePoint high{-coordinate_limit, -coordinate_limit, -coordinate_limit};

    void add(const LatticePoint& p) { add({p, p}); }
    void add(const LatticeBox& b) {
        low = {std::min(low.x, b.low.x), std::min(low.y, b.low.y), std::min(low.z, b.low.z)};
        high = {std::max(high.x, b.high.x), std::max(high.y, b.high.y), std::max(high.z, b.high.z)};
    }
    /// By so much on each side, rounded.
    void grow(double by) {
        const auto moved = [](const LatticePoint& p, double d) {
            return LatticePoint{Coordinate(p.x.to_double() + d), Coordinate(p.y.to_double() + d),
                                Coordinate(p.z.to_double() + d)};
        };
        low = moved(low, -by);
        high = moved(high, by);
    }
    /// Touching counts.
    [[nodiscard]] bool overlaps(const LatticeBox& b) const {
        return low.x <= b.high.x && b.low.x <= high.x && low.y <= b.high.y && b.low.y <= high.y &&
               low.z <= b.high.z && b.low.z <= high.z;
    }
};

/// Balanced: median splits of the sheets and loose triangles, then within sheets, and boxes that
/// are long for their node apart from the others; depth at most 132. A sheet is divided where a
/// search comes to: most of it lies where nothing else is. Refers to the mesh; for one thread.
class TriangleTree {
public:
    /// `sheets` gives each triangle a sheet, or no_sheet; empty if there are none. A coordinate may
    /// be off by `error`, which boxes make up for. O(n log n).
    TriangleTree(std::span<const LatticePoint> points,
                 std::span<const std::array<std::uint32_t, 3>> triangles,
                 std::span<const std::uint32_t> sheets = {}, double error = 0);

    /// Calls visit(a, b), a < b, once for every pair of triangles that are not of one sheet and
    /// whose boxes overlap, except for pairs that turned boxes prove to be apart; the order is
    /// deterministic. Stops when it returns false.
    template <class Visit>
    void for_each_pair(Visit&& visit) {
        if (nodes_.empty()) return;
        TurnedBoxes turned(*this);
        std::vector<std::array<std::uint32_t, 2>> stack{{0, 0}};
        while (!stack.empty()) {
            const auto [i, k] = stack.back();
            stack.pop_back();
            check_stop();
            if (i == k) {
                if (nodes_[i].is_sheet) continue;
                if (nodes_[i].is_leaf()) {
                    if (!visit_leaf(i, visit)) return;
                    continue;
                }
                const auto [left, right] = children(i);
                stack.push_back({right, right});
                stack.push_back({left, right});
                stack.push_back({left, left});
            } else if (nodes_[i].box.overlaps(nodes_[k].box) && !turned.are_apart(i, k)) {
                const Node& a = nodes_[i];
                const Node& b = nodes_[k];
                if (a.is_leaf() && b.is_leaf()) {
                    if (!visit_leaves({i, k}, turned, visit)) return;
                } else if (b.is_leaf() || (!a.is_leaf() && a.count() >= b.count())) {
                    const auto [left, right] = children(i);
                    stack.push_back({right, k});
                    stack.push_back({left, k});
                } else {
                    const auto [left, right] = children(k);
                    stack.push_back({i, right});
                    stack.push_back({i, left});
                }
            }
        }
    }

    /// Calls visit(triangle) for every triangle whose box overlaps `box`.
    template <class Visit>
    void for_each_in(const LatticeBox& box, Visit&& visit) {
        if (nodes_.empty()) return;
        std::vector<std::uint32_t> stack{0};
        while (!stack.empty()) {
            const std::uint32_t i = stack.back();
            stack.pop_back();
            const Node n = nodes_[i];
            if (!n.box.overlaps(box)) continue;
            if (n.is_leaf()) {
                for (std::uint32_t t = n.begin; t < n.end; ++t)
                    if (boxes_[order_[t]].overlaps(box)) visit(order_[t]);
            } else {
                const auto [left, right] = children(i);
                stack.push_back(right);
                stack.push_back(left);
            }
        }
    }

    [[nodiscard]] const LatticeBox& box(std::uint32_t triangle) const { return boxes_[triangle]; }

private:
    struct Node {
        LatticeBox box;
        std::uint32_t begin = 0, end = 0;   // into order_
        std::uint32_t left = 0, right = 0;  // 0: a leaf, or not divided yet
        bool is_sheet = false;              // a whole one
        bool is_parted = false;             // long boxes have come apart from others here
        [[nodiscard]] bool is_leaf() const { return count() <= leaf_size && left == 0; }
        [[nodiscard]] std::uint32_t count() const { return end - begin; }
    };
    static constexpr std::uint32_t leaf_size = 4;

    // What the upper part of the tree divides: a sheet or a triangle, a range of triangles.
    struct Item {
        LatticeBox box;
        std::uint32_t begin, end;
        [[nodiscard]] std::uint32_t count() const { return end - begin; }
    };
    struct Grouped {
        std::vector<Item> items;
        std::vector<std::uint32_t> triangles;  // of all items
    };
    // Boxes for nodes that were come to often, made on the way.
    class TurnedBoxes {
    public:
        explicit TurnedBoxes(const TriangleTree& tree);
        [[nodiscard]] bool are_apart(std::uint32_t a, std::uint32_t b);
        /// Bit i: the box of triangle i of a leaf may meet that of the other leaf. All where
        /// neither leaf has been come to often.
        [[nodiscard]] unsigned meeting(std::uint32_t leaf, std::uint32_t other);

    private:
        [[nodiscard]] std::uint32_t triangles_of(std::uint32_t leaf);
        [[nodiscard]] bool is_hot(std::uint32_t node);
        [[nodiscard]] TurnedBox box_of(std::uint32_t node) const;

        static constexpr std::uint32_t hot_visits = 32;
        const TriangleTree& tree_;
        BoxFrame frame_;
        std::vector<std::uint32_t> visits_;  // by node; hot_visits + 1 + its number in boxes_
        std::vector<TurnedBox> boxes_;
        std::vector<std::uint32_t> first_of_leaf_;  // by node: the first of its triangles' boxes
        std::vector<TurnedBox> triangle_boxes_;
    };

    [[nodiscard]] Grouped group(std::span<const std::uint32_t> sheets) const;
    std::uint32_t divide(std::span<Item> items, std::span<const std::uint32_t> triangles,
                         bool parted);
    // A node for a part of a sheet, without children.
    std::uint32_t add_part(std::uint32_t begin, std::uint32_t end);
    /// Divides the node if it is not. \pre it is no leaf. Moves the nodes.
    std::array<std::uint32_t, 2> children(std::uint32_t node);

    template <class Visit>
    bool visit_pair(std::uint32_t s, std::uint32_t t, Visit& visit) const {
        if (!boxes_[s].overlaps(boxes_[t])) return true;
        return s < t ? visit(s, t) : visit(t, s);
    }
    template <class Visit>
    bool visit_leaf(std::uint32_t leaf, Visit& visit) const {
        const Node& a = nodes_[leaf];
        for (std::uint32_t i = a.begin; i < a.end; ++i)
            for (std::uint32_t k = i + 1; k < a.end; ++k)
                if (!visit_pair(order_[i], order_[k], visit)) return false;
        return true;
    }
    template <class Visit>
    bool visit_leaves(const std::array<std::uint32_t, 2>& leaves, TurnedBoxes& turned,
                      Visit& visit) const {
        const Node& a = nodes_[leaves[0]];
        const Node& b = nodes_[leaves[1]];
        const unsigned of_a = turned.meeting(leaves[0], leaves[1]);
        const unsigned of_b = of_a == 0 ? 0 : turned.meeting(leaves[1], leaves[0]);
        for (std::uint32_t i = 0; i < a.count(); ++i) {
            if ((of_a >> i & 1U) == 0) continue;
            for (std::uint32_t k = 0; k < b.count(); ++k)
                if ((of_b >> k & 1U) != 0 &&
                    !visit_pair(order_[a.begin + i], order_[b.begin + k], visit))
                    return false;
        }
        return true;
    }

    std::span<const LatticePoint> points_;
    std::span<const std::array<std::uint32_t, 3>> triangles_;
    std::vector<LatticeBox> boxes_;
    std::vector<std::uint32_t> order_;
    std::vector<Node> nodes_;
    double error_;
};

}  // namespace trisect::detail
