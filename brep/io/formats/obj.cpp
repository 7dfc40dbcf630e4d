// SPDX-License-Identifier: Apache-2.0
//
// Wavefront OBJ, the polygonal part (Wavefront, Advanced Visualizer manual, appendix B1).
//
// An OBJ file is a program of one statement a line, so reading is a loop over lines that looks at
// the keyword. Only `v` and `f` (and its old spelling `fo`) mean anything here. Two things make the
// naive reader fail: negative indices count back from the vertices read so far, so a file can name
// vertices before the first; and counting `/` fields instead of checking them lets `1/x` through.
//
// Leniencies: `1`, `1/2`, `1//3`, `1/2/3` and with empty last fields (`1//`); texture and normal
// indices must be integers but need not exist. After x y z a vertex may have a weight, a colour, or
// both (one, three or four numbers), which are ignored but must be numbers, so that two statements
// run together are an error. A face may name vertices that come later. All objects and groups make
// one mesh. Unknown statements are skipped when they begin with a letter; a line that begins with
// anything else is an error, except after a skipped line that ends in a backslash. A backslash
// joins lines of `v` and `f` only, since comments and material names may end in one without meaning
// it. A file without vertices and faces is an empty mesh, unless it has an unknown statement: then
// it is some other text.
#include <trisect/brep/io/formats/formats.h>
#include <trisect/brep/io/formats/mesh_builder.h>
#include <trisect/brep/io/formats/number_text.h>
#include <trisect/brep/io/formats/quick_items.h>
#include <trisect/brep/io/formats/quick_text.h>
#include <trisect/brep/io/formats/text_cursor.h>

#include <algorithm>
#include <array>
#include <cstdint>

namespace trisect::detail {
namespace {

constexpr std::array<std::string_view, 14> ignored_keywords{
    "vt", "vn", "vp", "l", "p", "g", "o", "s", "mtllib", "usemtl", "usemap", "maplib", "mg", "lod"};

class ObjReader {
public:
    explicit ObjReader(const InputText& source)
        : source_(source),
          text_(source, TextRules{.hash_comments = true, .continuation = true}),
          quick_(source),
          mesh_(source, 1) {
        // A face line of a closed triangle mesh takes about as many bytes as its vertex lines.
        const std::uint64_t hint = source.bytes().size() / 64;
        mesh_.reserve(hint / 2, hint, 3 * hint);
    }

    PolygonMesh read() {
        do quick_lines();
        while (text_.next_line() && statement());
        if (mesh_.point_count() == 0 && mesh_.face_count() == 0 && unknown_ != nullptr) {
            source_.fail(unknown_, "no vertices, no faces and a statement that OBJ does not have");
        }
        return mesh_.finish();
    }

private:
    /// Vertices and faces without anything unusual; stops at the first other line.
    void quick_lines() {
        const char* const first = text_.after_line();
        const char* line = first;
        while (line < quick_.end() && (*line == 'v' ? quick_vertex(line) : quick_face(line)))
            line = quick_.here(), ++quick_items;
        if (line == first) return;
        skipped_continues_ = false;
        text_.resume_at(line);
    }

    bool quick_vertex(const char* line) {
        Point3d p;
        quick_.begin(line);
        if (!quick_.keyword("v") || !quick_.number(p[0]) || !quick_.number(p[1]) ||
            !quick_.number(p[2]) || !quick_.line_end())
            return false;
        mesh_.add_point(p, line);
        return true;
    }

    bool quick_face(const char* line) {
        std::array<QuickCorner, 8> corners;
        std::size_t n = 0;
        quick_.begin(line);
        if (!quick_.keyword("f")) return false;
        while (!quick_.at_line_end()) {
            if (n == corners.size() || !quick_corner(corners[n++])) return false;
        }
        if (!quick_.line_end()) return false;
        for (std::size_t i = 0; i < n; ++i)
            mesh_.add_corner(std::uint64_t{corners[i].number} - 1, corners[i].at);
        mesh_.end_face(line);
        return true;
    }

    struct QuickCorner {
        const char* at = nullptr;
        std::uint32_t number = 0;
    };

    /// `1`, `1/2`, `1//3` or `1/2/3`.
    bool quick_corner(QuickCorner& corner) {
        corner.at = quick_.here();
        std::uint32_t ignored = 0;
        if (!quick_.integer(corner.number) || corner.number == 0) return false;
        if (quick_.take('/')) {
            if (!quick_.take('/')) {
                if (!quick_.integer(ignored)) return false;
                if (quick_.take('/') && !quick_.integer(ignored)) return false;
            } else if (!quick_.integer(ignored)) {
                return false;
            }
        }
        return quick_.blanks_or_line_end();
    }

    /// Always true, for the loop over statements.
    bool statement() {
        const bool after_skipped = skipped_continues_;
        skipped_continues_ = false;
        const char* line = text_.here();
        const std::string_view keyword = text_.word();
        if (keyword == "v")
            vertex(line);
        else if (keyword == "f" || keyword == "fo")
            face(line);
        else if (!keyword.empty())
            skip(keyword, after_skipped);
        return true;
    }

    void vertex(const char* line) {
        Point3d p;
        p[0] = text_.real("the x coordinate of a vertex");
        p[1] = text_.real("the y coordinate of a vertex");
        p[2] = text_.real("the z coordinate of a vertex");
        if (!text_.at_line_end()) ignore_weight_and_colour(line);
        mesh_.add_point(p, line);
    }

    void ignore_weight_and_colour(const char* line) {
        int extra = 0;
        for (; !text_.at_line_end(); ++extra) (void)text_.any_real("a weight or colour");
        if (extra != 1 && extra != 3 && extra != 4) {
            source_.fail(line, "a vertex with " + std::to_string(3 + extra) +
                                   " numbers; it has three, and may have a weight and a colour");
        }
    }

    void face(const char* line) {
        while (!text_.at_line_end()) corner();
        mesh_.end_face(line);
    }

    void corner() {
        const char* at = text_.here();
        const std::int64_t number = text_.leading_integer("a vertex index");
        if (text_.inside_word()) texture_and_normal(at);
        mesh_.add_corner(from_zero(number, at), at);
    }

    /// OBJ counts from 1; negative numbers count back from the last vertex so far, which is -1.
    std::uint64_t from_zero(std::int64_t number, const char* at) const {
        if (number > 0) return static_cast<std::uint64_t>(number) - 1;
        const std::uint64_t known = mesh_.point_count();
        const std::uint64_t back = std::uint64_t{0} - static_cast<std::uint64_t>(number);
        if (number == 0) source_.fail(at, "vertex index 0; OBJ counts from 1");
        if (back > known) {
            source_.fail(at, "vertex index " + std::to_string(number) +
                                 " reaches back before the first of the " + std::to_string(known) +
                                 " vertices so far");
        }
        return known - back;
    }

    void texture_and_normal(const char* corner) {
        for (int field = 0; field < 2 && text_.take('/'); ++field) {
            if (text_.inside_word() && !text_.at('/')) {
                (void)text_.leading_integer("a texture or normal index");
            }
        }
        if (!text_.inside_word()) return;
        text_.go_back_to(corner);
        source_.fail(corner,
                     shown_word(text_.word()) + ", read as a corner of a face, is malformed");
    }

    void skip(std::string_view keyword, bool after_skipped) {
        const char c = keyword.front();
        const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
        if (!letter && !after_skipped) {
            source_.fail(keyword.data(), shown_word(keyword) + " does not begin an OBJ statement");
        }
        const bool known =
            std::count(ignored_keywords.begin(), ignored_keywords.end(), keyword) != 0;
        if (letter && !known && unknown_ == nullptr) unknown_ = keyword.data();
        skipped_continues_ = text_.line_continues();
    }

    const InputText& source_;
    TextCursor text_;
    QuickText quick_;
    MeshBuilder mesh_;
    const char* unknown_ = nullptr;   ///< the first statement that OBJ does not have
    bool skipped_continues_ = false;  ///< the last line was skipped and ended in a backslash
};

}  // namespace

PolygonMesh read_obj(const InputText& source) { return ObjReader(source).read(); }

void write_obj(std::string& out, const PolygonMesh& mesh) {
    reserve_text(out, mesh);
    TextWriter text(out);
    text << "# Trisect\n";
    for (const Point3d& p : mesh.points) text << "v " << p << '\n';
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        text << 'f';
        for (const std::uint32_t corner : mesh.face(f)) text << ' ' << std::uint64_t{corner} + 1;
        text << '\n';
    }
    text.finish();
}

}  // namespace trisect::detail
