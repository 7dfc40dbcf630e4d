// SPDX-License-Identifier: Apache-2.0
#include "locate_points.h"

#include <trisect/brep/io/file_bytes.h>
#include <trisect/kernel/error.h>

#include <algorithm>
#include <cstdint>

#include "line_words.h"
#include "values.h"

namespace trisect::app {
namespace {

constexpr std::uint64_t points_file_limit = std::uint64_t{2} << 30;

double coordinate(const LineWord& word, const FilePlace& line) {
    try {
        return parse_number(word.text, "point");
    } catch (const UsageError& e) {
        throw InputError(FilePlace{line.file, line.line, word.column, 0}, e.what());
    }
}

}  // namespace

std::vector<std::array<double, 3>> parse_points(std::string_view text, const std::string& name) {
    std::vector<std::array<double, 3>> points;
    FilePlace place{name, 0, 0, 0};
    while (!text.empty()) {
        ++place.line;
        const std::vector<LineWord> words = words_of(without_comment(take_line(text)));
        if (words.empty()) continue;
        std::array<double, 3> point{};
        for (std::size_t k = 0; k < std::min<std::size_t>(3, words.size()); ++k) {
            point[k] = coordinate(words[k], place);
        }
        if (words.size() != 3) {
            place.column = words.back().column;
            throw InputError(place, "a point is three numbers");
        }
        points.push_back(point);
    }
    return points;
}

std::vector<std::array<double, 3>> read_points(const std::string& file) {
    if (file == "-") {
        const std::string name = "standard input";
        return parse_points(read_descriptor(0, name, points_file_limit).view(), name);
    }
    return parse_points(read_file(file, points_file_limit).view(), file);
}

}  // namespace trisect::app
