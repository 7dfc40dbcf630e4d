// SPDX-License-Identifier: Apache-2.0
//
// The corner is a + (b - a) t with t = (height - level of a) / (level of b - level of a). Numbers
// are pairs of doubles (double_pair.h), and u = 2^-53:
// - both differences of levels are exact pairs, n and d. The quotient q of their high parts is off
//   by 3 u of itself. What is left, n - q d, is below 4 u |n|; it is computed to 10 u² |n|, and
//   its quotient, the low part of t, to as much again. So t is off by less than 2^-100, being at
//   most 1.
// - b - a is an exact pair. Of its product with t the product of the low parts is left out, and
//   three terms of u are rounded: less than 2^-102 |b - a|.
// - the sum with a is rounded at its low part: less than 2^-104 of |a| and |b - a|.
// Together that is less than 2^-98 (|a| + |b|), and the bound is 2^-94 of it. What underflows is
// below 2^-1000, or by division through d >= 2^-100 below 2^-900.

#include <trisect/bsp/modelling/sections/corner_rows.h>

#include <cstring>

#include <trisect/kernel/support/wide_clones.h>

namespace trisect::detail {

namespace {

using Reals = double __attribute__((vector_size(32)));
using Integers = std::int64_t __attribute__((vector_size(32)));

struct Pair {
    Reals high;
    Reals low;
};

#define TRISECT_ALWAYS_INLINE inline __attribute__((always_inline))

TRISECT_ALWAYS_INLINE Pair sum(const Reals& a, const Reals& b) {
    const Reals s = a + b;
    const Reals t = s - a;
    return {s, (a - (s - t)) + (b - t)};
}

// high + low = a, both with half of the bits.
TRISECT_ALWAYS_INLINE Pair halves(const Reals& a) {
    const Reals c = 134217729.0 * a;
    const Reals high = c - (c - a);
    return {high, a - high};
}

TRISECT_ALWAYS_INLINE Pair product(const Reals& a, const Pair& ha, const Reals& b, const Pair& hb) {
    const Reals p = a * b;
    return {p, ((ha.high * hb.high - p) + ha.high * hb.low + ha.low * hb.high) + ha.low * hb.low};
}

// Vectors that are returned warn of the ABI of wider registers.
TRISECT_ALWAYS_INLINE void take_magnitude(const Reals& a, Reals& out) {
    out = reinterpret_cast<Reals>(reinterpret_cast<Integers>(a) & INT64_MAX);
}

TRISECT_ALWAYS_INLINE void take(const std::array<double, 4>& from, Reals& out) {
    std::memcpy(&out, &from, sizeof(out));
}

TRISECT_WIDE_CLONES void find_corners(FourCorners* fours, std::size_t n, double height) {
    const Reals h = Reals{} + height;
    for (FourCorners* four = fours; four != fours + n; ++four) {
        Reals from_level;
        Reals to_level;
        take(four->from_level, from_level);
        take(four->to_level, to_level);
        const Pair above = sum(h, -from_level);
        const Pair both = sum(to_level, -from_level);
        const Reals q = above.high / both.high;
        const Pair back = product(q, halves(q), both.high, halves(both.high));
        const Reals rest = ((above.high - back.high) - back.low) + (above.low - q * both.low);
        const Reals q_low = rest / both.high;
        const Reals t = q + q_low;
        const Reals t_low = q_low - (t - q);
        const Pair ht = halves(t);
        Integers is_found = both.high >= 0x1p-100;
        Integers was_rounded{};
        for (std::size_t k = 0; k < 2; ++k) {
            Reals a;
            Reals b;
            take(four->from[k], a);
            take(four->to[k], b);
            const Pair way = sum(b, -a);
            const Pair part = product(way.high, halves(way.high), t, ht);
            const Pair s = sum(a, part.high);
            const Pair at = sum(s.high, s.low + (part.low + (way.high * t_low + way.low * t)));
            Reals size_a;
            Reals size_b;
            Reals size_low;
            take_magnitude(a, size_a);
            take_magnitude(b, size_b);
            take_magnitude(at.low, size_low);
            const Reals error = 0x1p-94 * (size_a + size_b) + 0x1p-900;
            const Reals slack = error + 0x1p-50 * size_low;
            // Where both ends are equal nothing is rounded, be it 0.
            is_found &= ((at.high + (at.low + slack) == at.high) &
                         (at.high + (at.low - slack) == at.high)) |
                        (a == b);
            was_rounded |= size_low > error;
            std::memcpy(&four->at[k], &at.high, sizeof(at.high));
        }
        std::memcpy(&four->is_found, &is_found, sizeof(is_found));
        std::memcpy(&four->was_rounded, &was_rounded, sizeof(was_rounded));
    }
}

}  // namespace

void CornerRows::begin_four() {
    const std::size_t i = count_ / 4;
    if (i == fours_.size()) fours_.emplace_back();
    fours_[i].from = fours_[i].to = {};
    fours_[i].from_level = {};
    fours_[i].to_level.fill(1);
}

void CornerRows::find(double height) { find_corners(fours_.data(), (count_ + 3) / 4, height); }

}  // namespace trisect::detail
