// SPDX-License-Identifier: Apache-2.0
//
// Triangles of one face whose corners were rounded lie nearly in one plane, and edges that were on
// one line nearly are: neither of the planes and lines that the triangles come with keeps them
// apart, but a turned one does. Its normal is found by the perceptron: the corners that are worst
// off by the last direction turn it towards them. Whatever comes out is tested with bounds.

#include <trisect/brep/contact/separating_plane.h>

#include <cmath>
#include <cstddef>

#include <trisect/kernel/number/error_bounds.h>
#include <trisect/kernel/number/vector3.h>

namespace trisect::detail {

namespace {

using Triangle = std::array<std::uint32_t, 3>;

constexpr int most_steps = 24;

// What one triangle has on its side of the plane: corners from an origin, one rounding each.
struct Corners {
    std::array<Vector3, 3> at;
    std::size_t count = 0;
};

struct Farthest {
    double value = 0;  // along the direction, at least
    std::size_t corner = 0;
};

// The corner that is least far along a direction, with the bound taken off: a corner's components
// carry one rounding, products two, sums two more.
Farthest least_along(const Vector3& direction, const Corners& corners) {
    Farthest out;
    for (std::size_t i = 0; i < corners.count; ++i) {
        const Vector3& p = corners.at[i];
        const double size = std::fabs(direction[0] * p[0]) + std::fabs(direction[1] * p[1]) +
                            std::fabs(direction[2] * p[2]);
        const double value = dot(direction, p) - plane_value_rounding * size;
        if (i == 0 || value < out.value) out = {value, i};
    }
    return out;
}

Vector3 unit(const Vector3& v) {
    const double size = length(v);
    return size > 0 ? scaled(v, 1 / size) : v;
}

}  // namespace

bool have_plane_between(std::span<const LatticePoint> points, const Triangle& a,
                        const Triangle& b) {
    std::uint32_t shared = ~std::uint32_t{0};
    for (const std::uint32_t v : a)
        if (v == b[0] || v == b[1] || v == b[2]) shared = v;
    // Without a shared corner the plane goes between the corner of a that is farthest along, and
    // all of b: differences are between all pairs of corners.
    Corners ahead;   // is to be along the direction
    Corners behind;  // negated, so along it as well
    const bool is_shared = shared != ~std::uint32_t{0};
    const Vector3 origin = points[is_shared ? shared : a[0]].doubles();
    for (const std::uint32_t v : b)
        if (v != shared) ahead.at[ahead.count++] = minus(points[v].doubles(), origin);
    for (const std::uint32_t v : a)
        if (v != shared) behind.at[behind.count++] = minus(origin, points[v].doubles());
    Vector3 direction{};
    for (const Corners* side : {&ahead, &behind})
        for (std::size_t i = 0; i < side->count; ++i)
            direction = plus(direction, is_shared ? unit(side->at[i]) : side->at[i]);
    direction = unit(direction);
    for (int step = 0; step < most_steps; ++step) {
        const Farthest first = least_along(direction, ahead);
        const Farthest second = least_along(direction, behind);
        if (is_shared ? first.value > 0 && second.value > 0 : first.value + second.value > 0)
            return true;
        Vector3 worst = plus(ahead.at[first.corner], behind.at[second.corner]);
        if (is_shared)
            worst = first.value < second.value ? ahead.at[first.corner] : behind.at[second.corner];
        direction = unit(plus(direction, unit(worst)));
    }
    return false;
}

}  // namespace trisect::detail
