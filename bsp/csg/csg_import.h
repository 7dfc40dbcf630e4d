// SPDX-License-Identifier: Apache-2.0
//
// Files that programs read: meshes and height fields.
#pragma once

#include <filesystem>

#include <trisect/brep/polygon_mesh.h>

#include <trisect/bsp/csg/csg_arguments.h>

namespace trisect::detail {

/// Whether import() reads a drawing, by the name of its file.
[[nodiscard]] bool is_flat_import(const CsgArguments& arguments);

/// The file of the argument `file`; relative names start in the folder of the program. Empty when
/// no name is given.
[[nodiscard]] std::filesystem::path csg_file(const CsgArguments& arguments,
                                             const std::filesystem::path& folder);

/// A mesh of import(): STL, OFF, OBJ or PLY.
/// \throw CsgError (Unsupported) for other formats; InputError for a file that cannot be read
[[nodiscard]] PolygonMesh csg_import(const CsgArguments& arguments,
                                     const std::filesystem::path& file);

/// The solid of surface() below a height field of text: a line a row, numbers apart by blanks, "#"
/// before remarks. A point of the mean height is in the middle of each cell; the bottom is 1 below
/// the lowest point.
/// \throw CsgError (Input) for text that is no number, (Unsupported) for pictures
[[nodiscard]] PolygonMesh csg_surface(const CsgArguments& arguments,
                                      const std::filesystem::path& file);

}  // namespace trisect::detail
