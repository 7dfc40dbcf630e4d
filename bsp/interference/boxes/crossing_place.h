// SPDX-License-Identifier: Apache-2.0
//
// CrossingPlace: a point where two triangles pass through each other, in doubles.
#pragma once

#include <array>
#include <optional>

#include <trisect/bsp/interference/boxes/triangle_filter.h>

namespace trisect::detail {

/// A point of the common segment of two triangles, between its ends: one in the insides of both
/// exact triangles is within `error` of it in each coordinate.
struct CrossingPlace {
    std::array<double, 3> at{};
    double error = 0;
};

/// About the middle of the common segment. `error` bounds the error of a coordinate of each of p
/// and q. Nothing where doubles put it badly. \pre the triangles certainly cross
[[nodiscard]] std::optional<CrossingPlace> crossing_place(const TriangleCorners& p,
                                                          const TriangleCorners& q, double error);

}  // namespace trisect::detail
