// SPDX-License-Identifier: Apache-2.0
//
// Numbers as the shortest digits that read back exactly (std::to_chars).
#pragma once

#include <trisect/brep/polygon_mesh.h>

#include <charconv>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

namespace trisect::detail {

/// Text on its way into a string, gathered in a buffer because single characters and numbers are
/// appended slowly. finish() hands the last of it over.
class TextWriter {
public:
    explicit TextWriter(std::string& out) : out_(out) {}
    TextWriter(const TextWriter&) = delete;
    TextWriter& operator=(const TextWriter&) = delete;
    void finish() {
        out_.append(text_, end_);
        end_ = text_;
    }

    /// A word of at most 64 characters.
    TextWriter& operator<<(std::string_view word) {
        make_room();
        std::memcpy(end_, word.data(), word.size());
        end_ += word.size();
        return *this;
    }
    TextWriter& operator<<(char c) { return *this << std::string_view(&c, 1); }
    TextWriter& operator<<(std::uint64_t value) { return number(value); }
    TextWriter& operator<<(float value) { return number(value); }
    TextWriter& operator<<(double value) { return number(value); }
    /// `x y z`
    TextWriter& operator<<(const Point3d& p) { return *this << p[0] << ' ' << p[1] << ' ' << p[2]; }

private:
    /// At most 24 characters, for instance -2.2250738585072014e-308.
    template <class Number>
    TextWriter& number(Number value) {
        make_room();
        end_ = std::to_chars(end_, text_ + sizeof(text_), value).ptr;
        return *this;
    }
    void make_room() {
        if (text_ + sizeof(text_) - end_ < 64) finish();
    }

    std::string& out_;
    char text_[4096];
    char* end_ = text_;
};

/// The faces as OFF and ASCII PLY have them: count and indices from 0, a line each.
inline void append_loops(TextWriter& text, const PolygonMesh& mesh) {
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        text << std::uint64_t{mesh.face(f).size()};
        for (const std::uint32_t corner : mesh.face(f)) text << ' ' << std::uint64_t{corner};
        text << '\n';
    }
}

/// Room for vertex and face lines; what is not used is never touched.
inline void reserve_text(std::string& out, const PolygonMesh& mesh) {
    out.reserve(out.size() + 80 * mesh.points.size() + 12 * mesh.corners.size() +
                14 * mesh.face_count() + 64);
}

}  // namespace trisect::detail
