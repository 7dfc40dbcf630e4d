// SPDX-License-Identifier: Apache-2.0
#include "values.h"

#include <trisect/brep/io/formats/decimal.h>
#include <trisect/kernel/error.h>

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <concepts>
#include <limits>
#include <system_error>

namespace trisect::app {
namespace {

[[noreturn]] void refuse(std::string_view what, std::string_view text, std::string_view wanted) {
    throw UsageError(fmt::format("{}: '{}' is not {}", what, text, wanted));
}

std::from_chars_result read(const char* first, const char* last, double& value) {
    return detail::nearest_double(first, last, value);
}
template <std::integral Number>
std::from_chars_result read(const char* first, const char* last, Number& value) {
    return std::from_chars(first, last, value);
}

template <class Number>
bool parse_whole(std::string_view text, Number& value) {
    // from_chars knows no plus sign.
    if (text.size() > 1 && text.front() == '+' && text[1] != '-') text.remove_prefix(1);
    const auto [end, error] = read(text.data(), text.data() + text.size(), value);
    return error == std::errc{} && end == text.data() + text.size();
}

}  // namespace

double parse_number(std::string_view text, std::string_view what) {
    double value = 0;
    if (!parse_whole(text, value) || !std::isfinite(value)) refuse(what, text, "a finite number");
    return value;
}

std::int64_t parse_integer(std::string_view text, std::string_view what) {
    std::int64_t value = 0;
    if (!parse_whole(text, value)) refuse(what, text, "an integer");
    return value;
}

std::uint64_t parse_bytes(std::string_view text, std::string_view what) {
    constexpr std::string_view wanted = "a number of bytes such as 512M or 4G";
    constexpr std::string_view units = "KMGT";
    unsigned shift = 0;
    std::string_view digits = text;
    if (!digits.empty()) {
        const char last = digits.back();
        const auto unit = units.find(last >= 'a' && last <= 'z' ? char(last - 'a' + 'A') : last);
        if (unit != std::string_view::npos) {
            shift = 10 * (static_cast<unsigned>(unit) + 1);
            digits.remove_suffix(1);
        }
    }
    std::uint64_t value = 0;
    if (!parse_whole(digits, value) || value == 0) refuse(what, text, wanted);
    if (value > std::numeric_limits<std::uint64_t>::max() >> shift) refuse(what, text, wanted);
    return value << shift;
}

std::vector<double> parse_numbers(std::string_view text, std::string_view what) {
    std::vector<double> values;
    for (;;) {
        const auto comma = text.find(',');
        values.push_back(parse_number(text.substr(0, comma), what));
        if (comma == std::string_view::npos) return values;
        text.remove_prefix(comma + 1);
    }
}

template <std::size_t N>
std::array<double, N> parse_tuple(std::string_view text, std::string_view what) {
    const std::vector<double> values = parse_numbers(text, what);
    if (values.size() != N) refuse(what, text, fmt::format("{} numbers with commas between", N));
    std::array<double, N> result{};
    for (std::size_t i = 0; i < N; ++i) result[i] = values[i];
    return result;
}

template std::array<double, 3> parse_tuple<3>(std::string_view, std::string_view);
template std::array<double, 4> parse_tuple<4>(std::string_view, std::string_view);

std::string number_text(double value) {
    std::array<char, 32> buffer{};
    const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr;
    return std::string(buffer.data(), end);
}

}  // namespace trisect::app
