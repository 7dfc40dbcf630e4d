// SPDX-License-Identifier: Apache-2.0
//
// Pieces of a stroke: a line of points with a width.
#pragma once

#include <cstdint>
#include <vector>

#include <trisect/brep/primitives/point_2d.h>

namespace trisect::detail {

struct Stroke {
    enum class Cap : std::uint8_t { Butt, Square, Round };
    Outline points;
    double width = 1;
    Cap cap = Cap::Square;
};

/// Convex outlines whose union is the stroke: one for each edge, corner and end. Corners are
/// mitered; where that would reach beyond the width, cut off at half the width. Equal neighbours
/// are one point. Empty for fewer than two points.
[[nodiscard]] std::vector<Outline> stroke_pieces(const Stroke& stroke);

}  // namespace trisect::detail
