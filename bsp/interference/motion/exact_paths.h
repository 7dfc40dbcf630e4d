// SPDX-License-Identifier: Apache-2.0
//
// Exact paths of points and directions of moving solids.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include <trisect/bsp/interference/motion/feature_contact.h>
#include <trisect/bsp/interference/motion/motion_piece.h>
#include <trisect/kernel/number/gmp.h>
#include <trisect/kernel/point.h>

namespace trisect::detail {

using MpzVector = std::array<mpz_class, 3>;

/// Points as integers over one common weight.
struct ExactPoints {
    std::vector<MpzVector> xyz;
    mpz_class weight = 1;

    void add(const Point& p);
};

[[nodiscard]] MpzVector difference(const MpzVector& a, const MpzVector& b);
[[nodiscard]] PolynomialVector constant(const MpzVector& v);
[[nodiscard]] PolynomialVector times(const PolynomialMatrix& m, const MpzVector& v);

/// The path of a point of B, over the common weight of points and motion.
[[nodiscard]] PolynomialVector moving_path(const RelativeMotion& motion, const ExactPoints& points,
                                           std::size_t i);
/// The same of a point of A, which stays where it is.
[[nodiscard]] PolynomialVector resting_path(const RelativeMotion& motion, const ExactPoints& points,
                                            std::size_t i);

/// A straight line by one of its points.
struct ExactLine {
    Point point;
    MpzVector direction;
};

/// Whether lines of A and B that meet at the time s cross there: they are not parallel then, and
/// not in one plane for good.
[[nodiscard]] bool cross_at(RealRoot& s, const RelativeMotion& motion, const ExactLine& a,
                            const ExactLine& b);

}  // namespace trisect::detail
