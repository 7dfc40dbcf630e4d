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

/// Where the line of a side, from p to q, meets the plane of a triangle. `error` bounds the error
/// of a coordinate of each point, `g` differences between points of both. Nothing where doubles put
/// it badly.
[[nodiscard]] std::optional<CrossingPlace> side_in_plane(const std::array<double, 3>& p,
                                                         const std::array<double, 3>& q,
                                                         const TriangleCorners& t, double g,
                                                         double error);

/// Where two sides meet, from p to q and from r to s. \pre they do, in one point. The rest as
/// above.
[[nodiscard]] std::optional<CrossingPlace> sides_crossing(const std::array<double, 3>& p,
                                                          const std::array<double, 3>& q,
                                                          const std::array<double, 3>& r,
                                                          const std::array<double, 3>& s, double g,
                                                          double error);

/// About the middle of the common segment. `error` bounds the error of a coordinate of each of p
/// and q. Nothing where doubles put it badly. \pre the triangles certainly cross
[[nodiscard]] std::optional<CrossingPlace> crossing_place(const TriangleCorners& p,
                                                          const TriangleCorners& q, double error);

}  // namespace trisect::detail
