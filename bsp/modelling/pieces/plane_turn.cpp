// SPDX-License-Identifier: Apache-2.0
#include <trisect/bsp/modelling/pieces/plane_turn.h>

#include <cmath>

#include <trisect/kernel/lattice.h>
#include <trisect/kernel/plane.h>

namespace trisect::detail {

PlaneTurns::PlaneTurns(std::span<const Point2d> points) {
    std::vector<Point3d> corners;
    corners.reserve(points.size());
    for (const Point2d& p : points) corners.push_back({p[0], p[1], 0});
    LatticeReport report;
    const Lattice lattice = choose_lattice(corners, 1, Fractions::Kept);
    at_ = to_lattice(corners, lattice, report, 1, Fractions::Kept);
}

int PlaneTurns::turn(std::size_t i, std::size_t j, std::size_t k) const {
    const LatticePoint& a = at_[i];
    const LatticePoint& b = at_[j];
    const LatticePoint& c = at_[k];
    const auto d = [](Coordinate p, Coordinate q) { return q.to_double() - p.to_double(); };
    const double left = d(a.x, b.x) * d(a.y, c.y);
    const double right = d(a.y, b.y) * d(a.x, c.x);
    const double bound = 0x1p-50 * (std::fabs(left) + std::fabs(right));
    if (std::fabs(left - right) > bound) return left > right ? 1 : -1;
    return bound == 0 || are_collinear(a, b, c) ? 0 : Plane::through(a, b, c).normal(2).sign();
}

}  // namespace trisect::detail
