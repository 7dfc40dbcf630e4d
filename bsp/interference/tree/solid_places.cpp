// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/interference/tree/solid_places.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include <trisect/bsp/interference/tree/entity_names.h>

namespace trisect::detail {

std::array<double, 3> point_on(const SolidBoundary& s, std::uint32_t triangle,
                               const std::array<double, 3>& weights) {
    const TriangleCorners c = s.corners_of(triangle);
    std::array<double, 3> p{};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t k = 0; k < 3; ++k) p[k] += weights[i] * c[i][k];
    return p;
}

Point3d in_world(std::array<double, 3> p, Lattice lattice, const Pose& pose) {
    for (double& c : p) c = std::ldexp(c, lattice.exponent);
    const auto f = pose.approximate();
    Point3d r{};
    for (std::size_t i = 0; i < 3; ++i)
        r[i] = f[4 * i] * p[0] + f[4 * i + 1] * p[1] + f[4 * i + 2] * p[2] + f[4 * i + 3];
    return r;
}

EntityName name_near(const SolidBoundary& s, std::uint32_t triangle,
                     const std::array<double, 3>& at) {
    const SolidBoundary::Origin origin = s.origin(triangle);
    double size = 0;
    for (const double c : at) size = std::max(size, std::fabs(c));
    std::vector<PolygonId> on = origin.leaf->polygons_near(at, 0x1p-40 * size, origin.turned);
    if (on.empty()) on.push_back(origin.polygon());
    return name_of(place_on(on));
}

}  // namespace trisect::detail
