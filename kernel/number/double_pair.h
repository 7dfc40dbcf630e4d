// SPDX-License-Identifier: Apache-2.0
//
// DoublePair: numbers of some 100 bits as sums of two doubles.
//
// The operations (Dekker 1971) keep less than the formulas of the literature could: what they are
// off by is stated in multiples of 2^-100, which leaves room for the sums of several. u = 2^-53.
#pragma once

#include <cmath>
#include <cstdint>

#include <trisect/kernel/wide_int.h>

namespace trisect::detail {

/// An unevaluated sum of two doubles, |low| at most half a unit in the last place of high.
struct DoublePair {
    double high = 0;
    double low = 0;
};

/// high + low = a + b exactly.
inline DoublePair two_sum(double a, double b) {
    const double s = a + b;
    const double t = s - a;
    return {s, (a - (s - t)) + (b - t)};
}

/// Off by less than 2^-103 (|a| + |b|): the low parts are below u times the high ones, and their
/// sums are rounded three times.
inline DoublePair add(const DoublePair& a, const DoublePair& b) {
    const DoublePair s = two_sum(a.high, b.high);
    return two_sum(s.high, s.low + (a.low + b.low));
}

inline DoublePair negated(const DoublePair& a) { return {-a.high, -a.low}; }

inline DoublePair subtract(const DoublePair& a, const DoublePair& b) { return add(a, negated(b)); }

/// Off by less than 2^-102 |a b|: the product of the low parts is left out, u² |a b|, and four
/// terms of u |a b| are rounded.
inline DoublePair multiply(const DoublePair& a, const DoublePair& b) {
    const double p = a.high * b.high;
    const double rest = std::fma(a.high, b.high, -p);
    return two_sum(p, rest + (a.high * b.low + a.low * b.high));
}

/// Off by less than 2^-100 |a / b|: the first quotient is off by less than 3 u, what is left of `a`
/// by less than 2^-101 |a|, and the second quotient by 3 u of itself. \pre b is not 0
inline DoublePair divide(const DoublePair& a, const DoublePair& b) {
    const double q = a.high / b.high;
    const DoublePair rest = subtract(a, multiply(b, {q, 0}));
    return two_sum(q, rest.high / b.high);
}

/// All bits, for summands of one sign: off by less than 2^-99 in relation, with two additions for
/// each limb, of up to eight.
template <int N>
DoublePair to_pair(const WideInt<N>& v) {
    DoublePair r;
    for (int i = N - 1; i >= 0; --i) {
        for (const std::uint64_t part : {v.limb(i) >> 32U, v.limb(i) & 0xffffffffU}) {
            r = {r.high * 0x1p32, r.low * 0x1p32};
            r = add(r, {static_cast<double>(part), 0});
        }
    }
    return r;
}

/// A number as value · 2^(64 · shift); the three limbs that are taken have its first 129 bits at
/// least, so it is off by less than 2^-100 in relation.
struct ScaledPair {
    DoublePair value;
    int shift = 0;
};
template <int N>
ScaledPair to_scaled_pair(const WideInt<N>& v) {
    const WideInt<N> magnitude = v.abs();
    int top = N - 1;
    while (top > 0 && magnitude.limb(top) == 0) --top;
    const int last = top < 2 ? 0 : top - 2;
    ScaledPair out;
    out.shift = last;
    for (int i = top; i >= last; --i) {
        for (const std::uint64_t part :
             {magnitude.limb(i) >> 32U, magnitude.limb(i) & 0xffffffffU}) {
            out.value = {out.value.high * 0x1p32, out.value.low * 0x1p32};
            out.value = add(out.value, {static_cast<double>(part), 0});
        }
    }
    if (v.is_negative()) out.value = negated(out.value);
    return out;
}

/// One step of Newton's iteration from the rounded root x: (v - x²) / (2x) is small, so computing
/// it in doubles adds an error of a few 2^-105. With half of that of to_pair: below 2^-99. \pre
/// v >= 0
inline DoublePair root(const DoublePair& v) {
    const double x = std::sqrt(v.high);
    if (x == 0) return {};
    const double square = x * x;
    const double rest = std::fma(x, x, -square);
    return two_sum(x, (((v.high - square) - rest) + v.low) / (2 * x));
}

}  // namespace trisect::detail
