// SPDX-License-Identifier: Apache-2.0
//
// A segment and a box are apart where an axis, or the product of one and the segment, parts them.

#include <trisect/bsp/assembly/parts/vertex_boxes.h>

#include <algorithm>
#include <cmath>

namespace trisect::detail {

void VertexBoxes::build(std::span<Vertex> vertices) {
    vertices_ = vertices;
    boxes_.clear();
    if (!vertices.empty()) add(0, static_cast<std::uint32_t>(vertices.size()));
}

// Halves are of equal size, so the depth is that of a number's bits.
void VertexBoxes::add(std::uint32_t begin, std::uint32_t end) {
    constexpr std::uint32_t few = 8;
    const std::size_t place = boxes_.size();
    std::array<double, 3> lo = vertices_[begin].c;
    std::array<double, 3> hi = lo;
    for (std::uint32_t i = begin; i < end; ++i)
        for (std::size_t k = 0; k < 3; ++k) {
            lo[k] = std::min(lo[k], vertices_[i].c[k]);
            hi[k] = std::max(hi[k], vertices_[i].c[k]);
        }
    VertexBox box;
    std::size_t axis = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        box.middle[k] = lo[k] + (hi[k] - lo[k]) / 2;
        box.half[k] = std::max(hi[k] - box.middle[k], box.middle[k] - lo[k]);
        if (box.half[k] > box.half[axis]) axis = k;
    }
    box.begin = begin;
    box.end = end;
    boxes_.push_back(box);
    if (end - begin <= few) return;
    const std::uint32_t half = begin + (end - begin) / 2;
    std::ranges::nth_element(
        vertices_.subspan(begin, end - begin), vertices_.begin() + half,
        [axis](const Vertex& a, const Vertex& b) { return a.c[axis] < b.c[axis]; });
    add(begin, half);
    boxes_[place].second = static_cast<std::uint32_t>(boxes_.size());
    add(half, end);
}

// Products of lengths are off by less than 2^-50 of the largest ones.
VertexBoxes::Edge::Edge(const std::array<double, 3>& from, const std::array<double, 3>& to,
                        double within) {
    double longest = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        along[k] = to[k] - from[k];
        middle[k] = from[k] + along[k] / 2;
        half[k] = std::fabs(along[k]) * 0.5000001 + within;
        longest = std::max(longest, std::fabs(along[k]));
    }
    reach.fill(2 * longest * within);
}

bool VertexBoxes::Edge::may_meet(const VertexBox& box) const {
    std::array<double, 3> apart;
    for (std::size_t k = 0; k < 3; ++k) {
        apart[k] = box.middle[k] - middle[k];
        if (std::fabs(apart[k]) > (box.half[k] + half[k]) * 1.0000001) return false;
    }
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t i = (k + 1) % 3;
        const std::size_t j = (k + 2) % 3;
        const double left = apart[i] * along[j];
        const double right = apart[j] * along[i];
        const double width = box.half[i] * std::fabs(along[j]) + box.half[j] * std::fabs(along[i]);
        const double rounding = 0x1p-48 * (std::fabs(left) + std::fabs(right) + width);
        if (std::fabs(left - right) > width + reach[k] + rounding) return false;
    }
    return true;
}

}  // namespace trisect::detail
