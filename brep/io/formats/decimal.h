// SPDX-License-Identifier: Apache-2.0
//
// Decimal numbers as the nearest doubles.
#pragma once

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <system_error>

namespace trisect::detail {

/// The number after the `e`, cut off at a size that no mantissa can make up for.
inline std::int64_t decimal_exponent(std::string_view text) noexcept {
    constexpr std::int64_t huge = std::int64_t{1} << 62;
    if (text.empty()) return 0;
    text.remove_prefix(text.substr(1, 1) == "+" ? 2 : 1);
    std::int64_t value = 0;
    const auto error = std::from_chars(text.data(), text.data() + text.size(), value).ec;
    if (error == std::errc::result_out_of_range) return text[0] == '-' ? -huge : huge;
    return std::min(std::max(value, -huge), huge);
}

/// Whether a number beyond the range of doubles is large, and not near zero: the two are
/// distinguished by the decimal position of the first digit that is not 0.
inline bool is_large_decimal(std::string_view text) noexcept {
    const std::size_t e = std::min(text.find_first_of("eE"), text.size());
    const std::string_view mantissa = text.substr(0, e);
    const std::size_t point = std::min(mantissa.find('.'), mantissa.size());
    const std::size_t digit = std::min(mantissa.find_first_of("123456789"), mantissa.size());
    const auto position = static_cast<std::int64_t>(point) - static_cast<std::int64_t>(digit);
    return position + decimal_exponent(text.substr(e)) > 0;
}

/// std::from_chars for doubles, which rounds correctly but reports overflow and underflow alike and
/// leaves the value alone in both. Here what rounds to zero is zero, with its sign, and
/// result_out_of_range means too large.
inline std::from_chars_result nearest_double(const char* first, const char* last,
                                             double& value) noexcept {
    std::from_chars_result result = std::from_chars(first, last, value);
    if (result.ec != std::errc::result_out_of_range) return result;
    const std::string_view text(first, static_cast<std::size_t>(result.ptr - first));
    if (is_large_decimal(text)) return result;
    value = text[0] == '-' ? -0.0 : 0.0;
    result.ec = std::errc{};
    return result;
}

}  // namespace trisect::detail
