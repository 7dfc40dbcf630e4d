// SPDX-License-Identifier: Apache-2.0
//
// The path data of SVG.
// SVG 1.1, 8.3: commands and numbers; arcs by F.6.
#pragma once

#include <string_view>
#include <vector>

#include <trisect/brep/io/formats/input_text.h>
#include <trisect/brep/primitives/point_2d.h>

namespace trisect::detail {

struct SvgSubpath {
    Outline points;
    bool is_closed = false;  ///< by a command
};

/// Curves have 20 edges, an arc 10 for half a turn and four more, as OpenSCAD has it.
/// \throw InputError at `at` for text that is no path data, LimitError beyond drawing_limit points
[[nodiscard]] std::vector<SvgSubpath> svg_subpaths(const InputText& source, const char* at,
                                                   std::string_view data);

/// Numbers of a list, apart by blanks and commas. \throw InputError
[[nodiscard]] std::vector<double> svg_numbers(const InputText& source, const char* at,
                                              std::string_view list);

}  // namespace trisect::detail
