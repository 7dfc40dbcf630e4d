// SPDX-License-Identifier: Apache-2.0
//
// First contact of a moving vertex and triangle, or two moving edges.
// It is the exact stage of first contact, on polynomials.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include <trisect/brep/number/integer_polynomial.h>
#include <trisect/brep/number/real_root.h>

namespace trisect::detail {

/// Three polynomials in the parameter of the motion.
using PolynomialVector = std::array<IntegerPolynomial, 3>;

[[nodiscard]] PolynomialVector operator-(const PolynomialVector& a, const PolynomialVector& b);
/// Of a corner or side of a triangle, or an axis.
[[nodiscard]] constexpr std::size_t next_of_three(std::size_t i) { return (i + 1) % 3; }

[[nodiscard]] PolynomialVector cross(const PolynomialVector& a, const PolynomialVector& b);
[[nodiscard]] IntegerPolynomial dot(const PolynomialVector& a, const PolynomialVector& b);

/// An edge in motion. All points of one question are given times one common weight, a polynomial
/// that is positive all over the interval of the question; directions times any positive weight of
/// their own. So nothing is ever divided.
struct MovingEdge {
    std::array<PolynomialVector, 2> ends;
    PolynomialVector direction;  ///< of ends[1] - ends[0]
};

/// A triangle in motion; side i runs from corner i to corner i + 1.
struct MovingTriangle {
    std::array<PolynomialVector, 3> corners;
    std::array<PolynomialVector, 3> directions;  ///< of the sides
};

[[nodiscard]] MovingEdge moving_edge(const PolynomialVector& a, const PolynomialVector& b);
[[nodiscard]] MovingTriangle moving_triangle(const PolynomialVector& a, const PolynomialVector& b,
                                             const PolynomialVector& c);

/// Do the point and the closed triangle have a common point at the time s? The triangle may be flat
/// there. \pre the point is in a plane with the corners at s.
[[nodiscard]] bool meet_at(RealRoot& s, const PolynomialVector& point,
                           const MovingTriangle& triangle);
/// The same for two closed edges, which may be parallel or points. \pre they are coplanar at s.
[[nodiscard]] bool meet_at(RealRoot& s, const MovingEdge& a, const MovingEdge& b);
/// Is the point on the closed edge?
[[nodiscard]] bool meet_at(RealRoot& s, const PolynomialVector& point, const MovingEdge& edge);

/// On which sides of the triangle's sides the point is: 1 inside, 0 on the line, -1 beyond it.
/// \pre the point is in the triangle's plane at s, and the triangle is not flat there.
[[nodiscard]] std::array<int, 3> sides_at(RealRoot& s, const PolynomialVector& point,
                                          const MovingTriangle& triangle);
/// Do the edges cross in a point within both, the ends not counted? \pre they are coplanar at s.
[[nodiscard]] bool cross_within_at(RealRoot& s, const MovingEdge& a, const MovingEdge& b);

/// The closed interval of the parameter in which a contact is looked for.
struct TimeInterval {
    mpq_class from;
    mpq_class to;
};

/// The polynomial that is zero when the features are coplanar: a positive multiple of the
/// determinant of the differences.
[[nodiscard]] IntegerPolynomial coplanarity(const PolynomialVector& point,
                                            const MovingTriangle& triangle);
[[nodiscard]] IntegerPolynomial coplanarity(const MovingEdge& a, const MovingEdge& b);

/// The first time at which they meet, exactly; nothing means that they do not.
///
/// `coplanar` is their coplanarity up to factors without a root in the interval. Where it is zero
/// for good, the first time is the start or one when their order in the common plane changes.
[[nodiscard]] std::optional<RealRoot> first_meeting(const IntegerPolynomial& coplanar,
                                                    const PolynomialVector& point,
                                                    const MovingTriangle& triangle,
                                                    const TimeInterval& interval);
[[nodiscard]] std::optional<RealRoot> first_meeting(const IntegerPolynomial& coplanar,
                                                    const MovingEdge& a, const MovingEdge& b,
                                                    const TimeInterval& interval);

/// All times in the interval at which how they meet may change while they are coplanar for good,
/// ascending: a superset. \pre their coplanarity is the zero polynomial.
[[nodiscard]] std::vector<RealRoot> times_of_change(const PolynomialVector& point,
                                                    const MovingTriangle& triangle,
                                                    const TimeInterval& interval);
[[nodiscard]] std::vector<RealRoot> times_of_change(const MovingEdge& a, const MovingEdge& b,
                                                    const TimeInterval& interval);

}  // namespace trisect::detail
