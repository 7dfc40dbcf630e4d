// SPDX-License-Identifier: Apache-2.0
//
// Gathered file: the corners of an operand not read in pieces.
#pragma once

#include <string>

namespace trisect::app {

/// Reads a mesh of any format, or a native file, and writes the corners of its triangles for
/// TriangleStream::open_gathered(). Exact. What import_in_pieces() does not read is read as a
/// whole.
/// \throw InputError; LimitError where coordinates span more than 126 bits; UnsupportedError where
/// corners of a native file are no doubles; InvalidSolid where what is read as a whole is not
/// closed
void gather_triangles(const std::string& name, const std::string& output);

}  // namespace trisect::app
