// SPDX-License-Identifier: Apache-2.0
#include "line_words.h"

#include <algorithm>

namespace trisect::app {

std::string_view take_line(std::string_view& text) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    return line;
}

std::string_view without_comment(std::string_view line) { return line.substr(0, line.find('#')); }

std::vector<LineWord> words_of(std::string_view line) {
    constexpr std::string_view separators = " \t,\r";
    std::vector<LineWord> words;
    std::size_t begin = line.find_first_not_of(separators);
    while (begin != std::string_view::npos) {
        const std::size_t end = std::min(line.find_first_of(separators, begin), line.size());
        words.push_back({line.substr(begin, end - begin), begin + 1});
        begin = line.find_first_not_of(separators, end);
    }
    return words;
}

}  // namespace trisect::app
