// SPDX-License-Identifier: Apache-2.0
//
// A corner is near a plane where its value is within the bound of it, and far from it beyond 2^20
// times that. True values are within the bound of computed ones. So on an edge from a near corner
// to a far one the plane is met, if at all, within 2 / (2^20 + 1) of the edge's length from the
// near one, and on an edge between far corners within 2^-19 of it from the point that computed
// values give. What a triangle has in the plane then lies between two points, each known up to
// 2^-18 of the triangle's size. The other triangle lies on one side of the lines of its edges, in
// any projection along an axis.

#include <trisect/bsp/leaf/doubles/part_near_plane.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace trisect::detail {

namespace {

constexpr double far_from_plane = 0x1p20;
constexpr double error_of_part = 0x1p-18;

// What a triangle has in a plane: between two points, up to an error along each axis.
struct PartNearPlane {
    std::array<Vector3, 2> ends{};
    double error = 0;
    bool is_known = false;

    PartNearPlane(const std::array<Vector3, 3>& corners, const FilteredPlane& plane) {
        std::array<double, 3> value;
        std::array<std::size_t, 3> near;
        std::array<std::size_t, 3> far;
        std::size_t near_count = 0;
        std::size_t far_count = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            value[i] = plane.value(corners[i]);
            const double size = std::fabs(value[i]);
            if (size <= plane.bound) near[near_count++] = i;
            if (size > far_from_plane * plane.bound) far[far_count++] = i;
        }
        if (near_count == 0 || far_count == 0 || near_count + far_count != 3) return;
        is_known = true;
        double extent = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const auto [low, high] = std::minmax({corners[0][k], corners[1][k], corners[2][k]});
            extent = std::max(extent, high - low);
        }
        error = error_of_part * extent;
        ends = {corners[near[0]], corners[near[near_count - 1]]};
        if (near_count == 2 || (value[far[0]] > 0) == (value[far[1]] > 0)) return;
        const Vector3& from = corners[far[0]];
        const Vector3& to = corners[far[1]];
        const double part = value[far[0]] / (value[far[0]] - value[far[1]]);
        for (std::size_t k = 0; k < 3; ++k) {
            ends[1][k] = from[k] + part * (to[k] - from[k]);
            error = std::max(error, 0x1p-50 * std::fabs(from[k]));
        }
    }
};

std::size_t largest_of(const Vector3& v) {
    const double x = std::fabs(v[0]);
    const double y = std::fabs(v[1]);
    const double z = std::fabs(v[2]);
    return x >= y && x >= z ? 0 : (y >= z ? 1 : 2);
}

bool is_beside(const PartNearPlane& part, const TriangleAndPlane& other) {
    if (!part.is_known) return false;
    const std::size_t axis = largest_of(other.plane.normal);
    const std::size_t u = axis == 2 ? 0 : axis + 1;
    const std::size_t v = u == 2 ? 0 : u + 1;
    const std::array<Vector3, 3>& corners = other.corners;
    // Twice an area, and what it is off by for a point that is off by `error`.
    struct Area {
        double value;
        double off;
    };
    const auto area = [&](std::size_t i, std::size_t j, const Vector3& p, double error) {
        const double along_u = corners[j][u] - corners[i][u];
        const double along_v = corners[j][v] - corners[i][v];
        const double a = along_u * (p[v] - corners[i][v]);
        const double b = along_v * (p[u] - corners[i][u]);
        return Area{a - b, 0x1p-50 * (std::fabs(a) + std::fabs(b)) +
                               error * (std::fabs(along_u) + std::fabs(along_v))};
    };
    const Area all = area(0, 1, corners[2], 0);
    if (std::fabs(all.value) <= all.off) return false;
    const double inner = all.value > 0 ? 1 : -1;
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t j = i == 2 ? 0 : i + 1;
        const auto is_outside = [&](const Vector3& p) {
            const Area a = area(i, j, p, part.error);
            return inner * a.value < -2 * a.off;
        };
        if (is_outside(part.ends[0]) && is_outside(part.ends[1])) return true;
    }
    return false;
}

}  // namespace

bool are_apart_near_planes(const TriangleAndPlane& first, const TriangleAndPlane& second) {
    return is_beside(PartNearPlane(second.corners, first.plane), first) ||
           is_beside(PartNearPlane(first.corners, second.plane), second);
}

}  // namespace trisect::detail
