// SPDX-License-Identifier: Apache-2.0
//
// BallMotion: a relative motion over an interval, with error bounds.
// It is in doubles.
#pragma once

#include <array>
#include <cstddef>

#include <trisect/bsp/interference/motion/motion_piece.h>
#include <trisect/kernel/number/ball.h>

namespace trisect::detail {

/// Bernstein coefficients of a polynomial over an interval. All polynomials of a motion are raised
/// to one degree.
struct BallPolynomial {
    static constexpr std::size_t max_degree = 8;
    std::array<Ball, max_degree + 1> b{};
};

/// Halves: the coefficients over the left and the right half. The two results may not be `p`.
void halve(const BallPolynomial& p, std::size_t degree, BallPolynomial& left,
           BallPolynomial& right);

/// The sign that the polynomial certainly has all over its interval, or 0.
[[nodiscard]] inline int constant_sign(const BallPolynomial& p, std::size_t degree) {
    const int s = p.b[0].sign();
    for (std::size_t k = 1; s != 0 && k <= degree; ++k)
        if (p.b[k].sign() != s) return 0;
    return s;
}

using BallMatrix = std::array<BallVector, 3>;

/// The maps of a RelativeMotion: one set of numbers for every Bernstein coefficient.
struct BallMotion {
    struct Maps {
        BallMatrix matrix;
        BallVector shift;
        Ball weight;
        BallMatrix plane_normal;
        BallVector plane_shift;
        Ball plane_offset;
        BallMatrix line_direction;
        BallMatrix line_moment;
        BallMatrix line_lever;
    };

    /// Over [0, 1]. \pre fits(motion)
    explicit BallMotion(const RelativeMotion& motion);
    /// The map of points alone, over [0, 1]. \pre fits(points)
    [[nodiscard]] static BallMotion of_points(const MotionPiece& points);
    /// Whether the degrees are low enough; otherwise every question is an exact one.
    [[nodiscard]] static bool fits(const RelativeMotion& motion);
    [[nodiscard]] static bool fits(const MotionPiece& points);

    /// The interval becomes its left or right half.
    [[nodiscard]] BallMotion left_half() const { return half(false); }
    [[nodiscard]] BallMotion right_half() const { return half(true); }

    [[nodiscard]] double middle() const { return (from + to) / 2; }

    /// Where the k-th coefficients take a point, without their errors: to guess.
    [[nodiscard]] std::array<double, 3> guessed_image(std::size_t k,
                                                      const std::array<double, 3>& x) const;

    std::size_t degree = 0;
    double from = 0;  ///< exact: multiples of powers of two
    double to = 1;
    std::array<Maps, BallPolynomial::max_degree + 1> maps{};

private:
    BallMotion() = default;
    [[nodiscard]] BallMotion half(bool right) const;
};

[[nodiscard]] inline BallVector operator*(const BallMatrix& m, const BallVector& v) {
    return {dot(m[0], v), dot(m[1], v), dot(m[2], v)};
}
[[nodiscard]] inline BallVector operator*(const BallVector& v, Ball f) {
    return {v[0] * f, v[1] * f, v[2] * f};
}

}  // namespace trisect::detail
