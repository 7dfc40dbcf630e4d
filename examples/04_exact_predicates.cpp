// SPDX-License-Identifier: Apache-2.0
//
// Two questions that doubles get wrong, answered by the kernel, and which stage answered them.

#include <iostream>

#include <trisect/kernel/counters.h>
#include <trisect/kernel/diagnostics.h>
#include <trisect/kernel/plane.h>
#include <trisect/kernel/point.h>
#include <trisect/kernel/predicates.h>

namespace {

using namespace trisect;

const char* name(Side side) {
    return side == Side::Below ? "below" : (side == Side::On ? "on" : "above");
}

// A point so close to a plane that the products of its equation differ in their 105th bit.
bool near_a_plane() {
    const std::int64_t big = std::int64_t{1} << 52;
    const LatticePoint c{big + 2, big + 1, 0};
    const LatticePoint p{big + 3, big + 2, 0};
    const Plane plane = Plane::through({0, 0, 0}, {0, 0, 1}, c);

    const double in_doubles =
        -c.y.to_double() * p.x.to_double() + c.x.to_double() * p.y.to_double();
    const Side exact = side_of(p, plane);
    std::cout << "doubles say " << in_doubles << ", exactly it is " << name(exact) << '\n';
    return exact == Side::Above;
}

// 1/10 + 2/10 = 3/10, which no double knows: the point where x = 1/10, y = 2/10 and z = 3/10 lies
// on the plane x + y = z.
bool on_a_plane() {
    const Point p(Plane::axis_aligned(0, 10, 1), Plane::axis_aligned(1, 10, 2),
                  Plane::axis_aligned(2, 10, 3));
    const Plane sum = Plane::through({0, 0, 0}, {1, 0, 1}, {0, 1, 1});
    const auto c = p.nearest();
    const Side exact = side_of(p, sum);
    std::cout << "doubles say " << c[0] + c[1] - c[2] << ", exactly it is " << name(exact) << '\n';
    // A plane by which the point is named contains it: no arithmetic. Most points are far away: one
    // line of doubles with an error bound is enough.
    const Side named = side_of(p, Plane::axis_aligned(0, 10, 1));
    const Side far = side_of(p, Plane::axis_aligned(0, 1, 7));
    if (named != Side::On || far != Side::Below) return false;
    return exact == Side::On && c[0] == 0.1 && c[1] == 0.2 && c[2] == 0.3;
}

}  // namespace

int main() {
    const Diagnostics<PredicateCounters> diagnostics;
    const bool right = near_a_plane() && on_a_plane();
    const PredicateCounters n = diagnostics.counters();
    std::cout << n.symbolic << " signs symbolic, " << n.filtered << " filtered, " << n.exact_narrow
              << " in 256 bits, " << n.exact_wide << " in 512 bits\n";
    return right ? 0 : 1;
}
