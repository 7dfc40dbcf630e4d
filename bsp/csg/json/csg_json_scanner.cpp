// SPDX-License-Identifier: Apache-2.0
#include <trisect/bsp/csg/json/csg_json_scanner.h>

#include <algorithm>
#include <charconv>
#include <system_error>

namespace trisect::detail {
namespace {

bool is_json_digit(char c) { return c >= '0' && c <= '9'; }
bool is_json_blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

std::uint32_t byte_of(char c) { return static_cast<unsigned char>(c); }

/// How long a number by JSON's grammar is; 0 where there is none.
std::size_t number_length(std::string_view text) {
    std::size_t i = 0;
    const auto is_digit_at = [&] { return i < text.size() && is_json_digit(text[i]); };
    const auto is_at = [&](std::string_view any) {
        return i < text.size() && any.find(text[i]) != std::string_view::npos;
    };
    const auto skip_digits = [&] {
        if (!is_digit_at()) return false;
        while (is_digit_at()) ++i;
        return true;
    };
    if (is_at("-")) ++i;
    if (is_at("0"))
        ++i;
    else if (!skip_digits())
        return 0;
    if (is_at(".")) {
        ++i;
        if (!skip_digits()) return 0;
    }
    if (is_at("eE")) {
        ++i;
        if (is_at("+-")) ++i;
        if (!skip_digits()) return 0;
    }
    return i;
}

void add_utf8(std::string& out, std::uint32_t code) {
    const auto tail = [&](int shift) {
        out += static_cast<char>(0x80U | ((code >> shift) & 0x3fU));
    };
    if (code < 0x80) {
        out += static_cast<char>(code);
    } else if (code < 0x800) {
        out += static_cast<char>(0xc0U | (code >> 6));
        tail(0);
    } else if (code < 0x10000) {
        out += static_cast<char>(0xe0U | (code >> 12));
        tail(6);
        tail(0);
    } else {
        out += static_cast<char>(0xf0U | (code >> 18));
        tail(12);
        tail(6);
        tail(0);
    }
}

}  // namespace

std::size_t utf8_length(std::string_view text) {
    if (text.empty()) return 0;
    const std::uint32_t first = byte_of(text[0]);
    if (first < 0x80) return 1;
    const std::size_t length = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
    if (first < 0xc2 || first > 0xf4 || text.size() < length) return 0;
    for (std::size_t i = 1; i < length; ++i)
        if ((byte_of(text[i]) & 0xc0U) != 0x80) return 0;
    // Longer than they need be, halves of pairs, and beyond the last character.
    const std::uint32_t second = byte_of(text[1]);
    if ((first == 0xe0 && second < 0xa0) || (first == 0xed && second > 0x9f) ||
        (first == 0xf0 && second < 0x90) || (first == 0xf4 && second > 0x8f))
        return 0;
    return length;
}

CsgJsonScanner::CsgJsonScanner(std::string_view text, const std::string& file)
    : text_(text), file_(file) {
    if (text_.starts_with("\xef\xbb\xbf")) position_ = 3;
}

void CsgJsonScanner::fail(CsgPlace place, const std::string& message) const {
    throw CsgError(ErrorCode::Input, {file_, place.line, place.column, 0}, message);
}

void CsgJsonScanner::expected(const std::string& what) {
    skip_blanks();
    std::string found = "the end of the text";
    if (left() > 0) {
        const std::size_t length = utf8_length(text_.substr(position_));
        found = length == 0 || byte_of(at()) < 0x20
                    ? "a byte that has no meaning"
                    : "'" + std::string(text_.substr(position_, length)) + "'";
    }
    fail(place_, what + " was expected, not " + found);
}

void CsgJsonScanner::step(std::size_t count) {
    for (; count > 0; --count) {
        if (text_[position_++] == '\n') {
            ++place_.line;
            place_.column = 1;
        } else {
            ++place_.column;
        }
    }
}

void CsgJsonScanner::skip_blanks() {
    while (is_json_blank(at())) step();
}

char CsgJsonScanner::next() {
    skip_blanks();
    return at();
}

CsgPlace CsgJsonScanner::place() {
    skip_blanks();
    return place_;
}

bool CsgJsonScanner::is_at_end() {
    skip_blanks();
    return left() == 0;
}

bool CsgJsonScanner::take_if(char sign) {
    if (next() != sign) return false;
    step();
    return true;
}

void CsgJsonScanner::take(char sign) {
    if (!take_if(sign)) expected(std::string("'") + sign + "'");
}

bool CsgJsonScanner::take_if(std::string_view word) {
    skip_blanks();
    if (!text_.substr(position_).starts_with(word)) return false;
    step(word.size());
    return true;
}

double CsgJsonScanner::read_number() {
    skip_blanks();
    const std::size_t length = number_length(text_.substr(position_));
    if (length == 0) expected("a number");
    double value = 0;
    const char* const begin = text_.data() + position_;
    const auto [end, error] = std::from_chars(begin, begin + length, value);
    if (error == std::errc::result_out_of_range)
        fail(place_, "the number is out of the range of doubles");
    if (error != std::errc() || end != begin + length) fail(place_, "a number was expected");
    step(length);
    return value;
}

std::uint32_t CsgJsonScanner::read_unit() {
    std::uint32_t unit = 0;
    const char* const begin = text_.data() + position_;
    const char* const end = begin + std::min<std::size_t>(4, left());
    if (std::from_chars(begin, end, unit, 16).ptr != begin + 4)
        fail(place_, "four hexadecimal digits were expected");
    step(4);
    return unit;
}

void CsgJsonScanner::read_escape(std::string& out) {
    const CsgPlace start = place_;
    step();
    const char c = at();
    const std::size_t simple = std::string_view("\"\\/bfnrt").find(c);
    if (left() > 0 && simple != std::string_view::npos) {
        out += "\"\\/\b\f\n\r\t"[simple];
        return step();
    }
    if (c != 'u') fail(start, "an escape that JSON does not have");
    step();
    std::uint32_t code = read_unit();
    if (code >= 0xd800 && code < 0xdc00 && at() == '\\' && at(1) == 'u') {
        step(2);
        const std::uint32_t second = read_unit();
        if (second < 0xdc00 || second > 0xdfff) fail(start, "half of a pair of UTF-16");
        code = 0x10000 + ((code - 0xd800) << 10) + (second - 0xdc00);
    } else if (code >= 0xd800 && code < 0xe000) {
        fail(start, "half of a pair of UTF-16");
    }
    add_utf8(out, code);
}

void CsgJsonScanner::read_character(std::string& out) {
    if (at() == '\\') return read_escape(out);
    if (byte_of(at()) < 0x20) fail(place_, "a control character within a text");
    const std::size_t length = utf8_length(text_.substr(position_));
    if (length == 0) fail(place_, "a text that is not UTF-8");
    out += text_.substr(position_, length);
    step(length);
}

std::string CsgJsonScanner::read_text() {
    if (next() != '"') expected("a text");
    const CsgPlace start = place_;
    step();
    std::string out;
    while (left() > 0 && at() != '"') read_character(out);
    if (left() == 0) fail(start, "a text that does not end");
    step();
    return out;
}

}  // namespace trisect::detail
