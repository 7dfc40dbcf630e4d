// SPDX-License-Identifier: Apache-2.0
#include <trisect/bsp/csg/csg_extrude.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <trisect/bsp/csg/csg_shapes.h>

namespace trisect::detail {
namespace {

double squared_distance(const Point3d& a, const Point3d& b) {
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k) sum += (a[k] - b[k]) * (a[k] - b[k]);
    return sum;
}

// Lengths that differ by less, relatively, are equal: rounded corners decide nothing.
constexpr double equal_lengths = 1e-9;

/// Two triangles that share the shorter diagonal; of equal ones that from a to c, or the other one.
void add_quad(PolygonMesh& mesh, const std::array<std::uint32_t, 4>& quad, bool prefers_ac) {
    const auto [a, b, c, d] = quad;
    const double ac = squared_distance(mesh.points[a], mesh.points[c]);
    const double bd = squared_distance(mesh.points[b], mesh.points[d]);
    const bool are_equal = std::fabs(ac - bd) <= equal_lengths * (ac + bd);
    const bool takes_ac = are_equal ? prefers_ac : ac < bd;
    mesh.add_triangle(a, b, takes_ac ? c : d);
    if (takes_ac)
        mesh.add_triangle(a, c, d);
    else
        mesh.add_triangle(b, c, d);
}

bool runs_counter_clockwise(const PlaneRegion& region, const std::vector<std::uint32_t>& loop) {
    double twice_area = 0;
    for (std::size_t i = 0; i < loop.size(); ++i) {
        const Point2d& p = region.points[loop[i]];
        const Point2d& q = region.points[loop[(i + 1) % loop.size()]];
        twice_area += p[0] * q[1] - p[1] * q[0];
    }
    return twice_area > 0;
}

/// Walls between two copies of the points; those of the second one begin at `upper`. Of equal
/// diagonals that one is taken which goes up along a loop that runs counter-clockwise, if `along`.
void add_walls(PolygonMesh& mesh, const PlaneRegion& region, std::uint32_t lower,
               std::uint32_t upper, bool along) {
    for (const auto& loop : region.loops) {
        const bool prefers_ac = runs_counter_clockwise(region, loop) == along;
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const std::uint32_t a = loop[i];
            const std::uint32_t b = loop[(i + 1) % loop.size()];
            add_quad(mesh, {lower + a, lower + b, upper + b, upper + a}, prefers_ac);
        }
    }
}

void add_ends(PolygonMesh& mesh, const PlaneRegion& region, std::uint32_t lower,
              std::uint32_t upper) {
    for (const auto& [a, b, c] : region.triangles) {
        mesh.add_triangle(lower + a, lower + c, lower + b);
        mesh.add_triangle(upper + a, upper + b, upper + c);
    }
}

double largest_radius(const PlaneRegion& region) {
    double out = 0;
    for (const Point2d& p : region.points) out = std::max(out, std::hypot(p[0], p[1]));
    return out;
}

/// By $fn, or by the angle and the length of the way of the outermost point.
double default_slices(const CsgArguments& arguments, double radius, double height, double twist) {
    const double least = std::max(std::ceil(twist / 120), 1.0);
    const double fn = std::floor(arguments.number("$fn", 0));
    if (twist == 0 || radius == 0 || (fn > 0 && fn <= 3)) return least;
    if (fn > 0) return std::max(std::ceil(twist / 360 * fn), least);
    const double way = std::hypot(height, radius * twist * std::numbers::pi / 180);
    const double by_angle = std::ceil(twist / std::max(arguments.number("$fa", 12), 0.01));
    const double by_way = std::ceil(way / std::max(arguments.number("$fs", 2), 0.01));
    return std::max(std::min(by_angle, by_way), least);
}

std::uint32_t layer_count(const CsgArguments& arguments, const PlaneRegion& region, double layers) {
    // A region may be empty; its layers are a number of 32 bits all the same.
    const std::size_t points = std::max<std::size_t>(region.points.size(), 1);
    if (!(layers * static_cast<double>(points) <= shape_limit))
        arguments.fail(ErrorCode::Limit, "too many facets");
    return static_cast<std::uint32_t>(layers);
}

void turn_over(PolygonMesh& mesh) {
    for (std::size_t f = 0; f < mesh.face_count(); ++f)
        std::reverse(mesh.corners.begin() + mesh.face_begin[f],
                     mesh.corners.begin() + mesh.face_begin[f + 1]);
}

}  // namespace

bool is_straight(const CsgArguments& arguments) {
    const std::vector<double> scale = arguments.numbers("scale", 2, 1);
    return arguments.number("twist", 0) == 0 && scale[0] == 1 && scale[1] == 1;
}

PolygonMesh csg_twisted(const PlaneRegion& region, const CsgArguments& arguments, double low,
                        double high) {
    const double twist = arguments.number("twist", 0);
    const std::vector<double> scale = arguments.numbers("scale", 2, 1);
    const double wanted = arguments.number(
        "slices", default_slices(arguments, largest_radius(region), high - low, std::fabs(twist)));
    const std::uint32_t slices = layer_count(arguments, region, std::max(std::floor(wanted), 1.0));
    const auto n = static_cast<std::uint32_t>(region.points.size());
    PolygonMesh mesh;
    for (std::uint32_t k = 0; k <= slices; ++k) {
        const double part = static_cast<double>(k) / slices;
        const double c = cosine_of_degrees(-twist * part);
        const double s = sine_of_degrees(-twist * part);
        const double sx = 1 + (std::max(scale[0], 0.0) - 1) * part;
        const double sy = 1 + (std::max(scale[1], 0.0) - 1) * part;
        const double z = k == slices ? high : low + (high - low) * part;
        for (const Point2d& p : region.points)
            mesh.points.push_back({sx * (c * p[0] - s * p[1]), sy * (s * p[0] + c * p[1]), z});
    }
    for (std::uint32_t k = 0; k < slices; ++k)
        add_walls(mesh, region, k * n, (k + 1) * n, twist > 0);
    add_ends(mesh, region, 0, slices * n);
    return mesh;
}

PolygonMesh csg_revolved(const PlaneRegion& region, const CsgArguments& arguments) {
    double least = 0;
    double most = 0;
    for (const Point2d& p : region.points) {
        least = std::min(least, p[0]);
        most = std::max(most, p[0]);
    }
    if (least < 0 && most > 0)
        arguments.fail(ErrorCode::Input, "the region is on both sides of the axis x = 0");
    const double given = arguments.number("angle", 360);
    if (given == 0) return {};
    const bool is_full = std::fabs(given) >= 360;
    const double angle = is_full ? 360 : given;
    const double sides = csg_fragments(arguments, most - least);
    const std::uint32_t steps =
        layer_count(arguments, region, std::max(std::floor(sides * std::fabs(angle) / 360), 1.0));
    const auto n = static_cast<std::uint32_t>(region.points.size());
    PolygonMesh mesh;
    for (std::uint32_t k = 0; k < steps + (is_full ? 0 : 1); ++k) {
        const double at = (is_full ? 180 : 0) + angle * k / steps;
        for (const Point2d& p : region.points)
            mesh.points.push_back({p[0] * cosine_of_degrees(at), p[0] * sine_of_degrees(at), p[1]});
    }
    for (std::uint32_t k = 0; k < steps; ++k)
        add_walls(mesh, region, k * n, (is_full && k + 1 == steps ? 0 : k + 1) * n, true);
    if (!is_full) add_ends(mesh, region, 0, steps * n);
    // Moved along +y, as here at first, a region of the plane xz lies the other way round.
    if ((most > 0) == (angle > 0)) turn_over(mesh);
    return mesh;
}

}  // namespace trisect::detail
