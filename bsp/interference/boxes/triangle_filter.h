// SPDX-License-Identifier: Apache-2.0
//
// Filtered relation of two triangles, in doubles.
#pragma once

#include <array>
#include <cstdint>

namespace trisect::detail {

enum class PairVerdict : std::uint8_t {
    Apart,     ///< certainly no common point
    Crossing,  ///< certainly a side of one passes strictly through the inside of the other
    Unknown    ///< doubles cannot decide, or the triangles merely touch
};

using TriangleCorners = std::array<std::array<double, 3>, 3>;

/// `error` bounds the sum of the errors of a coordinate of p and one of q.
[[nodiscard]] PairVerdict compare_triangles(const TriangleCorners& p, const TriangleCorners& q,
                                            double error);

}  // namespace trisect::detail
