// SPDX-License-Identifier: Apache-2.0
//
// Drawings of programs: text, and files that import() and extrusions name.
#pragma once

#include <filesystem>

#include <trisect/bsp/csg/csg_arguments.h>
#include <trisect/bsp/csg/drawing/drawing.h>

namespace trisect::detail {

/// \throw CsgError (Unsupported) in a build without what text takes, or without any font
[[nodiscard]] Drawing csg_text(const CsgArguments& arguments);

/// A DXF or SVG file. `scale` is that of the drawing about its origin.
/// \throw CsgError (Unsupported) for other kinds, InputError for a file that cannot be read
[[nodiscard]] Drawing csg_drawing_file(const CsgArguments& arguments,
                                       const std::filesystem::path& file, double scale);

}  // namespace trisect::detail
