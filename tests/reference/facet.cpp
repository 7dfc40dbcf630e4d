// SPDX-License-Identifier: Apache-2.0
#include "facet.h"

#include <algorithm>
#include <utility>

namespace reference {

Integer value_at(const OrientedPlane& plane, const IntegerPoint& p) {
    return plane.normal[0] * p[0] + plane.normal[1] * p[1] + plane.normal[2] * p[2] + plane.offset;
}

Point3 to_point(const IntegerPoint& p) { return {Rational(p[0]), Rational(p[1]), Rational(p[2])}; }

std::vector<Facet> gather(const std::vector<Operand>& operands) {
    std::vector<Facet> facets;
    for (std::size_t index = 0; index < operands.size(); ++index) {
        for (const Triangle& triangle : operands[index]) {
            const auto plane = plane_through(triangle[0], triangle[1], triangle[2]);
            if (!plane) {
                continue;
            }
            Facet facet{index, {}, *plane, {}, {}, 0};
            for (std::size_t axis = 0; axis < 3; ++axis) {
                for (std::size_t corner = 0; corner < 3; ++corner) {
                    facet.corners[corner][axis] = to_integer(triangle[corner][axis]);
                }
                facet.low[axis] =
                    to_integer(std::min({triangle[0][axis], triangle[1][axis], triangle[2][axis]}));
                facet.high[axis] =
                    to_integer(std::max({triangle[0][axis], triangle[1][axis], triangle[2][axis]}));
            }
            facets.push_back(std::move(facet));
        }
    }
    return facets;
}

OrientedPlane unoriented(const OrientedPlane& plane) {
    const OrientedPlane flipped = plane.flipped();
    return plane < flipped ? flipped : plane;
}

}  // namespace reference
