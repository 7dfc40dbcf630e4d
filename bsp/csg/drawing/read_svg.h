// SPDX-License-Identifier: Apache-2.0
//
// Outlines of SVG files.
#pragma once

#include <trisect/brep/io/formats/input_text.h>

#include <trisect/bsp/csg/drawing/drawing.h>

namespace trisect::detail {

struct SvgOptions {
    double dots_per_inch = 72;  ///< of lengths in pixels
    bool is_centered = false;   ///< the box of the drawing about the origin
};

/// Shapes and paths, in millimetres with y upwards (svg_page.h). As in OpenSCAD, closed paths are
/// areas, where an odd number of outlines goes around, whatever `fill` says; lines and open paths
/// are strokes of `stroke-width`, 1 by default; circles have 40 sides and curves 20; what is hidden
/// counts; elements that are not known are groups. Text, images and `use` are left out with a
/// remark, contents of `defs` without.
/// \throw InputError for text that is not XML or not SVG, LimitError beyond drawing_limit corners
[[nodiscard]] Drawing read_svg(const InputText& source, const SvgOptions& options);

}  // namespace trisect::detail
