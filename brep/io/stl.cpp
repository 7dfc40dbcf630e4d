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
#include <trisect/brep/io/detail/binary.h>
#include <trisect/brep/io/detail/formats.h>
#include <trisect/brep/io/detail/mesh_builder.h>
#include <trisect/brep/io/detail/text_cursor.h>
#include <trisect/brep/io/detail/trailing.h>
#include <trisect/brep/io/detail/vertex_welder.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace trisect::detail {
namespace {

/// Welds corners and adds them to a mesh, with the limits of the builder.
class SoupBuilder {
public:
    SoupBuilder(const Source& source, std::uint64_t faces_hint)
        : mesh_(source, 0), welder_(mesh_.points(), faces_hint / 2) {
        mesh_.reserve(faces_hint / 2, faces_hint, 3 * faces_hint);
    }
    void add_corner(const Point3d& p, const char* at) {
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
    std::uint32_t known_ = 0;
};

class AsciiReader {
public:
    explicit AsciiReader(const Source& source)
        : source_(source),
          text_(source, TextRules{}),
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

    void facet(const char* at) {
        normal();
        expect("loop");
        for (int i = 0; i < 3; ++i) vertex();
        expect("endloop");
        expect("endfacet");
        soup_.end_face(at);
    }

    /// Skips `normal` and up to three words, which nobody reads, and the word `outer`.
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

    const Source& source_;
    TextCursor text_;
    SoupBuilder soup_;
};

/// The count of a binary STL, once it is known to fit the size of the file.
std::uint64_t checked_count(const Source& source) {
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

Point3d load_corner(const Source& source, const char* at) {
    Point3d p;
    for (std::size_t i = 0; i < 3; ++i) {
        p[i] = static_cast<double>(load<float, false>(at + 4 * i));
        if (!std::isfinite(p[i])) source.fail(at + 4 * i, "a coordinate that is not finite");
    }
    return p;
}

}  // namespace

PolygonMesh read_stl_ascii(const Source& source) { return AsciiReader(source).read(); }

PolygonMesh read_stl_binary(const Source& source) {
    const std::uint64_t count = checked_count(source);
    SoupBuilder soup(source, count);
    const char* record = source.begin() + stl_header_size;
    for (std::uint64_t i = 0; i < count; ++i, record += stl_record_size) {
        for (std::size_t corner = 0; corner < 3; ++corner) {
            const char* at = record + 12 * (corner + 1);
            soup.add_corner(load_corner(source, at), at);
        }
        soup.end_face(record);
    }
    refuse_trailing_bytes(source, record, "the last triangle");
    return soup.finish();
}

}  // namespace trisect::detail
