// SPDX-License-Identifier: Apache-2.0
//
// A sum of two corners is a corner of the hull only if some direction is extreme at both of them.
// The directions that are extreme at a corner of a convex solid are those between the normals of
// its faces there. A cone around these is a cheap test that drops most of the pairs of two round
// solids; it is widened by far more than the errors of its doubles.
#include <trisect/bsp/modelling/pieces/sum_hull.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <trisect/brep/primitives/hull.h>
#include <trisect/kernel/error.h>

namespace trisect::detail {
namespace {

// Fewer pairs than this go to the hull as they are.
constexpr std::size_t few_pairs = 2000;
// Radians by which cones are widened, and the least sine of a triangle's angle whose normal in
// doubles is trusted.
constexpr double widening = 1e-6;
constexpr double least_sine = 1e-5;

struct Cone {
    Point3d axis{};
    double radius = std::numbers::pi;
};

Point3d difference(const Point3d& a, const Point3d& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
double product(const Point3d& a, const Point3d& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
double length(const Point3d& a) { return std::sqrt(product(a, a)); }
double angle(const Point3d& a, const Point3d& b) {
    return std::acos(std::clamp(product(a, b), -1.0, 1.0));
}

/// Zero where the triangle is so thin that its normal is in doubt.
Point3d unit_normal(const PolygonMesh& mesh, std::size_t f) {
    const auto corners = mesh.face(f);
    const Point3d u = difference(mesh.points[corners[1]], mesh.points[corners[0]]);
    const Point3d v = difference(mesh.points[corners[2]], mesh.points[corners[0]]);
    const Point3d n{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
                    u[0] * v[1] - u[1] * v[0]};
    const double size = length(n);
    if (!(size > least_sine * length(u) * length(v))) return {};
    return {n[0] / size, n[1] / size, n[2] / size};
}

Cone around(const std::vector<Point3d>& normals) {
    Point3d sum{};
    for (const Point3d& n : normals) {
        if (product(n, n) == 0) return {};
        for (std::size_t k = 0; k < 3; ++k) sum[k] += n[k];
    }
    const double size = length(sum);
    if (!(size > least_sine)) return {};
    Cone out{{sum[0] / size, sum[1] / size, sum[2] / size}, 0};
    for (const Point3d& n : normals) out.radius = std::max(out.radius, angle(out.axis, n));
    // Only within a right angle does a cap contain the arcs between its points.
    if (out.radius + widening >= std::numbers::pi / 2) return {};
    out.radius += widening;
    return out;
}

std::vector<Cone> cones_of(const PolygonMesh& hull) {
    std::vector<std::vector<Point3d>> normals(hull.points.size());
    for (std::size_t f = 0; f < hull.face_count(); ++f)
        for (const std::uint32_t v : hull.face(f)) normals[v].push_back(unit_normal(hull, f));
    std::vector<Cone> out;
    for (const auto& at : normals) out.push_back(around(at));
    return out;
}

bool meet(const Cone& a, const Cone& b) {
    const double reach = a.radius + b.radius;
    return reach >= std::numbers::pi || product(a.axis, b.axis) >= std::cos(reach);
}

Point3d sum(const Point3d& a, const Point3d& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }

std::vector<Point3d> all_sums(std::span<const Point3d> a, std::span<const Point3d> b) {
    std::vector<Point3d> out;
    out.reserve(a.size() * b.size());
    for (const Point3d& p : a)
        for (const Point3d& q : b) out.push_back(sum(p, q));
    return out;
}

std::optional<PolygonMesh> hull_if_solid(std::span<const Point3d> points) {
    try {
        return make_hull(points);
    } catch (const UsageError&) {
        return std::nullopt;
    }
}

std::vector<Point3d> extreme_sums(const PolygonMesh& a, const PolygonMesh& b) {
    const std::vector<Cone> of_a = cones_of(a);
    const std::vector<Cone> of_b = cones_of(b);
    std::vector<Point3d> out;
    for (std::size_t i = 0; i < of_a.size(); ++i)
        for (std::size_t j = 0; j < of_b.size(); ++j)
            if (meet(of_a[i], of_b[j])) out.push_back(sum(a.points[i], b.points[j]));
    return out;
}

}  // namespace

std::optional<PolygonMesh> sum_hull(std::span<const Point3d> a, std::span<const Point3d> b) {
    if (a.size() * b.size() > few_pairs) {
        const auto hull_a = hull_if_solid(a);
        const auto hull_b = hull_if_solid(b);
        if (hull_a && hull_b) return hull_if_solid(extreme_sums(*hull_a, *hull_b));
    }
    return hull_if_solid(all_sums(a, b));
}

}  // namespace trisect::detail
