// SPDX-License-Identifier: Apache-2.0
//
// Directions of oriented boxes: the principal axes of triangles.
#pragma once

#include <array>
#include <cstddef>

#include <trisect/kernel/number/vector3.h>

namespace trisect::detail {

/// Moments of area of triangles.
struct AreaMoments {
    double area = 0;
    Vector3 first{};                 ///< integral of x
    std::array<double, 6> second{};  ///< integral of xx, yy, zz, xy, xz, yz

    void add(const Vector3& a, const Vector3& b, const Vector3& c);
};

/// An orthonormal frame up to rounding, by descending spread of the area.
struct AreaFrame {
    std::array<Vector3, 3> axis{Vector3{1, 0, 0}, Vector3{0, 1, 0}, Vector3{0, 0, 1}};
};

[[nodiscard]] AreaFrame principal_frame(const AreaMoments& moments);
/// Along the longest side and the normal of one triangle.
[[nodiscard]] AreaFrame triangle_frame(const Vector3& a, const Vector3& b, const Vector3& c);

}  // namespace trisect::detail
