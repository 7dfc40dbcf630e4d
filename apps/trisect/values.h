// SPDX-License-Identifier: Apache-2.0
//
// Values of options as text.
// They are parsed here and not by the option library, because that follows the locale and accepts
// what is only half a number.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace trisect::app {

/// A finite number, the whole text, as the nearest double. \throw UsageError naming `what`.
[[nodiscard]] double parse_number(std::string_view text, std::string_view what);
/// The same for an integer.
[[nodiscard]] std::int64_t parse_integer(std::string_view text, std::string_view what);
/// "1500", "64K", "512M", "4G", "1T": bytes, with factors of 1024. Never 0.
[[nodiscard]] std::uint64_t parse_bytes(std::string_view text, std::string_view what);
/// Numbers separated by commas.
[[nodiscard]] std::vector<double> parse_numbers(std::string_view text, std::string_view what);

template <std::size_t N>
[[nodiscard]] std::array<double, N> parse_tuple(std::string_view text, std::string_view what);

extern template std::array<double, 3> parse_tuple<3>(std::string_view, std::string_view);
extern template std::array<double, 4> parse_tuple<4>(std::string_view, std::string_view);

/// Shortest digits that read back as the same double.
[[nodiscard]] std::string number_text(double value);

}  // namespace trisect::app
