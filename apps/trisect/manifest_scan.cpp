// SPDX-License-Identifier: Apache-2.0
#include "manifest_scan.h"

#include <algorithm>
#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace trisect::app {

namespace {

constexpr std::uint64_t least_window = std::uint64_t{1} << 16;
constexpr std::string_view key_of_parts = "parts";
constexpr std::string_view key_of_a_part = "file";

// Brackets and strings of the whole, from the beginning or from a comma between two parts.
class Scanner {
public:
    enum class At : std::uint8_t { Document, Parts };
    explicit Scanner(At at) : depth_(at == At::Parts ? 2 : 0), in_parts_(at == At::Parts) {}

    /// Stops behind a bracket that begins or ends the list of parts. How many characters it took.
    std::size_t take(std::string_view bytes) {
        for (std::size_t i = 0; i < bytes.size(); ++i) {
            if (in_string_)
                take_in_string(bytes[i]);
            else if (take(bytes[i]))
                return i + 1;
        }
        return bytes.size();
    }
    [[nodiscard]] bool is_in_parts() const { return in_parts_; }
    [[nodiscard]] std::size_t lists() const { return lists_; }  ///< that were begun
    [[nodiscard]] bool is_odd() const { return is_odd_; }
    [[nodiscard]] std::int64_t depth() const { return depth_; }

private:
    void take_in_string(char c) {
        if (std::exchange(is_escaped_, false)) return;
        if (c == '\\')
            is_escaped_ = true;
        else if (c == '"')
            in_string_ = false;
        else if (depth_ == 1 && word_.size() <= key_of_parts.size())
            word_ += c;
    }
    // Whether the list of parts begins or ends here.
    bool take(char c) {
        switch (c) {
            case '"':
                in_string_ = true;
                word_.clear();
                return false;
            case ':':
                if (depth_ == 1) is_wanted_ = word_ == key_of_parts;
                return false;
            case ',':
                if (depth_ == 1) is_wanted_ = false;
                return false;
            case '[':
            case '{':
                return depth_++ == 1 && is_wanted_ && begin(c);
            case ']':
            case '}':
                return --depth_ == 1 && in_parts_ && end(c);
            default:
                return false;
        }
    }
    bool begin(char c) {
        is_odd_ |= c != '[';
        ++lists_;
        in_parts_ = true;
        is_wanted_ = false;
        return true;
    }
    bool end(char c) {
        is_odd_ |= c != ']';
        in_parts_ = false;
        return true;
    }

    std::string word_;  // the beginning of the last string of the whole
    std::int64_t depth_;
    std::size_t lists_ = 0;
    bool in_string_ = false;
    bool is_escaped_ = false;
    bool is_wanted_ = false;
    bool in_parts_;
    bool is_odd_ = false;
};

std::string text_of(const InputFile& file, std::uint64_t begin, std::uint64_t end) {
    std::string out(end - begin, '\0');
    file.read(begin, std::span(out.data(), out.size()));
    return out;
}

std::size_t behind_space(std::string_view text, std::size_t i) {
    return std::min(text.find_first_not_of(" \t\r\n", i), text.size());
}

// Whether an object is a part, which has a file; nothing where the text ends before it does.
std::optional<bool> is_part(std::string_view text) {
    std::size_t depth = 0;
    bool has_file = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '{' || text[i] == '[') ++depth;
        if ((text[i] == '}' || text[i] == ']') && --depth == 0) return has_file;
        if (text[i] != '"') continue;
        const std::size_t begin = ++i;
        for (; i < text.size() && text[i] != '"'; ++i)
            if (text[i] == '\\') ++i;
        if (depth == 1 && i < text.size() && text.substr(begin, i - begin) == key_of_a_part) {
            const std::size_t next = behind_space(text, i + 1);
            has_file |= next < text.size() && text[next] == ':';
        }
    }
    return std::nullopt;
}

// The first comma between two objects of which the second is a part. Nothing is found in a text
// that ends before that is certain.
std::optional<std::size_t> first_cut(std::string_view text) {
    for (std::size_t i = text.find('}'); i != std::string_view::npos; i = text.find('}', i + 1)) {
        const std::size_t comma = behind_space(text, i + 1);
        if (comma == text.size() || text[comma] != ',') continue;
        const std::size_t next = behind_space(text, comma + 1);
        if (next == text.size() || text[next] != '{') continue;
        if (const auto part = is_part(text.substr(next)); !part || *part)
            return part ? std::optional(comma) : std::nullopt;
    }
    return std::nullopt;
}

// The same from a place on.
std::optional<std::uint64_t> cut_behind(const InputFile& file, std::uint64_t from,
                                        std::uint64_t end) {
    for (std::uint64_t window = least_window;; window *= 4) {
        const std::uint64_t to = std::min(end, from + window);
        if (const auto at = first_cut(text_of(file, from, to))) return from + *at;
        if (to == end) return std::nullopt;
    }
}

// The end of the list, as seen from a place in it, where nothing behind it is another list.
std::optional<std::uint64_t> end_behind(const InputFile& file, std::uint64_t from) {
    const std::string text = text_of(file, from, file.size());
    std::string_view rest(text);
    Scanner scanner(Scanner::At::Parts);
    rest.remove_prefix(scanner.take(rest));
    if (scanner.is_in_parts()) return std::nullopt;
    const std::uint64_t end = file.size() - rest.size() - 1;
    while (!rest.empty()) rest.remove_prefix(scanner.take(rest));
    if (scanner.lists() != 0 || scanner.is_odd() || scanner.depth() != 0) return std::nullopt;
    return end;
}

std::optional<std::uint64_t> begin_of_parts(const InputFile& file) {
    Scanner scanner(Scanner::At::Document);
    for (std::uint64_t at = 0; at < file.size(); at += least_window) {
        const std::uint64_t to = std::min(file.size(), at + least_window);
        const std::uint64_t begin = at + scanner.take(text_of(file, at, to));
        if (!scanner.is_in_parts()) continue;
        return scanner.is_odd() ? std::nullopt : std::optional(begin);
    }
    return std::nullopt;
}

}  // namespace

std::array<std::uint64_t, 2> PartsPlace::share(const InputFile& file, std::size_t i,
                                               std::size_t shares) const {
    const auto cut_of = [&](std::size_t s) {
        if (s == 0) return begin;
        if (s == shares) return end;
        return cut_behind(file, begin + (end - begin) * s / shares, end).value_or(end);
    };
    const std::uint64_t first = cut_of(i);
    const std::uint64_t last = cut_of(i + 1);
    // The comma is of neither.
    return {std::min(first == begin || first == end ? first : first + 1, last), last};
}

std::optional<PartsPlace> find_parts(const InputFile& file) {
    const auto begin = begin_of_parts(file);
    if (!begin) return std::nullopt;
    for (std::uint64_t window = least_window;; window *= 4) {
        const bool is_all = file.size() - *begin <= window;
        const std::uint64_t from = is_all ? *begin : file.size() - window;
        const auto cut = is_all ? begin : cut_behind(file, from, file.size());
        const auto end = cut ? end_behind(file, *cut) : std::nullopt;
        if (end) return PartsPlace{*begin, *end};
        if (is_all) return std::nullopt;
    }
}

}  // namespace trisect::app
