// SPDX-License-Identifier: Apache-2.0
//
// OFF, the object file format of Geomview (Geomview manual, section "OFF Files").
//
// The header says which numbers a vertex has: [ST][C][N][4][n]OFF. In the wild it says too little
// (plain OFF with colours), stands on the line of the counts, runs into them (`OFF490 518 0`), or
// is missing. So a vertex is the first three numbers of its line and the header is not believed
// about the rest; to keep two vertices on one line from passing as a vertex with a colour, every
// vertex line must have equally many numbers. With that rule a file whose lines are not one item
// each can never lose a vertex in silence: its face lines would have to look like its vertex lines,
// and then the counts come out wrong.
//
// Leniencies: comments from `#` before a word or after a number and blank lines anywhere; the
// number of edges may be missing; numbers after the indices of a face (its colour) are ignored, as
// is a vertex's normal, colour or texture position. Each vertex stands on its own line, and each
// face begins one. Refused: the four-dimensional (4OFF, nOFF) and the binary variant, anything
// after the last face.
#include <trisect/brep/io/formats/formats.h>
#include <trisect/brep/io/formats/mesh_builder.h>
#include <trisect/brep/io/formats/number_text.h>
#include <trisect/brep/io/formats/quick_items.h>
#include <trisect/brep/io/formats/quick_loop.h>
#include <trisect/brep/io/formats/quick_text.h>
#include <trisect/brep/io/formats/text_cursor.h>

#include <algorithm>
#include <cstdint>

namespace trisect::detail {
namespace {

class OffReader {
public:
    explicit OffReader(const InputText& source)
        : source_(source),
          text_(source, TextRules{.hash_comments = true, .continuation = false}),
          quick_(source),
          mesh_(source, 0) {}

    PolygonMesh read() {
        header();
        counts();
        for (std::uint64_t i = quick_vertices(0); i < vertices_; i = quick_vertices(i + 1))
            vertex(i);
        for (std::uint64_t i = quick_faces(0); i < faces_; i = quick_faces(i + 1)) face(i);
        if (text_.seek_word()) {
            const std::string_view extra = text_.word();
            source_.fail(extra.data(), shown_word(extra) + " after the last of the " +
                                           std::to_string(faces_) +
                                           " faces that the header states");
        }
        return mesh_.finish();
    }

private:
    /// Reads the keyword, if any, and leaves the cursor before the counts.
    void header() {
        if (!text_.seek_word()) source_.fail(text_.here(), "no OFF header and no counts");
        const char* at = text_.here();
        const std::string_view word = text_.word();
        const std::size_t n = word.find("OFF");
        const std::string_view prefix = word.substr(0, n);
        if (n == std::string_view::npos ||
            prefix.find_first_not_of("STCN4n") != std::string_view::npos) {
            if (!is_digit(*at)) source_.fail(at, shown_word(word) + " is no OFF header");
            return text_.go_back_to(at);  // without a keyword: the counts come first
        }
        if (prefix.find_first_of("4n") != std::string_view::npos) {
            source_.fail(at, "OFF with other than three dimensions cannot be read");
        }
        if (word.size() > n + 3 && !is_digit(word[n + 3])) {
            source_.fail(at, shown_word(word) + " is no OFF header");
        }
        text_.go_back_to(at + n + 3);
        if (!text_.at_line_end() && text_.at('B')) {
            source_.fail(text_.here(), "binary OFF cannot be read");
        }
    }

    static bool is_digit(char c) noexcept { return c >= '0' && c <= '9'; }

    void counts() {
        (void)text_.seek_word();
        const char* at = text_.here();
        vertices_ = text_.count("the number of vertices");
        (void)text_.seek_word();
        faces_ = text_.count("the number of faces");
        if (!text_.at_line_end()) (void)text_.count("the number of edges");
        text_.expect_line_end();
        check_counts(at);
        // The shortest vertex line is "0 0 0\n", the shortest face line "3 0 0 0\n".
        const auto left = static_cast<std::uint64_t>(source_.end() - text_.here());
        const std::uint64_t faces = std::min(faces_, left / 8);
        mesh_.reserve(std::min(vertices_, left / 6), faces, 3 * faces);
    }

    void check_counts(const char* at) const {
        const auto left = static_cast<std::uint64_t>(source_.end() - text_.here());
        if (vertices_ > left || faces_ > left || vertices_ * 6 + faces_ * 8 > left + 1) {
            source_.fail(at, "the header states " + std::to_string(vertices_) + " vertices and " +
                                 std::to_string(faces_) +
                                 " faces, more than the rest of the file (" + std::to_string(left) +
                                 " bytes) can hold");
        }
    }

    /// Lines of three numbers, from vertex i on; the number of the first vertex on another line.
    std::uint64_t quick_vertices(std::uint64_t i) {
        if (i != 0 && extra_ != 0) return i;
        const char* line = text_.after_line();
        Point3d p;
        for (; i < vertices_ && line < quick_.end(); ++i, line = quick_.here()) {
            quick_.begin(line);
            if (!quick_.number(p[0]) || !quick_.number(p[1]) || !quick_.number(p[2]) ||
                !quick_.line_end())
                break;
            mesh_.add_point(p, line);
            ++quick_items;
        }
        text_.resume_at(line);
        return i;
    }

    /// Lines of nothing but a count and its indices, from face i on.
    std::uint64_t quick_faces(std::uint64_t i) {
        const char* line = text_.after_line();
        for (; i < faces_ && line < quick_.end(); ++i, line = quick_.here()) {
            quick_.begin(line);
            if (!quick_loop(quick_, mesh_)) break;
            ++quick_items;
        }
        text_.resume_at(line);
        return i;
    }

    void item(const char* what, std::uint64_t i, std::uint64_t n) {
        if (text_.seek_word()) return;
        source_.fail(text_.here(), "the file ends before " + std::string(what) + " " +
                                       std::to_string(i + 1) + " of " + std::to_string(n));
    }

    void vertex(std::uint64_t i) {
        item("vertex", i, vertices_);
        const char* at = text_.here();
        Point3d p;
        p[0] = text_.real("the x coordinate of a vertex");
        p[1] = text_.real("the y coordinate of a vertex");
        p[2] = text_.real("the z coordinate of a vertex");
        std::uint64_t extra = 0;
        for (; !text_.at_line_end(); ++extra) (void)text_.any_real("a normal or colour");
        if (i == 0) extra_ = extra;
        if (extra != extra_) {
            source_.fail(at, "a vertex line with " + std::to_string(3 + extra) +
                                 " numbers; the first one has " + std::to_string(3 + extra_));
        }
        mesh_.add_point(p, at);
    }

    // Some programs break lines within a face. What one takes from the next is missed there, so
    // none is lost in silence.
    void next_index() {
        if (!text_.at_line_end()) return;
        const char* at = text_.here();
        if (!text_.seek_word()) source_.fail(at, "the line ends where a vertex index is expected");
    }

    void face(std::uint64_t i) {
        item("face", i, faces_);
        const char* at = text_.here();
        const std::uint64_t n = text_.count("the number of corners of a face");
        for (std::uint64_t k = 0; k < n; ++k) {
            next_index();
            const std::uint64_t index = text_.count("a vertex index");
            mesh_.add_corner(index, text_.last_number());
        }
        while (!text_.at_line_end()) (void)text_.any_real("a colour");
        mesh_.end_face(at);
    }

    const InputText& source_;
    TextCursor text_;
    QuickText quick_;
    MeshBuilder mesh_;
    std::uint64_t vertices_ = 0;
    std::uint64_t faces_ = 0;
    std::uint64_t extra_ = 0;  ///< numbers after x y z in every vertex line
};

}  // namespace

PolygonMesh read_off(const InputText& source) { return OffReader(source).read(); }

void write_off(std::string& out, const PolygonMesh& mesh) {
    reserve_text(out, mesh);
    TextWriter text(out);
    text << "OFF\n"
         << std::uint64_t{mesh.points.size()} << ' ' << std::uint64_t{mesh.face_count()} << " 0\n";
    for (const Point3d& p : mesh.points) text << p << '\n';
    append_loops(text, mesh);
    text.finish();
}

}  // namespace trisect::detail
