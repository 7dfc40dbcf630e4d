// SPDX-License-Identifier: Apache-2.0
//
// SvgScanner: numbers and letters of attributes of SVG.
#pragma once

#include <trisect/brep/io/formats/decimal.h>
#include <trisect/brep/io/formats/input_text.h>

#include <algorithm>
#include <cmath>
#include <string_view>

namespace trisect::detail {

/// Errors are at the element, since an attribute has no place of its own.
class SvgScanner {
public:
    SvgScanner(const InputText& source, const char* at, std::string_view text)
        : source_(source), at_(at), text_(text) {}

    /// Passes blanks and commas.
    bool at_end() {
        const std::size_t n = text_.find_first_not_of(" \t\r\n\f,");
        text_.remove_prefix(n == std::string_view::npos ? text_.size() : n);
        return text_.empty();
    }
    /// The next character, which is not taken; 0 at the end.
    [[nodiscard]] char next() { return at_end() ? '\0' : text_.front(); }
    [[nodiscard]] bool is_at_number() {
        const char c = next();
        return (c >= '0' && c <= '9') || c == '+' || c == '-' || c == '.';
    }
    char take() {
        const char c = next();
        if (c != '\0') text_.remove_prefix(1);
        return c;
    }
    /// Up to the first of these characters, which is not taken.
    std::string_view take_until(std::string_view ends) {
        const std::size_t n = std::min(text_.find_first_of(ends), text_.size());
        const std::string_view out = text_.substr(0, n);
        text_.remove_prefix(n);
        return out;
    }

    /// A finite number. \throw InputError
    double number() {
        if (!is_at_number()) fail();
        if (text_.front() == '+') text_.remove_prefix(1);
        double out = 0;
        const char* const first = text_.data();
        const auto [stop, error] = nearest_double(first, first + text_.size(), out);
        if (error != std::errc{} || !std::isfinite(out)) fail();
        text_.remove_prefix(static_cast<std::size_t>(stop - first));
        return out;
    }
    /// 0 or 1, which need not be apart from what follows.
    bool flag() {
        const char c = take();
        if (c != '0' && c != '1') fail();
        return c == '1';
    }
    [[noreturn]] void fail() const {
        source_.fail(at_, text_.empty() ? "the attribute ends early"
                                        : shown_word(text_) + " is not expected here");
    }

private:
    const InputText& source_;
    const char* at_;
    std::string_view text_;
};

}  // namespace trisect::detail
