// SPDX-License-Identifier: Apache-2.0
//
// The words of a line of a text file, and where they are.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

namespace trisect::app {

/// A view of the line; columns begin with 1.
struct LineWord {
    std::string_view text;
    std::size_t column = 0;
};

/// What blanks, tabs, commas and a carriage return separate.
[[nodiscard]] std::vector<LineWord> words_of(std::string_view line);

}  // namespace trisect::app
