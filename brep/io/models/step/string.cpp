// SPDX-License-Identifier: Apache-2.0
#include <trisect/brep/io/models/step/string.h>

#include <charconv>
#include <cstdint>
#include <optional>

namespace trisect::detail {
namespace {

constexpr std::size_t longest_step_name = 1000;

void append_utf8(std::string& out, std::uint32_t code) {
    const auto byte = [&](std::uint32_t b) { out += static_cast<char>(b); };
    if (code < 0x80) {
        byte(code);
    } else if (code < 0x800) {
        byte(0xC0 | (code >> 6));
        byte(0x80 | (code & 0x3F));
    } else if (code < 0x10000) {
        byte(0xE0 | (code >> 12));
        byte(0x80 | ((code >> 6) & 0x3F));
        byte(0x80 | (code & 0x3F));
    } else {
        byte(0xF0 | (code >> 18));
        byte(0x80 | ((code >> 12) & 0x3F));
        byte(0x80 | ((code >> 6) & 0x3F));
        byte(0x80 | (code & 0x3F));
    }
}

std::optional<std::uint32_t> hex_value(std::string_view digits) {
    std::uint32_t value = 0;
    const char* end = digits.data() + digits.size();
    const auto [stop, error] = std::from_chars(digits.data(), end, value, 16);
    if (error != std::errc{} || stop != end || value > 0x10FFFF) return std::nullopt;
    return value;
}

/// Characters of `width` digits each, up to \X0\. Returns what it took, 0 where it is malformed.
std::size_t take_wide(std::string_view text, std::size_t width, std::string& out) {
    const std::size_t end = text.find("\\X0\\");
    if (end == std::string_view::npos || end % width != 0) return 0;
    std::string made;
    for (std::size_t i = 0; i < end; i += width) {
        auto code = hex_value(text.substr(i, width));
        if (!code) return 0;
        const bool is_high = *code >= 0xD800 && *code < 0xDC00;
        const auto low = is_high && i + 2 * width <= end ? hex_value(text.substr(i + width, width))
                                                         : std::nullopt;
        if (low && *low >= 0xDC00 && *low < 0xE000) {
            code = 0x10000 + ((*code - 0xD800) << 10) + (*low - 0xDC00);
            i += width;
        }
        if (*code >= 0xD800 && *code < 0xE000) return 0;
        append_utf8(made, *code);
    }
    out += made;
    return end + 4;
}

/// What a directive at the start of the text takes; 0 where there is none.
std::size_t take_directive(std::string_view text, std::string& out) {
    if (text.starts_with("\\\\")) {
        out += '\\';
        return 2;
    }
    std::size_t taken = 0;
    if (text.starts_with("\\X2\\")) taken = take_wide(text.substr(4), 4, out);
    if (text.starts_with("\\X4\\")) taken = take_wide(text.substr(4), 8, out);
    if (taken != 0) return taken + 4;
    if (text.starts_with("\\S\\") && text.size() > 3) {
        append_utf8(out, 0x80U + (static_cast<unsigned char>(text[3]) & 0x7FU));
        return 4;
    }
    if (text.starts_with("\\X\\") && text.size() > 4) {
        const auto code = hex_value(text.substr(3, 2));
        if (!code) return 0;
        append_utf8(out, *code);
        return 5;
    }
    return 0;
}

/// The character at the start of the text and its length; a length of 0 where it is no UTF-8.
std::size_t take_utf8(std::string_view text, std::uint32_t& code) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const std::uint32_t first = byte(0);
    const std::size_t length = first < 0x80 ? 1 : first < 0xE0 ? 2 : first < 0xF0 ? 3 : 4;
    if ((first >= 0x80 && first < 0xC2) || first > 0xF4 || length > text.size()) return 0;
    code = length == 1 ? first : first & (0x7FU >> length);
    for (std::size_t i = 1; i < length; ++i) {
        if ((byte(i) & 0xC0U) != 0x80) return 0;
        code = (code << 6) | (byte(i) & 0x3FU);
    }
    const bool is_short = (length == 3 && code < 0x800) || (length == 4 && code < 0x10000);
    return is_short || code > 0x10FFFF || (code >= 0xD800 && code < 0xE000) ? 0 : length;
}

}  // namespace

std::string step_string(std::string_view text) {
    text = text.substr(0, longest_step_name);
    std::string out;
    for (std::size_t i = 0; i < text.size();) {
        const std::size_t taken = text[i] == '\\' ? take_directive(text.substr(i), out) : 0;
        if (taken == 0) out += text[i];
        i += taken != 0 ? taken : text.substr(i).starts_with("''") ? 2 : 1;
    }
    return out;
}

std::string step_quoted(std::string_view utf8) {
    constexpr std::string_view digits = "0123456789ABCDEF";
    std::string out = "'";
    for (std::size_t i = 0; i < utf8.size();) {
        std::uint32_t code = '?';
        const std::size_t length = take_utf8(utf8.substr(i), code);
        i += length == 0 ? 1 : length;
        if (length == 0) code = '?';
        if (code < ' ' || code == 0x7F) code = ' ';
        if (code > 0x7F) {
            const bool is_wide = code > 0xFFFF;
            out += is_wide ? "\\X4\\" : "\\X2\\";
            for (int shift = is_wide ? 28 : 12; shift >= 0; shift -= 4)
                out += digits[(code >> shift) & 0xFU];
            out += "\\X0\\";
            continue;
        }
        if (code == '\'' || code == '\\') out += static_cast<char>(code);
        out += static_cast<char>(code);
    }
    return out + "'";
}

}  // namespace trisect::detail
