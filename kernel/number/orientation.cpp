// SPDX-License-Identifier: Apache-2.0
//
// Each axis has a unit of its own, the last bit that a coordinate along it has: scaling an axis
// changes no sign. So coordinates are integers, mostly of hardly more than the 53 bits of a double.

#include <trisect/kernel/number/orientation.h>

#include <algorithm>
#include <array>
#include <limits>

#include <trisect/kernel/number/dyadic.h>
#include <trisect/kernel/wide_int.h>

namespace trisect::detail {

namespace {

using Rows = std::array<std::array<Int128, 3>, 3>;

// By products of N limbs and 2 N limbs. Of entries below 2^e minors are below 2^(2 e + 1), and the
// determinant is below 4 · 2^(3 e), the most that three rows of 1 and -1 have. That is 2^127 and
// 2^191 for 63 bits, 2^255 and 2^383 for 127.
template <int N>
int sign_of_determinant(const Rows& m) {
    WideInt<3 * N> sum;
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t i = (k + 1) % 3;
        const std::size_t j = (k + 2) % 3;
        const auto product = [&](std::size_t u, std::size_t v) {
            return multiply<2 * N>(WideInt<N>(m[1][u]), WideInt<N>(m[2][v]));
        };
        sum += multiply<3 * N>(product(i, j) - product(j, i), WideInt<N>(m[0][k]));
    }
    return sum.sign();
}

}  // namespace

std::optional<int> exact_orientation_of_fractions(const Vector3& a, const Vector3& b,
                                                  const Vector3& c, const Vector3& d) {
    constexpr int most_bits = 126;
    constexpr Int128 short_side = std::numeric_limits<std::int64_t>::max();
    const std::array<const Vector3*, 4> points{&a, &b, &c, &d};
    Rows m;
    bool is_short = true;
    for (std::size_t k = 0; k < 3; ++k) {
        std::array<Dyadic, 4> at;
        int unit = std::numeric_limits<int>::max();
        int top = std::numeric_limits<int>::min();
        for (std::size_t p = 0; p < 4; ++p) {
            at[p] = dyadic((*points[p])[k]);
            if (at[p].mantissa == 0) continue;
            unit = std::min(unit, at[p].exponent);
            top = std::max(top, exponent_above((*points[p])[k]));
        }
        if (top > unit && top - unit > most_bits) return std::nullopt;
        const auto scaled = [&](std::size_t p) {
            if (at[p].mantissa == 0) return Int128{0};
            return Int128{at[p].mantissa} * (Int128{1} << (at[p].exponent - unit));
        };
        const Int128 last = scaled(3);
        for (std::size_t p = 0; p < 3; ++p) {
            m[p][k] = scaled(p) - last;
            is_short = is_short && m[p][k] < short_side && m[p][k] > -short_side;
        }
    }
    return is_short ? sign_of_determinant<1>(m) : sign_of_determinant<2>(m);
}

}  // namespace trisect::detail
