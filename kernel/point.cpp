// SPDX-License-Identifier: Apache-2.0

#include <trisect/kernel/point.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include <trisect/kernel/contract.h>
#include <trisect/kernel/counters.h>

namespace trisect {

namespace {

// The integer equal to x/w if there is one within the lattice's range. The candidate is the nearest
// integer to the correctly rounded quotient; equality is then checked exactly.
std::optional<std::int64_t> integer_quotient(const WideInt<7>& x, const WideInt<6>& w,
                                             double nearest) {
    if (std::fabs(nearest) >= static_cast<double>(coordinate_limit)) return std::nullopt;
    const double r = std::nearbyint(nearest);
    if (r != nearest) return std::nullopt;
    const auto i = static_cast<std::int64_t>(r);
    if (multiply<7>(w, WideInt<1>(i)) != x) return std::nullopt;
    return i;
}

// Correctly rounded coordinates are off by half a unit in the last place of the largest one.
Approximation certified(const std::array<double, 3>& nearest) {
    const double largest =
        std::max(std::fabs(nearest[0]), std::max(std::fabs(nearest[1]), std::fabs(nearest[2])));
    return {nearest, largest * 0x1p-53};
}

}  // namespace

Point::Point(const Plane& p, const Plane& q, const Plane& r) {
    const auto exact = intersect(p, q, r);
    TRISECT_EXPECTS(exact.has_value(), "point of three planes that do not meet in one point");
    approximation_ = certified(nearest_doubles(approximate(p, q, r), p, q, r));
    const auto x = integer_quotient(exact->xyz[0], exact->w, approximation_.c[0]);
    const auto y = integer_quotient(exact->xyz[1], exact->w, approximation_.c[1]);
    const auto z = integer_quotient(exact->xyz[2], exact->w, approximation_.c[2]);
    if (x && y && z) {
        lattice_ = {*x, *y, *z};
        approximation_ = approximate(lattice_);
        return;
    }
    planes_ = std::make_shared<const PlanePoint>(PlanePoint{{p, q, r}, *exact});
}

HomogeneousPoint Point::homogeneous() const {
    if (planes_) return planes_->exact;
    return {{WideInt<7>(lattice_.x), WideInt<7>(lattice_.y), WideInt<7>(lattice_.z)},
            WideInt<6>(1)};
}

std::array<double, 3> Point::nearest() const { return approximation_.c; }

bool operator==(const Point& a, const Point& b) {
    if (a.is_lattice() != b.is_lattice()) return false;
    if (a.is_lattice()) return a.lattice_ == b.lattice_;
    if (a.planes_ == b.planes_) return true;
    // Correctly rounded coordinates are a function of the exact point.
    if (a.approximation_.c != b.approximation_.c) return false;
    for (const Plane& plane : a.planes_->planes)
        if (side_of(b, plane) != Side::On) return false;
    return true;
}

Side side_of(const Point& point, const Plane& plane) {
    if (point.is_lattice()) return side_of(point.lattice(), plane);
    const PlanePoint& p = *point.plane_point();
    auto& counters = predicate_counters();
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

std::strong_ordering compare_coordinate(const Point& a, const Point& b, int axis) {
    const auto i = static_cast<std::size_t>(axis);
    if (a.is_lattice() && b.is_lattice()) return a.lattice()[axis] <=> b.lattice()[axis];
    // Rounding is monotone, so different nearest doubles tell the order of the exact values.
    const double u = a.approximation().c[i];
    const double v = b.approximation().c[i];
    if (u < v) return std::strong_ordering::less;
    if (u > v) return std::strong_ordering::greater;
    return compare_coordinate(a.homogeneous(), b.homogeneous(), axis);
}

std::strong_ordering compare_lexicographic(const Point& a, const Point& b) {
    for (int axis = 0; axis < 3; ++axis)
        if (const auto c = compare_coordinate(a, b, axis); c != 0) return c;
    return std::strong_ordering::equal;
}

}  // namespace trisect
