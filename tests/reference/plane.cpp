// SPDX-License-Identifier: Apache-2.0
#include "plane.h"

#include <stdexcept>
#include <utility>

namespace reference {

OrientedPlane::OrientedPlane(Integer a, Integer b, Integer c, Integer d)
    : normal{std::move(a), std::move(b), std::move(c)}, offset(std::move(d)) {
    Integer divisor = gcd(gcd(normal[0], normal[1]), normal[2]);
    if (divisor == 0) {
        throw std::invalid_argument("reference: a plane needs a normal");
    }
    divisor = gcd(divisor, offset);
    if (divisor != 1) {
        for (Integer& component : normal) {
            component /= divisor;
        }
        offset /= divisor;
    }
}

OrientedPlane OrientedPlane::flipped() const {
    return OrientedPlane(-normal[0], -normal[1], -normal[2], -offset);
}

Rational OrientedPlane::value(const Point3& p) const {
    return normal[0] * p[0] + normal[1] * p[1] + normal[2] * p[2] + offset;
}

bool OrientedPlane::operator<(const OrientedPlane& other) const {
    if (normal != other.normal) {
        return normal < other.normal;
    }
    return offset < other.offset;
}

std::optional<OrientedPlane> plane_through(const LatticePoint& a, const LatticePoint& b,
                                           const LatticePoint& c) {
    std::array<Integer, 3> e;
    std::array<Integer, 3> f;
    for (std::size_t i = 0; i < 3; ++i) {
        e[i] = to_integer(b[i]) - to_integer(a[i]);
        f[i] = to_integer(c[i]) - to_integer(a[i]);
    }
    const Integer x = e[1] * f[2] - e[2] * f[1];
    const Integer y = e[2] * f[0] - e[0] * f[2];
    const Integer z = e[0] * f[1] - e[1] * f[0];
    if (x == 0 && y == 0 && z == 0) {
        return std::nullopt;
    }
    const Integer offset = -(x * to_integer(a[0]) + y * to_integer(a[1]) + z * to_integer(a[2]));
    return OrientedPlane(x, y, z, offset);
}

PlaneChart::PlaneChart(const OrientedPlane& plane) : plane_(plane), dropped_(0) {
    for (std::size_t i = 1; i < 3; ++i) {
        if (abs(plane.normal[i]) > abs(plane.normal[dropped_])) {
            dropped_ = i;
        }
    }
    u_ = (dropped_ + 1) % 3;
    v_ = (dropped_ + 2) % 3;
}

Point3 PlaneChart::lift(const Point2& p) const {
    Point3 result;
    const Rational sum = plane_.normal[u_] * p[0] + plane_.normal[v_] * p[1] + plane_.offset;
    result[dropped_] = -sum / plane_.normal[dropped_];
    result[u_] = p[0];
    result[v_] = p[1];
    return result;
}

}  // namespace reference
