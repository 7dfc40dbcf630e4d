// SPDX-License-Identifier: Apache-2.0
#include <trisect/bsp/csg/csg_lexer.h>

#include <charconv>
#include <limits>
#include <system_error>

namespace trisect::detail {
namespace {

// What a message shows of a word, in characters.
constexpr std::size_t shown_length = 40;

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || c == '$';
}
bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }
bool is_sign(char c) { return std::string_view("(){}[],;=*!#%").find(c) != std::string_view::npos; }

}  // namespace

CsgLexer::CsgLexer(std::string_view text, const std::string& file) : text_(text), file_(file) {
    if (text_.starts_with("\xef\xbb\xbf")) position_ = 3;
    advance();
}

void CsgLexer::fail(CsgPlace place, const std::string& message) const {
    throw CsgError(ErrorCode::Input, {file_, place.line, place.column, 0}, message);
}

void CsgLexer::step() {
    if (text_[position_++] == '\n') {
        ++place_.line;
        place_.column = 1;
    } else {
        ++place_.column;
    }
}

void CsgLexer::skip_blanks() {
    while (!is_at_end() && (is_blank(at()) || skip_comment()))
        if (!is_at_end() && is_blank(at())) step();
}

bool CsgLexer::skip_comment() {
    if (at() != '/' || (at(1) != '/' && at(1) != '*')) return false;
    const CsgPlace start = place_;
    const bool is_line = at(1) == '/';
    step();
    step();
    if (is_line) {
        while (!is_at_end() && at() != '\n') step();
        return true;
    }
    while (!is_at_end() && !(at() == '*' && at(1) == '/')) step();
    if (is_at_end()) fail(start, "a comment that does not end");
    step();
    step();
    return true;
}

void CsgLexer::advance() {
    skip_blanks();
    token_ = CsgToken();
    token_.place = place_;
    if (is_at_end()) return;
    const char c = at();
    if (is_letter(c)) return read_name();
    if (is_digit(c) || c == '.' || c == '-' || c == '+') return read_number();
    if (c == '"') return read_text();
    if (!is_sign(c)) fail(place_, "a character that has no meaning here");
    token_.kind = CsgToken::Kind::Sign;
    token_.sign = c;
    step();
}

void CsgLexer::read_name() {
    const std::size_t start = position_;
    while (!is_at_end() && (is_letter(at()) || is_digit(at()))) step();
    token_.kind = CsgToken::Kind::Name;
    token_.text = text_.substr(start, position_ - start);
}

void CsgLexer::read_number() {
    const bool is_negative = at() == '-';
    if (is_negative || at() == '+') step();
    token_.kind = CsgToken::Kind::Number;
    const std::string_view rest = text_.substr(position_);
    const bool is_named = rest.starts_with("inf") || rest.starts_with("nan");
    if (!is_named && !is_digit(at()) && at() != '.') fail(token_.place, "a sign without a number");
    double value = 0;
    const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), value);
    if (error == std::errc::result_out_of_range)
        fail(token_.place, "the number is out of the range of doubles");
    if (error != std::errc()) fail(token_.place, "a number was expected");
    const auto length = static_cast<std::size_t>(end - rest.data());
    position_ += length;
    place_.column += static_cast<std::uint32_t>(length);
    if (!is_at_end() && (is_letter(at()) || at() == '.'))
        fail(token_.place, "a number that does not end where it should");
    token_.number = is_negative ? -value : value;
}

char CsgLexer::escaped() {
    step();
    switch (is_at_end() ? '\0' : at()) {
        case 'n':
            return '\n';
        case 't':
            return '\t';
        case 'r':
            return '\r';
        default:
            return at();
    }
}

void CsgLexer::read_text() {
    token_.kind = CsgToken::Kind::Text;
    step();
    while (!is_at_end() && at() != '"') {
        const char c = at() == '\\' ? escaped() : at();
        if (is_at_end()) break;
        token_.text += c;
        step();
    }
    if (is_at_end()) fail(token_.place, "a text that does not end");
    step();
}

std::string CsgLexer::description() const {
    switch (token_.kind) {
        case CsgToken::Kind::End:
            return "the end of the file";
        case CsgToken::Kind::Name:
            return "'" + token_.text.substr(0, shown_length) + "'";
        case CsgToken::Kind::Number:
            return "a number";
        case CsgToken::Kind::Text:
            return "a text";
        case CsgToken::Kind::Sign:
            break;
    }
    return std::string("'") + token_.sign + "'";
}

}  // namespace trisect::detail
