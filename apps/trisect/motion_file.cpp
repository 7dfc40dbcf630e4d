// SPDX-License-Identifier: Apache-2.0
#include "motion_file.h"

#include <trisect/brep/io/file_bytes.h>
#include <trisect/kernel/error.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "line_words.h"
#include "motion_document.h"
#include "values.h"

namespace trisect::app {
namespace {

constexpr std::uint64_t motion_file_limit = std::uint64_t{64} << 20;
constexpr std::size_t pose_words = 12;
constexpr std::size_t screw_words = 11;  // with the word itself

/// The motion as far as it has been read.
class MotionReader {
public:
    explicit MotionReader(std::string file) : place_{std::move(file), 0, 0, 0} {}

    void line(std::string_view text) {
        ++place_.line;
        place_.column = 1;
        const std::vector<LineWord> words = words_of(without_comment(text));
        if (words.empty()) return;
        if (words.front().text == "screw")
            screw(words);
        else
            pose(words);
    }

    Motion finish() {
        if (!pieces_.empty()) return Motion::joined(pieces_);  // each begins where one ends
        if (pose_) return Motion(*pose_);
        place_.column = 0;
        throw InputError(place_, "a motion needs a pose or a screw");
    }

private:
    /// Errors of the library get the place in the file.
    template <class Work>
    auto checked(Work&& work) {
        try {
            return work();
        } catch (const InputError&) {
            throw;
        } catch (const Error& e) {
            throw InputError(place_, e.what());
        }
    }
    double number(const LineWord& word) {
        place_.column = word.column;
        return checked([&] { return parse_number(word.text, "motion"); });
    }
    std::int64_t integer(const LineWord& word) {
        place_.column = word.column;
        return checked([&] { return parse_integer(word.text, "motion"); });
    }
    void expect(bool condition, const char* message) {
        if (!condition) throw InputError(place_, message);
    }

    void pose(const std::vector<LineWord>& words) {
        expect(words.size() == pose_words, "a line is twelve numbers, or 'screw' and ten numbers");
        std::array<double, pose_words> rows{};
        for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = number(words[i]);
        place_.column = 1;
        const Pose next = checked([&] { return Pose::from_doubles(rows); });
        if (pose_) pieces_.push_back(checked([&] { return Motion::blend(*pose_, next); }));
        pose_ = next;
    }

    void screw(const std::vector<LineWord>& words) {
        expect(words.size() == screw_words, "a screw is ten numbers");
        Screw screw;
        for (std::size_t i = 0; i < 4; ++i) screw.turn[i] = integer(words[1 + i]);
        for (std::size_t i = 0; i < 3; ++i) screw.center[i] = number(words[5 + i]);
        for (std::size_t i = 0; i < 3; ++i) screw.shift[i] = number(words[8 + i]);
        place_.column = 1;
        pieces_.push_back(checked([&] { return Motion::screw(pose_.value_or(Pose()), screw); }));
        pose_ = checked([&] { return pieces_.back().pose_at(1); });
    }

    FilePlace place_;
    std::optional<Pose> pose_;  // where the motion is
    std::vector<Motion> pieces_;
};

}  // namespace

Motion parse_motion(std::string_view text, const std::string& name) {
    MotionReader reader(name);
    while (!text.empty()) reader.line(take_line(text));
    return reader.finish();
}

FileMotion read_motion(const std::string& file) {
    const FileBytes bytes = read_file(file, motion_file_limit);
    const std::string_view text = bytes.view();
    const std::size_t begin = text.find_first_not_of(" \t\r\n");
    if (begin != std::string_view::npos && text[begin] == '{')
        return parse_motion_document(text, file);
    return parse_motion(text, file);
}

}  // namespace trisect::app
