// SPDX-License-Identifier: Apache-2.0
//
// Heights of moving points over planes, as polynomials in integers.
// They are scaled by positive numbers: only their signs are used.
#pragma once

#include <trisect/bsp/interference/certificate/find/gmp_vector.h>
#include <trisect/bsp/interference/motion/motion_piece.h>

namespace trisect::detail {

/// Where a point goes, times a positive weight; and that weight.
struct MovingPoint {
    PolynomialVector x;
    IntegerPolynomial w;

    MovingPoint(const MotionPiece& map, const GmpVector& p);
};

/// A positive multiple of n·x + c w.
[[nodiscard]] IntegerPolynomial height(const GmpVector& n, const mpq_class& c,
                                       const MovingPoint& p);
/// A positive multiple of x - w q.
[[nodiscard]] PolynomialVector way_from(const GmpVector& q, const MovingPoint& p);
/// Of a vector v: a positive multiple of M v.
[[nodiscard]] PolynomialVector moving_direction(const MotionPiece& map, const GmpVector& v);
/// A positive multiple of a vector that rests.
[[nodiscard]] PolynomialVector constant(const GmpVector& v);

}  // namespace trisect::detail
