// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/two_meshes/conforming/edge_order.h>

#include <optional>

#include <trisect/kernel/number/flat_corner.h>
#include <trisect/kernel/number/orientation.h>
#include <trisect/kernel/plane.h>
#include <trisect/kernel/predicates.h>

namespace trisect::detail {

int orientation(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c,
                const LatticePoint& d) {
    const Vector3 p = a.doubles();
    const Vector3 q = b.doubles();
    const Vector3 r = c.doubles();
    const Vector3 s = d.doubles();
    if (const int sign = filtered_orientation(p, q, r, s); sign != 0) return sign;
    if (const std::optional<int> sign = exact_orientation_of_fractions(p, q, r, s)) return *sign;
    return -sign_of(side_of(d, Plane::through(a, b, c)));
}

bool are_on_one_side(const LatticePoint& from, const LatticePoint& to, const LatticePoint& a,
                     const LatticePoint& b) {
    for (int axis = 0; axis < 3; ++axis) {
        const int u = (axis + 1) % 3;
        const int v = (axis + 2) % 3;
        const FlatCorner p = flat_corner(from, u, v);
        const FlatCorner q = flat_corner(to, u, v);
        if (const int of_a = turn(p, q, flat_corner(a, u, v)); of_a != 0)
            return of_a == turn(p, q, flat_corner(b, u, v));
    }
    return false;
}

}  // namespace trisect::detail
