// SPDX-License-Identifier: Apache-2.0
//
// CsgJsonScanner: the words of a JSON text, with their places.
// Strict: as RFC 8259 says, texts in UTF-8.
#pragma once

#include <string>
#include <string_view>

#include <trisect/bsp/csg/csg_tree.h>

namespace trisect::detail {

/// Every call skips blanks first. The text and the name must outlive it.
class CsgJsonScanner {
public:
    CsgJsonScanner(std::string_view text, const std::string& file);

    /// The first character of the next word; 0 at the end.
    [[nodiscard]] char next();
    /// Of the next word.
    [[nodiscard]] CsgPlace place();
    [[nodiscard]] bool is_at_end();

    bool take_if(char sign);
    /// \throw CsgError (Input) unless it is next
    void take(char sign);
    [[nodiscard]] std::string read_text();
    /// \throw CsgError (Input) as well for a number that no double holds
    [[nodiscard]] double read_number();
    /// true, false or null
    [[nodiscard]] bool take_if(std::string_view word);

    /// "WHAT was expected, not ...", at the next word.
    [[noreturn]] void expected(const std::string& what);
    [[noreturn]] void fail(CsgPlace place, const std::string& message) const;

private:
    [[nodiscard]] char at(std::size_t ahead = 0) const {
        return position_ + ahead < text_.size() ? text_[position_ + ahead] : '\0';
    }
    [[nodiscard]] std::size_t left() const { return text_.size() - position_; }
    void skip_blanks();
    void step(std::size_t count = 1);
    void read_escape(std::string& out);
    [[nodiscard]] std::uint32_t read_unit();
    void read_character(std::string& out);

    std::string_view text_;
    const std::string& file_;
    std::size_t position_ = 0;
    CsgPlace place_{1, 1};
};

/// How many bytes the character at the beginning of the text has; 0 where it is not UTF-8.
[[nodiscard]] std::size_t utf8_length(std::string_view text);

}  // namespace trisect::detail
