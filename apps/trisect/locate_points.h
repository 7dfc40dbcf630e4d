// SPDX-License-Identifier: Apache-2.0
//
// Files of points: three numbers a line.
// Numbers are separated by blanks, tabs or commas. Empty lines and text after '#' mean nothing.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace trisect::app {

/// "-" is the standard input. \throw InputError with the line and column.
[[nodiscard]] std::vector<std::array<double, 3>> read_points(const std::string& file);

/// The same from text; `name` stands for the file in messages.
[[nodiscard]] std::vector<std::array<double, 3>> parse_points(std::string_view text,
                                                              const std::string& name);

}  // namespace trisect::app
