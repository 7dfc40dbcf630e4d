// SPDX-License-Identifier: Apache-2.0
//
// ObbTree: a wide tree of oriented boxes around triangles.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <trisect/kernel/support/float4.h>

namespace trisect::detail {

/// An oriented box, in the units of its tree. It stands for two sets, and the triangles below it
/// are in both: the slabs |axis_i · (x - centre)| <= half_i, and all centre + Σ s_i axis_i with
/// |s_i| <= half_i. (They would be the same if floats could be orthonormal.)
struct OrientedBox {
    std::array<std::array<float, 3>, 3> axis{};
    std::array<float, 3> center{};
    std::array<float, 3> half{};
};

/// What is below a box: an inner node, perhaps one that is still to be made (ObbSource), or up to
/// `max_leaf` triangles.
class ObbChild {
public:
    static constexpr std::uint32_t max_leaf = 7;

    ObbChild() = default;
    [[nodiscard]] static ObbChild node(std::uint32_t n) { return ObbChild(n); }
    [[nodiscard]] static ObbChild leaf(std::uint32_t first, std::uint32_t count) {
        return ObbChild(leaf_bit | first << 3 | count);
    }
    /// A node that is still to be made. `what` is a number of its source, below 2^30.
    [[nodiscard]] static ObbChild pending(std::uint32_t what) {
        return ObbChild(pending_bit | what);
    }
    [[nodiscard]] bool is_pending() const {
        return (code_ & (leaf_bit | pending_bit)) == pending_bit;
    }
    [[nodiscard]] std::uint32_t pending() const { return code_ & ~pending_bit; }
    [[nodiscard]] bool is_leaf() const { return (code_ & leaf_bit) != 0; }
    [[nodiscard]] std::uint32_t node() const { return code_; }
    /// A range of ObbTree::order.
    [[nodiscard]] std::uint32_t first() const { return (code_ & ~leaf_bit) >> 3; }
    [[nodiscard]] std::uint32_t count() const { return code_ & 7U; }

private:
    static constexpr std::uint32_t leaf_bit = std::uint32_t{1} << 31;
    static constexpr std::uint32_t pending_bit = std::uint32_t{1} << 30;
    explicit ObbChild(std::uint32_t code) : code_(code) {}
    std::uint32_t code_ = leaf_bit;
};

/// Four boxes side by side: lane k of every array is box k. A lane that is not used has a negative
/// half and overlaps nothing. 272 bytes.
struct ObbNode {
    std::array<std::array<Float4, 3>, 3> axis{};
    std::array<Float4, 3> center{};
    std::array<Float4, 3> half{};
    std::array<ObbChild, 4> child{};

    [[nodiscard]] OrientedBox box(std::uint32_t lane) const {
        OrientedBox b;
        for (std::size_t i = 0; i < 3; ++i) {
            for (std::size_t j = 0; j < 3; ++j) b.axis[i][j] = axis[i][j][lane];
            b.center[i] = center[i][lane];
            b.half[i] = half[i][lane];
        }
        return b;
    }
};

/// Names a box: node and lane.
struct ObbId {
    std::uint32_t index = 0;
    [[nodiscard]] static ObbId of(std::uint32_t node, std::uint32_t lane) {
        return {4 * node + lane};
    }
    [[nodiscard]] std::uint32_t node() const { return index / 4; }
    [[nodiscard]] std::uint32_t lane() const { return index % 4; }
};

/// How a tree is built.
struct ObbTreeOptions {
    std::uint32_t leaf_triangles = 1;  ///< at most ObbChild::max_leaf
};

class ObbSource;

/// Immutable once built, unless it has a source. The box with id 0 is around everything; node 0 has
/// no other.
///
/// Boxes are in units of `unit` about `origin`, so that the contents are within [-1, 1]^3.
struct ObbTree {
    ObbTree() = default;
    /// `triangles` index `positions`, which are within `error` of the exact points.
    ObbTree(std::span<const std::array<double, 3>> positions, double error,
            std::span<const std::array<std::uint32_t, 3>> triangles, ObbTreeOptions options = {});

    [[nodiscard]] bool is_empty() const { return nodes.empty(); }
    /// A pending node is made now, which ends references to nodes.
    [[nodiscard]] ObbChild child(ObbId id) const {
        const ObbChild c = nodes[id.node()].child[id.lane()];
        return c.is_pending() ? ObbChild::node(open(id)) : c;
    }
    /// Whether triangles are below, without making anything.
    [[nodiscard]] bool is_leaf(ObbId id) const {
        return nodes[id.node()].child[id.lane()].is_leaf();
    }
    [[nodiscard]] OrientedBox box(ObbId id) const { return nodes[id.node()].box(id.lane()); }
    [[nodiscard]] std::size_t bytes() const {
        return nodes.size() * sizeof(ObbNode) + order.size() * 4 * sizeof(std::uint32_t);
    }

    std::vector<ObbNode> nodes;
    std::vector<std::uint32_t> parent;  ///< the box (index of its id) above each node; of node 0: 0
    std::vector<std::uint32_t> order;   ///< triangles as leaves name them
    std::vector<std::array<std::uint32_t, 3>> corners;  ///< of these triangles
    std::array<double, 3> origin{};
    double unit = 1;    ///< a power of two
    double reach = 0;   ///< every box is within this distance of the origin, in units
    double radius = 0;  ///< and all that is in boxes within this one
    std::size_t depth = 0;
    ObbSource* source = nullptr;  ///< of a tree that is made as walks come to its boxes

private:
    [[nodiscard]] std::uint32_t open(ObbId id) const;
};

/// Makes the nodes below boxes of a tree, one by one.
class ObbSource {
public:
    virtual ~ObbSource() = default;
    /// The number of the node that is below a box from now on, where one was pending. Nodes,
    /// triangles and their positions may be appended to the tree.
    virtual std::uint32_t open(ObbId id) = 0;
};

/// Which boxes of a tree are other ones than before.
class ChangedBoxes {
public:
    /// Of a tree with so many nodes.
    explicit ChangedBoxes(std::size_t nodes) : gone_(nodes, false), other_(4 * nodes, false) {}
    void set_gone(std::uint32_t node) { gone_[node] = true; }
    void set_other(ObbId id) { other_[id.index] = true; }
    /// Whether the box is no more.
    [[nodiscard]] bool is_gone(ObbId id) const { return gone_[id.node()]; }
    /// Whether it is around something else.
    [[nodiscard]] bool is_other(ObbId id) const { return other_[id.index]; }

private:
    std::vector<bool> gone_;
    std::vector<bool> other_;
};

/// A boundary as walks see it.
struct BoxedTriangles {
    const ObbTree* tree = nullptr;
    const std::vector<std::array<double, 3>>* positions = nullptr;
    double position_error = 0;
    double largest = 0;  ///< bound on the magnitude of a coordinate of a position
};

}  // namespace trisect::detail
