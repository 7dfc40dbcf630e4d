// SPDX-License-Identifier: Apache-2.0
#include <trisect/bsp/csg/drawing/dxf_groups.h>

#include <charconv>
#include <cmath>

namespace trisect::detail {

bool DxfGroups::next() {
    // A text value may be empty, a code may not; empty lines at the end of the file are no group.
    do {
        if (!cursor_.next_line()) return false;
    } while (cursor_.at_line_end());
    code_ = cursor_.integer("the code of a group");
    cursor_.expect_line_end();
    const char* const code = cursor_.here();
    if (!cursor_.next_line()) source_.fail(code, "the file ends after the code of a group");
    cursor_.at_line_end();
    const char* const first = cursor_.here();
    const char* last = cursor_.after_line();
    while (last != first && static_cast<unsigned char>(last[-1]) <= ' ') --last;
    value_ = {first, static_cast<std::size_t>(last - first)};
    return true;
}

double DxfGroups::number() const {
    double out = 0;
    const char* const last = value_.data() + value_.size();
    const char* const first = value_.data() + (value_.starts_with('+') ? 1 : 0);
    if (value_.size() > source_.limits().literal_characters)
        source_.fail_limit(at(), "a number that is too long");
    const auto [stop, error] = nearest_double(first, last, out);
    if (error != std::errc{} || stop != last || !std::isfinite(out))
        source_.fail(at(), shown_word(value_) + " is not a finite number");
    return out;
}

std::int64_t DxfGroups::integer() const {
    std::int64_t out = 0;
    const char* const last = value_.data() + value_.size();
    const auto [stop, error] = std::from_chars(value_.data(), last, out);
    if (error != std::errc{} || stop != last)
        source_.fail(at(), shown_word(value_) + " is not an integer");
    return out;
}

}  // namespace trisect::detail
