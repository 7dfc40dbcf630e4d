// SPDX-License-Identifier: Apache-2.0
//
// The lines of a text file, their words, and where these are.
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

/// Takes the first line off a text: what stands before the line feed, or all that is left. Reads
/// no byte behind the line feed, so that a file costs what its length is, however many lines it
/// has.
[[nodiscard]] std::string_view take_line(std::string_view& text);

/// The line without the comment that a '#' begins.
[[nodiscard]] std::string_view without_comment(std::string_view line);

/// What blanks, tabs, commas and a carriage return separate.
[[nodiscard]] std::vector<LineWord> words_of(std::string_view line);

}  // namespace trisect::app
