// SPDX-License-Identifier: Apache-2.0
//
// VertexBoxes: a tree of boxes over vertices, to find those near an edge.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <trisect/bsp/cells/workbench.h>

namespace trisect::detail {

/// A binary tree that halves vertices along the longest side of their box.
class VertexBoxes {
public:
    struct Vertex {
        std::array<double, 3> c{};  // approximate
        PointId point = -1;
    };

    /// Sorts the vertices, which must outlive it. O(n log n)
    void build(std::span<Vertex> vertices);
    void clear() { boxes_.clear(); }
    [[nodiscard]] bool is_empty() const { return boxes_.empty(); }

    /// Calls `look_at` with spans that have all vertices within `reach` of the edge, along every
    /// axis, and few others.
    template <class LookAt>
    void for_each_near(const std::array<double, 3>& from, const std::array<double, 3>& to,
                       double reach, const LookAt& look_at) const {
        const Edge edge(from, to, reach);
        std::array<std::uint32_t, 64> stack;  // NOLINT(*-member-init): filled from below
        std::size_t depth = 0;
        stack[depth++] = 0;
        while (depth != 0) {
            const std::uint32_t i = stack[--depth];
            const VertexBox& box = boxes_[i];
            if (!edge.may_meet(box)) continue;
            if (box.second == 0) {
                look_at(vertices_.subspan(box.begin, box.end - box.begin));
            } else {
                stack[depth++] = box.second;
                stack[depth++] = i + 1;
            }
        }
    }

private:
    struct VertexBox {
        std::array<double, 3> middle{};
        std::array<double, 3> half{};
        std::uint32_t begin = 0;
        std::uint32_t end = 0;
        std::uint32_t second = 0;  // child, the first one comes next; 0: none
    };
    struct Edge {
        std::array<double, 3> middle{};
        std::array<double, 3> half{};  // with the reach
        std::array<double, 3> along{};
        std::array<double, 3> reach{};  // across, of products

        Edge(const std::array<double, 3>& from, const std::array<double, 3>& to, double within);
        [[nodiscard]] bool may_meet(const VertexBox& box) const;
    };

    void add(std::uint32_t begin, std::uint32_t end);

    std::span<Vertex> vertices_;
    std::vector<VertexBox> boxes_;
};

}  // namespace trisect::detail
