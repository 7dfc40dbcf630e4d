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
#include <trisect/bsp/interference/tree/leaf_tree.h>

namespace trisect::detail {

/// Whether no point of a triangle, whose corners are within `error` of these, is within `reach` of
/// the point in each coordinate. By the directions across the triangle and across its sides.
[[nodiscard]] bool is_certainly_beyond(const TriangleCorners& triangle, double error,
                                       const std::array<double, 3>& point, double reach);

/// A point with a reach against boxes, as far as floats decide: see quick_relation.cpp, where the
/// reach is an error.
class PointInBoxes {
public:
    /// Boxes in units about an origin, within `extent` of it.
    PointInBoxes(const std::array<double, 3>& point, double reach,
                 const std::array<double, 3>& origin, double unit, double extent) {
        double size = extent;
        for (std::size_t k = 0; k < 3; ++k) {
            const double c = (point[k] - origin[k]) / unit;
            x_[k] = all_lanes(static_cast<float>(c));
            size += std::fabs(c);
        }
        in_range_ = size < 1e30;
        margin_ = all_lanes(static_cast<float>(0x1p-20 * size + 2.0001 * reach / unit));
    }
    /// The lanes in whose boxes may be a point within the reach, in each coordinate.
    [[nodiscard]] unsigned near(const ObbNode& n) const {
        Mask4 away = n.half[0] < all_lanes(0);
        std::array<Float4, 3> d;
        for (std::size_t k = 0; k < 3; ++k) d[k] = x_[k] - n.center[k];
        for (std::size_t i = 0; i < 3 && in_range_; ++i)
            away |= magnitude((n.axis[i][0] * d[0] + n.axis[i][1] * d[1]) + n.axis[i][2] * d[2]) >
                    n.half[i] + margin_;
        return ~bits_of(away) & 15U;
    }

private:
    std::array<Float4, 3> x_{};
    Float4 margin_{};
    bool in_range_ = true;
};

/// Calls visit(triangle) for triangles in whose boxes, or those of a few of them, is a point within
/// `reach` of the given one, in each coordinate; until it returns true.
template <class Visit>
void for_triangles_near(const LeafTree& tree, const std::array<double, 3>& point, double reach,
                        const Visit& visit) {
    if (tree.size() == 0) return;
    const PointInBoxes at(point, reach, tree.origin(), tree.unit(), 4 * tree.radius());
    std::vector<const LeafTree::Node*> stack{&tree.root()};
    while (!stack.empty()) {
        const LeafTree::Node& n = *stack.back();
        stack.pop_back();
        const unsigned near = at.near(n.boxes());
        for (std::uint32_t k = 0; k < 4; ++k) {
            if ((near >> k & 1U) == 0) continue;
            if (!n.has_few(k)) {
                stack.push_back(&tree.below(n, k));
                continue;
            }
            for (const std::uint32_t triangle : tree.triangles(n, k))
                if (visit(triangle)) return;
        }
    }
}

}  // namespace trisect::detail
