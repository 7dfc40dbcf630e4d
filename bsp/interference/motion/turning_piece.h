// SPDX-License-Identifier: Apache-2.0
//
// Turning: a uniform rotation about an axis with a straight shift.
// It is enclosed by rational screws.
#pragma once

#include <array>

#include <trisect/bsp/interference/motion/motion_piece.h>
#include <trisect/kernel/number/gmp.h>

namespace trisect::detail {

/// x -> R(t) (start x - center) + center + from + t (to - from) for 0 <= t <= 1, where R(t) is the
/// rotation by the quaternion `base` · (cos(t half_angle), sin(t half_angle) axis).
struct Turning {
    MotionPiece start = MotionPiece::still();   ///< a constant map
    std::array<mpz_class, 4> base{1, 0, 0, 0};  ///< of any length, not zero
    std::array<mpz_class, 3> axis{};            ///< a unit vector in fixed point (trigonometry.h),
                                                ///< each component within 2^-120
    mpq_class half_angle;                       ///< radians, within 2^-120; |.| <= 2^20
    std::array<mpq_class, 3> center;
    std::array<mpq_class, 3> from;
    std::array<mpq_class, 3> to;
};

/// A rational motion and how far it is from another one: at no time is any point x (in the user's
/// units, before the motion) farther than by_length |x| + constant from where it should be.
struct NearPiece {
    MotionPiece piece;
    double by_length = 0;
    double constant = 0;
};

/// A rational screw near the turning from t0 to t1. Where that is more than about 80 degrees the
/// bounds are infinite. \pre 0 <= t0 <= t1 <= 1
[[nodiscard]] NearPiece near_piece(const Turning& turning, const mpq_class& t0,
                                   const mpq_class& t1);

}  // namespace trisect::detail
