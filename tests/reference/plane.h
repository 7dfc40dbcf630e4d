// SPDX-License-Identifier: Apache-2.0
//
// Oriented planes with integer coefficients of any size, in lowest terms, so that two planes are
// the same oriented plane exactly if their coefficients are equal; and the chart that maps a plane
// to two of the three coordinates.
#pragma once

#include <array>
#include <optional>

#include "rational.h"

namespace reference {

// The plane normal . x + offset = 0, whose normal points to the positive side.
// Invariant: gcd(normal, offset) = 1 and the normal is not zero.
struct OrientedPlane {
    std::array<Integer, 3> normal;
    Integer offset;

    // a x + b y + c z + d = 0, divided by the greatest common divisor; the sign is kept.
    // Throws std::invalid_argument if a = b = c = 0.
    OrientedPlane(Integer a, Integer b, Integer c, Integer d);

    OrientedPlane flipped() const;
    Rational value(const Point3& p) const;

    bool operator==(const OrientedPlane&) const = default;
    bool operator<(const OrientedPlane& other) const;
};

// The plane through three points, counter-clockwise seen from the positive side; nothing if they
// are collinear.
std::optional<OrientedPlane> plane_through(const LatticePoint& a, const LatticePoint& b,
                                           const LatticePoint& c);

// Drops the coordinate in which the plane's normal is largest. The two others are kept in cyclic
// order, so that a region of area A seen from the positive side maps to the signed area
// A * normal[dropped] / |normal|.
class PlaneChart {
public:
    explicit PlaneChart(const OrientedPlane& plane);

    Point2 project(const Point3& p) const { return {p[u_], p[v_]}; }
    Point3 lift(const Point2& p) const;

    // Signed area in the chart times this is area / |normal|.
    Rational area_factor() const { return Rational(1) / Rational(plane_.normal[dropped_]); }

private:
    OrientedPlane plane_;
    std::size_t dropped_;
    std::size_t u_;
    std::size_t v_;
};

}  // namespace reference
