// SPDX-License-Identifier: Apache-2.0
//
// Regions of the plane as prisms.
#pragma once

#include <vector>

#include <trisect/brep/primitives/point_2d.h>
#include <trisect/bsp/expression.h>

#include <trisect/bsp/csg/csg_frame.h>
#include <trisect/bsp/csg/drawing/drawing.h>

namespace trisect::detail {

/// A drawing between the heights of the frame; exact over the corners that the frame's map makes,
/// of which each is rounded once. The empty set where nothing has an area.
[[nodiscard]] Expression drawing_prism(Drawing drawing, const CsgFrame& frame);

}  // namespace trisect::detail
