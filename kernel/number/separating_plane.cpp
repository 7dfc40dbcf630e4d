// SPDX-License-Identifier: Apache-2.0
//
// Triangles of one face whose corners were rounded lie nearly in one plane, and edges that were on
// one line nearly are: neither of the planes and lines that the triangles come with keeps them
// apart, but a turned one does. Its normal is found by the perceptron: the corners that are worst
// off by the last direction turn it towards them. Whatever comes out is tested with bounds.

#include <trisect/kernel/number/separating_plane.h>

#include <cmath>
#include <cstddef>

#include <trisect/kernel/number/error_bounds.h>
#include <trisect/kernel/number/vector3.h>

namespace trisect::detail {

namespace {

constexpr int most_steps = 24;

// What one triangle has on its side of the plane: corners from an origin, one rounding each.
struct SideCorners {
    std::array<Vector3, 3> at;
    std::size_t count = 0;
};

struct Farthest {
    double value = 0;  // along the direction, at least
    std::size_t corner = 0;
};

// The corner that is least far along a direction, with the bound taken off: a corner's components
// carry one rounding, products two, sums two more.
Farthest least_along(const Vector3& direction, const SideCorners& corners) {
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

// From the mean of all differences on.
template <class IsFound, class Worst>
bool search(const SideCorners& ahead, const SideCorners& behind, bool normalized,
            const IsFound& is_found, const Worst& worst) {
    Vector3 direction{};
    for (const SideCorners* side : {&ahead, &behind})
        for (std::size_t i = 0; i < side->count; ++i)
            direction = plus(direction, normalized ? unit(side->at[i]) : side->at[i]);
    direction = unit(direction);
    for (int step = 0; step < most_steps; ++step) {
        const Farthest first = least_along(direction, ahead);
        const Farthest second = least_along(direction, behind);
        if (is_found(first.value, second.value)) return true;
        direction = unit(plus(direction, unit(worst(first, second))));
    }
    return false;
}

}  // namespace

// What is farthest along of a comes before what is least far of b.
bool have_plane_between(const std::array<Vector3, 3>& a, const std::array<Vector3, 3>& b) {
    SideCorners ahead;
    SideCorners behind;  // negated, so that it is to be along the direction as well
    for (const Vector3& p : b) ahead.at[ahead.count++] = minus(p, a[0]);
    for (const Vector3& p : a) behind.at[behind.count++] = minus(a[0], p);
    return search(
        ahead, behind, false, [](double first, double second) { return first + second > 0; },
        [&](const Farthest& first, const Farthest& second) {
            return plus(ahead.at[first.corner], behind.at[second.corner]);
        });
}

bool have_plane_between(const Vector3& common, const std::array<Vector3, 2>& a,
                        const std::array<Vector3, 2>& b) {
    SideCorners ahead;
    SideCorners behind;
    for (const Vector3& p : b) ahead.at[ahead.count++] = minus(p, common);
    for (const Vector3& p : a) behind.at[behind.count++] = minus(common, p);
    return search(
        ahead, behind, true, [](double first, double second) { return first > 0 && second > 0; },
        [&](const Farthest& first, const Farthest& second) {
            return first.value < second.value ? ahead.at[first.corner] : behind.at[second.corner];
        });
}

}  // namespace trisect::detail
