// SPDX-License-Identifier: Apache-2.0
#include "manifest_scan.h"

#include <algorithm>
#include <span>
#include <string>
#include <string_view>

namespace trisect::app {

namespace {

constexpr std::uint64_t block = std::uint64_t{1} << 20;
constexpr std::uint64_t cut_distance = std::uint64_t{1} << 16;
constexpr std::string_view wanted_key = "parts";

constexpr std::array<bool, 256> special_characters() {
    std::array<bool, 256> out{};
    for (const char c : std::string_view("\":,[]{}")) out[static_cast<unsigned char>(c)] = true;
    return out;
}

class Scanner {
public:
    /// Most characters are of numbers and of names, which are passed over.
    void take(std::string_view bytes, std::uint64_t at) {
        constexpr std::array<bool, 256> special = special_characters();
        for (std::size_t i = 0; i < bytes.size();) {
            if (in_string_) {
                i = pass_string(bytes, i);
                continue;
            }
            while (i < bytes.size() && !special[static_cast<unsigned char>(bytes[i])]) ++i;
            if (i == bytes.size()) return;
            take(bytes[i], at + i);
            ++i;
        }
    }
    [[nodiscard]] std::optional<PartsPlace> found() const {
        if (lists_ != 1 || in_parts_ || is_odd_) return std::nullopt;
        return place_;
    }

private:
    void take(char c, std::uint64_t at) {
        switch (c) {
            case '"':
                in_string_ = true;
                word_.clear();
                break;
            case ':':
                if (depth_ == 1) is_wanted_ = word_ == wanted_key;
                break;
            case '[':
            case '{':
                if (depth_++ == 1 && is_wanted_) begin(c, at);
                break;
            case ']':
            case '}':
                if (--depth_ == 1 && in_parts_) end(c, at);
                break;
            case ',':
                if (depth_ == 1) is_wanted_ = false;
                if (in_parts_ && depth_ == 2) cut(at);
                break;
            default:
                break;
        }
    }
    // To the character after its next end or escape.
    [[nodiscard]] std::size_t pass_string(std::string_view bytes, std::size_t i) {
        const std::size_t begin = i;
        if (is_escaped_) {
            is_escaped_ = false;
            ++i;
        }
        while (i < bytes.size() && bytes[i] != '"' && bytes[i] != '\\') ++i;
        const bool has_more = i < bytes.size();
        in_string_ = !has_more || bytes[i] != '"';
        is_escaped_ = has_more && in_string_;
        const std::size_t end = i + (is_escaped_ ? 1 : 0);
        if (depth_ == 1 && word_.size() <= wanted_key.size())
            word_ += bytes.substr(begin, std::min(end - begin, wanted_key.size() + 1));
        return has_more ? i + 1 : i;
    }
    void begin(char c, std::uint64_t at) {
        is_odd_ |= c != '[';
        ++lists_;
        in_parts_ = true;
        is_wanted_ = false;
        place_.begin = at + 1;
    }
    void end(char c, std::uint64_t at) {
        is_odd_ |= c != ']';
        in_parts_ = false;
        place_.end = at;
    }
    void cut(std::uint64_t at) {
        if (at - (place_.cuts.empty() ? place_.begin : place_.cuts.back()) >= cut_distance)
            place_.cuts.push_back(at);
    }

    PartsPlace place_;
    std::string word_;  // the beginning of the last string of the whole
    std::int64_t depth_ = 0;
    std::size_t lists_ = 0;
    bool in_string_ = false;
    bool is_escaped_ = false;
    bool is_wanted_ = false;
    bool in_parts_ = false;
    bool is_odd_ = false;
};

}  // namespace

std::array<std::uint64_t, 2> PartsPlace::share(std::size_t i, std::size_t shares) const {
    const auto cut_of = [&](std::size_t s) {
        if (s == 0) return begin;
        if (s == shares) return end;
        const auto at = std::ranges::lower_bound(cuts, begin + (end - begin) * s / shares);
        return at == cuts.end() ? end : *at;
    };
    const std::uint64_t first = cut_of(i);
    const std::uint64_t last = cut_of(i + 1);
    // The comma is of neither.
    return {std::min(first == begin || first == end ? first : first + 1, last), last};
}

std::optional<PartsPlace> find_parts(const InputFile& file) {
    Scanner scanner;
    std::string bytes;
    for (std::uint64_t at = 0; at < file.size(); at += block) {
        bytes.resize(std::min(block, file.size() - at));
        file.read(at, std::span(bytes.data(), bytes.size()));
        scanner.take(bytes, at);
    }
    return scanner.found();
}

}  // namespace trisect::app
