// SPDX-License-Identifier: Apache-2.0
//
// Reading STL (3D Systems, StereoLithography Interface Specification, 1989), ASCII and binary.
//
// STL is a soup of triangles; what joins them is the equality of coordinates, so corners are welded
// when they are exactly equal (VertexWelder). A tolerance would join what the author kept apart and
// would make the result depend on the order of the triangles.
//
// Leniencies, ASCII: keywords in either case, free use of white space and line ends, any name or
// none after `solid` and `endsolid`, any numbers or none after `facet` (the normal is ignored), any
// number of solids, which make one mesh. Binary: header and attribute bytes may be anything.
// Refused: a facet with other than three vertices, a solid without its `endsolid`, a count that
// does not fit the size of the file, and anything but white space or zero bytes after the end.
#include <trisect/brep/io/formats/binary.h>
#include <trisect/brep/io/formats/formats.h>
#include <trisect/brep/io/formats/mesh_builder.h>
#include <trisect/brep/io/formats/quick_items.h>
#include <trisect/brep/io/formats/quick_text.h>
#include <trisect/brep/io/formats/text_cursor.h>
#include <trisect/brep/io/formats/trailing.h>
#include <trisect/brep/io/formats/vertex_welder.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

#include <trisect/kernel/stop_scope.h>

namespace trisect::detail {
namespace {

/// Welds corners and adds them to a mesh, with the limits of the builder.
class SoupBuilder {
public:
    SoupBuilder(const InputText& source, std::uint64_t faces_hint)
        : mesh_(source, 0),
          welder_(mesh_.points(), source.sink() == nullptr ? faces_hint / 2 : 0),
          is_given_away_(source.sink() != nullptr) {
        mesh_.reserve(faces_hint / 2, faces_hint, 3 * faces_hint);
    }
    void add_corner(const Point3d& p, const char* at) {
        if (is_given_away_) {
            mesh_.add_point(p, at);
            mesh_.add_corner(mesh_.point_count() - 1, at);
            return;
        }
        const std::uint32_t v = welder_.vertex(p);
        if (v >= known_) {
            mesh_.check_point_count(at);
            known_ = v + 1;
        }
        mesh_.add_corner(v, at);
    }
    void end_face(const char* at) { mesh_.end_face(at); }
    [[nodiscard]] PolygonMesh finish() { return mesh_.finish(); }

private:
    MeshBuilder mesh_;
    VertexWelder welder_;
    bool is_given_away_;  // piece by piece, and not connected
    std::uint32_t known_ = 0;
};

class AsciiReader {
public:
    explicit AsciiReader(const InputText& source)
        : source_(source),
          text_(source, TextRules{}),
          quick_(source),
          // A facet takes about 200 bytes; a terse one a third of it.
          soup_(source, source.bytes().size() / 200) {}

    PolygonMesh read() {
        if (!text_.seek_word()) source_.fail(text_.here(), "no 'solid' in an ASCII STL");
        while (text_.seek_word()) solid();
        return soup_.finish();
    }

private:
    void solid() {
        expect("solid");
        (void)text_.next_line();  // the rest of the line is the name
        for (;;) {
            if (text_.at_line_end()) quick_facets();
            const std::string_view keyword = next("'facet' or 'endsolid'");
            if (is(keyword, "endsolid")) break;
            if (!is(keyword, "facet")) {
                source_.fail(keyword.data(),
                             shown_word(keyword) + " where 'facet' or 'endsolid' is expected");
            }
            facet(keyword.data());
        }
        (void)text_.next_line();
    }

    /// Facets of seven lines, each with its words in lower case and nothing else.
    void quick_facets() {
        const char* line = text_.after_line();
        for (; line < quick_.end() && quick_facet(line); ++quick_items) line = quick_.here();
        text_.resume_at(line);
    }

    bool quick_facet(const char* line) {
        std::array<Point3d, 3> p;
        std::array<const char*, 3> at{};
        quick_.begin(line);
        (void)quick_.blanks();
        const char* const facet = quick_.here();
        if (!quick_.keyword("facet") || !quick_.keyword("normal")) return false;
        for (int i = 0; i < 3; ++i)
            if (!quick_.word()) return false;
        if (!next_quick_line() || !quick_.keyword("outer") || !quick_.last_word("loop"))
            return false;
        for (std::size_t i = 0; i < 3; ++i) {
            if (!next_quick_line()) return false;
            at[i] = quick_.here() + std::string_view("vertex").size();
            if (!quick_.keyword("vertex")) return false;
            for (double& c : p[i])
                if (!quick_.number(c)) return false;
        }
        if (!next_quick_line() || !quick_.last_word("endloop")) return false;
        if (!next_quick_line() || !quick_.last_word("endfacet")) return false;
        if (!quick_.line_end()) return false;
        for (std::size_t i = 0; i < 3; ++i) soup_.add_corner(p[i], at[i]);
        soup_.end_face(facet);
        return true;
    }

    /// Goes on to the first word of the next line; no scan may leave the text.
    bool next_quick_line() {
        if (!quick_.line_end() || quick_.here() >= quick_.end()) return false;
        (void)quick_.blanks();
        return true;
    }

    void facet(const char* at) {
        normal();
        expect("loop");
        for (int i = 0; i < 3; ++i) vertex();
        expect("endloop");
        expect("endfacet");
        soup_.end_face(at);
    }

    /// Skips `normal` and up to three words, which are not used, and the word `outer`.
    void normal() {
        std::string_view word = next("'outer loop'");
        for (int i = 0; i < 4 && !is(word, "outer"); ++i) word = next("'outer loop'");
        if (!is(word, "outer")) {
            source_.fail(word.data(), shown_word(word) + " where 'outer loop' is expected");
        }
    }

    void vertex() {
        expect("vertex");
        const char* at = text_.here();
        Point3d p;
        for (double& c : p) {
            (void)text_.seek_word();
            c = text_.real("a coordinate of a vertex");
        }
        soup_.add_corner(p, at);
    }

    std::string_view next(const char* expected) {
        if (!text_.seek_word()) {
            source_.fail(text_.here(),
                         std::string("the file ends where ") + expected + " is expected");
        }
        return text_.word();
    }

    void expect(const char* keyword) {
        const std::string_view word = next(keyword);
        if (!is(word, keyword)) {
            source_.fail(word.data(), shown_word(word) + " where '" + keyword + "' is expected");
        }
    }

    static bool is(std::string_view word, std::string_view keyword) noexcept {
        return std::equal(word.begin(), word.end(), keyword.begin(), keyword.end(),
                          [](char a, char b) { return a == b || a == b - 'a' + 'A'; });
    }

    const InputText& source_;
    TextCursor text_;
    QuickText quick_;
    SoupBuilder soup_;
};

/// The count of a binary STL, once it is known to fit the size of the file.
std::uint64_t checked_count(const InputText& source) {
    const std::uint64_t size = source.bytes().size();
    if (size < stl_header_size) {
        source.fail(source.end(), "a binary STL has at least 84 bytes, this file has " +
                                      std::to_string(size) +
                                      "; an ASCII STL would begin with 'solid'");
    }
    const std::uint64_t count = load<std::uint32_t, false>(source.begin() + 80);
    const std::uint64_t needed = stl_header_size + count * stl_record_size;
    if (needed > size) {
        const std::string cause = size - stl_header_size < stl_record_size && count > 0xFFFFFFU
                                      ? "; or it is a text, which would begin with 'solid'"
                                      : "";
        source.fail(source.end(), "the file ends inside its triangles: a binary STL of " +
                                      std::to_string(count) + " triangles has " +
                                      std::to_string(needed) + " bytes, this file " +
                                      std::to_string(size) + cause);
    }
    if (count > source.limits().faces) {
        source.fail_limit(
            source.begin() + 80,
            "more than " + std::to_string(source.limits().faces) + " faces, the limit for a file");
    }
    return count;
}

Point3d load_corner(const InputText& source, const char* at) {
    Point3d p;
    for (std::size_t i = 0; i < 3; ++i) {
        p[i] = static_cast<double>(load<float, false>(at + 4 * i));
        if (!std::isfinite(p[i])) source.fail(at + 4 * i, "a coordinate that is not finite");
    }
    return p;
}

/// Any file: every corner is checked for every error and limit.
PolygonMesh read_records(const InputText& source, std::uint64_t count) {
    SoupBuilder soup(source, count);
    const char* record = source.begin() + stl_header_size;
    for (std::uint64_t i = 0; i < count; ++i, record += stl_record_size) {
        for (std::size_t corner = 0; corner < 3; ++corner) {
            const char* at = record + 12 * (corner + 1);
            soup.add_corner(load_corner(source, at), at);
        }
        soup.end_face(record);
    }
    return soup.finish();
}

/// Loads the corners of some records; false when a coordinate is not finite.
bool load_corners(const char* record, std::size_t count, Point3d* out) {
    std::uint32_t largest = 0;
    for (std::size_t i = 0; i < count; ++i, record += stl_record_size)
        for (std::size_t corner = 0; corner < 3; ++corner, ++out)
            for (std::size_t k = 0; k < 3; ++k) {
                const char* at = record + 12 * (corner + 1) + 4 * k;
                largest = std::max(largest, load<std::uint32_t, false>(at) & 0x7FFF'FFFFU);
                (*out)[k] = static_cast<double>(load<float, false>(at));
            }
    return largest < 0x7F80'0000U;
}

/// Files without errors that are far from all limits, in blocks; nothing for others.
std::optional<PolygonMesh> read_records_quickly(const InputText& source, std::uint64_t count) {
    constexpr std::size_t block = VertexWelder::block / 3;
    if (!source.allows_quick() || source.sink() != nullptr || count > 0x4000'0000U)
        return std::nullopt;
    if (source.limits().loop_corners < 3) return std::nullopt;
    PolygonMesh mesh;
    VertexWelder welder(mesh.points, count / 2);
    mesh.points.reserve(count / 2 + 2);
    mesh.corners.resize(3 * count);
    std::array<Point3d, VertexWelder::block> points;
    const char* record = source.begin() + stl_header_size;
    for (std::size_t i = 0; i < count; i += block) {
        detail::check_stop(block);
        const std::size_t n = std::min(block, static_cast<std::size_t>(count) - i);
        if (!load_corners(record, n, points.data())) return std::nullopt;
        welder.vertices({points.data(), 3 * n}, &mesh.corners[3 * i]);
        record += n * stl_record_size;
    }
    if (mesh.points.size() > source.limits().vertices) return std::nullopt;
    quick_items += count;
    mesh.face_begin.resize(count + 1);
    for (std::size_t i = 0; i <= count; ++i) mesh.face_begin[i] = static_cast<std::uint32_t>(3 * i);
    return mesh;
}

}  // namespace

PolygonMesh read_stl_ascii(const InputText& source) { return AsciiReader(source).read(); }

PolygonMesh read_stl_binary(const InputText& source) {
    const std::uint64_t count = checked_count(source);
    auto quick = read_records_quickly(source, count);
    PolygonMesh mesh = quick ? *std::move(quick) : read_records(source, count);
    refuse_trailing_bytes(source, source.begin() + stl_header_size + count * stl_record_size,
                          "the last triangle");
    return mesh;
}

}  // namespace trisect::detail
