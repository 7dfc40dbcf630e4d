// SPDX-License-Identifier: Apache-2.0
//
// Import of a file without records of one size: piece by piece, with its points on disk.
#pragma once

#include <cstdint>
#include <string>

namespace trisect::app {

/// Whether import_in_pieces() reads a file: OBJ, OFF, PLY and STL, of any kind.
[[nodiscard]] bool is_imported_in_pieces(const std::string& name);

/// How many triangles it has, by its size and what such files take for each.
[[nodiscard]] std::uint64_t guessed_triangles(const std::string& name);

/// Writes the corners of its triangles as gather_triangles() does, in little memory. Points are
/// written to a file first, and mapped then, as the file itself is: the system may take both back.
/// Files beside `output`, which begin with its name, are removed at the end.
/// \throw InputError; LimitError where coordinates of a polygon span more than 126 bits
void import_in_pieces(const std::string& name, const std::string& output);

}  // namespace trisect::app
