// SPDX-License-Identifier: Apache-2.0
#include <trisect/brep/primitives/box.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <string>

#include "gdml_shape.h"

namespace trisect::app {
namespace {

constexpr std::size_t most_corners = 1U << 22;

/// Two rings of four corners, and the faces between them.
GdmlShape hexahedron(const std::array<Point3d, 8>& corners) {
    GdmlShape out;
    for (Point3d p : corners) {
        for (double& c : p) {
            // Half steps are exact: sizes of boxes are whole, and half of one is a corner.
            const double near = std::nearbyint(2 * c) / 2;
            if (near != c) out.deviation = rounding_of_corners;
            c = near;
        }
        out.mesh.points.push_back(p);
    }
    const std::array<std::array<std::uint32_t, 4>, 6> faces{
        {{3, 2, 1, 0}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}};
    for (const auto& f : faces) out.mesh.add_face(f);
    make_outward(out.mesh);
    return out;
}

GdmlShape box(const GdmlSource& in, const GdmlElement& e) {
    Point3d half{};
    for (std::size_t k = 0; k < 3; ++k) {
        half[k] = in.values.length(e, std::array{"x", "y", "z"}.at(k)) / 2;
        if (!(half[k] > 0)) in.document.fail(e, "<box> with a size that is not positive");
    }
    GdmlShape out;
    out.mesh = make_box({-half[0], -half[1], -half[2]}, half);
    return out;
}

/// Half the width at two places in y, how the middle shifts with y, and where the middle is.
struct TrapEnd {
    double y, low_x, high_x, slope, x0, y0, z;
};

void add_end(std::array<Point3d, 8>& corners, std::size_t at, const TrapEnd& t) {
    const double shift = t.y * t.slope;
    corners[at] = {t.x0 - shift - t.low_x, t.y0 - t.y, t.z};
    corners[at + 1] = {t.x0 - shift + t.low_x, t.y0 - t.y, t.z};
    corners[at + 2] = {t.x0 + shift + t.high_x, t.y0 + t.y, t.z};
    corners[at + 3] = {t.x0 + shift - t.high_x, t.y0 + t.y, t.z};
}

double slope_of(double degrees) { return degrees == 0 ? 0 : std::tan(radians(degrees)); }

GdmlShape trap(const GdmlSource& in, const GdmlElement& e) {
    const auto half = [&](const char* name) { return in.values.length(e, name) / 2; };
    const double z = half("z");
    const double slope = slope_of(in.values.angle(e, "theta", 0));
    const double phi = in.values.angle(e, "phi", 0);
    const double dx = slope == 0 ? 0 : z * slope * std::cos(radians(phi));
    const double dy = slope == 0 ? 0 : z * slope * std::sin(radians(phi));
    std::array<Point3d, 8> corners{};
    add_end(corners, 0,
            {half("y1"), half("x1"), half("x2"), slope_of(in.values.angle(e, "alpha1", 0)), -dx,
             -dy, -z});
    add_end(
        corners, 4,
        {half("y2"), half("x3"), half("x4"), slope_of(in.values.angle(e, "alpha2", 0)), dx, dy, z});
    return hexahedron(corners);
}

GdmlShape trd(const GdmlSource& in, const GdmlElement& e) {
    const auto half = [&](const char* name) { return in.values.length(e, name) / 2; };
    std::array<Point3d, 8> corners{};
    add_end(corners, 0, {half("y1"), half("x1"), half("x1"), 0, 0, 0, -half("z")});
    add_end(corners, 4, {half("y2"), half("x2"), half("x2"), 0, 0, 0, half("z")});
    return hexahedron(corners);
}

GdmlShape para(const GdmlSource& in, const GdmlElement& e) {
    const auto half = [&](const char* name) { return in.values.length(e, name) / 2; };
    const double z = half("z");
    const double slope = slope_of(in.values.angle(e, "theta", 0));
    const double phi = radians(in.values.angle(e, "phi", 0));
    const double dx = slope == 0 ? 0 : z * slope * std::cos(phi);
    const double dy = slope == 0 ? 0 : z * slope * std::sin(phi);
    const double alpha = slope_of(in.values.angle(e, "alpha", 0));
    std::array<Point3d, 8> corners{};
    add_end(corners, 0, {half("y"), half("x"), half("x"), alpha, -dx, -dy, -z});
    add_end(corners, 4, {half("y"), half("x"), half("x"), alpha, dx, dy, z});
    return hexahedron(corners);
}

/// Whether the sides between two quadrilaterals are planes: twisted ones are curved.
bool has_plane_sides(const std::array<Point3d, 8>& c) {
    for (std::size_t i = 0; i < 4; ++i) {
        const std::size_t j = (i + 1) % 4;
        const double lower_x = c[j][0] - c[i][0];
        const double lower_y = c[j][1] - c[i][1];
        const double upper_x = c[j + 4][0] - c[i + 4][0];
        const double upper_y = c[j + 4][1] - c[i + 4][1];
        const double lower = std::hypot(lower_x, lower_y);
        const double upper = std::hypot(upper_x, upper_y);
        // Less than a step off a plane.
        if (std::fabs(lower_x * upper_y - lower_y * upper_x) > std::max(lower, upper)) return false;
    }
    return true;
}

GdmlShape arb8(const GdmlSource& in, const GdmlElement& e) {
    std::array<Point3d, 8> corners{};
    const double z = in.values.length(e, "dz");
    for (std::size_t i = 0; i < 8; ++i) {
        const std::string name = "v" + std::to_string(i + 1);
        corners[i] = {in.values.length(e, name + "x"), in.values.length(e, name + "y"),
                      i < 4 ? -z : z};
    }
    if (!has_plane_sides(corners))
        in.document.fail_unsupported(e, "<arb8> with twisted sides is not supported");
    return hexahedron(corners);
}

GdmlShape tet(const GdmlSource& in, const GdmlElement& e) {
    GdmlShape out;
    for (const char* name : {"vertex1", "vertex2", "vertex3", "vertex4"})
        out.mesh.points.push_back(in.values.named_position(e, in.document.required(e, name)));
    out.mesh.add_triangle(0, 2, 1);
    out.mesh.add_triangle(0, 1, 3);
    out.mesh.add_triangle(1, 2, 3);
    out.mesh.add_triangle(2, 0, 3);
    make_outward(out.mesh);
    return out;
}

/// One layer of an extrusion: all corners, scaled and moved.
void add_section(GdmlShape& out, const GdmlSource& in, const Outline& outline, const GdmlElement& e,
                 const GdmlElement& section) {
    const double x = section.find("xOffset") ? in.values.length(section, "xOffset", e) : 0;
    const double y = section.find("yOffset") ? in.values.length(section, "yOffset", e) : 0;
    const double scale = in.values.number(section, "scalingFactor", 1);
    const double z = in.values.length(section, "zPosition", e);
    for (const Point2d& p : outline) {
        const Point2d q{std::nearbyint(x + scale * p[0]), std::nearbyint(y + scale * p[1])};
        if (q[0] != x + scale * p[0] || q[1] != y + scale * p[1])
            out.deviation = rounding_of_corners;
        out.mesh.points.push_back({q[0], q[1], z});
    }
}

GdmlShape xtru(const GdmlSource& in, const GdmlElement& e) {
    Outline outline;
    for (const GdmlElement& c : e.children)
        if (c.name == "twoDimVertex")
            outline.push_back({in.values.length(c, "x", e), in.values.length(c, "y", e)});
    std::vector<std::pair<double, const GdmlElement*>> sections;
    for (const GdmlElement& c : e.children)
        if (c.name == "section") sections.emplace_back(in.values.number(c, "zOrder", 0), &c);
    std::ranges::stable_sort(sections, {}, [](const auto& s) { return s.first; });
    if (outline.size() < 3 || sections.size() < 2)
        in.document.fail(e, "<xtru> with fewer than three corners or two sections");
    if (outline.size() * sections.size() > most_corners)
        in.document.fail_limit(e, "<xtru> with too many corners");
    GdmlShape out;
    for (const auto& [order, section] : sections) add_section(out, in, outline, e, *section);
    const auto n = static_cast<std::uint32_t>(outline.size());
    std::vector<std::uint32_t> low(n);
    std::vector<std::uint32_t> high(n);
    const auto top = static_cast<std::uint32_t>(sections.size() - 1) * n;
    for (std::uint32_t i = 0; i < n; ++i) {
        low[n - 1 - i] = i;
        high[i] = top + i;
    }
    out.mesh.add_face(low);
    for (std::uint32_t k = 0; k < top; k += n)
        for (std::uint32_t i = 0; i < n; ++i) {
            const std::uint32_t j = (i + 1) % n;
            const std::array<std::uint32_t, 4> side{k + i, k + j, k + n + j, k + n + i};
            out.mesh.add_face(side);
        }
    out.mesh.add_face(high);
    make_outward(out.mesh);
    return out;
}

GdmlShape tessellated(const GdmlSource& in, const GdmlElement& e) {
    GdmlShape out;
    std::map<Point3d, std::uint32_t> numbers;
    for (const GdmlElement& facet : e.children) {
        if (facet.name != "triangular" && facet.name != "quadrangular") continue;
        if (facet.text("type") == "RELATIVE")
            in.document.fail_unsupported(facet, "facets of type RELATIVE are not supported");
        std::vector<std::uint32_t> loop;
        for (const char* name : {"vertex1", "vertex2", "vertex3", "vertex4"}) {
            if (facet.name == "triangular" && loop.size() == 3) break;
            const Point3d p = in.values.named_position(facet, in.document.required(facet, name));
            const auto [at, is_new] =
                numbers.try_emplace(p, static_cast<std::uint32_t>(out.mesh.points.size()));
            if (is_new) out.mesh.points.push_back(p);
            loop.push_back(at->second);
        }
        out.mesh.add_face(loop);
    }
    make_outward(out.mesh);
    return out;
}

}  // namespace

void make_outward(PolygonMesh& mesh) {
    double volume = 0;
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        const auto loop = mesh.face(f);
        const Point3d& a = mesh.points[loop[0]];
        for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
            const Point3d& b = mesh.points[loop[i]];
            const Point3d& c = mesh.points[loop[i + 1]];
            volume += a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
                      a[2] * (b[0] * c[1] - b[1] * c[0]);
        }
    }
    if (volume >= 0) return;
    for (std::size_t f = 0; f < mesh.face_count(); ++f)
        std::reverse(mesh.corners.begin() + mesh.face_begin[f],
                     mesh.corners.begin() + mesh.face_begin[f + 1]);
}

std::optional<GdmlShape> flat_gdml_shape(const GdmlSource& source, const GdmlElement& element) {
    using Make = GdmlShape (*)(const GdmlSource&, const GdmlElement&);
    constexpr std::array<std::pair<std::string_view, Make>, 8> kinds{
        {{"box", box},
         {"trap", trap},
         {"trd", trd},
         {"para", para},
         {"arb8", arb8},
         {"tet", tet},
         {"xtru", xtru},
         {"tessellated", tessellated}}};
    for (const auto& [name, make] : kinds)
        if (name == element.name) return make(source, element);
    return std::nullopt;
}

}  // namespace trisect::app
