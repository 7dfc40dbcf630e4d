// SPDX-License-Identifier: Apache-2.0
//
// SweptSeparation: moving triangles separated by a fixed direction during an interval.
#pragma once

#include <array>
#include <cstdint>

#include <trisect/bsp/interference/boxes/triangle_filter.h>
#include <trisect/bsp/interference/motion/ball_motion.h>
#include <trisect/bsp/interference/motion/swept_walk.h>
#include <trisect/bsp/interference/relation/boundary.h>

namespace trisect::detail {

class SweptSeparation {
public:
    /// During the interval of `over`; `middle` is its swept map. All must outlive this.
    SweptSeparation(const Boundary& a, const Boundary& b, const BallMotion& over,
                    const SweptMap& middle, double margin)
        : a_(a), b_(b), over_(over), middle_(middle), margin_(margin) {}

    /// Whether the triangles are certainly farther than the margin from each other all the time, in
    /// A's lattice units. Best called with the same triangle of B many times in a row.
    [[nodiscard]] bool are_apart(std::uint32_t triangle_a, std::uint32_t triangle_b);

private:
    using Path = std::array<BallVector, BallPolynomial::max_degree + 1>;

    void move(std::uint32_t triangle_b);
    [[nodiscard]] bool is_separated_along(const std::array<double, 3>& direction,
                                          const std::array<BallVector, 3>& corners) const;

    const Boundary& a_;
    const Boundary& b_;
    const BallMotion& over_;
    const SweptMap& middle_;
    double margin_;
    std::uint32_t moved_ = 0xffffffffU;
    std::array<Path, 3> paths_;
    TriangleCorners in_the_middle_{};
};

}  // namespace trisect::detail
