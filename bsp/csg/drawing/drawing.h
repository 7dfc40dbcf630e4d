// SPDX-License-Identifier: Apache-2.0
//
// Drawing: outlines and strokes of the plane, as files and texts give them.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <trisect/brep/primitives/point_2d.h>

namespace trisect::detail {

/// Where an odd number of outlines and strokes go around. A stroke is the union of its pieces.
struct DrawingShape {
    std::vector<Outline> outlines;
    std::vector<std::vector<Outline>> strokes;
};

/// The union of its shapes.
struct Drawing {
    std::vector<DrawingShape> shapes;
    std::vector<std::string> remarks;  ///< what was left out
};

/// How many sides a circle of a radius has.
using CircleSides = std::function<std::uint32_t(double radius)>;

/// Most corners of one drawing.
inline constexpr std::size_t drawing_limit = std::size_t{1} << 22;

}  // namespace trisect::detail
