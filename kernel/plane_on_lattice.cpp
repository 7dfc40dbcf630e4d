// SPDX-License-Identifier: Apache-2.0

#include <trisect/kernel/plane_on_lattice.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include <trisect/kernel/error.h>

namespace trisect {

Plane plane_on_lattice(const std::array<double, 4>& coefficients, Lattice lattice) {
    // a x + b y + c z + d with x = X 2^e: integers times a common power of two.
    std::array<std::int64_t, 4> mantissa{};
    std::array<int, 4> exponent{};
    int least = std::numeric_limits<int>::max();
    for (std::size_t i = 0; i < 4; ++i) {
        if (!std::isfinite(coefficients[i]))
            throw UsageError("a plane with a coefficient that is not finite");
        if (coefficients[i] == 0) continue;
        int e = 0;
        const double m = std::ldexp(std::frexp(coefficients[i], &e), 53);
        const auto v = static_cast<std::int64_t>(m);
        const int zeros = std::countr_zero(static_cast<std::uint64_t>(v));
        mantissa[i] = v >> zeros;
        exponent[i] = e - 53 + zeros + (i < 3 ? lattice.exponent : 0);
        least = std::min(least, exponent[i]);
    }
    if (mantissa[0] == 0 && mantissa[1] == 0 && mantissa[2] == 0)
        throw UsageError("a plane whose normal is 0");
    std::array<Plane::Coefficient, 4> n;
    for (std::size_t i = 0; i < 4; ++i) {
        if (mantissa[i] == 0) continue;
        const int shift = exponent[i] - least;
        const int limit = i < 3 ? 109 : 162;
        const Plane::Coefficient m(mantissa[i]);
        if (shift > limit || m.bit_length() + shift >= limit)
            throw LimitError("the coefficients of the plane span too many bits for the lattice");
        n[i] = m.shifted_left(shift);
    }
    return {n[0], n[1], n[2], n[3]};
}

}  // namespace trisect
