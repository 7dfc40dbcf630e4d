// SPDX-License-Identifier: Apache-2.0
//
// Orientation of four exact points, filtered and exact.
#pragma once

#include <array>
#include <optional>

#include <trisect/kernel/number/error_bounds.h>
#include <trisect/kernel/number/filters.h>
#include <trisect/kernel/number/vector3.h>

namespace trisect::detail {

/// The sign of det(a - d, b - d, c - d), 0 when doubles cannot decide. Points are exact.
[[nodiscard]] inline int filtered_orientation(const Vector3& a, const Vector3& b, const Vector3& c,
                                              const Vector3& d) {
    static_assert(Roundoff<double>::times_8 == orientation_rounding);
    return filter_orientation(a, b, c, d).sign();
}

/// The same, exact, for any doubles; nothing where a coordinate along an axis takes 126 bits or
/// more in units of the last bit that any of the four points has there. No plane is made for it,
/// which has ten times the digits.
[[nodiscard]] std::optional<int> exact_orientation_of_fractions(const Vector3& a, const Vector3& b,
                                                                const Vector3& c, const Vector3& d);

/// The determinant itself, under the same condition: off by less than 2^-51 of it, and 0 where it
/// is. \pre it is far from the least and from the largest double
[[nodiscard]] std::optional<double> determinant_of_fractions(const Vector3& a, const Vector3& b,
                                                             const Vector3& c, const Vector3& d);

/// From one point of a plane to another.
using Segment2 = std::array<std::array<double, 2>, 2>;
/// The product of the directions of two segments, first × second, likewise.
[[nodiscard]] std::optional<double> product_of_fractions(const Segment2& first,
                                                         const Segment2& second);

}  // namespace trisect::detail
