// SPDX-License-Identifier: Apache-2.0
//
// Each axis has a unit of its own, the last bit that a coordinate along it has: scaling an axis
// changes no sign. So coordinates are integers, mostly of hardly more than the 53 bits of a double.

#include <trisect/kernel/number/orientation.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <trisect/kernel/number/dyadic.h>
#include <trisect/kernel/wide_int.h>

namespace trisect::detail {

namespace {

using Rows = std::array<std::array<Int128, 3>, 3>;

// Of four numbers: integers in units of the last bit that any of them has. Nothing where they take
// more than 126 bits.
struct OnOneUnit {
    std::array<Int128, 4> value{};
    int exponent = 0;

    [[nodiscard]] static std::optional<OnOneUnit> of(const std::array<double, 4>& numbers) {
        constexpr int most_bits = 126;
        std::array<Dyadic, 4> at;
        int unit = std::numeric_limits<int>::max();
        int top = std::numeric_limits<int>::min();
        for (std::size_t i = 0; i < 4; ++i) {
            at[i] = dyadic(numbers[i]);
            if (at[i].mantissa == 0) continue;
            unit = std::min(unit, at[i].exponent);
            top = std::max(top, exponent_above(numbers[i]));
        }
        OnOneUnit out;
        if (top < unit) return out;  // all are 0
        if (top - unit > most_bits) return std::nullopt;
        out.exponent = unit;
        for (std::size_t i = 0; i < 4; ++i)
            if (at[i].mantissa != 0)
                out.value[i] = Int128{at[i].mantissa} * (Int128{1} << (at[i].exponent - unit));
        return out;
    }
};

// By products of N limbs and 2 N limbs. Of entries below 2^e minors are below 2^(2 e + 1), and the
// determinant is below 4 · 2^(3 e), the most that three rows of 1 and -1 have. That is 2^127 and
// 2^191 for 63 bits, 2^255 and 2^383 for 127.
template <int N>
WideInt<3 * N> determinant(const Rows& m) {
    WideInt<3 * N> sum;
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t i = (k + 1) % 3;
        const std::size_t j = (k + 2) % 3;
        const auto product = [&](std::size_t u, std::size_t v) {
            return multiply<2 * N>(WideInt<N>(m[1][u]), WideInt<N>(m[2][v]));
        };
        sum += multiply<3 * N>(product(i, j) - product(j, i), WideInt<N>(m[0][k]));
    }
    return sum;
}

// The rows a - d, b - d and c - d, by axis in units of their own.
struct ScaledRows {
    Rows m;
    int exponent = 0;
    bool is_short = true;  ///< each entry has 63 bits

    [[nodiscard]] static std::optional<ScaledRows> of(const std::array<const Vector3*, 4>& points) {
        constexpr Int128 short_side = std::numeric_limits<std::int64_t>::max();
        ScaledRows out;
        for (std::size_t k = 0; k < 3; ++k) {
            const auto at =
                OnOneUnit::of({(*points[0])[k], (*points[1])[k], (*points[2])[k], (*points[3])[k]});
            if (!at) return std::nullopt;
            out.exponent += at->exponent;
            for (std::size_t p = 0; p < 3; ++p) {
                out.m[p][k] = at->value[p] - at->value[3];
                out.is_short =
                    out.is_short && out.m[p][k] < short_side && out.m[p][k] > -short_side;
            }
        }
        return out;
    }
};

}  // namespace

std::optional<int> exact_orientation_of_fractions(const Vector3& a, const Vector3& b,
                                                  const Vector3& c, const Vector3& d) {
    const auto rows = ScaledRows::of({&a, &b, &c, &d});
    if (!rows) return std::nullopt;
    return rows->is_short ? determinant<1>(rows->m).sign() : determinant<2>(rows->m).sign();
}

std::optional<double> determinant_of_fractions(const Vector3& a, const Vector3& b, const Vector3& c,
                                               const Vector3& d) {
    const auto rows = ScaledRows::of({&a, &b, &c, &d});
    if (!rows) return std::nullopt;
    const double value =
        rows->is_short ? determinant<1>(rows->m).to_double() : determinant<2>(rows->m).to_double();
    return std::ldexp(value, rows->exponent);
}

std::optional<double> product_of_fractions(const Segment2& first, const Segment2& second) {
    std::array<OnOneUnit, 2> at;
    for (std::size_t k = 0; k < 2; ++k) {
        const auto known = OnOneUnit::of({first[0][k], first[1][k], second[0][k], second[1][k]});
        if (!known) return std::nullopt;
        at[k] = *known;
    }
    const auto along = [&](std::size_t k, std::size_t which) {
        return WideInt<2>(at[k].value[2 * which + 1] - at[k].value[2 * which]);
    };
    const WideInt<4> value =
        multiply<4>(along(0, 0), along(1, 1)) - multiply<4>(along(1, 0), along(0, 1));
    return std::ldexp(value.to_double(), at[0].exponent + at[1].exponent);
}

}  // namespace trisect::detail
