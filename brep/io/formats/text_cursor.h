// SPDX-License-Identifier: Apache-2.0
//
// TextCursor: words and numbers of a text, line by line, without copies.
//
// Lines end with LF, CR LF, or (in a file whose first line does) a bare CR. Words are separated by
// blanks, tabs, CR, vertical tabs and form feeds. A number must fill its whole word: `1.5x` is an
// error, not 1.5. Numbers are read by nearest_double (decimal.h), which rounds correctly and has no
// locale; a leading `+`, which it refuses, is skipped here.
#pragma once

#include <trisect/brep/io/formats/decimal.h>
#include <trisect/brep/io/formats/input_text.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <system_error>

namespace trisect::detail {

struct TextRules {
    bool hash_comments = false;  ///< `#` before a word or after a number hides the rest
    bool continuation = false;   ///< a backslash at the end of a line joins it with the next
};

class TextCursor {
public:
    TextCursor(const InputText& source, TextRules rules)
        : source_(source), rules_(rules), next_line_(source.begin()) {
        if (source.bytes().starts_with("\xEF\xBB\xBF")) next_line_ += 3;
        here_ = line_end_ = next_line_;
    }
    /// Begins at `from` instead of the start of the file.
    TextCursor(const InputText& source, TextRules rules, const char* from)
        : source_(source), rules_(rules), here_(from), line_end_(from), next_line_(from) {}

    /// Moves to the start of the next line; false at the end of the file.
    bool next_line() {
        if (next_line_ == source_.end()) {
            here_ = line_end_ = source_.end();
            continues_ = false;
            return false;
        }
        here_ = next_line_;
        const auto rest = static_cast<std::size_t>(source_.end() - here_);
        const void* eol = std::memchr(here_, source_.line_end(), rest);
        line_end_ = eol != nullptr ? static_cast<const char*>(eol) : source_.end();
        next_line_ = eol != nullptr ? line_end_ + 1 : line_end_;
        if (static_cast<std::uint64_t>(line_end_ - here_) > source_.limits().line_bytes) {
            source_.fail_limit(here_, "a line of more than " +
                                          std::to_string(source_.limits().line_bytes) + " bytes");
        }
        if (line_end_ != here_ && line_end_[-1] == '\r') --line_end_;
        continues_ = rules_.continuation && line_end_ != here_ && line_end_[-1] == '\\';
        if (continues_) --line_end_;
        return true;
    }

    /// Where the cursor stands.
    [[nodiscard]] const char* here() const noexcept { return here_; }
    /// The first byte after the current line and its line end.
    [[nodiscard]] const char* after_line() const noexcept { return next_line_; }
    /// True when the line ends in a backslash that joins it with the next.
    [[nodiscard]] bool line_continues() const noexcept { return continues_; }

    /// Skips blanks; true when the line has no further word.
    bool at_line_end() {
        for (;;) {
            while (here_ != line_end_ && is_blank(*here_)) ++here_;
            if (here_ != line_end_) return rules_.hash_comments && *here_ == '#';
            if (!continues_ || !next_line()) return true;
        }
    }

    /// The next word of the line; empty at its end.
    std::string_view word() {
        if (at_line_end()) return {};
        const char* first = here_;
        while (here_ != line_end_ && !is_blank(*here_)) ++here_;
        return {first, static_cast<std::size_t>(here_ - first)};
    }

    /// All words of the rest of the line, as they stand; a line end in between ends them.
    std::string_view rest_of_line() {
        if (at_line_end()) return {};
        const char* const first = here_;
        const char* last = line_end_;
        while (last != first && is_blank(last[-1])) --last;
        here_ = line_end_;
        return {first, static_cast<std::size_t>(last - first)};
    }

    /// Moves over line ends until there is a word; false at the end of the file.
    bool seek_word() {
        while (at_line_end()) {
            if (!next_line()) return false;
        }
        return true;
    }

    /// The next word of the line as a finite number.
    double real(const char* what) {
        const double value = any_real(what);
        if (!std::isfinite(value)) fail_word(what, "is not finite");
        return value;
    }

    /// The next word as a number that may be infinite or not a number: for values that are ignored.
    double any_real(const char* what) {
        require_word(what);
        word_ = here_;
        const char* first = here_ + (*here_ == '+' ? 1 : 0);
        double value = 0;
        auto [stop, error] = nearest_double(first, line_end_, value);
        if (first != here_ && first != line_end_ && *first == '-')
            error = std::errc::invalid_argument;
        if (error == std::errc::result_out_of_range) fail_word(what, "is too large for a double");
        if (error != std::errc{}) fail_word(what, "is not a number");
        end_number(stop, what);
        return value;
    }

    /// The next word as an integer.
    std::int64_t integer(const char* what) {
        const std::int64_t value = leading_integer(what);
        end_number(here_, what);
        return value;
    }

    /// The next word as an integer that is not negative: a count or an index from 0.
    std::uint64_t count(const char* what) {
        const std::int64_t value = integer(what);
        if (value < 0) fail_word(what, "is negative");
        return static_cast<std::uint64_t>(value);
    }

    /// The integer with which the next word begins; the cursor stops behind it.
    std::int64_t leading_integer(const char* what) {
        require_word(what);
        word_ = here_;
        std::int64_t value = 0;
        const auto [stop, error] = std::from_chars(here_, line_end_, value);
        if (error == std::errc::result_out_of_range) fail_word(what, "is too large");
        if (error != std::errc{}) fail_word(what, "is not an integer");
        here_ = stop;
        return value;
    }

    /// Goes on at the start of a line, which the next call of next_line() takes.
    void resume_at(const char* line) noexcept {
        here_ = line_end_ = next_line_ = line;
        continues_ = false;
    }

    /// Goes back to a place in the current line.
    void go_back_to(const char* place) noexcept { here_ = place; }

    /// Inside a word: takes one character if it is `c`.
    bool take(char c) noexcept {
        if (here_ == line_end_ || *here_ != c) return false;
        ++here_;
        return true;
    }
    [[nodiscard]] bool at(char c) const noexcept { return here_ != line_end_ && *here_ == c; }
    [[nodiscard]] bool inside_word() const noexcept {
        return here_ != line_end_ && !is_blank(*here_);
    }

    /// Fails unless the line has no further word.
    void expect_line_end() {
        if (at_line_end()) return;
        const std::string_view extra = word();
        source_.fail(extra.data(), "unexpected " + shown_word(extra) + " in this line");
    }

    /// Fails about the word whose number was read last.
    [[noreturn]] void fail_word(const char* what, const char* why) const {
        const char* stop = word_;
        while (stop != line_end_ && !is_blank(*stop)) ++stop;
        const std::string_view text(word_, static_cast<std::size_t>(stop - word_));
        source_.fail(word_, shown_word(text) + ", read as " + what + ", " + why);
    }
    [[nodiscard]] const char* last_number() const noexcept { return word_; }

private:
    static bool is_blank(char c) noexcept {
        return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f' || c == '\n';
    }

    void require_word(const char* what) {
        if (!at_line_end()) return;
        const bool file_ends = here_ == source_.end() || next_line_ == source_.end();
        source_.fail(here_, std::string(file_ends ? "the file" : "the line") + " ends where " +
                                what + " is expected");
    }

    void end_number(const char* stop, const char* what) {
        const bool comment = rules_.hash_comments && stop != line_end_ && *stop == '#';
        if (stop != line_end_ && !is_blank(*stop) && !comment) fail_word(what, "is not a number");
        if (static_cast<std::uint64_t>(stop - word_) > source_.limits().literal_characters) {
            source_.fail_limit(word_, "a number of more than " +
                                          std::to_string(source_.limits().literal_characters) +
                                          " characters");
        }
        here_ = stop;
    }

    const InputText& source_;
    TextRules rules_;
    const char* here_;
    const char* line_end_;
    const char* next_line_;
    const char* word_ = nullptr;
    bool continues_ = false;
};

}  // namespace trisect::detail
