// SPDX-License-Identifier: Apache-2.0

#include <algorithm>
#include <cmath>
#include <utility>

#include <manifold/cross_section.h>
#include <manifold/manifold.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/modelling/offset.h>

#include "node.h"
#include "planar.h"

namespace manifold {

namespace {

// Half-way up, where no cap is.
constexpr double middle = 0.5;

double area_of(const SimplePolygon& polygon) {
    double twice = 0;
    for (std::size_t i = 0; i < polygon.size(); ++i)
        twice += la::cross(polygon[i] - polygon[0], polygon[(i + 1) % polygon.size()] - polygon[0]);
    return twice / 2;
}

bool are_finite(const Polygons& polygons) {
    const auto is_finite = [](const vec2& p) { return la::all(la::isfinite(p)); };
    return std::ranges::all_of(polygons, [&](const SimplePolygon& polygon) {
        return std::ranges::all_of(polygon, is_finite);
    });
}

// Douglas and Peucker 1973: what is left of the way from one corner to another.
void simplify(const SimplePolygon& polygon, std::size_t from, std::size_t to, double tolerance,
              SimplePolygon& kept) {
    const vec2 start = polygon[from];
    const vec2 along = polygon[to % polygon.size()] - start;
    const double length = la::length(along);
    std::size_t farthest = from;
    double most = -1;
    for (std::size_t i = from + 1; i < to; ++i) {
        const vec2 off = polygon[i] - start;
        const double apart =
            length > 0 ? std::abs(la::cross(along, off)) / length : la::length(off);
        if (apart > most) most = apart, farthest = i;
    }
    if (most < tolerance || (most == 0 && tolerance == 0)) return;
    simplify(polygon, from, farthest, tolerance, kept);
    kept.push_back(polygon[farthest]);
    simplify(polygon, farthest, to, tolerance, kept);
}

}  // namespace

CrossSection::CrossSection(const SimplePolygon& contour) : CrossSection(Polygons{contour}) {}
CrossSection::CrossSection(const Polygons& contours) {
    if (are_finite(contours)) polygons_ = section_of(prism_over(contours), middle);
}
CrossSection::CrossSection(const Rect& rect) {
    if (rect.IsEmpty()) return;
    polygons_ = {{rect.min, {rect.max.x, rect.min.y}, rect.max, {rect.min.x, rect.max.y}}};
}

CrossSection CrossSection::EvenOdd(const Polygons& contours) {
    CrossSection section;
    if (are_finite(contours)) section.polygons_ = section_of(prism_by_parity(contours), middle);
    return section;
}

std::vector<CrossSection> CrossSection::Decompose() const {
    std::vector<CrossSection> parts;
    for (Polygons& region : regions_of(prism_over(polygons_), middle))
        parts.emplace_back().polygons_ = std::move(region);
    return parts;
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
    for (int k = 0; k < 3; ++k)
        if (!la::all(la::isfinite(m[k]))) return *this;
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

CrossSection CrossSection::WarpBatch(const std::function<void(VecView<vec2>)>& warp) const {
    SimplePolygon all;
    for (const SimplePolygon& polygon : polygons_)
        all.insert(all.end(), polygon.begin(), polygon.end());
    warp(all);
    Polygons moved;
    std::size_t begin = 0;
    for (const SimplePolygon& polygon : polygons_) {
        const auto from = all.begin() + static_cast<std::ptrdiff_t>(begin);
        moved.emplace_back(from, from + static_cast<std::ptrdiff_t>(polygon.size()));
        begin += polygon.size();
    }
    return moved;
}

CrossSection CrossSection::Simplify(double tolerance) const {
    CrossSection result;
    for (SimplePolygon polygon : polygons_) {
        // From a corner of the box, which stays.
        std::ranges::rotate(polygon, std::ranges::min_element(polygon, {}, [](const vec2& p) {
                                return std::pair(p.x, p.y);
                            }));
        SimplePolygon kept{polygon[0]};
        simplify(polygon, 0, polygon.size(), tolerance, kept);
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
    if (!are_finite({points})) return {};
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
CrossSection CrossSection::Hull() const { return Hull(polygons_); }
CrossSection CrossSection::Hull(const Polygons& polygons) {
    SimplePolygon points;
    for (const SimplePolygon& polygon : polygons)
        points.insert(points.end(), polygon.begin(), polygon.end());
    return Hull(points);
}
CrossSection CrossSection::Hull(const std::vector<CrossSection>& sections) {
    Polygons polygons;
    for (const CrossSection& section : sections)
        polygons.insert(polygons.end(), section.polygons_.begin(), section.polygons_.end());
    return Hull(polygons);
}

CrossSection CrossSection::Offset(double delta, JoinType joins, double miterLimit,
                                  int circularSegments) const {
    if (!std::isfinite(delta)) return {};
    using Corners = trisect::OffsetOptions::Corners;
    trisect::OffsetOptions options;
    options.corners = joins == JoinType::Round   ? Corners::Round
                      : joins == JoinType::Miter ? Corners::Miter
                      : joins == JoinType::Bevel ? Corners::Bevel
                                                 : Corners::Chamfer;
    options.miter_limit = miterLimit >= 2 ? miterLimit : 2;
    options.segments = static_cast<std::uint32_t>(
        circularSegments > 2 ? circularSegments : Quality::GetCircularSegments(std::abs(delta)));
    CrossSection result;
    result.polygons_ =
        section_of(trisect::offset_of_region(prism_over(polygons_), delta, options), middle);
    return result;
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
