// SPDX-License-Identifier: Apache-2.0
//
// Ball: a double with a proved error bound, for the filters of motions.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include <trisect/kernel/number/error_bounds.h>
#include <trisect/kernel/number/vector3.h>

namespace trisect::detail {

/// All numbers within `error` of `value`. Sums and products contain every sum and product of
/// members, for round-to-nearest. Sizes must stay below 2^1000; the unit below guards against
/// underflow.
struct Ball {
    double value = 0;
    double error = 0;

    constexpr Ball() = default;
    constexpr Ball(double v, double e) : value(v), error(e) {}
    /// An exact double.
    constexpr explicit Ball(double v) : value(v) {}
    /// A number of which v is a nearest double, or off by one unit in the last place.
    static Ball rounded(double v) { return {v, std::abs(v) * last_place + 0x1p-1000}; }

    // One rounding of the value costs 2^-53 of it; the factor 1 + 2^-50 pays for the roundings of
    // the error itself.
    friend Ball operator+(Ball a, Ball b) {
        const double v = a.value + b.value;
        return {v, (a.error + b.error + std::abs(v) * unit_roundoff) * slightly_more};
    }
    friend Ball operator-(Ball a, Ball b) { return a + (-b); }
    friend Ball operator-(Ball a) { return {-a.value, a.error}; }
    friend Ball operator*(Ball a, Ball b) {
        const double v = a.value * b.value;
        return {v, (std::abs(a.value) * b.error + (std::abs(b.value) + b.error) * a.error +
                    std::abs(v) * unit_roundoff) *
                           slightly_more +
                       0x1p-1000};
    }
    Ball& operator+=(Ball b) { return *this = *this + b; }

    /// The sign of all members, or 0 when they do not share one.
    [[nodiscard]] int sign() const { return value > error ? 1 : (value < -error ? -1 : 0); }
    [[nodiscard]] double lower() const { return (value - error) - std::abs(value) * last_place; }
    [[nodiscard]] double upper() const { return (value + error) + std::abs(value) * last_place; }
};

using BallVector = VectorOf<Ball>;

/// A vector of which each component of v is a nearest double, or off by one unit in the last place.
inline BallVector rounded(const Vector3& v) {
    return {Ball::rounded(v[0]), Ball::rounded(v[1]), Ball::rounded(v[2])};
}

inline BallVector operator-(const BallVector& a, const BallVector& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline BallVector operator+(const BallVector& a, const BallVector& b) {
    return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}

/// The sign that a polynomial certainly has all over [0, 1], or 0. Coefficients in the Bernstein
/// basis, constant one first.
template <std::size_t N>
[[nodiscard]] int sign_of_bernstein(const std::array<Ball, N>& b) {
    const int s = b[0].sign();
    if (s == 0) return 0;
    for (std::size_t i = 1; i < N; ++i)
        if (b[i].sign() != s) return 0;
    return s;
}

}  // namespace trisect::detail
