// SPDX-License-Identifier: Apache-2.0
//
// Directions of oriented boxes: the principal axes of triangles.
#pragma once

#include <array>
#include <cstddef>

namespace trisect::detail {

using Double3 = std::array<double, 3>;

[[nodiscard]] inline double dot(const Double3& a, const Double3& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
[[nodiscard]] inline Double3 minus(const Double3& a, const Double3& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
[[nodiscard]] inline Double3 cross(const Double3& a, const Double3& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// Moments of area of triangles.
struct AreaMoments {
    double area = 0;
    Double3 first{};                 ///< integral of x
    std::array<double, 6> second{};  ///< integral of xx, yy, zz, xy, xz, yz

    void add(const Double3& a, const Double3& b, const Double3& c);
};

/// An orthonormal frame up to rounding, by descending spread of the area.
struct AreaFrame {
    std::array<Double3, 3> axis{Double3{1, 0, 0}, Double3{0, 1, 0}, Double3{0, 0, 1}};
};

[[nodiscard]] AreaFrame principal_frame(const AreaMoments& moments);
/// Along the longest side and the normal of one triangle.
[[nodiscard]] AreaFrame triangle_frame(const Double3& a, const Double3& b, const Double3& c);

}  // namespace trisect::detail
