// SPDX-License-Identifier: Apache-2.0
//
// VertexBoxes: a tree of boxes over vertices, to find those near an edge.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include <trisect/bsp/cells/workbench.h>
#include <trisect/kernel/support/pool_allocator.h>

namespace trisect::detail {

/// A tree that parts vertices by eight, along the longest sides of their boxes. Boxes of a node's
/// children are compared together, in single precision, so that they fill vector registers.
class VertexBoxes {
public:
    struct Vertex {
        std::array<double, 3> c{};  // approximate
        PointId point = -1;
    };

    /// Sorts the vertices, which must outlive it. O(n log n). `threads` as in ParallelParts.
    void build(std::span<Vertex> vertices, std::uint32_t threads = 1);
    void clear() { nodes_.clear(); }
    [[nodiscard]] bool is_empty() const { return nodes_.empty(); }

    /// Calls `look_at` with spans that have all vertices within `reach` of the edge, along every
    /// axis, and few others.
    template <class LookAt>
    void for_each_near(const std::array<double, 3>& from, const std::array<double, 3>& to,
                       double reach, const LookAt& look_at) const {
        const Edge edge = single_precision(from, to, reach);
        std::array<std::uint32_t, 512> stack;  // NOLINT(*-member-init): filled from below
        std::size_t depth = 0;
        stack[depth++] = 0;
        while (depth != 0) {
            const Node& node = nodes_[stack[--depth]];
            std::array<std::uint8_t, width> is_near;
            edge.compare(node, is_near);
            for (std::uint32_t i = 0; i < node.count; ++i) {
                if (is_near[i] == 0) continue;
                if (node.child[i] != 0) {
                    stack[depth++] = node.child[i];
                } else {
                    look_at(vertices_.subspan(node.begin[i], node.begin[i + 1] - node.begin[i]));
                }
            }
        }
    }

private:
    static constexpr std::size_t width = 8;
    // One number of each child, times scale_: products of single precision would be too small for
    // solids that are far smaller than a unit.
    using Row = std::array<float, width>;
    struct Node {
        std::array<Row, 3> middle{};  // from origin_
        std::array<Row, 3> half{};
        std::array<std::uint32_t, width + 1> begin{};  // of its vertices, in a row
        std::array<std::uint32_t, width> child{};      // 0: none
        std::uint32_t count = 0;
    };
    struct Edge {
        std::array<float, 3> middle{};
        std::array<float, 3> half{};  // with the reach
        std::array<float, 3> along{};
        float reach = 0;  // across, of products
        void compare(const Node& node, std::array<std::uint8_t, width>& is_near) const;
    };

    [[nodiscard]] Edge single_precision(const std::array<double, 3>& from,
                                        const std::array<double, 3>& to, double within) const;
    using Nodes = PoolVector<Node>;
    std::uint32_t add(std::uint32_t begin, std::uint32_t end, Nodes& nodes);
    void add_all(std::uint32_t count, std::uint32_t threads);
    void part_on_threads(std::span<std::uint32_t> bounds);
    void part(Node& node, std::uint32_t begin, std::uint32_t end, int levels);
    void set_box(Node& node, std::uint32_t child, std::uint32_t begin, std::uint32_t end) const;
    [[nodiscard]] std::uint32_t parted_at(std::uint32_t begin, std::uint32_t end);

    std::span<Vertex> vertices_;
    Nodes nodes_;
    std::array<double, 3> origin_{};
    double rounding_ = 0;  // of a coordinate, to single precision
    double scale_ = 1;     // a power of two, so that all vertices are within one or two
};

}  // namespace trisect::detail
