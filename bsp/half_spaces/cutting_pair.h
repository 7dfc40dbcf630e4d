// SPDX-License-Identifier: Apache-2.0
//
// CuttingPair: one or two planes that cut a mesh, looked at together.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include <trisect/bsp/half_spaces/cutting_plane.h>
#include <trisect/kernel/support/double2.h>

namespace trisect::detail {

/// Of each plane one side is kept. Both are looked at in the two lanes of a register.
class CuttingPair {
public:
    struct Side {
        const CuttingPlane* plane = nullptr;
        bool keeps_below = true;
    };
    /// \pre one or two
    explicit CuttingPair(std::span<const Side> sides) {
        for (std::size_t i = 0; i < 2; ++i) {
            const Side& side = sides[i < sides.size() ? i : 0];
            const Plane& plane = side.plane->plane();
            for (std::size_t k = 0; k < 3; ++k)
                normal_[k][i] = plane.approx_normal(static_cast<int>(k));
            offset_[i] = plane.approx_offset();
            bound_[i] = side.plane->bound();
            keeps_below_ |= side.keeps_below ? 1U << i : 0U;
        }
        used_ = sides.size() == 1 ? 1U : 3U;
    }

    static constexpr unsigned in_doubt = 4;
    /// On which planes' wrong sides a corner is, a bit for each, or in_doubt where doubles do not
    /// decide.
    [[nodiscard]] unsigned wrong_sides(const LatticePoint& p) const {
        const std::array<double, 3> c = p.doubles();
        // As CuttingPlane::value() adds.
        const Double2 v =
            ((normal_[0] * both(c[0]) + normal_[1] * both(c[1])) + normal_[2] * both(c[2])) +
            offset_;
        const unsigned above = bits_of(v > bound_);
        const unsigned below = bits_of(v < -bound_);
        if ((above | below) != 3) [[unlikely]]
            return in_doubt;
        return ((above & keeps_below_) | (below & ~keeps_below_)) & used_;
    }

private:
    std::array<Double2, 3> normal_{};
    Double2 offset_{};
    Double2 bound_{};
    unsigned keeps_below_ = 0;
    unsigned used_ = 0;
};

}  // namespace trisect::detail
