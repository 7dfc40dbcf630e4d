// SPDX-License-Identifier: Apache-2.0
//
// NearNumber: a double with a proved error, for shifted points.
#pragma once

#include <cmath>

#include <trisect/kernel/coordinate.h>
#include <trisect/kernel/number/error_bounds.h>

namespace trisect::detail::shifted {

/// All numbers within `error` of `value`. An error of 0 means that nothing was rounded, so zeros of
/// planes across an axis and of edges along one are certain; a Ball has none.
///
/// Coordinates are multiples of 2^-73, and rounding leaves a product of d of them a multiple of
/// 2^-73d, so with d up to 10 neither values nor errors underflow; values are below 2^600.
struct NearNumber {
    double value = 0;
    double error = 0;

    constexpr NearNumber() = default;
    constexpr NearNumber(double v, double e) : value(v), error(e) {}
    constexpr explicit NearNumber(double v) : value(v) {}

    [[nodiscard]] bool is_zero() const { return value == 0 && error == 0; }
    [[nodiscard]] double to_double() const { return value; }

    // A sum's own error is what its rounding took away, which is a double.
    friend NearNumber operator+(const NearNumber& a, const NearNumber& b) {
        const double v = a.value + b.value;
        const double of_b = v - a.value;
        const double off = (a.value - (v - of_b)) + (b.value - of_b);
        return {v, (a.error + b.error + std::fabs(off)) * slightly_more};
    }
    friend NearNumber operator-(const NearNumber& a, const NearNumber& b) {
        return a + NearNumber(-b.value, b.error);
    }
    NearNumber& operator+=(const NearNumber& b) { return *this = *this + b; }
    friend NearNumber operator*(const NearNumber& a, const NearNumber& b) {
        if (a.is_zero() || b.is_zero()) return {};
        const double v = a.value * b.value;
        return {v, (std::fabs(a.value) * b.error + (std::fabs(b.value) + b.error) * a.error +
                    std::fabs(v) * unit_roundoff) *
                       slightly_more};
    }
};

/// The same interface as the integers'. Where errors leave a sign open, is_open() is true from then
/// on.
class NearNumbersOfShifts {
public:
    static constexpr int fraction = 0;
    using Length = NearNumber;
    using Area = NearNumber;
    using Minor = NearNumber;
    using Value = NearNumber;
    using Volume = NearNumber;
    using Sum = NearNumber;

    static NearNumber length(Coordinate c) { return NearNumber(c.to_double()); }
    [[nodiscard]] int sign(const NearNumber& v) const {
        const int s = certain_sign(v.value, v.error);
        if (s == 0 && !v.is_zero()) is_open_ = true;
        return s;
    }
    [[nodiscard]] bool is_open() const { return is_open_; }

private:
    mutable bool is_open_ = false;
};

}  // namespace trisect::detail::shifted
