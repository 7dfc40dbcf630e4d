// SPDX-License-Identifier: Apache-2.0

#include <trisect/brep/validate/triangle_tree.h>

#include <algorithm>
#include <numeric>

#include <trisect/kernel/stop_scope.h>

namespace trisect::detail {

TriangleTree::TriangleTree(std::span<const LatticePoint> points,
                           std::span<const std::array<std::uint32_t, 3>> triangles)
    : boxes_(triangles.size()), order_(triangles.size()) {
    for (std::size_t t = 0; t < triangles.size(); ++t)
        for (const std::uint32_t c : triangles[t]) boxes_[t].add(points[c]);
    std::iota(order_.begin(), order_.end(), 0U);
    if (triangles.empty()) return;
    nodes_.reserve(triangles.size());
    build(0, static_cast<std::uint32_t>(triangles.size()));
}

// Recursive, but halving: 32 levels at most.
std::uint32_t TriangleTree::build(std::uint32_t begin, std::uint32_t end) {
    check_stop();
    const auto self = static_cast<std::uint32_t>(nodes_.size());
    Node node;
    node.begin = begin;
    node.end = end;
    const auto centre = [this](std::uint32_t t, std::size_t axis) {
        return boxes_[t].low[axis] + boxes_[t].high[axis];
    };
    std::array<std::int64_t, 3> low{}, high{};
    for (std::uint32_t i = begin; i < end; ++i) {
        node.box.add(boxes_[order_[i]]);
        for (std::size_t k = 0; k < 3; ++k) {
            const std::int64_t c = centre(order_[i], k);
            low[k] = i == begin ? c : std::min(low[k], c);
            high[k] = i == begin ? c : std::max(high[k], c);
        }
    }
    nodes_.push_back(node);
    if (end - begin <= leaf_size) return self;
    std::size_t axis = 0;
    for (std::size_t k = 1; k < 3; ++k)
        if (high[k] - low[k] > high[axis] - low[axis]) axis = k;
    const std::uint32_t middle = begin + (end - begin) / 2;
    std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                     [&](std::uint32_t a, std::uint32_t b) {
                         const std::int64_t ca = centre(a, axis);
                         const std::int64_t cb = centre(b, axis);
                         return ca != cb ? ca < cb : a < b;
                     });
    build(begin, middle);
    const std::uint32_t right = build(middle, end);
    nodes_[self].right = right;
    return self;
}

}  // namespace trisect::detail
