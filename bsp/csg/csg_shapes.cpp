// SPDX-License-Identifier: Apache-2.0
#include <trisect/bsp/csg/csg_shapes.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <trisect/brep/primitives/box.h>

namespace trisect::detail {
namespace {

// Below this radius a circle is a triangle: the finest step of OpenSCAD's grid.
constexpr double grid_step = 0x1p-20;

std::uint32_t checked_count(const CsgArguments& arguments, double count, double limit) {
    if (!(count <= limit)) arguments.fail(ErrorCode::Limit, "too many facets");
    return static_cast<std::uint32_t>(count);
}

/// Adds a ring about the z axis and returns its first point.
std::uint32_t add_ring(PolygonMesh& mesh, double radius, double z, std::uint32_t n) {
    const auto first = static_cast<std::uint32_t>(mesh.points.size());
    for (std::uint32_t i = 0; i < n; ++i) {
        const double angle = 360.0 * i / n;
        mesh.points.push_back(
            {radius * cosine_of_degrees(angle), radius * sine_of_degrees(angle), z});
    }
    return first;
}

void add_cap(PolygonMesh& mesh, std::uint32_t first, std::uint32_t n, bool looks_up) {
    std::vector<std::uint32_t> loop(n);
    for (std::uint32_t i = 0; i < n; ++i) loop[i] = first + (looks_up ? i : n - 1 - i);
    mesh.add_face(loop);
}

}  // namespace

std::uint32_t csg_fragments(const CsgArguments& arguments, double radius) {
    const double fn = arguments.number("$fn", 0);
    if (radius < grid_step) return 3;
    if (fn > 0) return checked_count(arguments, std::max(std::floor(fn), 3.0), circle_limit);
    const double fa = std::max(arguments.number("$fa", 12), 0.01);
    const double fs = std::max(arguments.number("$fs", 2), 0.01);
    const double by_size = radius * 2 * std::numbers::pi / fs;
    return checked_count(arguments, std::ceil(std::max(std::min(360 / fa, by_size), 5.0)),
                         circle_limit);
}

PolygonMesh csg_cube(const CsgArguments& arguments) {
    const std::vector<double> size = arguments.numbers("size", 3, 1);
    if (!std::all_of(size.begin(), size.begin() + 3, [](double s) { return s > 0; })) return {};
    if (!arguments.truth("center", false)) return make_box({size[0], size[1], size[2]});
    const Point3d half{size[0] / 2, size[1] / 2, size[2] / 2};
    // Half of the least double is 0.
    if (!std::all_of(half.begin(), half.end(), [](double s) { return s > 0; })) return {};
    return make_box({-half[0], -half[1], -half[2]}, half);
}

void add_band(PolygonMesh& mesh, std::uint32_t lower, std::uint32_t upper, std::uint32_t n) {
    for (std::uint32_t i = 0; i < n; ++i) {
        const std::uint32_t j = (i + 1) % n;
        mesh.add_triangle(lower + i, lower + j, upper + j);
        mesh.add_triangle(lower + i, upper + j, upper + i);
    }
}

PolygonMesh csg_sphere(const CsgArguments& arguments) {
    const double radius = arguments.radius("r", "d", 1);
    if (!(radius > 0)) return {};
    const std::uint32_t n = csg_fragments(arguments, radius);
    const std::uint32_t rings = (n + 1) / 2;
    (void)checked_count(arguments, 2.0 * n * rings, shape_limit);
    PolygonMesh mesh;
    for (std::uint32_t i = 0; i < rings; ++i) {  // from the bottom up
        const double angle = 180.0 * (rings - 1 - i + 0.5) / rings;
        add_ring(mesh, radius * sine_of_degrees(angle), radius * cosine_of_degrees(angle), n);
    }
    add_cap(mesh, 0, n, false);
    for (std::uint32_t i = 0; i + 1 < rings; ++i) add_band(mesh, i * n, (i + 1) * n, n);
    add_cap(mesh, (rings - 1) * n, n, true);
    return mesh;
}

PolygonMesh csg_cylinder(const CsgArguments& arguments) {
    const double height = arguments.number("h", 1);
    const double r = arguments.radius("r", "d", 1);
    const double r1 = arguments.radius("r1", "d1", r);
    const double r2 = arguments.radius("r2", "d2", r);
    if (!(height > 0) || r1 < 0 || r2 < 0 || !(std::max(r1, r2) > 0)) return {};
    const std::uint32_t n = csg_fragments(arguments, std::max(r1, r2));
    const double low = arguments.truth("center", false) ? -height / 2 : 0;
    PolygonMesh mesh;
    const std::uint32_t lower = add_ring(mesh, r1, low, n);
    const std::uint32_t upper = add_ring(mesh, r2, low + height, n);
    // Rings of radius 0 are one point; import leaves out what they make flat.
    add_band(mesh, lower, upper, n);
    if (r1 > 0) add_cap(mesh, lower, n, false);
    if (r2 > 0) add_cap(mesh, upper, n, true);
    return mesh;
}

PolygonMesh csg_polyhedron(const CsgArguments& arguments) {
    const CsgValue* points = arguments.find("points");
    const CsgValue* faces = arguments.find("faces");
    if (faces == nullptr) faces = arguments.find("triangles");
    if (points == nullptr || faces == nullptr) return {};
    PolygonMesh mesh;
    for (const CsgValue& p : arguments.list(*points)) {
        const std::vector<double> c = arguments.numbers(p, 3);
        mesh.points.push_back({c[0], c[1], c[2]});
    }
    for (auto& loop : arguments.index_lists(*faces, mesh.points.size())) {
        std::reverse(loop.begin(), loop.end());  // clockwise seen from outside
        if (loop.size() >= 3) mesh.add_face(loop);
    }
    return mesh;
}

std::vector<Outline> csg_square(const CsgArguments& arguments) {
    const std::vector<double> size = arguments.numbers("size", 2, 1);
    if (!(size[0] > 0) || !(size[1] > 0)) return {};
    const bool center = arguments.truth("center", false);
    const Point2d low = center ? Point2d{-size[0] / 2, -size[1] / 2} : Point2d{0, 0};
    const Point2d high = center ? Point2d{size[0] / 2, size[1] / 2} : Point2d{size[0], size[1]};
    return {{low, {high[0], low[1]}, high, {low[0], high[1]}}};
}

std::vector<Outline> csg_circle(const CsgArguments& arguments) {
    const double radius = arguments.radius("r", "d", 1);
    if (!(radius > 0)) return {};
    const std::uint32_t n = csg_fragments(arguments, radius);
    Outline out;
    for (std::uint32_t i = 0; i < n; ++i) {
        const double angle = 360.0 * i / n;
        out.push_back({radius * cosine_of_degrees(angle), radius * sine_of_degrees(angle)});
    }
    return {out};
}

std::vector<Outline> csg_polygon(const CsgArguments& arguments) {
    const CsgValue* points = arguments.find("points");
    if (points == nullptr) return {};
    Outline all;
    for (const CsgValue& p : arguments.list(*points)) {
        const std::vector<double> c = arguments.numbers(p, 2);
        all.push_back({c[0], c[1]});
    }
    const CsgValue* paths = arguments.find("paths");
    if (paths == nullptr || arguments.list(*paths).empty()) return {all};
    std::vector<Outline> out;
    for (const auto& path : arguments.index_lists(*paths, all.size())) {
        Outline& outline = out.emplace_back();
        for (const std::uint32_t i : path) outline.push_back(all[i]);
    }
    return out;
}

}  // namespace trisect::detail
