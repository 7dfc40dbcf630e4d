// SPDX-License-Identifier: Apache-2.0
#include "mill_path.h"

#include <trisect/brep/io/file_bytes.h>
#include <trisect/kernel/error.h>

#include <algorithm>
#include <cmath>

#include "line_words.h"
#include "values.h"

namespace trisect::app {
namespace {

constexpr std::uint64_t path_file_limit = std::uint64_t{1} << 30;

/// Whether the columns have length 1 and are perpendicular up to a millionth, and are not mirrored.
bool is_rotation(const std::array<double, 9>& m) {
    constexpr double tolerance = 1e-6;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j <= i; ++j) {
            const double dot = m[i] * m[j] + m[3 + i] * m[3 + j] + m[6 + i] * m[6 + j];
            if (std::abs(dot - (i == j ? 1 : 0)) > tolerance) return false;
        }
    const double det = m[0] * (m[4] * m[8] - m[5] * m[7]) - m[1] * (m[3] * m[8] - m[5] * m[6]) +
                       m[2] * (m[3] * m[7] - m[4] * m[6]);
    return det > 0;
}

class PosePathReader {
public:
    PosePathReader(const std::string& name, const PathOptions& options)
        : options_(options), place_{name, 0, 0, 0} {
        path_.file = name;
    }

    void line(std::string_view text) {
        ++place_.line;
        std::vector<LineWord> words = words_of(without_comment(text));
        if (words.empty()) return;
        ToolMove move;
        move.line = place_.line;
        move.is_rapid = words.front().text == "rapid";
        move.feed = move.is_rapid ? 0 : options_.feed;
        place_.column = words.back().column;
        if (move.is_rapid) words.erase(words.begin());
        if (words.size() != 12)
            throw InputError(place_, "a line is twelve numbers, perhaps after 'rapid'");
        std::array<double, 9> turn{};
        for (std::size_t row = 0; row < 3; ++row) {
            for (std::size_t c = 0; c < 3; ++c) turn[3 * row + c] = number(words[4 * row + c]);
            move.to[row] = number(words[4 * row + 3]);
        }
        place_.column = words.front().column;
        if (!is_rotation(turn)) throw InputError(place_, "the first three columns are no rotation");
        move.orientation = orientation(turn);
        add(move);
    }
    ToolPath finish() {
        place_.column = 0;
        if (path_.moves.size() < 2) throw InputError(place_, "a path needs two poses");
        return std::move(path_);
    }

private:
    double number(const LineWord& word) {
        place_.column = word.column;
        try {
            return parse_number(word.text, "pose");
        } catch (const UsageError& e) {
            throw InputError(place_, e.what());
        }
    }
    std::uint32_t orientation(const std::array<double, 9>& turn) {
        auto& all = path_.orientations;
        // Turns come one after the other: the last one is the likeliest.
        const auto found = std::find(all.rbegin(), all.rend(), turn);
        if (found != all.rend()) return static_cast<std::uint32_t>(all.rend() - found - 1);
        all.push_back(turn);
        return static_cast<std::uint32_t>(all.size() - 1);
    }
    void add(ToolMove move) {
        move.is_placement = path_.moves.empty();
        if (!move.is_placement && move.orientation != path_.moves.back().orientation) {
            if (!move.is_rapid)
                throw UnsupportedError(
                    place_.to_string() +
                    ": the tool turns while it cuts, which sweeps no polyhedron; turns are for "
                    "rapid lines");
            move.is_placement = true;
            if (path_.notes.empty())
                path_.notes.emplace_back("turns of the tool are checked at their ends only");
        }
        path_.moves.push_back(move);
    }

    PathOptions options_;
    FilePlace place_;
    ToolPath path_;
};

}  // namespace

ToolPath parse_pose_path(std::string_view text, const std::string& name,
                         const PathOptions& options) {
    PosePathReader reader(name, options);
    while (!text.empty()) reader.line(take_line(text));
    return reader.finish();
}

ToolPath read_tool_path(const std::string& file, const PathOptions& options) {
    const bool is_input = file == "-";
    const std::string name = is_input ? "standard input" : file;
    const FileBytes bytes =
        is_input ? read_descriptor(0, name, path_file_limit) : read_file(file, path_file_limit);
    return file.ends_with(".poses") ? parse_pose_path(bytes.view(), name, options)
                                    : parse_gcode(bytes.view(), name, options);
}

}  // namespace trisect::app
