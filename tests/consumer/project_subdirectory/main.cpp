// SPDX-License-Identifier: Apache-2.0
//
// One exact question: 1/10 + 2/10 = 3/10, of a point that no double holds.
#include <trisect/kernel/point.h>
#include <trisect/kernel/predicates.h>

int main() {
    using namespace trisect;
    const Point p(Plane::axis_aligned(0, 10, 1), Plane::axis_aligned(1, 10, 2),
                  Plane::axis_aligned(2, 10, 3));
    return side_of(p, Plane::through({0, 0, 0}, {1, 0, 1}, {0, 1, 1})) == Side::On ? 0 : 1;
}
