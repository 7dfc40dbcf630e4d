// SPDX-License-Identifier: Apache-2.0

#include <algorithm>
#include <cmath>
#include <utility>

#include <manifold/cross_section.h>
#include <manifold/manifold.h>
#include <trisect/bsp/expression.h>

#include "node.h"
#include "planar.h"

namespace manifold {

namespace {

// Half-way up, where no cap is.
constexpr double middle = 0.5;

double area_of(const SimplePolygon& polygon) {
    double twice = 0;
    for (std::size_t i = 0; i < polygon.size(); ++i)
        twice += la::cross(polygon[i], polygon[(i + 1) % polygon.size()]);
    return twice / 2;
}

}  // namespace

CrossSection::CrossSection(const SimplePolygon& contour) : CrossSection(Polygons{contour}) {}
CrossSection::CrossSection(const Polygons& contours)
    : polygons_(section_of(prism_over(contours), middle)) {}
CrossSection::CrossSection(const Rect& rect) {
    if (rect.IsEmpty()) return;
    polygons_ = {{rect.min, {rect.max.x, rect.min.y}, rect.max, {rect.min.x, rect.max.y}}};
}

CrossSection CrossSection::Square(vec2 dims, bool center) {
    if (!(dims.x > 0 && dims.y > 0)) return {};
    const vec2 low = center ? dims * -0.5 : vec2();
    return Rect(low, low + dims);
}

CrossSection CrossSection::Circle(double radius, int circularSegments) {
    if (!(radius > 0)) return {};
    const int n = circularSegments > 2 ? circularSegments : Quality::GetCircularSegments(radius);
    SimplePolygon circle;
    for (int i = 0; i < n; ++i)
        circle.push_back({radius * cosd(360.0 * i / n), radius * sind(360.0 * i / n)});
    CrossSection section;
    section.polygons_.push_back(std::move(circle));
    return section;
}

std::size_t CrossSection::NumVert() const {
    std::size_t count = 0;
    for (const SimplePolygon& polygon : polygons_) count += polygon.size();
    return count;
}

double CrossSection::Area() const {
    double area = 0;
    for (const SimplePolygon& polygon : polygons_) area += area_of(polygon);
    return area;
}

Rect CrossSection::Bounds() const {
    Rect box;
    for (const SimplePolygon& polygon : polygons_)
        for (const vec2& p : polygon) box.Union(p);
    return box;
}

CrossSection CrossSection::Transform(const mat2x3& m) const {
    CrossSection moved = *this;
    const bool turned = la::cross(m[0], m[1]) < 0;
    for (SimplePolygon& polygon : moved.polygons_) {
        for (vec2& p : polygon) p = m * vec3(p, 1.0);
        if (turned) std::ranges::reverse(polygon);
    }
    return moved;
}
CrossSection CrossSection::Translate(vec2 by) const {
    return Transform({vec2(1, 0), vec2(0, 1), by});
}
CrossSection CrossSection::Rotate(double degrees) const {
    const double c = cosd(degrees);
    const double s = sind(degrees);
    return Transform({vec2(c, s), vec2(-s, c), vec2()});
}
CrossSection CrossSection::Scale(vec2 by) const {
    return Transform({vec2(by.x, 0), vec2(0, by.y), vec2()});
}
CrossSection CrossSection::Mirror(vec2 axis) const {
    const double length = la::length2(axis);
    if (!(length > 0)) return {};
    const vec2 u = axis * (2 / length);
    return Transform(
        {vec2(1 - u.x * axis.x, -u.x * axis.y), vec2(-u.y * axis.x, 1 - u.y * axis.y), vec2()});
}
CrossSection CrossSection::Warp(const std::function<void(vec2&)>& warp) const {
    Polygons moved = polygons_;
    for (SimplePolygon& polygon : moved)
        for (vec2& p : polygon) warp(p);
    return moved;
}

CrossSection CrossSection::Simplify(double tolerance) const {
    CrossSection result;
    for (const SimplePolygon& polygon : polygons_) {
        SimplePolygon kept = polygon;
        for (std::size_t i = 0; i < kept.size() && kept.size() > 2;) {
            const vec2 before = kept[(i + kept.size() - 1) % kept.size()];
            const vec2 along = kept[(i + 1) % kept.size()] - before;
            const double length = la::length(along);
            const double apart = length > 0 ? std::abs(la::cross(along, kept[i] - before)) / length
                                            : la::length(kept[i] - before);
            if (apart < tolerance)
                kept.erase(kept.begin() + static_cast<std::ptrdiff_t>(i));
            else
                ++i;
        }
        if (kept.size() > 2) result.polygons_.push_back(std::move(kept));
    }
    return result;
}

CrossSection CrossSection::BatchBoolean(const std::vector<CrossSection>& sections, OpType op) {
    std::vector<trisect::Solid> prisms;
    for (const CrossSection& section : sections) prisms.push_back(prism_over(section.polygons_));
    if (prisms.empty()) return {};
    using trisect::Expression;
    const std::span<const trisect::Solid> all(prisms);
    const Expression formula = op == OpType::Add ? Expression::any_of(all)
                               : op == OpType::Intersect
                                   ? Expression::all_of(all)
                                   : prisms[0] - Expression::any_of(all.subspan(1));
    CrossSection result;
    result.polygons_ = section_of(trisect::evaluate(formula), middle);
    return result;
}

CrossSection CrossSection::Hull(const SimplePolygon& points) {
    SimplePolygon sorted = points;
    std::ranges::sort(sorted, {}, [](const vec2& p) { return std::pair(p.x, p.y); });
    SimplePolygon hull;
    // The lower side, then the upper one on the way back.
    for (int pass = 0; pass < 2; ++pass) {
        const std::size_t kept = hull.size();
        for (const vec2& p : sorted) {
            while (hull.size() >= kept + 2 &&
                   la::cross(hull.back() - hull[hull.size() - 2], p - hull.back()) <= 0)
                hull.pop_back();
            hull.push_back(p);
        }
        if (!hull.empty()) hull.pop_back();
        std::ranges::reverse(sorted);
    }
    CrossSection section;
    if (hull.size() > 2) section.polygons_.push_back(std::move(hull));
    return section;
}
CrossSection CrossSection::Hull() const {
    SimplePolygon points;
    for (const SimplePolygon& polygon : polygons_)
        points.insert(points.end(), polygon.begin(), polygon.end());
    return Hull(points);
}
CrossSection CrossSection::Offset(double /*delta*/, JoinType /*joins*/, double /*miterLimit*/,
                                  int /*circularSegments*/) const {
    throw NotSupported("CrossSection::Offset");
}

Polygons Manifold::Slice(double height) const {
    // A face in the plane belongs to what is above it.
    const trisect::Solid& solid = node_->solid().solid;
    if (solid.is_empty()) return {};
    const Box box = BoundingBox();
    if (height < box.min.z || height >= box.max.z) return {};
    return section_of(trisect::evaluate(solid & trisect::evaluate(~trisect::Solid::half_space(
                                                    {0, 0, 1, -height}))),
                      height);
}

Polygons Manifold::Project() const {
    std::vector<trisect::Solid> prisms;
    const TriMesh& mesh = node_->mesh();
    for (std::size_t t = 0; t < mesh.corners.size(); ++t) {
        if (!(mesh.normal(t).z > 0)) continue;
        SimplePolygon shadow;
        for (std::size_t k = 0; k < 3; ++k) shadow.push_back(mesh.corner(t, k).xy());
        prisms.push_back(prism_over({shadow}));
    }
    if (prisms.empty()) return {};
    return section_of(trisect::evaluate(trisect::Expression::any_of(prisms)), middle);
}

}  // namespace manifold
