// SPDX-License-Identifier: Apache-2.0
//
// Filtered stage of the predicates: rounded values with error bounds.
// The sign of a value is certain where the value is larger than its bound.
//
// The formulas are templates, because the bounds are theorems about any binary format: a test runs
// them in a format of six bits, where all roundings that can happen do happen
// (tests/kernel/number/filter_bounds_test.cpp). The predicates use them with double;
// `filtered_side` of predicates.h is filter_side written out, and the same test compares both.
//
// u is the unit roundoff, half the distance from 1 to the next number. Rounding is to nearest;
// nothing underflows or overflows (terms are 0 or at least 2^-400, and below 2^400). Coefficients
// of planes are integers that carry one rounding each.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include <trisect/kernel/number/error_bounds.h>
#include <trisect/kernel/number/vector3.h>

namespace trisect::detail {

/// The constants of a format.
template <class F>
struct Roundoff;

template <>
struct Roundoff<double> {
    static constexpr double times_8 = 0x1p-50;
    static constexpr double times_16 = 0x1p-49;
    static constexpr double slack = error_slack;  ///< at least 1 + 8u
};

template <class F>
struct Filtered {
    F value;
    F bound;

    /// 1 or -1, or 0 when nothing is known.
    [[nodiscard]] constexpr int sign() const {
        if (value > bound) return 1;
        return value < -bound ? -1 : 0;
    }
};

template <class F>
[[nodiscard]] constexpr F magnitude(F v) {
    return v < F(0) ? -v : v;
}

// Without a branch.
[[nodiscard]] inline double magnitude(double v) { return std::fabs(v); }

/// n·c + d, where each true coordinate is within `error` of c.
///
/// Products carry two roundings, the additions one each, so the rounding error is below 6u
/// Σ|terms|; moving each c_i by `error` changes the sum by at most error·Σ|n_i|. The factor 8 and
/// the slack pay for the rounding of the bound itself.
template <class F>
[[nodiscard]] constexpr Filtered<F> filter_side(const std::array<F, 3>& n, F d,
                                                const std::array<F, 3>& c, F error) {
    const F tx = n[0] * c[0];
    const F ty = n[1] * c[1];
    const F tz = n[2] * c[2];
    const F terms = ((magnitude(tx) + magnitude(ty)) + magnitude(tz)) + magnitude(d);
    const F normals = (magnitude(n[0]) + magnitude(n[1])) + magnitude(n[2]);
    return {((tx + ty) + tz) + d,
            Roundoff<F>::times_8 * terms + Roundoff<F>::slack * (error * normals)};
}

/// a d - b c. Products carry three roundings, the difference one: 4u, and 8u with those of the
/// bound.
template <class F>
[[nodiscard]] constexpr Filtered<F> filter_cross(F a, F b, F c, F d) {
    const F s = a * d;
    const F t = b * c;
    return {s - t, Roundoff<F>::times_8 * (magnitude(s) + magnitude(t))};
}

/// a·b. A product of two rounded factors is within 3u of itself, two additions make it 5u.
template <class F>
[[nodiscard]] constexpr Filtered<F> filter_dot(const std::array<F, 3>& a,
                                               const std::array<F, 3>& b) {
    F sum = F(0);
    F terms = F(0);
    for (std::size_t i = 0; i < 3; ++i) {
        const F t = a[i] * b[i];
        sum = sum + t;
        terms = terms + magnitude(t);
    }
    return {sum, Roundoff<F>::times_8 * terms};
}

/// a · (b × c). An entry of the cross product is within 5u of the sum of the magnitudes of its two
/// products, a term (one more product, three more sums) within 11u; 16u covers the second-order
/// terms and the rounding of the magnitudes.
template <class F>
[[nodiscard]] constexpr Filtered<F> filter_det(const std::array<F, 3>& a, const std::array<F, 3>& b,
                                               const std::array<F, 3>& c) {
    F sum = F(0);
    F terms = F(0);
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t j = (i + 1) % 3;
        const std::size_t l = (i + 2) % 3;
        const F s = b[j] * c[l];
        const F t = b[l] * c[j];
        sum = sum + a[i] * (s - t);
        terms = terms + magnitude(a[i]) * (magnitude(s) + magnitude(t));
    }
    return {sum, Roundoff<F>::times_16 * terms};
}

/// det(a - d, b - d, c - d) of exact points; differences carry one rounding each. Shewchuk (1997,
/// 4.4) proves that 8u cover it, with those of the bound.
template <class F>
[[nodiscard]] constexpr Filtered<F> filter_orientation(const std::array<F, 3>& a,
                                                       const std::array<F, 3>& b,
                                                       const std::array<F, 3>& c,
                                                       const std::array<F, 3>& d) {
    const std::array<F, 3> p = minus(a, d);
    const std::array<F, 3> q = minus(b, d);
    const std::array<F, 3> r = minus(c, d);
    F sum = F(0);
    F permanent = F(0);
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t i = (k + 1) % 3;
        const std::size_t j = (k + 2) % 3;
        const F s = q[i] * r[j];
        const F t = q[j] * r[i];
        sum = sum + p[k] * (s - t);
        permanent = permanent + magnitude(p[k]) * (magnitude(s) + magnitude(t));
    }
    return {sum, Roundoff<F>::times_8 * permanent};
}

}  // namespace trisect::detail
