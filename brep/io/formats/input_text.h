// SPDX-License-Identifier: Apache-2.0
//
// InputText: the bytes of an input, their limits, and its errors.
// Readers report errors through it alone. They hold plain pointers into the bytes; line and
// column are counted when an error needs them, so that the fast path counts nothing.
#pragma once

#include <trisect/brep/io/read_mesh.h>
#include <trisect/kernel/error.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>

namespace trisect::detail {

class InputText {
public:
    InputText(std::string_view bytes, std::string name, const ReadLimits& limits, bool binary)
        : bytes_(bytes), name_(std::move(name)), limits_(limits), binary_(binary) {
        // The first line end decides the convention: a CR that no LF follows means bare CR.
        const std::size_t eol = bytes.find_first_of("\r\n");
        if (eol != std::string_view::npos && bytes[eol] == '\r' &&
            (eol + 1 == bytes.size() || bytes[eol + 1] != '\n')) {
            line_end_ = '\r';
        }
    }

    [[nodiscard]] const char* begin() const noexcept { return bytes_.data(); }
    [[nodiscard]] const char* end() const noexcept { return bytes_.data() + bytes_.size(); }
    [[nodiscard]] std::string_view bytes() const noexcept { return bytes_; }
    [[nodiscard]] const ReadLimits& limits() const noexcept { return limits_; }
    [[nodiscard]] char line_end() const noexcept { return line_end_; }
    /// Whether readers may take their fast paths. The result is the same; tests compare.
    [[nodiscard]] bool allows_quick() const noexcept { return quick_; }
    [[nodiscard]] InputText carefully() const {
        InputText copy = *this;
        copy.quick_ = false;
        return copy;
    }
    /// Who takes the mesh piece by piece; null: readers return it.
    [[nodiscard]] MeshSink* sink() const noexcept { return sink_; }
    void give_pieces_to(MeshSink* sink) noexcept { sink_ = sink; }
    /// The same bytes with places given as byte offsets: the body of a binary PLY.
    [[nodiscard]] InputText as_binary() const {
        InputText copy = *this;
        copy.binary_ = true;
        return copy;
    }

    [[noreturn]] void fail(const char* at, const std::string& message) const {
        throw InputError(place(at), message);
    }
    [[noreturn]] void fail_limit(const char* at, const std::string& message) const {
        throw LimitError(place(at).to_string() + ": " + message);
    }

    [[nodiscard]] FilePlace place(const char* at) const {
        FilePlace p{name_, 0, 0, static_cast<std::uint64_t>(at - begin())};
        if (binary_) return p;
        const std::string_view before = bytes_.substr(0, p.offset);
        p.line =
            1 + static_cast<std::uint64_t>(std::count(before.begin(), before.end(), line_end_));
        const std::size_t eol = before.rfind(line_end_);
        p.column = p.offset - (eol == std::string_view::npos ? 0 : eol + 1) + 1;
        return p;
    }

private:
    std::string_view bytes_;
    std::string name_;
    ReadLimits limits_;
    bool binary_;
    bool quick_ = true;
    MeshSink* sink_ = nullptr;
    char line_end_ = '\n';
};

/// A word of the file as it may stand in a message: quoted, short, without control characters.
[[nodiscard]] inline std::string shown_word(std::string_view word) {
    constexpr std::size_t longest = 40;
    std::string s = "'";
    for (const char c : word.substr(0, longest)) {
        const bool plain = c >= ' ' && c <= '~';
        s += plain ? c : '?';
    }
    return s + (word.size() > longest ? "...'" : "'");
}

}  // namespace trisect::detail
