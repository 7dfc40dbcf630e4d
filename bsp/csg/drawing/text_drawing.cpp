// SPDX-License-Identifier: Apache-2.0
//
// The font is set to as many pixels an em as its design has units. Then all numbers of FreeType and
// HarfBuzz, which count in 64ths of a pixel, are multiples of 64, and nothing is rounded on the
// way.
#include <trisect/bsp/csg/drawing/text_drawing.h>

#include <ft2build.h>
#include FT_FREETYPE_H
#include FT_FONT_FORMATS_H
#include FT_OUTLINE_H
#include <hb-ft.h>
#include <hb.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string_view>
#include <vector>

#include <trisect/bsp/csg/drawing/font_file.h>
#include <trisect/bsp/csg/drawing/glyph_shapes.h>
#include <trisect/kernel/error.h>

namespace trisect::detail {
namespace {

constexpr std::size_t most_bytes = 10'000;
// OpenSCAD's: the size that it sets, at 100 dots an inch, and what it divides lengths by.
constexpr double peer_size = 100'000;
constexpr double outline_divisor = 100'000;
constexpr double advance_divisor = 102'400;
constexpr double peer_pixel = 64;

struct DoneLibrary {
    void operator()(FT_Library l) const { FT_Done_FreeType(l); }
};
struct DoneFace {
    void operator()(FT_Face f) const { FT_Done_Face(f); }
};
struct DoneFont {
    void operator()(hb_font_t* f) const { hb_font_destroy(f); }
};
struct DoneBuffer {
    void operator()(hb_buffer_t* b) const { hb_buffer_destroy(b); }
};
using Library = std::unique_ptr<FT_LibraryRec_, DoneLibrary>;
using Face = std::unique_ptr<FT_FaceRec_, DoneFace>;
using Font = std::unique_ptr<hb_font_t, DoneFont>;
using Buffer = std::unique_ptr<hb_buffer_t, DoneBuffer>;

struct OpenFace {
    Library library;
    Face face;
    double peer_units = 1;  ///< of OpenSCAD's 100,000, for one 64th of a pixel
};

/// Unicode where the font has it, else a map of symbols, in which HarfBuzz finds letters.
void choose_characters(FT_Face face) {
    if (FT_Select_Charmap(face, FT_ENCODING_UNICODE) != 0)
        (void)FT_Select_Charmap(face, FT_ENCODING_MS_SYMBOL);
}

/// OpenSCAD's em has 100,000 / 64 points of 72 to the inch, at 100 pixels an inch. FreeType makes
/// pixels an em of TrueType a whole number.
double peer_units_of(FT_Face face) {
    const double pixels = peer_size / 64 * 100 / 72;
    const bool is_truetype = std::string_view(FT_Get_Font_Format(face)) == "TrueType";
    return (is_truetype ? std::round(pixels) : pixels) / face->units_per_EM;
}

OpenFace open_face(const FontFile& file) {
    FT_Library library = nullptr;
    if (FT_Init_FreeType(&library) != 0) throw UnsupportedError("FreeType does not start");
    OpenFace out;
    out.library.reset(library);
    FT_Face face = nullptr;
    if (FT_New_Face(library, file.path.c_str(), file.face, &face) != 0)
        throw UnsupportedError("the font " + file.path + " cannot be read");
    out.face.reset(face);
    choose_characters(face);
    const FT_UShort units = face->units_per_EM;
    out.peer_units = peer_units_of(face);
    if (units == 0 || FT_Set_Char_Size(face, 0, FT_F26Dot6{units} * 64, 72, 72) != 0)
        throw UnsupportedError("the font " + file.path + " is not scalable");
    return out;
}

/// Corners of one glyph. FreeType closes contours without repeating their first point.
struct GlyphPath {
    std::vector<Outline> outlines;
    double scale = 1;
    Point2d offset{0, 0};
    std::uint32_t segments = 1;
    FT_Vector at{0, 0};
    std::size_t* corners = nullptr;
    bool is_too_long = false;

    void add(double x, double y) {
        if (++*corners > drawing_limit) is_too_long = true;
        if (!is_too_long) outlines.back().push_back({offset[0] + scale * x, offset[1] + scale * y});
    }
};

int move_to(const FT_Vector* to, void* user) {
    auto& path = *static_cast<GlyphPath*>(user);
    path.outlines.emplace_back();
    path.add(static_cast<double>(to->x), static_cast<double>(to->y));
    path.at = *to;
    return 0;
}

int line_to(const FT_Vector* to, void* user) {
    auto& path = *static_cast<GlyphPath*>(user);
    path.add(static_cast<double>(to->x), static_cast<double>(to->y));
    path.at = *to;
    return path.is_too_long ? 1 : 0;
}

/// A Bézier curve from where the path is, by de Casteljau's scheme.
int curve_to(GlyphPath& path, std::initializer_list<FT_Vector> controls) {
    for (std::uint32_t i = 1; i <= path.segments && !path.is_too_long; ++i) {
        const double t = static_cast<double>(i) / path.segments;
        std::vector<Point2d> p{{static_cast<double>(path.at.x), static_cast<double>(path.at.y)}};
        for (const FT_Vector& c : controls)
            p.push_back({static_cast<double>(c.x), static_cast<double>(c.y)});
        for (std::size_t n = p.size() - 1; n > 0; --n)
            for (std::size_t k = 0; k < n; ++k)
                for (std::size_t d = 0; d < 2; ++d) p[k][d] += t * (p[k + 1][d] - p[k][d]);
        const FT_Vector& last = *(controls.end() - 1);
        if (i == path.segments) p[0] = {static_cast<double>(last.x), static_cast<double>(last.y)};
        path.add(p[0][0], p[0][1]);
    }
    path.at = *(controls.end() - 1);
    return path.is_too_long ? 1 : 0;
}

int conic_to(const FT_Vector* c, const FT_Vector* to, void* user) {
    return curve_to(*static_cast<GlyphPath*>(user), {*c, *to});
}

int cubic_to(const FT_Vector* c, const FT_Vector* d, const FT_Vector* to, void* user) {
    return curve_to(*static_cast<GlyphPath*>(user), {*c, *d, *to});
}

constexpr FT_Outline_Funcs path_functions{move_to, line_to, conic_to, cubic_to, 0, 0};

Buffer shaped(hb_font_t* font, const TextOptions& options) {
    Buffer buffer(hb_buffer_create());
    hb_buffer_add_utf8(buffer.get(), options.text.data(), static_cast<int>(options.text.size()), 0,
                       -1);
    hb_buffer_set_direction(buffer.get(), hb_direction_from_string(options.direction.c_str(), -1));
    hb_buffer_set_script(buffer.get(), hb_script_from_string(options.script.c_str(), -1));
    hb_buffer_set_language(buffer.get(), hb_language_from_string(options.language.c_str(), -1));
    hb_buffer_guess_segment_properties(buffer.get());
    hb_shape(font, buffer.get(), nullptr, 0);
    return buffer;
}

class TextPath {
public:
    TextPath(const OpenFace& open, const TextOptions& options) : open_(open), options_(options) {}

    Drawing draw() {
        const Font font(hb_ft_font_create_referenced(open_.face.get()));
        hb_ft_font_set_load_flags(font.get(), FT_LOAD_NO_HINTING);
        const Buffer buffer = shaped(font.get(), options_);
        infos_ = hb_buffer_get_glyph_infos(buffer.get(), &count_);
        positions_ = hb_buffer_get_glyph_positions(buffer.get(), &count_);
        is_horizontal_ = HB_DIRECTION_IS_HORIZONTAL(hb_buffer_get_direction(buffer.get()));
        measure();
        Point2d at{x_offset(), y_offset()};
        Drawing out;
        for (unsigned int i = 0; i < count_; ++i) {
            const hb_glyph_position_t& p = positions_[i];
            add_glyph(out, i, {at[0] + length(p.x_offset), at[1] + length(p.y_offset)});
            at[0] += length(p.x_advance) * options_.spacing;
            at[1] += length(p.y_advance) * options_.spacing;
        }
        return out;
    }

private:
    [[nodiscard]] double length(double pixels64) const {
        return pixels64 * open_.peer_units * options_.size / advance_divisor;
    }
    bool load(unsigned int i) const {
        return FT_Load_Glyph(open_.face.get(), infos_[i].codepoint,
                             FT_LOAD_NO_HINTING | FT_LOAD_NO_BITMAP) == 0 &&
               open_.face->glyph->format == FT_GLYPH_FORMAT_OUTLINE;
    }
    /// On the grid of OpenSCAD's pixels, away from zero.
    [[nodiscard]] double fitted(double pixels64) const {
        const double units = std::round(pixels64 * open_.peer_units);
        const double pixels = units / peer_pixel;
        return (units < 0 ? std::floor(pixels) : std::ceil(pixels)) * peer_pixel * options_.size /
               advance_divisor;
    }

    void measure() {
        for (unsigned int i = 0; i < count_; ++i) {
            FT_BBox box{0, 0, 0, 0};
            if (load(i)) FT_Outline_Get_CBox(&open_.face->glyph->outline, &box);
            if (is_horizontal_) {
                width_ += length(positions_[i].x_advance) * options_.spacing;
                if (box.yMax > 0) ascent_ = larger(ascent_, fitted(static_cast<double>(box.yMax)));
                if (box.yMin < 0)
                    descent_ = larger(descent_, -fitted(static_cast<double>(box.yMin)));
            } else {
                width_ = larger(width_, fitted(static_cast<double>(box.xMax)) -
                                            fitted(static_cast<double>(box.xMin)));
                ascent_ += length(positions_[i].y_advance) * options_.spacing;
            }
        }
    }
    /// Sizes may be negative.
    static double larger(double a, double b) { return std::fabs(b) > std::fabs(a) ? b : a; }

    [[nodiscard]] double x_offset() const {
        if (options_.halign == "right") return -width_;
        return options_.halign == "center" ? -width_ / 2 : 0;
    }
    [[nodiscard]] double y_offset() const {
        if (options_.valign == "top") return -ascent_;
        if (options_.valign == "center") return (descent_ - ascent_) / 2;
        return options_.valign == "bottom" ? descent_ : 0;
    }

    void add_glyph(Drawing& out, unsigned int i, const Point2d& offset) {
        if (!load(i)) return;
        GlyphPath path;
        path.scale = open_.peer_units * options_.size / outline_divisor;
        path.offset = offset;
        path.segments = options_.segments;
        path.corners = &corners_;
        (void)FT_Outline_Decompose(&open_.face->glyph->outline, &path_functions, &path);
        if (path.is_too_long) throw LimitError("the text has too many corners");
        for (DrawingShape& shape : glyph_shapes(std::move(path.outlines)))
            out.shapes.push_back(std::move(shape));
    }

    const OpenFace& open_;
    const TextOptions& options_;
    const hb_glyph_info_t* infos_ = nullptr;
    const hb_glyph_position_t* positions_ = nullptr;
    unsigned int count_ = 0;
    bool is_horizontal_ = true;
    double width_ = 0;
    double ascent_ = 0;
    double descent_ = 0;
    std::size_t corners_ = 0;
};

}  // namespace

Drawing text_drawing(const TextOptions& options) {
    if (options.text.size() > most_bytes) throw LimitError("the text is too long");
    if (options.text.empty() || options.size == 0) return {};
    const FontFile file = find_font(options.font);
    Drawing out = TextPath(open_face(file), options).draw();
    if (!file.has_family)
        out.remarks.push_back("the font " + file.family + " stands in for '" +
                              options.font.substr(0, 60) + "'");
    return out;
}

}  // namespace trisect::detail
