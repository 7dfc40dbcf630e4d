// SPDX-License-Identifier: Apache-2.0
#include "svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "values.h"
#include "xml_text.h"

namespace trisect::app {
namespace {

constexpr double legend_square = 13;
constexpr double legend_letter = 7.2;  // average width of a letter of 13 px

/// At most two decimals, none where they are zero.
std::string compact(double value) {
    std::string text = fmt::format("{:.2f}", value);
    while (text.back() == '0') text.pop_back();
    if (text.back() == '.') text.pop_back();
    return text == "-0" ? "0" : text;
}

std::string attributes(const SvgStyle& style) {
    std::string out = fmt::format("fill=\"{}\"", style.fill ? style.fill->hex() : "none");
    if (style.fill && style.fill_opacity < 1) {
        out += fmt::format(" fill-opacity=\"{}\"", compact(style.fill_opacity));
    }
    if (style.stroke) {
        out += fmt::format(" stroke=\"{}\" stroke-width=\"{}\"", style.stroke->hex(),
                           compact(style.stroke_width));
        if (style.stroke_opacity < 1) {
            out += fmt::format(" stroke-opacity=\"{}\"", compact(style.stroke_opacity));
        }
    }
    return out;
}

}  // namespace

void DrawingFrame::add(const DrawingPoint& p) {
    for (std::size_t k = 0; k < 2; ++k) {
        lower[k] = std::min(lower[k], p[k]);
        upper[k] = std::max(upper[k], p[k]);
    }
}

DrawingFrame DrawingFrame::with_margin(double part) const {
    if (!(width() >= 0)) return {{0, 0}, {1, 1}};
    double longer = std::max(width(), height());
    if (!(longer > 0)) longer = std::max(1.0, std::abs(lower[0]) + std::abs(lower[1])) / 1024;
    DrawingFrame out = *this;
    for (std::size_t k = 0; k < 2; ++k) {
        out.lower[k] -= part * longer;
        out.upper[k] += part * longer;
    }
    return out;
}

DrawingFrame DrawingFrame::empty() {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    return {{infinity, infinity}, {-infinity, -infinity}};
}

Svg::Svg(const DrawingFrame& frame, double pixels, double footer, std::string_view title,
         Numbers numbers)
    : frame_(frame),
      scale_(pixels / std::max(frame.width(), frame.height())),
      width_(frame.width() * scale_),
      height_(frame.height() * scale_),
      footer_(footer),
      numbers_(numbers),
      title_(xml_text(title)) {}

std::string Svg::point_text(const DrawingPoint& p) const {
    if (numbers_ == Numbers::Precise) return number_text(p[0]) + " " + number_text(p[1]);
    return compact((p[0] - frame_.lower[0]) * scale_) + " " +
           compact((frame_.upper[1] - p[1]) * scale_);
}

void Svg::shape(const std::string& path, const SvgStyle& style) {
    shapes_ += fmt::format("    <path d=\"{}\" {}/>\n", path, attributes(style));
}

void Svg::polygons(const std::vector<std::vector<DrawingPoint>>& loops, const SvgStyle& style) {
    std::string path;
    for (const auto& loop : loops) {
        for (std::size_t i = 0; i < loop.size(); ++i) {
            path += i == 0 ? "M" : "L";
            path += point_text(loop[i]);
        }
        if (!loop.empty()) path += "Z";
    }
    if (!path.empty()) shape(path, style);
}

void Svg::rectangles(const std::vector<Rectangle>& boxes, const SvgStyle& style) {
    std::string path;
    for (const Rectangle& box : boxes) {
        DrawingPoint lower = box.lower;
        DrawingPoint upper = box.upper;
        for (std::size_t k = 0; k < 2; ++k) {
            lower[k] = std::max(lower[k], frame_.lower[k]);
            upper[k] = std::min(upper[k], frame_.upper[k]);
        }
        if (lower[0] >= upper[0] || lower[1] >= upper[1]) continue;
        path += "M" + point_text(lower) + "L" + point_text({upper[0], lower[1]}) + "L" +
                point_text(upper) + "L" + point_text({lower[0], upper[1]}) + "Z";
    }
    if (!path.empty()) shape(path, style);
}

double Svg::legend(double left, std::string_view word, const SvgStyle& style) {
    const double top = height_ + (footer_ - legend_square) / 2;
    footer_shapes_ += fmt::format("  <rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" {}/>\n",
                                  compact(left), compact(top), compact(legend_square),
                                  compact(legend_square), attributes(style));
    footer_shapes_ += fmt::format("  <text x=\"{}\" y=\"{}\" fill=\"{}\">{}</text>\n",
                                  compact(left + legend_square + 6),
                                  compact(top + legend_square - 2), ink.hex(), xml_text(word));
    return left + legend_square + 6 + legend_letter * static_cast<double>(word.size()) + 18;
}

std::string Svg::document() const {
    const std::string total = compact(height_ + footer_);
    std::string out = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" "
        "viewBox=\"0 0 {0} {1}\" font-family=\"sans-serif\" font-size=\"13\">\n"
        "  <title>{2}</title>\n"
        "  <rect width=\"{0}\" height=\"{1}\" fill=\"#ffffff\"/>\n",
        compact(width_), total, title_);
    if (numbers_ == Numbers::Precise) {
        // Shapes keep the user's coordinates; lines keep their width in pixels.
        out += fmt::format(
            "  <style>path {{ vector-effect: non-scaling-stroke }}</style>\n"
            "  <g transform=\"matrix({} 0 0 {} {} {})\" fill-rule=\"evenodd\" "
            "stroke-linejoin=\"round\">\n",
            number_text(scale_), number_text(-scale_), number_text(-frame_.lower[0] * scale_),
            number_text(frame_.upper[1] * scale_));
    } else {
        out += "  <g fill-rule=\"evenodd\" stroke-linejoin=\"round\">\n";
    }
    return out + shapes_ + "  </g>\n" + footer_shapes_ + "</svg>\n";
}

}  // namespace trisect::app
