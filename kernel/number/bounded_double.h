// SPDX-License-Identifier: Apache-2.0
//
// BoundedDouble: a double with an error bound, for filters of feature tracking.
#pragma once

#include <optional>

namespace trisect::detail {

/// The exact value is within `e` of `v`. Rounding to nearest assumed: a sum or product is off by at
/// most 2^-53 of itself (and 2^-1075 where it underflows); the factor 1 + 2^-50 pays for the
/// rounding of the bounds themselves. Where a bound is infinite or NaN no sign is ever known.
struct BoundedDouble {
    double v = 0;
    double e = 0;

    constexpr BoundedDouble() = default;
    constexpr BoundedDouble(double value, double error) : v(value), e(error) {}

    /// -1 or 1, when it is certain.
    [[nodiscard]] std::optional<int> sign() const {
        if (v > e) return 1;
        if (v < -e) return -1;
        return std::nullopt;
    }

    friend BoundedDouble operator-(const BoundedDouble& a) { return {-a.v, a.e}; }
    friend BoundedDouble operator+(const BoundedDouble& a, const BoundedDouble& b) {
        const double sum = a.v + b.v;
        return {sum, ((a.e + b.e) + magnitude(sum) * 0x1p-53) * (1 + 0x1p-50)};
    }
    friend BoundedDouble operator-(const BoundedDouble& a, const BoundedDouble& b) {
        return a + -b;
    }
    friend BoundedDouble operator*(const BoundedDouble& a, const BoundedDouble& b) {
        const double product = a.v * b.v;
        const double error = (magnitude(a.v) * b.e + magnitude(b.v) * a.e) +
                             (a.e * b.e + magnitude(product) * 0x1p-53);
        return {product, error * (1 + 0x1p-50) + 0x1p-1060};
    }

private:
    static double magnitude(double x) { return x < 0 ? -x : x; }
};

}  // namespace trisect::detail
