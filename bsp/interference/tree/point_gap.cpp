// SPDX-License-Identifier: Apache-2.0
//
// Along a direction d, whatever it is, the least of d · (x - c) over the corners c bounds what
// parts a point x from the triangle. With components of d at most D and of x - c at most g, the
// product is off by less than 2^-50 D g for rounding and 3 D e for an error e of the corners; a
// point within `reach` of x in each coordinate is along d within 3 D reach.

#include <trisect/bsp/interference/tree/point_gap.h>

#include <algorithm>

#include <trisect/kernel/number/error_bounds.h>
#include <trisect/kernel/number/vector3.h>

namespace trisect::detail {

bool is_certainly_beyond(const TriangleCorners& triangle, double error,
                         const std::array<double, 3>& point, double reach) {
    const std::array<Vector3, 3> way{minus(point, triangle[0]), minus(point, triangle[1]),
                                     minus(point, triangle[2])};
    const double g =
        std::max({largest_component(way[0]), largest_component(way[1]), largest_component(way[2])});
    const double slack = bound_slack * 3 * (error + reach) + 0x1p-48 * g;
    const auto parts = [&](const Vector3& d) {
        const std::array<double, 3> v{dot(d, way[0]), dot(d, way[1]), dot(d, way[2])};
        const double bound = slack * largest_component(d);
        return (v[0] > bound && v[1] > bound && v[2] > bound) ||
               (v[0] < -bound && v[1] < -bound && v[2] < -bound);
    };
    for (std::size_t k = 0; k < 3; ++k) {
        Vector3 axis{};
        axis[k] = 1;
        if (parts(axis)) return true;
    }
    const Vector3 normal = cross(minus(triangle[1], triangle[0]), minus(triangle[2], triangle[0]));
    if (parts(normal)) return true;
    for (std::size_t i = 0; i < 3; ++i)
        if (parts(cross(normal, minus(triangle[(i + 1) % 3], triangle[i])))) return true;
    return false;
}

}  // namespace trisect::detail
