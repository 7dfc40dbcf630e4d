// SPDX-License-Identifier: Apache-2.0
//
// Files of matrices and poses: twelve numbers.
// They are the 3x4 matrix row by row, separated by blanks, tabs and ends of lines.
#pragma once

#include <array>
#include <string>
#include <string_view>

namespace trisect::app {

/// "-" is the standard input. \throw InputError with the line and column.
[[nodiscard]] std::array<double, 12> read_matrix(const std::string& file);

/// The same from text; `name` stands for the file in messages.
[[nodiscard]] std::array<double, 12> parse_matrix(std::string_view text, const std::string& name);

}  // namespace trisect::app
