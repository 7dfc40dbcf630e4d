// SPDX-License-Identifier: Apache-2.0
//
// A block (line) is read into words first and then carried out in the order that the words have in
// every dialect: units and distance mode, plane, feed, and last the motion. What would change the
// path and is not carried out is refused; what does not (spindle, coolant, cancelled corrections)
// is passed over with one note.
#include <trisect/kernel/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>

#include "line_words.h"
#include "mill_arc.h"
#include "mill_path.h"
#include "values.h"

namespace trisect::app {
namespace {

struct GWord {
    char letter = 0;
    double value = 0;
    std::size_t column = 0;
    /// "G1" for messages and for what is listed.
    [[nodiscard]] std::string name() const { return fmt::format("{}{}", letter, value); }
};

class BlockLexer {
public:
    BlockLexer(std::string_view line, FilePlace place) : line_(line), place_(std::move(place)) {}

    std::vector<GWord> words() {
        std::vector<GWord> out;
        while (skip_to_word()) out.push_back(word());
        return out;
    }

private:
    [[noreturn]] void fail(std::size_t at, const std::string& what) {
        place_.column = at + 1;
        throw InputError(place_, what);
    }
    static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

    bool skip_to_word() {
        for (; at_ < line_.size(); ++at_) {
            if (is_blank(line_[at_])) continue;
            if (line_[at_] == ';') return false;
            if (line_[at_] != '(') return true;
            const std::size_t end = line_.find(')', at_);
            if (end == std::string_view::npos) fail(at_, "a comment without its ')'");
            at_ = end;
        }
        return false;
    }
    GWord word() {
        GWord w;
        w.column = at_ + 1;
        const char c = line_[at_];
        w.letter = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
        if (w.letter < 'A' || w.letter > 'Z') fail(at_, fmt::format("'{}' begins no word", c));
        ++at_;
        std::string digits;
        for (; at_ < line_.size(); ++at_) {
            const char d = line_[at_];
            if (is_blank(d)) continue;
            if ((d < '0' || d > '9') && d != '.' && d != '-' && d != '+') break;
            digits += d;
        }
        try {
            w.value = parse_number(digits, std::string(1, w.letter));
        } catch (const UsageError&) {
            fail(w.column - 1, fmt::format("{} has no number", w.letter));
        }
        return w;
    }

    std::string_view line_;
    FilePlace place_;
    std::size_t at_ = 0;
};

/// Codes that change nothing here: planes are carried out elsewhere.
constexpr std::array ignored_g{40.0, 49.0, 54.0, 64.0, 80.0, 91.1, 94.0};
constexpr std::array ignored_m{0.0, 1.0, 3.0, 4.0, 5.0, 7.0, 8.0, 9.0};

template <std::size_t N>
bool is_among(const std::array<double, N>& codes, double code) {
    return std::find(codes.begin(), codes.end(), code) != codes.end();
}

class GcodeReader {
public:
    GcodeReader(const std::string& name, const PathOptions& options)
        : options_(options), place_{name, 0, 0, 0} {
        path_.file = name;
    }

    /// False after the end of the program.
    bool line(std::string_view text) {
        ++place_.line;
        place_.column = 0;
        if (words_of(text).size() == 1 && words_of(text)[0].text == "%") return true;
        block_ = Block();
        for (const GWord& w : BlockLexer(text, place_).words()) take(w);
        carry_out();
        return !ended_;
    }
    ToolPath finish() {
        place_.column = 0;
        if (path_.moves.empty()) throw InputError(place_, "the program moves nothing");
        note("not carried out: ", ignored_);
        if (uses_default_feed_)
            path_.notes.push_back(fmt::format("moves before the first F have the feed {} (--feed)",
                                              number_text(options_.feed)));
        return std::move(path_);
    }

private:
    struct Block {
        std::array<std::optional<double>, 3> axes;     // X Y Z
        std::array<std::optional<double>, 3> centers;  // I J K
        std::optional<double> radius;
        std::optional<double> feed;
        std::size_t motion_column = 0;
        bool has_motion = false;
        std::set<char> seen;
        [[nodiscard]] bool has_axes() const {
            return std::any_of(axes.begin(), axes.end(),
                               [](const auto& a) { return a.has_value(); });
        }
        [[nodiscard]] bool has_center() const {
            return std::any_of(centers.begin(), centers.end(),
                               [](const auto& a) { return a.has_value(); });
        }
    };

    [[noreturn]] void fail(std::size_t column, const std::string& what) {
        place_.column = column;
        throw InputError(place_, what);
    }
    void note(const char* what, const std::set<std::string>& words) {
        if (words.empty()) return;
        std::string text = what;
        for (const std::string& w : words) text += (&w == &*words.begin() ? "" : " ") + w;
        path_.notes.push_back(std::move(text));
    }

    void take(const GWord& w) {
        if (w.letter == 'G') return take_g(w);
        if (w.letter == 'M') return take_m(w);
        if (w.letter == 'N') return;
        if (w.letter == 'S' || w.letter == 'T') {
            ignored_.insert(std::string(1, w.letter));
            return;
        }
        if (!block_.seen.insert(w.letter).second)
            fail(w.column, fmt::format("a second {} in one block", w.letter));
        constexpr std::string_view axes = "XYZ";
        constexpr std::string_view centers = "IJK";
        if (block_.motion_column == 0) block_.motion_column = w.column;
        if (const auto k = axes.find(w.letter); k != std::string_view::npos)
            block_.axes[k] = w.value;
        else if (const auto c = centers.find(w.letter); c != std::string_view::npos)
            block_.centers[c] = w.value;
        else if (w.letter == 'R')
            block_.radius = w.value;
        else if (w.letter == 'F')
            block_.feed = w.value;
        else
            fail(w.column, fmt::format("{} is not supported", w.name()));
    }
    void take_g(const GWord& w) {
        if (w.value == 0 || w.value == 1 || w.value == 2 || w.value == 3) {
            if (block_.has_motion) fail(w.column, "a second motion in one block");
            motion_ = static_cast<int>(w.value);
            block_.has_motion = true;
            block_.motion_column = w.column;
        } else if (w.value == 17 || w.value == 18 || w.value == 19) {
            plane_ = static_cast<int>(w.value) - 17;
        } else if (w.value == 20 || w.value == 21) {
            unit_ = w.value == 20 ? 25.4 : 1;
        } else if (w.value == 90 || w.value == 91) {
            is_relative_ = w.value == 91;
        } else if (is_among(ignored_g, w.value)) {
            ignored_.insert(w.name());
        } else {
            fail(w.column, fmt::format("{} is not supported", w.name()));
        }
    }
    void take_m(const GWord& w) {
        if (w.value == 2 || w.value == 30) {
            ended_ = true;
        } else if (w.value == 6) {
            if (!path_.moves.empty())
                fail(w.column, "M6: one tool a run; split the program at its tool changes");
            ignored_.insert("M6");
        } else if (is_among(ignored_m, w.value)) {
            ignored_.insert(w.name());
        } else {
            fail(w.column, fmt::format("{} is not supported", w.name()));
        }
    }

    void carry_out() {
        if (block_.feed) {
            if (!(*block_.feed > 0)) fail(block_.motion_column, "a feed must be positive");
            feed_ = *block_.feed * unit_;
        }
        const bool is_arc = motion_ == 2 || motion_ == 3;
        if (!block_.has_axes() && !block_.has_center() && !block_.radius) return;
        if (!motion_) fail(block_.motion_column, "coordinates before any of G0, G1, G2, G3");
        if (!is_arc && (block_.has_center() || block_.radius))
            fail(block_.motion_column, "I, J, K and R are for arcs");
        std::array<std::optional<double>, 3> to = at_;
        for (std::size_t k = 0; k < 3; ++k) {
            if (!block_.axes[k]) continue;
            const double value = *block_.axes[k] * unit_;
            if (is_relative_ && !at_[k])
                fail(block_.motion_column, "a relative move before the first place is complete");
            to[k] = is_relative_ ? *at_[k] + value : value;
        }
        if (is_arc)
            add_arc(to);
        else
            add_line(to);
        at_ = to;
    }
    [[nodiscard]] static bool is_complete(const std::array<std::optional<double>, 3>& p) {
        return p[0] && p[1] && p[2];
    }
    static Point3d point(const std::array<std::optional<double>, 3>& p) {
        return {p[0].value_or(0), p[1].value_or(0), p[2].value_or(0)};
    }

    void add_line(const std::array<std::optional<double>, 3>& to) {
        const bool is_rapid = motion_ == 0;
        const bool knew = is_complete(at_);
        if (!knew && !is_rapid)
            fail(block_.motion_column,
                 "the tool cuts before G0 has given it a place in X, Y and Z");
        if (is_complete(to)) add(point(to), is_rapid, !knew);
    }
    void add_arc(const std::array<std::optional<double>, 3>& to) {
        if (!is_complete(at_))
            fail(block_.motion_column,
                 "the tool cuts before G0 has given it a place in X, Y and Z");
        Arc arc;
        arc.from = point(at_);
        arc.to = point(to);
        arc.plane = plane_;
        arc.is_clockwise = motion_ == 2;
        if (block_.has_center() == block_.radius.has_value())
            fail(block_.motion_column, "an arc has either a radius or I, J, K");
        try {
            if (block_.radius) {
                arc.center = center_by_radius(arc, *block_.radius * unit_);
            } else {
                arc.center = arc.from;
                for (std::size_t k = 0; k < 3; ++k)
                    arc.center[k] += block_.centers[k].value_or(0) * unit_;
            }
            for (const Point3d& p : chords_of(arc, options_.chord)) add(p, false, false);
        } catch (const UsageError& e) {
            fail(block_.motion_column, e.what());
        }
        ++path_.arcs;
    }
    void add(const Point3d& to, bool is_rapid, bool is_placement) {
        ToolMove move;
        move.is_rapid = is_rapid;
        move.is_placement = is_placement;
        move.to = to;
        if (!is_rapid) {
            uses_default_feed_ = uses_default_feed_ || !feed_;
            move.feed = feed_.value_or(options_.feed);
        }
        move.line = place_.line;
        path_.moves.push_back(move);
    }

    PathOptions options_;
    FilePlace place_;
    ToolPath path_;
    Block block_;
    std::array<std::optional<double>, 3> at_;
    std::optional<int> motion_;
    int plane_ = 0;
    double unit_ = 1;
    bool is_relative_ = false;
    std::optional<double> feed_;
    bool uses_default_feed_ = false;
    bool ended_ = false;
    std::set<std::string> ignored_;
};

}  // namespace

ToolPath parse_gcode(std::string_view text, const std::string& name, const PathOptions& options) {
    GcodeReader reader(name, options);
    while (!text.empty() && reader.line(take_line(text))) {
    }
    return reader.finish();
}

}  // namespace trisect::app
