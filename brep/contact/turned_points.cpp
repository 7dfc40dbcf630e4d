// SPDX-License-Identifier: Apache-2.0
//
// Errors. Let R be the largest difference of coordinates to the origin and u = 2^-53. A difference
// is rounded once, and a sum of three products with entries below 1 + 2^-40 is within 8·u·3·R of
// that of exact numbers; the whole is below 2^-47·R. A quarter of
// the image keeps within the limit of coordinates. The map need not be a rotation: triangles that
// meet have images that meet under any linear map.

#include <trisect/brep/contact/turned_points.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <trisect/kernel/number/error_bounds.h>
#include <trisect/kernel/number/vector3.h>

namespace trisect::detail {

namespace {

using Triangle = std::array<std::uint32_t, 3>;

// So many triangles show the directions, and most meshes show after these that they have none.
constexpr std::size_t most_looked_at = 512;
constexpr std::size_t most_kept_directions = 24;
constexpr double near_one = 1 - 0x1p-24;
// Matrices of few digits turn by nearly right angles.
constexpr double nearly_across = 0x1p-10;

struct FrequentDirection {
    Vector3 normal;
    std::size_t count;
};

std::optional<Vector3> unit_normal_of(std::span<const LatticePoint> points, const Triangle& t) {
    const auto a = points[t[0]].doubles();
    const Vector3 n = cross(minus(points[t[1]].doubles(), a), minus(points[t[2]].doubles(), a));
    const double length = std::sqrt(dot(n, n));
    if (!(length > 0) || !std::isfinite(length)) return std::nullopt;
    return scaled(n, 1 / length);
}

std::vector<FrequentDirection> frequent_directions(std::span<const LatticePoint> points,
                                                   std::span<const Triangle> triangles,
                                                   std::size_t step) {
    std::vector<FrequentDirection> out;
    for (std::size_t t = 0; t < triangles.size(); t += step) {
        const auto n = unit_normal_of(points, triangles[t]);
        if (!n) continue;
        const auto known = std::ranges::find_if(out, [&](const FrequentDirection& d) {
            return std::fabs(dot(d.normal, *n)) > near_one;
        });
        if (known != out.end())
            ++known->count;
        else if (out.size() < most_kept_directions)
            out.push_back({*n, 1});
    }
    std::ranges::stable_sort(out, [](const FrequentDirection& a, const FrequentDirection& b) {
        return a.count > b.count;
    });
    return out;
}

// The most frequent direction, the most frequent one across it, and the one across both.
std::optional<std::array<Vector3, 3>> axes_across(std::span<const FrequentDirection> directions,
                                                  std::size_t looked_at) {
    std::array<Vector3, 3> out{};
    std::size_t found = 0;
    std::size_t count = 0;
    for (const auto& [normal, n] : directions) {
        const bool is_across = std::ranges::all_of(
            out.begin(), out.begin() + found, [&, m = normal](const Vector3& axis) {
                return std::fabs(dot(axis, m)) < nearly_across;
            });
        if (!is_across || found == 3) continue;
        out[found++] = normal;
        count += n;
    }
    if (found < 2 || 2 * count < looked_at) return std::nullopt;
    if (found == 2) out[2] = cross(out[0], out[1]);
    return out;
}

// Two triangles seen along a direction. Each coordinate is off by less than `error`, and a turn by
// less than what four of them, times the sides, and the rounding of its products can do.
struct FlatTriangles {
    using Flat = std::array<double, 2>;
    std::array<Flat, 3> a, b;
    double error;

    // -1, 1, or 0 for unknown.
    [[nodiscard]] int turn(const Flat& p, const Flat& q, const Flat& r) const {
        const double qu = q[0] - p[0], qv = q[1] - p[1];
        const double ru = r[0] - p[0], rv = r[1] - p[1];
        const double left = qu * rv;
        const double right = qv * ru;
        const double sides = std::fabs(qu) + std::fabs(qv) + std::fabs(ru) + std::fabs(rv);
        const double bound =
            minor_rounding * (std::fabs(left) + std::fabs(right)) + 4 * error * (sides + 4 * error);
        const double t = left - right;
        return t > bound ? 1 : t < -bound ? -1 : 0;
    }
    // The third corner of x strictly on one side of an edge, those of y strictly on the other.
    [[nodiscard]] bool separates(const std::array<Flat, 3>& x, const std::array<Flat, 3>& y) const {
        for (std::size_t i = 0; i < 3; ++i) {
            const Flat& p = x[i];
            const Flat& q = x[(i + 1) % 3];
            const int inner = turn(p, q, x[(i + 2) % 3]);
            if (inner != 0 &&
                std::ranges::all_of(y, [&](const Flat& r) { return turn(p, q, r) == -inner; }))
                return true;
        }
        return false;
    }
};

// The direction along which a triangle looks, nearly.
int looking_axis(std::span<const LatticePoint> points, const Triangle& t) {
    const auto a = points[t[0]].doubles();
    const Vector3 n = cross(minus(points[t[1]].doubles(), a), minus(points[t[2]].doubles(), a));
    const Vector3 size{std::fabs(n[0]), std::fabs(n[1]), std::fabs(n[2])};
    return static_cast<int>(std::ranges::max_element(size) - size.begin());
}

bool are_along_space(const std::array<Vector3, 3>& axes) {
    return std::ranges::all_of(axes, [](const Vector3& a) {
        return std::ranges::any_of(a, [](double x) { return std::fabs(x) > near_one; });
    });
}

}  // namespace

std::optional<TurnedPoints> TurnedPoints::of(std::span<const LatticePoint> points,
                                             std::span<const Triangle> triangles) {
    const std::size_t step = triangles.size() / most_looked_at + 1;
    const auto axes =
        axes_across(frequent_directions(points, triangles, step), triangles.size() / step);
    if (!axes || are_along_space(*axes)) return std::nullopt;
    const auto origin = points[triangles[0][0]].doubles();
    TurnedPoints out;
    out.points.reserve(points.size());
    double range = 0;
    for (const LatticePoint& p : points) {
        const Vector3 d = minus(p.doubles(), origin);
        for (const double x : d) range = std::max(range, std::fabs(x));
        const auto along = [&](std::size_t k) { return Coordinate(0.25 * dot((*axes)[k], d)); };
        out.points.push_back({along(0), along(1), along(2)});
    }
    out.error = 0x1p-47 * range;
    return out;
}

bool TurnedPoints::are_apart(const Triangle& a, const Triangle& b) const {
    const int first = looking_axis(points, a);
    const int second = looking_axis(points, b);
    for (const int axis : {first, second}) {
        const int u = (axis + 1) % 3;
        const int v = (axis + 2) % 3;
        FlatTriangles seen{{}, {}, error};
        for (std::size_t i = 0; i < 3; ++i) {
            seen.a[i] = {points[a[i]][u].to_double(), points[a[i]][v].to_double()};
            seen.b[i] = {points[b[i]][u].to_double(), points[b[i]][v].to_double()};
        }
        if (seen.separates(seen.a, seen.b) || seen.separates(seen.b, seen.a)) return true;
        if (first == second) break;
    }
    return false;
}

}  // namespace trisect::detail
