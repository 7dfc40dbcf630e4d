// SPDX-License-Identifier: Apache-2.0
//
// CsgLexer: the words of a modelling program.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include <trisect/bsp/csg/csg_tree.h>

namespace trisect::detail {

struct CsgToken {
    enum class Kind : std::uint8_t { End, Name, Number, Text, Sign } kind = Kind::End;
    CsgPlace place;
    std::string text;  ///< of a name or a text
    double number = 0;
    char sign = 0;  ///< one of ( ) { } [ ] , ; = * ! # %
};

/// Looks one token ahead. Blanks and comments are skipped.
class CsgLexer {
public:
    CsgLexer(std::string_view text, const std::string& file);

    [[nodiscard]] const CsgToken& token() const { return token_; }
    [[nodiscard]] bool is(char sign) const {
        return token_.kind == CsgToken::Kind::Sign && token_.sign == sign;
    }
    void advance();
    /// How the token is named in a message.
    [[nodiscard]] std::string description() const;
    [[noreturn]] void fail(CsgPlace place, const std::string& message) const;

private:
    [[nodiscard]] char at(std::size_t ahead = 0) const {
        return position_ + ahead < text_.size() ? text_[position_ + ahead] : '\0';
    }
    [[nodiscard]] bool is_at_end() const { return position_ >= text_.size(); }
    void step();
    void skip_blanks();
    bool skip_comment();
    void read_name();
    void read_number();
    void read_text();
    [[nodiscard]] char escaped();

    std::string_view text_;
    const std::string& file_;
    std::size_t position_ = 0;
    CsgPlace place_{1, 1};
    CsgToken token_;
};

}  // namespace trisect::detail
