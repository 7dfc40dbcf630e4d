// SPDX-License-Identifier: Apache-2.0
//
// Closest points of two triangles in doubles, with certified distance bounds.
#pragma once

#include <array>
#include <cstdint>

#include <trisect/bsp/interference/boxes/triangle_filter.h>

namespace trisect::detail {

struct ClosestPoints {
    double squared = 0;  ///< about
    /// Weights of the corners of both triangles, not negative, with sum 1 up to rounding.
    std::array<double, 3> on_p{};
    std::array<double, 3> on_q{};
};

/// Whether the triangles are certainly farther than `limit` from each other, by four directions:
/// `first`, that along which a pair before was apart, both normals and the line of centres. At most
/// a third of the cost of closest points. `error` as below.
[[nodiscard]] bool are_certainly_farther(const TriangleCorners& p, const TriangleCorners& q,
                                         double limit, double error,
                                         const std::array<double, 3>& first);

/// From the point on p to that on q.
[[nodiscard]] std::array<double, 3> way_between(const TriangleCorners& p, const TriangleCorners& q,
                                                const ClosestPoints& closest);

/// Up to rounding, for triangles that do not meet.
[[nodiscard]] ClosestPoints closest_points(const TriangleCorners& p, const TriangleCorners& q);

/// lower <= distance <= upper, whatever `closest` is; it is narrow when that is good.
struct DistanceBounds {
    double lower = 0;
    double upper = 0;
};

/// `error` bounds the error of each coordinate of p and q.
[[nodiscard]] DistanceBounds certify(const TriangleCorners& p, const TriangleCorners& q,
                                     const ClosestPoints& closest, double error);

}  // namespace trisect::detail
