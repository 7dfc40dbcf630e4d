// SPDX-License-Identifier: Apache-2.0
//
// CuttingPlane: a plane that cuts a mesh, with its values in doubles.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include <trisect/bsp/cells/source.h>
#include <trisect/kernel/plane.h>
#include <trisect/kernel/predicates.h>

namespace trisect::detail {

class CuttingPlane {
public:
    /// `box` has all corners of which values are taken.
    CuttingPlane(const Plane& plane, const Box& box);

    [[nodiscard]] const Plane& plane() const { return plane_; }
    [[nodiscard]] double bound() const { return bound_; }
    [[nodiscard]] double value(const LatticePoint& p) const {
        const std::array<double, 3> c = p.doubles();
        return ((normal_[0] * c[0] + normal_[1] * c[1]) + normal_[2] * c[2]) +
               plane_.approx_offset();
    }
    /// -1 below, 0 on the plane, 1 above.
    [[nodiscard]] int side(const LatticePoint& p) const {
        const double v = value(p);
        if (v > bound_ || v < -bound_) [[likely]]
            return v > 0 ? 1 : -1;
        return sign_of(side_of(p, plane_));
    }

private:
    Plane plane_;
    std::array<double, 3> normal_{};
    double bound_ = 0;
};

/// Where an edge of a facet goes through the plane, the same for both facets of the edge. \pre its
/// ends are on both sides
[[nodiscard]] Approximation pierced_by(const CuttingPlane& plane, const Source& source,
                                       std::uint32_t facet, int edge);

}  // namespace trisect::detail
