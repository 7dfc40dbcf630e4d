// SPDX-License-Identifier: Apache-2.0
//
// Text as XML holds it, in attributes and between tags.
#pragma once

#include <string>
#include <string_view>

namespace trisect::detail {

/// Control characters become blanks.
[[nodiscard]] inline std::string escaped_xml(std::string_view text) {
    std::string out;
    for (const char c : text) {
        if (c == '&')
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
