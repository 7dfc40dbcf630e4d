// SPDX-License-Identifier: Apache-2.0
#include <trisect/brep/io/models/dxf/pairs.h>

#include <trisect/brep/io/formats/decimal.h>
#include <trisect/kernel/stop_scope.h>

#include <charconv>
#include <cmath>
#include <cstring>

namespace trisect::detail {
namespace {

constexpr bool is_dxf_blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

/// What is left of a signed number without its plus sign.
std::string_view without_plus(std::string_view word) {
    const bool has_plus = word.size() > 1 && word[0] == '+' && word[1] != '-';
    return has_plus ? word.substr(1) : word;
}

}  // namespace

DxfPairs::DxfPairs(const InputText& source) : source_(source), here_(source.begin()) {
    if (source.bytes().starts_with("\xEF\xBB\xBF")) here_ += 3;
    value_ = {here_, 0};
}

std::string_view DxfPairs::line() {
    if (here_ == source_.end()) source_.fail(here_, "the file ends before EOF");
    const auto rest = static_cast<std::size_t>(source_.end() - here_);
    const void* found = std::memchr(here_, source_.line_end(), rest);
    const char* end = found != nullptr ? static_cast<const char*>(found) : source_.end();
    if (static_cast<std::uint64_t>(end - here_) > source_.limits().line_bytes)
        source_.fail_limit(
            here_, "a line of more than " + std::to_string(source_.limits().line_bytes) + " bytes");
    const char* first = here_;
    here_ = found != nullptr ? end + 1 : end;
    while (first != end && is_dxf_blank(*first)) ++first;
    while (end != first && is_dxf_blank(end[-1])) --end;
    return {first, static_cast<std::size_t>(end - first)};
}

void DxfPairs::next() {
    check_stop();
    do {
        const std::string_view code = line();
        const auto [stop, error] = std::from_chars(code.data(), code.data() + code.size(), code_);
        if (code.empty() || error != std::errc{} || stop != code.data() + code.size())
            source_.fail(code.data(), "a group code expected, not " + shown_word(code));
        value_ = line();
    } while (code_ == 999);
}

double DxfPairs::real() const {
    const std::string_view word = without_plus(value_);
    double value = 0;
    const auto [stop, error] = nearest_double(word.data(), word.data() + word.size(), value);
    if (word.empty() || error != std::errc{} || stop != word.data() + word.size() ||
        !std::isfinite(value))
        fail(shown_word(value_) + " of group " + std::to_string(code_) + " is not a number");
    if (word.size() > source_.limits().literal_characters)
        source_.fail_limit(at(), "a number of more than " +
                                     std::to_string(source_.limits().literal_characters) +
                                     " characters");
    return value;
}

std::int64_t DxfPairs::integer() const {
    const std::string_view word = without_plus(value_);
    std::int64_t value = 0;
    const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (word.empty() || error != std::errc{} || stop != word.data() + word.size())
        fail(shown_word(value_) + " of group " + std::to_string(code_) + " is not a whole number");
    return value;
}

void DxfPairs::expect_end() {
    while (here_ != source_.end() && (is_dxf_blank(*here_) || *here_ == '\0' || *here_ == '\x1a'))
        ++here_;
    if (here_ != source_.end()) source_.fail(here_, "more data after EOF");
}

}  // namespace trisect::detail
