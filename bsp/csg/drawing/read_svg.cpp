// SPDX-License-Identifier: Apache-2.0
#include <trisect/bsp/csg/drawing/read_svg.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include <trisect/brep/io/models/xml_reader.h>

#include <trisect/brep/primitives/degrees.h>
#include <trisect/bsp/csg/drawing/stroke_pieces.h>
#include <trisect/bsp/csg/drawing/svg_page.h>
#include <trisect/bsp/csg/drawing/svg_path.h>

namespace trisect::detail {
namespace {

constexpr int circle_sides = 40;
// OpenSCAD's: ends that are as near as this meet, and strokes that are thinner have width 1.
constexpr double closing_distance = 0.1;
constexpr double least_width = 0.01;

template <std::size_t N>
bool is_one_of(std::string_view name, const std::array<std::string_view, N>& names) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

class SvgParser final : public XmlHandler {
public:
    SvgParser(const InputText& source, const SvgOptions& options, Drawing& drawing)
        : source_(source), options_(options), drawing_(drawing) {}

    void begin(const XmlElement& element) override {
        static constexpr std::array<std::string_view, 6> hidden{"defs",     "style", "title",
                                                                "metadata", "desc",  "script"};
        static constexpr std::array<std::string_view, 3> not_read{"text", "image", "use"};
        if (hidden_depth_ > 0) {
            ++hidden_depth_;
        } else if (maps_.empty()) {
            if (element.name != "svg")
                source_.fail(element.at, "<" + std::string(element.name) + "> is no SVG");
            maps_.push_back(svg_page(source_, element, options_.dots_per_inch));
        } else if (is_one_of(element.name, hidden)) {
            hidden_depth_ = 1;
        } else if (is_one_of(element.name, not_read)) {
            ++left_out_[std::string(element.name)];
            hidden_depth_ = 1;
        } else if (element.name == "svg") {
            source_.fail(element.at, "<svg> within <svg> is not read");
        } else {
            const auto own = element.attribute("transform");
            maps_.push_back(own ? compose(maps_.back(), svg_transform(source_, element.at, *own))
                                : maps_.back());
            draw(element);
        }
    }

    void end() override {
        if (hidden_depth_ > 0)
            --hidden_depth_;
        else
            maps_.pop_back();
    }

    void finish() {
        for (const auto& [name, count] : left_out_)
            drawing_.remarks.push_back(std::to_string(count) + " of <" + name + "> left out");
    }

private:
    [[nodiscard]] double number(const XmlElement& e, std::string_view name, double otherwise) {
        const auto text = e.attribute(name);
        return text ? xml_real(source_, *text, std::string(name).c_str(), e.at) : otherwise;
    }

    void draw(const XmlElement& e) {
        if (e.name == "rect") rectangle(e);
        if (e.name == "circle") {
            const double r = number(e, "r", 0);
            ellipse(e, r, r);
        }
        if (e.name == "ellipse") ellipse(e, number(e, "rx", 0), number(e, "ry", 0));
        if (e.name == "line")
            add(e, {{{{number(e, "x1", 0), number(e, "y1", 0)},
                      {number(e, "x2", 0), number(e, "y2", 0)}},
                     false}});
        if (e.name == "polygon" || e.name == "polyline")
            add(e, {{points_of(e), e.name == "polygon"}});
        if (e.name == "path") add(e, svg_subpaths(source_, e.at, e.attribute("d").value_or("")));
    }

    [[nodiscard]] Outline points_of(const XmlElement& e) {
        const std::vector<double> v =
            svg_numbers(source_, e.at, e.attribute("points").value_or(""));
        if (v.size() % 2 != 0) source_.fail(e.at, "an odd number of coordinates");
        Outline out;
        for (std::size_t i = 0; i < v.size(); i += 2) out.push_back({v[i], v[i + 1]});
        return out;
    }

    void rectangle(const XmlElement& e) {
        const double x = number(e, "x", 0);
        const double y = number(e, "y", 0);
        const double width = number(e, "width", 0);
        const double height = number(e, "height", 0);
        if (!(width > 0) || !(height > 0)) return;
        double rx = number(e, "rx", number(e, "ry", 0));
        double ry = number(e, "ry", number(e, "rx", 0));
        rx = std::min(std::max(rx, 0.0), width / 2);
        ry = std::min(std::max(ry, 0.0), height / 2);
        Outline out;
        if (rx == 0 || ry == 0) {
            out = {{x, y}, {x + width, y}, {x + width, y + height}, {x, y + height}};
        } else {
            constexpr int quarter = circle_sides / 4;
            for (int corner = 0; corner < 4; ++corner) {
                const double cx = corner == 0 || corner == 3 ? x + width - rx : x + rx;
                const double cy = corner < 2 ? y + height - ry : y + ry;
                for (int i = 0; i <= quarter; ++i) {
                    const double angle = 90.0 * corner + 90.0 * i / quarter;
                    out.push_back(
                        {cx + rx * cosine_of_degrees(angle), cy + ry * sine_of_degrees(angle)});
                }
            }
        }
        add(e, {{std::move(out), true}});
    }

    void ellipse(const XmlElement& e, double rx, double ry) {
        if (!(rx > 0) || !(ry > 0)) return;
        const double cx = number(e, "cx", 0);
        const double cy = number(e, "cy", 0);
        Outline out;
        for (int i = 0; i < circle_sides; ++i) {
            const double angle = 360.0 * i / circle_sides;
            out.push_back({cx + rx * cosine_of_degrees(angle), cy + ry * sine_of_degrees(angle)});
        }
        add(e, {{std::move(out), true}});
    }

    /// The value in the attribute of the name, else in that of `style`.
    [[nodiscard]] static std::string_view style_of(const XmlElement& e, std::string_view name) {
        if (const auto value = e.attribute(name)) return trimmed_word(*value);
        std::string_view style = e.attribute("style").value_or("");
        while (!style.empty()) {
            const std::size_t end = std::min(style.find(';'), style.size());
            const std::string_view item = style.substr(0, end);
            const std::size_t colon = std::min(item.find(':'), item.size());
            if (colon < item.size() && trimmed_word(item.substr(0, colon)) == name)
                return trimmed_word(item.substr(colon + 1));
            style.remove_prefix(std::min(end + 1, style.size()));
        }
        return {};
    }

    [[nodiscard]] Stroke stroke_of(const XmlElement& e, Outline points) {
        Stroke out;
        out.points = std::move(points);
        std::string_view width = style_of(e, "stroke-width");
        if (width.ends_with("px")) width.remove_suffix(2);
        if (!width.empty()) out.width = xml_real(source_, width, "stroke-width", e.at);
        if (out.width < least_width) out.width = 1;
        const std::string_view cap = style_of(e, "stroke-linecap");
        if (cap == "butt") out.cap = Stroke::Cap::Butt;
        if (cap == "round") out.cap = Stroke::Cap::Round;
        return out;
    }

    [[nodiscard]] static bool is_area(const SvgSubpath& path) {
        if (path.is_closed || path.points.empty()) return true;
        const Point2d& a = path.points.front();
        const Point2d& b = path.points.back();
        return std::hypot(a[0] - b[0], a[1] - b[1]) <= closing_distance;
    }

    [[nodiscard]] Outline placed(Outline outline, const char* at) {
        corners_ += outline.size();
        if (corners_ > drawing_limit) source_.fail_limit(at, "too many corners");
        for (Point2d& p : outline) {
            p = maps_.back().apply(p);
            if (!std::isfinite(p[0]) || !std::isfinite(p[1]))
                source_.fail_limit(at, "coordinates are too large");
        }
        return outline;
    }

    void add(const XmlElement& e, std::vector<SvgSubpath> paths) {
        DrawingShape shape;
        for (SvgSubpath& path : paths) {
            if (is_area(path)) {
                shape.outlines.push_back(placed(std::move(path.points), e.at));
                continue;
            }
            std::vector<Outline> pieces = stroke_pieces(stroke_of(e, std::move(path.points)));
            for (Outline& piece : pieces) piece = placed(std::move(piece), e.at);
            shape.strokes.push_back(std::move(pieces));
        }
        drawing_.shapes.push_back(std::move(shape));
    }

    const InputText& source_;
    const SvgOptions& options_;
    Drawing& drawing_;
    std::vector<SvgMap> maps_;
    int hidden_depth_ = 0;
    std::size_t corners_ = 0;
    std::map<std::string, std::size_t> left_out_;
};

template <class Work>
void for_each_corner(Drawing& drawing, const Work& work) {
    for (DrawingShape& shape : drawing.shapes) {
        for (Outline& outline : shape.outlines)
            for (Point2d& p : outline) work(p);
        for (std::vector<Outline>& stroke : shape.strokes)
            for (Outline& piece : stroke)
                for (Point2d& p : piece) work(p);
    }
}

void center(Drawing& drawing) {
    bool is_first = true;
    Point2d low{0, 0};
    Point2d high{0, 0};
    for_each_corner(drawing, [&](const Point2d& p) {
        for (std::size_t k = 0; k < 2; ++k) {
            low[k] = is_first ? p[k] : std::min(low[k], p[k]);
            high[k] = is_first ? p[k] : std::max(high[k], p[k]);
        }
        is_first = false;
    });
    for_each_corner(drawing, [&](Point2d& p) {
        for (std::size_t k = 0; k < 2; ++k) p[k] -= low[k] / 2 + high[k] / 2;
    });
}

}  // namespace

Drawing read_svg(const InputText& source, const SvgOptions& options) {
    Drawing out;
    SvgParser parser(source, options, out);
    read_xml(source, parser);
    parser.finish();
    if (options.is_centered) center(out);
    return out;
}

}  // namespace trisect::detail
