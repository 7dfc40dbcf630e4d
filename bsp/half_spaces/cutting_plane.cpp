// SPDX-License-Identifier: Apache-2.0
//
// The value of a plane at a corner, its coefficients rounded: each of them is off by 2^-53 of
// itself, a product by as much again and the three sums by at most three times that. In all less
// than 6 · 2^-53 times the sum of magnitudes; 2^-50 of the largest such sum is taken.

#include <trisect/bsp/half_spaces/cutting_plane.h>

#include <algorithm>
#include <cmath>

#include <trisect/bsp/cells/trace/interpolation.h>

namespace trisect::detail {

CuttingPlane::CuttingPlane(const Plane& plane, const Box& box) : plane_(plane) {
    double size = std::fabs(plane_.approx_offset());
    for (int k = 0; k < 3; ++k) {
        const auto i = static_cast<std::size_t>(k);
        normal_[i] = plane_.approx_normal(k);
        const double reach = std::max(std::fabs(static_cast<double>(box.lo[i])),
                                      std::fabs(static_cast<double>(box.hi[i])));
        size += std::fabs(normal_[i]) * (reach + 1);
    }
    bound_ = 0x1p-50 * size;
}

// From the corner of the smaller number.
Approximation pierced_by(const CuttingPlane& plane, const Source& source, std::uint32_t facet,
                         int edge) {
    const int next = edge == 2 ? 0 : edge + 1;
    const bool turned = source.corner_index(facet, edge) > source.corner_index(facet, next);
    const LatticePoint& from = source.corner(facet, turned ? next : edge);
    const LatticePoint& to = source.corner(facet, turned ? edge : next);
    Approximation at;
    if (interpolate(approximate(from), plane.value(from), approximate(to), plane.value(to),
                    2 * plane.bound(), at))
        return at;
    const Plane support = source.support(facet);
    return approximate(support, source.edge_plane(facet, edge, support), plane.plane());
}

}  // namespace trisect::detail
