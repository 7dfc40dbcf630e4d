// SPDX-License-Identifier: Apache-2.0
//
// BspTree: a solid as a classic binary space partition.
// Its planes are the planes of the solid's faces, its leaves are labelled, and there is nothing
// else: no polygon, no vertex.
//
// It answers the same questions as the CellTree behind a Solid and shares no code with it above the
// kernel, so that the two can be checked against each other. It is the slower one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include <trisect/kernel/lattice_point.h>
#include <trisect/kernel/plane.h>
#include <trisect/kernel/point.h>

namespace trisect {

/// A regular set: the closure of the union of its In cells.
///
/// The space is the cube |coordinate| <= 2^53, which holds all lattice points; complements are
/// taken with respect to it, and its own faces never count as boundary. A cell is the open convex
/// region of a node: the cube cut by the half-spaces on the way from the root.
///
/// Invariants:
///  1. Node 0 is the root. A child has a larger number than its parent and exactly one parent.
///  2. Every plane cuts its cell: both children's cells have volume. The constructor cannot check;
///     build_bsp, merge, complement and reduced promise it (cell_sections finds violations).
/// The second one makes a point's class exact: a point of all closed half-spaces on the way to a
/// leaf is in the closure of that leaf's cell, which is false for a cell that is empty.
///
/// Regular value type; 240 bytes a node. Safe to read from many threads. Trees may be as deep as
/// they have nodes (a convex solid's is), so nothing here or in the algorithms recurses.
///
/// Source: Thibault and Naylor, Set operations on polyhedra using binary space partitioning trees
/// (SIGGRAPH 1987), sec. 2 and 3.
class BspTree {
public:
    enum class Label : std::uint8_t { Out, In };
    enum class Membership : std::int8_t { Outside = -1, OnBoundary = 0, Inside = 1 };

    /// Names an inner node or a leaf. Leaves with the same label are the same.
    class NodeId {
    public:
        constexpr NodeId() = default;
        constexpr explicit NodeId(Label leaf)
            : value_(leaf == Label::In ? first_leaf + 1 : first_leaf) {}
        constexpr explicit NodeId(std::uint32_t inner) : value_(inner) {}

        [[nodiscard]] constexpr bool is_leaf() const { return value_ >= first_leaf; }
        /// \pre is_leaf()
        [[nodiscard]] constexpr Label label() const {
            return value_ == first_leaf ? Label::Out : Label::In;
        }
        /// \pre !is_leaf()
        [[nodiscard]] constexpr std::uint32_t index() const { return value_; }
        friend constexpr bool operator==(NodeId, NodeId) = default;

    private:
        static constexpr std::uint32_t first_leaf = std::numeric_limits<std::uint32_t>::max() - 1;
        std::uint32_t value_ = first_leaf;  // Out
    };

    struct Node {
        Plane plane;
        NodeId below;
        NodeId above;
    };

    /// The empty set; so is a tree that was moved from.
    BspTree() = default;
    BspTree(const BspTree&) = default;
    BspTree& operator=(const BspTree&) = default;
    BspTree(BspTree&& o) noexcept : BspTree() { swap(o); }
    BspTree& operator=(BspTree&& o) noexcept {
        BspTree taken(std::move(o));
        swap(taken);
        return *this;
    }
    ~BspTree() = default;
    /// The empty set or the whole space.
    explicit BspTree(Label label) : root_(label) {}
    /// The points on or below a plane. \pre the plane cuts the cube.
    [[nodiscard]] static BspTree half_space(const Plane& plane);
    /// From nodes that satisfy the invariants; without nodes the set is empty.
    /// \throw Error (Internal) as validate does.
    explicit BspTree(std::vector<Node> nodes);

    [[nodiscard]] NodeId root() const { return root_; }
    /// The inner nodes.
    [[nodiscard]] std::span<const Node> nodes() const { return nodes_; }
    [[nodiscard]] const Node& node(NodeId id) const { return nodes_[id.index()]; }
    /// A tree that is one leaf: after `reduced`, exactly the empty set and the whole space.
    [[nodiscard]] bool is_constant() const { return root_.is_leaf(); }

    /// Number of nodes, leaves included.
    [[nodiscard]] std::size_t node_count() const { return 2 * nodes_.size() + 1; }
    [[nodiscard]] std::size_t leaf_count() const { return nodes_.size() + 1; }
    /// Largest number of planes between the root and a leaf. O(n).
    [[nodiscard]] std::size_t depth() const;

    /// The closure of the rest of the space. O(n).
    [[nodiscard]] BspTree complement() const;
    /// The same set without nodes whose two children are the same leaf or equal subtrees. O(n)
    /// expected.
    [[nodiscard]] BspTree reduced() const;

    /// Where a point of the cube lies. A point on a node's plane belongs to the closures of cells
    /// on both sides: both are queried, and the answers agree unless the point is on the boundary.
    /// O(depth) predicates for a point on no plane; a point on k planes visits up to 2^k ways, but
    /// no more than there are nodes.
    [[nodiscard]] Membership classify(const LatticePoint& p) const;
    [[nodiscard]] Membership classify(const Point& p) const;

    /// Checks the first invariant and that planes are planes. O(n).
    /// \throw Error (Internal) naming the node.
    void validate() const;

private:
    void swap(BspTree& o) noexcept {
        nodes_.swap(o.nodes_);
        std::swap(root_, o.root_);
    }

    std::vector<Node> nodes_;
    NodeId root_{Label::Out};
};

}  // namespace trisect
