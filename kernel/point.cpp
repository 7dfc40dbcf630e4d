// SPDX-License-Identifier: Apache-2.0

#include <trisect/kernel/point.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include <trisect/kernel/contract.h>
#include <trisect/kernel/counters.h>
#include <trisect/kernel/number/error_bounds.h>

namespace trisect {

namespace {

// The lattice point on all three planes, if there is one: their common point. Its coordinates are
// then the correctly rounded ones.
std::optional<LatticePoint> lattice_point_on(const std::array<double, 3>& nearest, const Plane& p,
                                             const Plane& q, const Plane& r) {
    for (const double c : nearest)
        if (std::fabs(c) >= static_cast<double>(coordinate_limit) || std::nearbyint(c) != c)
            return std::nullopt;
    const LatticePoint point{Coordinate(nearest[0]), Coordinate(nearest[1]),
                             Coordinate(nearest[2])};
    for (const Plane* plane : {&p, &q, &r})
        if (side_of(point, *plane) != Side::On) return std::nullopt;
    return point;
}

// Correctly rounded coordinates are off by half a unit in the last place of the largest one.
Approximation certified(const std::array<double, 3>& nearest) {
    const double largest =
        std::max(std::fabs(nearest[0]), std::max(std::fabs(nearest[1]), std::fabs(nearest[2])));
    return {nearest, largest * detail::unit_roundoff};
}

}  // namespace

Point::Point(const Plane& p, const Plane& q, const Plane& r) {
    const std::array<double, 3> nearest = nearest_doubles(approximate(p, q, r), p, q, r);
    if (const auto point = lattice_point_on(nearest, p, q, r)) {
        lattice_ = *point;
        approximation_ = approximate(lattice_);
        return;
    }
    approximation_ = certified(nearest);
    const auto exact = intersect(p, q, r);
    TRISECT_EXPECTS(exact.has_value(), "point of three planes that do not meet in one point");
    planes_ = std::make_shared<const PlanePoint>(PlanePoint{{p, q, r}, *exact});
}

HomogeneousPoint Point::homogeneous() const {
    if (planes_) return planes_->exact;
    return trisect::homogeneous(lattice_);
}

std::array<double, 3> Point::nearest() const { return approximation_.c; }

bool operator==(const Point& a, const Point& b) {
    if (a.is_lattice() && b.is_lattice()) return a.lattice_ == b.lattice_;
    if (a.planes_ == b.planes_) return true;
    // Correctly rounded coordinates are a function of the exact point.
    if (a.approximation_.c != b.approximation_.c) return false;
    if (a.is_lattice()) return b == a;
    // Whole points of planes are lattice points.
    if (b.is_lattice() && b.lattice_.is_whole()) return false;
    for (const Plane& plane : a.planes_->planes)
        if (side_of(b, plane) != Side::On) return false;
    return true;
}

Side side_of(const Point& point, const Plane& plane) {
    if (point.is_lattice()) return side_of(point.lattice(), plane);
    const PlanePoint& p = *point.plane_point();
    auto& counters = detail::counters_of_thread<PredicateCounters>;
    if (const auto s = filtered_side(point.approximation(), plane)) {
        ++counters.filtered;
        return *s;
    }
    for (const Plane& q : p.planes) {
        if (q == plane) {
            ++counters.symbolic;
            return Side::On;
        }
    }
    return side_of(p.exact, plane);
}

namespace {

// A plane across the axis that names the point; null where there is none.
const Plane* plane_across(const Point& p, int axis) {
    const PlanePoint* const named = p.plane_point();
    if (named == nullptr) return nullptr;
    const auto at = std::ranges::find_if(named->planes, [&](const Plane& plane) {
        return plane.approx_normal((axis + 1) % 3) == 0 && plane.approx_normal((axis + 2) % 3) == 0;
    });
    return at == named->planes.end() ? nullptr : &*at;
}

// Points of one plane across an axis are many where solids are flush.
bool are_in_one_plane_across(const Point& a, const Point& b, int axis) {
    const Plane* const p = plane_across(a, axis);
    const Plane* const q = plane_across(b, axis);
    if (p != nullptr && q != nullptr) return is_same_plane(*p, *q);
    if (p != nullptr && b.is_lattice()) return side_of(b.lattice(), *p) == Side::On;
    return q != nullptr && a.is_lattice() && side_of(a.lattice(), *q) == Side::On;
}

}  // namespace

std::strong_ordering compare_coordinate(const Point& a, const Point& b, int axis) {
    const auto i = static_cast<std::size_t>(axis);
    if (a.is_lattice() && b.is_lattice()) return a.lattice()[axis] <=> b.lattice()[axis];
    // Rounding is monotone, so different nearest doubles give the order of the exact values.
    const double u = a.approximation().c[i];
    const double v = b.approximation().c[i];
    if (u < v) return std::strong_ordering::less;
    if (u > v) return std::strong_ordering::greater;
    if (are_in_one_plane_across(a, b, axis)) return std::strong_ordering::equal;
    return compare_coordinate(a.homogeneous(), b.homogeneous(), axis);
}

std::strong_ordering compare_lexicographic(const Point& a, const Point& b) {
    for (int axis = 0; axis < 3; ++axis)
        if (const auto c = compare_coordinate(a, b, axis); c != 0) return c;
    return std::strong_ordering::equal;
}

}  // namespace trisect
