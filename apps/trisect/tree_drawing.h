// SPDX-License-Identifier: Apache-2.0
//
// A slice through a partition as a drawing: its cells, and the solid in the plane of the slice.
#pragma once

#include <trisect/bsp/brep_index.h>

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "section_drawing.h"
#include "svg.h"

namespace trisect::app {

/// A cell of a slice, in the coordinates of its plane; may be infinite.
struct SliceCell {
    enum class Kind { Outside, Inside, Listing, Arranged };
    Svg::Rectangle box;
    Kind kind = Kind::Outside;
    std::size_t polygons = 0;
};

/// A set in the plane of the slice.
struct SliceOutline {
    std::vector<std::vector<DrawingPoint>> loops;
    std::size_t color = 0;
};

struct Slice {
    std::vector<SliceCell> cells;
    std::vector<std::vector<DrawingPoint>> section;  ///< of the solid
    std::vector<SliceOutline> operands;              ///< where there are several
};

[[nodiscard]] std::string draw_slice(const Slice& slice, const DrawingFrame& frame);

}  // namespace trisect::app
