// SPDX-License-Identifier: Apache-2.0
//
// Text as XML holds it, in attributes and between tags.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace trisect::detail {

/// How many bytes the character has that a text begins with; 0 where it is no UTF-8, or a character
/// that XML does not have.
[[nodiscard]] inline std::size_t utf8_length(std::string_view text) {
    const auto first = static_cast<unsigned char>(text.front());
    if (first < 0x80) return 1;
    const std::size_t length = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
    if (first < 0xC2 || first > 0xF4 || text.size() < length) return 0;
    std::uint32_t code = first & (0xFFU >> (length + 1));
    for (std::size_t i = 1; i < length; ++i) {
        const auto byte = static_cast<unsigned char>(text[i]);
        if ((byte & 0xC0U) != 0x80) return 0;
        code = (code << 6) | (byte & 0x3FU);
    }
    const bool is_short = code < (length == 4 ? 0x10000U : length == 3 ? 0x800U : 0x80U);
    const bool is_none = (code >= 0xD800 && code < 0xE000) || code == 0xFFFE || code == 0xFFFF;
    return is_short || is_none || code > 0x10FFFF ? 0 : length;
}

/// Control characters become blanks, and bytes that are no UTF-8 question marks.
[[nodiscard]] inline std::string escaped_xml(std::string_view text) {
    std::string out;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const std::size_t length = utf8_length(text.substr(i));
        const char c = length == 0 ? '?' : text[i];
        if (length > 1) {
            out += text.substr(i, length);
            i += length - 1;
        } else if (c == '&')
            out += "&amp;";
        else if (c == '<')
            out += "&lt;";
        else if (c == '>')
            out += "&gt;";
        else if (c == '"')
            out += "&quot;";
        else
            out += static_cast<unsigned char>(c) < ' ' ? ' ' : c;
    }
    return out;
}

}  // namespace trisect::detail
