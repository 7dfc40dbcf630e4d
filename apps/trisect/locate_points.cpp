// SPDX-License-Identifier: Apache-2.0
#include "locate_points.h"

#include <trisect/brep/io/file_bytes.h>
#include <trisect/kernel/error.h>

#include <algorithm>
#include <cstdint>

#include "values.h"

namespace trisect::app {
namespace {

constexpr std::uint64_t points_file_limit = std::uint64_t{2} << 30;

bool is_separator(char c) { return c == ' ' || c == '\t' || c == ',' || c == '\r'; }

/// The words of one line, with the column where each begins.
struct Word {
    std::string_view text;
    std::size_t column = 0;
};

std::vector<Word> words_of(std::string_view line) {
    std::vector<Word> words;
    std::size_t i = 0;
    while (i < line.size()) {
        if (is_separator(line[i])) {
            ++i;
            continue;
        }
        const std::size_t begin = i;
        while (i < line.size() && !is_separator(line[i])) ++i;
        words.push_back({line.substr(begin, i - begin), begin + 1});
    }
    return words;
}

double coordinate(const Word& word, const FilePlace& line) {
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
        const std::size_t end = std::min(text.find('\n'), text.size());
        const std::string_view line = text.substr(0, std::min(end, text.find('#')));
        text.remove_prefix(std::min(end + 1, text.size()));
        const std::vector<Word> words = words_of(line);
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
