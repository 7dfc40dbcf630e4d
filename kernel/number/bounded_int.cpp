// SPDX-License-Identifier: Apache-2.0

#include <trisect/kernel/number/bounded_int.h>

namespace trisect::detail {

// With an odd divisor the lowest limb of the quotient is that of the dividend times the inverse of
// the divisor's modulo 2^64; subtract and go on with the next limb (Jebelean 1993). No estimate of
// a quotient digit is ever wrong, because the division is known to have no remainder.
BoundedInt divided_exactly(const BoundedInt& a, const BoundedInt& b) {
    TRISECT_EXPECTS(!b.is_zero(), "division by zero");
    const int zeros = b.trailing_zeros();
    const BoundedInt d = b.shifted_right(zeros);
    BoundedInt rest = a.shifted_right(zeros);
    const bool negative = (a.sign() < 0) != (b.sign() < 0);
    if (rest.sign() < 0) rest = -rest;
    if (rest.is_zero()) return rest;
    // Newton's iteration doubles the number of right bits; d d = 1 modulo 8 starts with three.
    const std::uint64_t low = d.limb(0);
    std::uint64_t inverse = low;
    for (int i = 0; i < 5; ++i) inverse *= 2 - low * inverse;

    const BoundedInt divisor = d.sign() < 0 ? -d : d;
    BoundedInt quotient;
    for (int at = 0; !rest.is_zero(); ++at) {
        const std::uint64_t digit = rest.limb(0) * inverse;
        const BoundedInt q(static_cast<Int128>(digit));
        rest -= q * divisor;
        TRISECT_EXPECTS(rest.sign() >= 0, "a division has a remainder");
        quotient += q.shifted_left(64 * at);
        rest = rest.shifted_right(64);
    }
    return negative ? -quotient : quotient;
}

}  // namespace trisect::detail
