// SPDX-License-Identifier: Apache-2.0
//
// Two triangles have a common point exactly if a side of one meets the other. Whether a side pq
// meets the triangle abc is decided by the sides of abc's plane on which p and q lie and by the
// three orientations of pq with the sides of abc (Guigue and Devillers 2003 order such signs
// cleverly; here all that matter are computed, since nearly every pair that comes this far is
// close).
//
// Every value is the determinant of three differences of points, with the bound of error_bounds.h
// (difference_determinant_bound).

#include <trisect/bsp/interference/boxes/triangle_filter.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <trisect/bsp/interference/boxes/obb_fit.h>
#include <trisect/kernel/number/error_bounds.h>
#include <trisect/kernel/number/vector3.h>

namespace trisect::detail {

namespace {

enum class SideVerdict : std::uint8_t { Misses, Crosses, Unknown };

// A side whose ends have the certain signs p and q to the plane of a triangle, about whose sides it
// turns as o says.
SideVerdict meet(int p, int q, int o0, int o1, int o2) {
    if (p * q > 0) return SideVerdict::Misses;
    const bool positive = o0 > 0 || o1 > 0 || o2 > 0;
    const bool negative = o0 < 0 || o1 < 0 || o2 < 0;
    if (positive && negative) return SideVerdict::Misses;
    if (p * q < 0 && o0 * o1 * o2 != 0) return SideVerdict::Crosses;
    return SideVerdict::Unknown;
}

// Whether a side of p, seen along an axis, has the rest of p strictly on one side of it and q on
// the other.
bool has_separating_side(const TriangleCorners& p, const TriangleCorners& q, std::size_t axis,
                         double g, double error) {
    const double bound = difference_minor_bound(g, error);
    const std::size_t i = (axis + 1) % 3;
    const std::size_t j = (axis + 2) % 3;
    for (std::size_t k = 0; k < 3; ++k) {
        const auto& from = p[k];
        const auto& to = p[(k + 1) % 3];
        const double u = to[i] - from[i];
        const double v = to[j] - from[j];
        const auto side = [&](const Vector3& x) {
            return certain_sign(u * (x[j] - from[j]) - v * (x[i] - from[i]), bound);
        };
        const int own = side(p[(k + 2) % 3]);
        if (own != 0 && side(q[0]) == -own && side(q[1]) == -own && side(q[2]) == -own) return true;
    }
    return false;
}

}  // namespace

PairVerdict compare_triangles(const TriangleCorners& p, const TriangleCorners& q, double error) {
    // All differences from corner 0 of p, and the sides.
    const Vector3 p1 = minus(p[1], p[0]);
    const Vector3 p2 = minus(p[2], p[0]);
    const std::array<Vector3, 3> w{minus(q[0], p[0]), minus(q[1], p[0]), minus(q[2], p[0])};
    const Vector3 q1 = minus(q[1], q[0]);
    const Vector3 q2 = minus(q[2], q[0]);
    // Components of other differences below are sums of two of these.
    double g = std::max(std::max(largest_component(p1), largest_component(p2)),
                        std::max(largest_component(q1), largest_component(q2)));
    g = 2 * std::max(g, std::max(largest_component(w[0]),
                                 std::max(largest_component(w[1]), largest_component(w[2]))));
    const double bound = difference_determinant_bound(g, error);

    const Vector3 n = cross(p1, p2);
    std::array<int, 3> q_side{};
    for (std::size_t i = 0; i < 3; ++i) q_side[i] = certain_sign(dot(n, w[i]), bound);
    if (q_side[0] != 0 && q_side[0] == q_side[1] && q_side[1] == q_side[2])
        return PairVerdict::Apart;
    const Vector3 m = cross(q1, q2);
    const std::array<Vector3, 3> v{minus(p[0], q[0]), minus(p[1], q[0]), minus(p[2], q[0])};
    std::array<int, 3> p_side{};
    for (std::size_t i = 0; i < 3; ++i) p_side[i] = certain_sign(dot(m, v[i]), bound);
    if (p_side[0] != 0 && p_side[0] == p_side[1] && p_side[1] == p_side[2])
        return PairVerdict::Apart;

    // turn[i][j]: the orientation of side i of p and side j of q.
    const std::array<Vector3, 3> p_side_vector{p1, minus(p[2], p[1]), minus(p[0], p[2])};
    const std::array<Vector3, 3> q_side_vector{q1, minus(q[2], q[1]), minus(q[0], q[2])};
    std::array<std::array<int, 3>, 3> turn{};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) {
            const Vector3 way = i == 0 ? w[j] : minus(q[j], p[i]);
            turn[i][j] = certain_sign(dot(cross(p_side_vector[i], q_side_vector[j]), way), bound);
        }
    bool unknown = false;
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t next = (i + 1) % 3;
        const SideVerdict of_p = meet(p_side[i], p_side[next], turn[i][0], turn[i][1], turn[i][2]);
        const SideVerdict of_q = meet(q_side[i], q_side[next], turn[0][i], turn[1][i], turn[2][i]);
        if (of_p == SideVerdict::Crosses || of_q == SideVerdict::Crosses)
            return PairVerdict::Crossing;
        unknown = unknown || of_p == SideVerdict::Unknown || of_q == SideVerdict::Unknown;
    }
    if (!unknown) return PairVerdict::Apart;
    // In one plane, or nearly so, all of these are next to nothing. What is apart seen along an
    // axis is apart.
    std::size_t axis = 0;
    for (std::size_t k = 1; k < 3; ++k)
        if (std::abs(n[k]) > std::abs(n[axis])) axis = k;
    return has_separating_side(p, q, axis, g, error) || has_separating_side(q, p, axis, g, error)
               ? PairVerdict::Apart
               : PairVerdict::Unknown;
}

}  // namespace trisect::detail
