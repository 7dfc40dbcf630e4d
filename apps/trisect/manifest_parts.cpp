// SPDX-License-Identifier: Apache-2.0
#include "manifest_parts.h"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <system_error>

namespace trisect::app {
namespace {

constexpr int digits_of_an_int = 15;  // doubles hold all of so many

enum Member : unsigned { File = 1, Name = 2, Id = 4, Group = 8, PoseOf = 16, Other = 0 };

Member member_of(std::string_view key) {
    if (key == "file") return File;
    if (key == "name") return Name;
    if (key == "id") return Id;
    if (key == "group") return Group;
    if (key == "pose") return PoseOf;
    return Other;
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }

void add_utf8(std::string& out, std::uint32_t code) {
    const auto add = [&](std::uint32_t byte) { out += static_cast<char>(byte); };
    if (code < 0x80) return add(code);
    if (code < 0x800) {
        add(0xc0 | (code >> 6));
    } else {
        if (code < 0x10000) {
            add(0xe0 | (code >> 12));
        } else {
            add(0xf0 | (code >> 18));
            add(0x80 | ((code >> 12) & 0x3f));
        }
        add(0x80 | ((code >> 6) & 0x3f));
    }
    add(0x80 | (code & 0x3f));
}

}  // namespace

void WrittenParts::skip_space() {
    while (at_ != end_ && (*at_ == ' ' || *at_ == '\n' || *at_ == '\r' || *at_ == '\t')) ++at_;
}

// Behind white space; then it is taken.
bool WrittenParts::is_next(char c) {
    skip_space();
    if (at_ == end_ || *at_ != c) return false;
    ++at_;
    return true;
}

bool WrittenParts::word(std::string_view text) {
    if (!std::string_view(at_, end_).starts_with(text)) return false;
    at_ += text.size();
    return true;
}

bool WrittenParts::next(WrittenPart& part) {
    skip_space();
    if (at_ == end_ && !is_first_) {
        is_whole_ = true;
        return false;
    }
    if (!is_first_ && !is_next(',')) return false;
    is_first_ = false;
    return object(part);
}

// Behind its first bracket, to behind the last one.
template <typename Item>
bool WrittenParts::list(char end, const Item& item) {
    if (is_next(end)) return true;
    do {
        if (!item()) return false;
    } while (is_next(','));
    return is_next(end);
}

bool WrittenParts::object(WrittenPart& part) {
    part.file.clear();
    part.name.clear();
    part.id.clear();
    part.group.clear();
    part.numbers = 0;
    seen_ = 0;
    return is_next('{') && list('}', [&] { return member(part); }) && (seen_ & File) != 0;
}

bool WrittenParts::member(WrittenPart& part) {
    if (!string(key_) || !is_next(':')) return false;
    const Member which = member_of(key_);
    if ((seen_ & which) != 0) return false;
    seen_ |= which;
    switch (which) {
        case File:
            return string(part.file);
        case Name:
            return string(part.name);
        case Id:
            return string(part.id);
        case Group:
            return string(part.group);
        case PoseOf:
            return pose(part);
        case Other:
            break;
    }
    return false;
}

bool WrittenParts::pose(WrittenPart& part) {
    const auto one = [&] {
        skip_space();
        return part.numbers < part.pose.size() && number(part.pose[part.numbers++]);
    };
    return is_next('[') && list(']', one) && (part.numbers == 3 || part.numbers == 12);
}

bool WrittenParts::digits() {
    const char* const begin = at_;
    while (at_ != end_ && is_digit(*at_)) ++at_;
    return at_ != begin;
}

// As JSON has them. A whole number is one of a document too: zero has no sign then.
bool WrittenParts::number(double& out) {
    const char* const begin = at_;
    const bool is_negative = word("-");
    const char* const first = at_;
    if (!digits() || (*first == '0' && at_ - first > 1)) return false;
    if (at_ == end_ || (*at_ != '.' && *at_ != 'e' && *at_ != 'E')) {
        if (at_ - first <= digits_of_an_int) {
            std::int64_t whole = 0;
            for (const char* c = first; c != at_; ++c) whole = 10 * whole + (*c - '0');
            out = static_cast<double>(is_negative ? -whole : whole);
            return true;
        }
    } else {
        if (word(".") && !digits()) return false;
        if (word("e") || word("E")) {
            if (!word("+")) word("-");
            if (!digits()) return false;
        }
    }
    const auto [end, error] = std::from_chars(begin, at_, out);
    return error == std::errc() && end == at_;
}

// Behind white space, with its quotes.
bool WrittenParts::string(std::string& out) {
    out.clear();
    if (!is_next('"')) return false;
    while (true) {
        const char* const begin = at_;
        while (at_ != end_ && *at_ != '"' && *at_ != '\\' && static_cast<signed char>(*at_) >= ' ')
            ++at_;
        out.append(begin, at_);
        if (at_ == end_) return false;
        if (*at_ == '"') {
            ++at_;
            return true;
        }
        if (!(*at_ == '\\' ? escape(out) : beyond_ascii(out))) return false;
    }
}

bool WrittenParts::code_unit(std::uint32_t& out) {
    if (end_ - at_ < 4) return false;
    const auto [end, error] = std::from_chars(at_, at_ + 4, out, 16);
    const bool is_unit = error == std::errc() && end == at_ + 4;
    at_ += 4;
    return is_unit;
}

bool WrittenParts::escape(std::string& out) {
    constexpr std::string_view names = "\"\\/bfnrt";
    constexpr std::string_view meant = "\"\\/\b\f\n\r\t";
    if (++at_ == end_) return false;
    const char c = *at_++;
    if (const std::size_t i = names.find(c); i != std::string_view::npos) {
        out += meant[i];
        return true;
    }
    std::uint32_t code = 0;
    if (c != 'u' || !code_unit(code)) return false;
    if (code >= 0xdc00 && code < 0xe000) return false;
    if (code >= 0xd800 && code < 0xdc00) {
        std::uint32_t low = 0;
        if (!word("\\u") || !code_unit(low) || low < 0xdc00 || low >= 0xe000) return false;
        code = 0x10000 + ((code - 0xd800) << 10) + (low - 0xdc00);
    }
    add_utf8(out, code);
    return true;
}

// One character of several bytes, as Unicode allows them (its table 3-7).
bool WrittenParts::beyond_ascii(std::string& out) {
    const auto byte = [&](std::ptrdiff_t i) { return static_cast<unsigned char>(at_[i]); };
    const unsigned first = byte(0);
    if (first < 0xc2 || first > 0xf4) return false;
    const std::ptrdiff_t length = first < 0xe0 ? 2 : first < 0xf0 ? 3 : 4;
    if (end_ - at_ < length) return false;
    const unsigned least = first == 0xe0 ? 0xa0 : first == 0xf0 ? 0x90 : 0x80;
    const unsigned most = first == 0xed ? 0x9f : first == 0xf4 ? 0x8f : 0xbf;
    if (byte(1) < least || byte(1) > most) return false;
    for (std::ptrdiff_t i = 2; i < length; ++i)
        if ((byte(i) & 0xc0U) != 0x80) return false;
    out.append(at_, at_ + length);
    at_ += length;
    return true;
}

}  // namespace trisect::app
