// SPDX-License-Identifier: Apache-2.0
#include <trisect/bsp/csg/drawing/svg_page.h>

#include <algorithm>
#include <map>
#include <optional>
#include <string>

#include <trisect/brep/primitives/degrees.h>
#include <trisect/bsp/csg/drawing/svg_path.h>
#include <trisect/bsp/csg/drawing/svg_scanner.h>

namespace trisect::detail {
namespace {

constexpr double inch = 25.4;

SvgMap turned(double degrees) {
    const double c = cosine_of_degrees(degrees);
    const double s = sine_of_degrees(degrees);
    return {{c, s, -s, c, 0, 0}};
}

SvgMap moved(double x, double y) { return {{1, 0, 0, 1, x, y}}; }

double tangent(double degrees) { return sine_of_degrees(degrees) / cosine_of_degrees(degrees); }

/// Nothing where the name, or the number of its arguments, is not SVG's.
std::optional<SvgMap> map_of(std::string_view name, const std::vector<double>& v) {
    const std::size_t n = v.size();
    if (name == "matrix" && n == 6) return SvgMap{{v[0], v[1], v[2], v[3], v[4], v[5]}};
    if (name == "translate" && (n == 1 || n == 2)) return moved(v[0], n == 2 ? v[1] : 0);
    if (name == "scale" && (n == 1 || n == 2))
        return SvgMap{{v[0], 0, 0, n == 2 ? v[1] : v[0], 0, 0}};
    if (name == "rotate" && n == 1) return turned(v[0]);
    if (name == "rotate" && n == 3)
        return compose(moved(v[1], v[2]), compose(turned(v[0]), moved(-v[1], -v[2])));
    if (name == "skewX" && n == 1) return SvgMap{{1, 0, tangent(v[0]), 1, 0, 0}};
    if (name == "skewY" && n == 1) return SvgMap{{1, tangent(v[0]), 0, 1, 0, 0}};
    return std::nullopt;
}

/// In millimetres; nothing when it is not there or a percentage.
std::optional<double> length_of(const InputText& source, const XmlElement& svg,
                                std::string_view name, double dots_per_inch) {
    const auto text = svg.attribute(name);
    if (!text) return std::nullopt;
    SvgScanner scan(source, svg.at, *text);
    const double value = scan.number();
    std::string unit;
    while (!scan.at_end()) unit += scan.take();
    static const std::map<std::string, double> units{
        {"mm", 1}, {"cm", 10}, {"in", inch}, {"pt", inch / 72}, {"pc", inch / 6}};
    if (unit == "%") return std::nullopt;
    if (unit.empty() || unit == "px") return value * inch / dots_per_inch;
    const auto it = units.find(unit);
    if (it == units.end()) source.fail(svg.at, shown_word(unit) + " is no unit that is read");
    return value * it->second;
}

/// Where the content lies between both ends: 0, 1/2 or 1 of what is left over.
double part_of(std::string_view align, std::string_view axis) {
    const std::size_t n = align.find(axis);
    if (n == std::string_view::npos) return 0.5;
    const std::string_view rest = align.substr(n + axis.size());
    return rest.starts_with("Min") ? 0 : rest.starts_with("Max") ? 1 : 0.5;
}

}  // namespace

SvgMap compose(const SvgMap& second, const SvgMap& first) {
    const auto& a = second.m;
    const auto& b = first.m;
    return {{a[0] * b[0] + a[2] * b[1], a[1] * b[0] + a[3] * b[1], a[0] * b[2] + a[2] * b[3],
             a[1] * b[2] + a[3] * b[3], a[0] * b[4] + a[2] * b[5] + a[4],
             a[1] * b[4] + a[3] * b[5] + a[5]}};
}

SvgMap svg_transform(const InputText& source, const char* at, std::string_view text) {
    SvgMap out;
    SvgScanner scan(source, at, text);
    while (!scan.at_end()) {
        const std::string_view name = trimmed_word(scan.take_until("("));
        if (scan.take() != '(') scan.fail();
        const std::vector<double> numbers = svg_numbers(source, at, scan.take_until(")"));
        if (scan.take() != ')') scan.fail();
        const auto map = map_of(name, numbers);
        if (!map) source.fail(at, shown_word(name) + " is no transformation");
        out = compose(out, *map);
    }
    return out;
}

SvgMap svg_page(const InputText& source, const XmlElement& svg, double dots_per_inch) {
    const std::optional<double> width = length_of(source, svg, "width", dots_per_inch);
    const std::optional<double> height = length_of(source, svg, "height", dots_per_inch);
    const auto box_text = svg.attribute("viewBox");
    if (!box_text) return {{1, 0, 0, -1, 0, height.value_or(0)}};
    const std::vector<double> box = svg_numbers(source, svg.at, *box_text);
    if (box.size() != 4 || !(box[2] > 0) || !(box[3] > 0))
        source.fail(svg.at, shown_word(*box_text) + " is no viewBox");
    const double page_width = width.value_or(box[2] * inch / dots_per_inch);
    const double page_height = height.value_or(box[3] * inch / dots_per_inch);
    double sx = page_width / box[2];
    double sy = page_height / box[3];
    const std::string_view aspect = svg.attribute("preserveAspectRatio").value_or("");
    const bool is_sliced = aspect.find("slice") != std::string_view::npos;
    if (aspect.find("none") == std::string_view::npos)
        sx = sy = is_sliced ? std::max(sx, sy) : std::min(sx, sy);
    const double left = (page_width - sx * box[2]) * part_of(aspect, "x");
    const double top = (page_height - sy * box[3]) * part_of(aspect, "Y");
    return {{sx, 0, 0, -sy, left - sx * box[0], page_height - top + sy * box[1]}};
}

}  // namespace trisect::detail
