// SPDX-License-Identifier: Apache-2.0
//
// Seen along the direction d, the triangles around a corner are sectors of less than half a turn,
// each to the left of the one before it where its normal n has n·d > 0. They go around as often as
// they pass from the right of a line through the corner to its left. Once means that sectors have
// at most a ray in common, and triangles over one ray the edge that they share.
//
// The line is where a plane through d meets that of the projection. Its normal h is across d
// exactly: d has few bits, and h is a sum of products of its coordinates with small numbers.

#include <trisect/brep/contact/graph_corners.h>

#include <cmath>
#include <cstddef>

#include <trisect/kernel/number/vector3.h>
#include <trisect/kernel/stop_scope.h>

namespace trisect::detail {

namespace {

using Triangle = std::array<std::uint32_t, 3>;

// A coordinate of a normal is within 4·2^-53 of the sum of the magnitudes of its products, and a
// product with a direction adds as much; a sign of a line has one difference and one product.
constexpr double normal_rounding = 0x1p-49;
constexpr double line_rounding = 0x1p-50;
constexpr double direction_steps = 0x1p20;

struct SizedNormal {
    Vector3 n;
    Vector3 size;  // magnitudes of the products
};

SizedNormal sized_normal_of(std::span<const LatticePoint> points, const Triangle& t) {
    const auto a = points[t[0]].doubles();
    const Vector3 p = minus(points[t[1]].doubles(), a);
    const Vector3 q = minus(points[t[2]].doubles(), a);
    SizedNormal out{};
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t u = (k + 1) % 3;
        const std::size_t v = (k + 2) % 3;
        const double left = p[u] * q[v];
        const double right = p[v] * q[u];
        out.n[k] = left - right;
        out.size[k] = std::fabs(left) + std::fabs(right);
    }
    return out;
}

constexpr std::uint8_t left_out = 255;  // not wanted, or hidden from the direction
constexpr std::uint8_t most_turns = 100;

bool are_left_out(const Triangle& t, std::span<const std::uint8_t> turns) {
    return turns[t[0]] == left_out && turns[t[1]] == left_out && turns[t[2]] == left_out;
}

// The sum of unit normals, with 20 bits; zero where they cancel.
std::vector<Vector3> view_directions(std::span<const LatticePoint> points,
                                     std::span<const Triangle> triangles,
                                     std::span<const std::uint8_t> turns) {
    std::vector<Vector3> out(points.size(), Vector3{});
    for (const Triangle& t : triangles) {
        if (are_left_out(t, turns)) continue;
        const Vector3 n = sized_normal_of(points, t).n;
        const double length = std::sqrt(dot(n, n));
        if (!(length > 0) || !std::isfinite(length)) continue;
        for (const std::uint32_t c : t)
            for (std::size_t k = 0; k < 3; ++k) out[c][k] += n[k] / length;
    }
    for (Vector3& d : out) {
        const double most = largest_component(d);
        for (double& x : d) x = most > 0x1p-10 ? std::nearbyint(x / most * direction_steps) : 0;
    }
    return out;
}

// Odd multiples, so that few edges along axes and diagonals lie in the plane.
Vector3 line_normal(const Vector3& d) {
    constexpr double a = 7, b = 11, c = -17;
    return {a * d[1] - c * d[2], b * d[2] - a * d[0], c * d[0] - b * d[1]};
}

// -1, 1, or 0 for unknown.
int side_of_line(const Vector3& h, const Vector3& from, const Vector3& to) {
    const Vector3 e = minus(to, from);
    const double sum = h[0] * e[0] + h[1] * e[1] + h[2] * e[2];
    const double bound =
        line_rounding * (std::fabs(h[0] * e[0]) + std::fabs(h[1] * e[1]) + std::fabs(h[2] * e[2]));
    return sum > bound ? 1 : sum < -bound ? -1 : 0;
}

bool is_seen_from(const Vector3& d, const SizedNormal& normal) {
    double bound = 0;
    for (std::size_t k = 0; k < 3; ++k) bound += std::fabs(d[k]) * normal.size[k];
    return dot(normal.n, d) > normal_rounding * bound;
}

}  // namespace

std::vector<std::uint8_t> find_graph_corners(std::span<const LatticePoint> points,
                                             std::span<const Triangle> triangles,
                                             std::span<const Triangle> wanted) {
    std::vector<std::uint8_t> turns(points.size(), left_out);
    for (const Triangle& t : wanted)
        for (const std::uint32_t c : t) turns[c] = 0;
    const std::vector<Vector3> directions = view_directions(points, triangles, turns);
    check_stop(triangles.size());
    for (const Triangle& t : triangles) {
        if (are_left_out(t, turns)) continue;
        const SizedNormal normal = sized_normal_of(points, t);
        for (std::size_t i = 0; i < 3; ++i) {
            std::uint8_t& of_corner = turns[t[i]];
            if (of_corner == left_out) continue;
            const Vector3& d = directions[t[i]];
            const Vector3 h = line_normal(d);
            const auto corner = points[t[i]].doubles();
            const int next = side_of_line(h, corner, points[t[(i + 1) % 3]].doubles());
            const int last = side_of_line(h, corner, points[t[(i + 2) % 3]].doubles());
            if (next == 0 || last == 0 || !is_seen_from(d, normal))
                of_corner = left_out;
            else if (next < 0 && last > 0 && of_corner < most_turns)
                ++of_corner;
        }
    }
    for (std::uint8_t& n : turns) n = n == 1 ? 1 : 0;
    return turns;
}

}  // namespace trisect::detail
