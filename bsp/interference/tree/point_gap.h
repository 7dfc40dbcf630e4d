// SPDX-License-Identifier: Apache-2.0
//
// Certain gaps between a point and triangles, in doubles.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include <trisect/bsp/interference/boxes/obb_tree.h>
#include <trisect/bsp/interference/boxes/triangle_filter.h>

namespace trisect::detail {

/// Whether no point of a triangle, whose corners are within `error` of these, is within `reach` of
/// the point in each coordinate. By the directions across the triangle and across its sides.
[[nodiscard]] bool is_certainly_beyond(const TriangleCorners& triangle, double error,
                                       const std::array<double, 3>& point, double reach);

/// Calls visit(place) for triangles of a tree, by their places in its order, in whose boxes is a
/// point within `reach` of the given one in each coordinate; until it returns true. Returns whether
/// it was stopped. In the proof of quick_relation.cpp `reach` is the error. \pre no node is pending
template <class Visit>
bool for_triangles_near(const ObbTree& tree, const std::array<double, 3>& point, double reach,
                        const Visit& visit) {
    if (tree.is_empty()) return false;
    std::array<float, 3> x{};
    double size = tree.reach;
    for (std::size_t k = 0; k < 3; ++k) {
        const double c = (point[k] - tree.origin[k]) / tree.unit;
        x[k] = static_cast<float>(c);
        size += std::fabs(c);
    }
    const bool in_range = size < 1e30;
    const Float4 margin = all_lanes(static_cast<float>(0x1p-20 * size + 2.0001 * reach / tree.unit));
    std::vector<std::uint32_t> stack{0};
    while (!stack.empty()) {
        const ObbNode& n = tree.nodes[stack.back()];
        stack.pop_back();
        Mask4 away = n.half[0] < all_lanes(0);
        std::array<Float4, 3> d;
        for (std::size_t k = 0; k < 3; ++k) d[k] = all_lanes(x[k]) - n.center[k];
        for (std::size_t i = 0; i < 3 && in_range; ++i)
            away |= magnitude((n.axis[i][0] * d[0] + n.axis[i][1] * d[1]) + n.axis[i][2] * d[2]) >
                    n.half[i] + margin;
        const unsigned near = ~bits_of(away) & 15U;
        for (std::uint32_t k = 0; k < 4; ++k) {
            if ((near >> k & 1U) == 0) continue;
            if (!n.child[k].is_leaf()) {
                stack.push_back(n.child[k].node());
                continue;
            }
            for (std::uint32_t i = 0; i < n.child[k].count(); ++i)
                if (visit(n.child[k].first() + i)) return true;
        }
    }
    return false;
}

}  // namespace trisect::detail
