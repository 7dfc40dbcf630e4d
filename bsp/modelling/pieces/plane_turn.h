// SPDX-License-Identifier: Apache-2.0
//
// PlaneTurns: exact turns of points of the plane.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <trisect/brep/primitives/point_2d.h>
#include <trisect/kernel/lattice_point.h>

namespace trisect::detail {

class PlaneTurns {
public:
    /// \throw LimitError for points that are not finite
    explicit PlaneTurns(std::span<const Point2d> points);
    /// 1 for a left turn, 0 on a line. Doubles decide where they can.
    [[nodiscard]] int turn(std::size_t a, std::size_t b, std::size_t c) const;

private:
    std::vector<LatticePoint> at_;
};

}  // namespace trisect::detail
