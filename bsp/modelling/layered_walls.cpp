// SPDX-License-Identifier: Apache-2.0
#include <trisect/bsp/modelling/layered_walls.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <trisect/kernel/error.h>

namespace trisect::detail {
namespace {

constexpr double most_corners_of_walls = 1 << 24;

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

}  // namespace

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

void require_corners(const PlaneRegion& region, double copies) {
    // A region may be empty; its copies are a number of 32 bits all the same.
    const std::size_t points = std::max<std::size_t>(region.points.size(), 1);
    if (!(copies * static_cast<double>(points) <= most_corners_of_walls))
        throw LimitError("a solid of layers with more than 2^24 corners");
}

}  // namespace trisect::detail
