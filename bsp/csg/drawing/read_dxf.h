// SPDX-License-Identifier: Apache-2.0
//
// Outlines of DXF files.
#pragma once

#include <string>

#include <trisect/brep/io/formats/input_text.h>
#include <trisect/brep/primitives/point_2d.h>

#include <trisect/bsp/csg/drawing/drawing.h>

namespace trisect::detail {

struct DxfOptions {
    std::string layer;  ///< empty: all of them
    Point2d origin{0, 0};
    double scale = 1;  ///< about the origin
    CircleSides sides;
};

/// The lines of LINE, LWPOLYLINE, CIRCLE, ARC and ELLIPSE, and of blocks that are inserted, put
/// together to outlines (LineChains). As in OpenSCAD, arcs have the sides of their part of a
/// circle, rounded up, bulges are straight, and base points of blocks and extrusion directions do
/// not count. Other entities are left out with a remark. \throw InputError at a malformed group,
/// LimitError beyond drawing_limit lines
[[nodiscard]] Drawing read_dxf(const InputText& source, const DxfOptions& options);

}  // namespace trisect::detail
