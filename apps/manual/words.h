// SPDX-License-Identifier: Apache-2.0
//
// Small helpers for text that shells read.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace trisect::app {

[[nodiscard]] inline std::string joined(const std::vector<std::string>& words,
                                        std::string_view separator) {
    std::string out;
    for (const std::string& word : words) {
        if (!out.empty()) out += separator;
        out += word;
    }
    return out;
}

/// In single quotes, whatever is in it.
[[nodiscard]] inline std::string quoted(std::string_view text) {
    std::string out = "'";
    for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return out + "'";
}

}  // namespace trisect::app
