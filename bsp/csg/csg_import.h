// SPDX-License-Identifier: Apache-2.0
//
// Files that programs read: meshes and height fields.
#pragma once

#include <filesystem>
#include <string>

#include <trisect/brep/polygon_mesh.h>

#include <trisect/bsp/csg/csg_arguments.h>

namespace trisect::detail {

/// In small letters, with its dot.
[[nodiscard]] std::string csg_extension(const std::filesystem::path& file);

/// Whether import() reads a drawing, by the name of its file.
[[nodiscard]] bool is_flat_import(const CsgArguments& arguments);

/// The file of the argument `file`; relative names start in the folder of the program. Empty when
/// no name is given.
[[nodiscard]] std::filesystem::path csg_file(const CsgArguments& arguments,
                                             const std::filesystem::path& folder);

/// A mesh of import(), of any format that is read.
/// \throw CsgError (Unsupported) for other formats; InputError for a file that cannot be read
[[nodiscard]] PolygonMesh csg_import(const CsgArguments& arguments,
                                     const std::filesystem::path& file);

/// The solid of surface() below a height field. A point of the mean height is in the middle of each
/// cell; the bottom is at 0, or 1 below the lowest point where that is below 1. Text has a line a
/// row, numbers apart by blanks, "#" before remarks. PNG pictures have heights from 0 to 100 by
/// brightness, the top row at the largest y; inverted ones from 100/255 down, as OpenSCAD has it.
/// \throw CsgError (Input) for text that is no number, InputError for malformed pictures,
/// UnsupportedError for pictures in a build without libpng
[[nodiscard]] PolygonMesh csg_surface(const CsgArguments& arguments,
                                      const std::filesystem::path& file);

}  // namespace trisect::detail
