// SPDX-License-Identifier: Apache-2.0
//
// Sine and cosine: the angle is halved k <= 28 times until it is below 2^-8, Taylor's series is
// summed, and the doubling formulas bring the angle back. With |r| < 2^-8 the terms after the
// twenty-sixth are below 2^-300; each of the 52 roundings costs 2^-256. A doubling multiplies the
// error by at most 4 and adds two roundings, so the whole is below 2^(-256 + 7 + 56 + 2).
//
// An angle: the C library proposes one. Turned back by it the direction is nearly (1, 0), and what
// is left has the tangent q, |q| < 2^-40, whose arctangent is q - q^3/3 up to |q|^5/5 < 2^-200.
// So the proposal decides nothing about the error; a bad one is noticed.

#include <trisect/brep/number/trigonometry.h>

#include <algorithm>
#include <cmath>

#include <trisect/kernel/error.h>

namespace trisect::detail {

namespace {

mpz_class product(const mpz_class& a, const mpz_class& b) {
    return shifted_down(mpz_class(a * b), fixed_bits);
}

}  // namespace

mpz_class shifted_down(const mpz_class& v, unsigned bits) {
    if (bits == 0) return v;
    const mpz_class half = v + (mpz_class(1) << (bits - 1));
    mpz_class r;
    mpz_fdiv_q_2exp(r.get_mpz_t(), half.get_mpz_t(), bits);
    return r;
}

SineCosine sine_cosine(const mpq_class& angle) {
    const mpz_class one = mpz_class(1) << fixed_bits;
    unsigned halvings = 0;
    mpq_class small = abs(angle);
    while (small * 256 >= 1) {
        small /= 2;
        ++halvings;
    }
    mpz_class r;
    const mpz_class numerator = angle.get_num() << (fixed_bits - halvings);
    mpz_fdiv_q(r.get_mpz_t(), numerator.get_mpz_t(), angle.get_den_mpz_t());
    SineCosine result{0, 0};
    mpz_class term = one;
    for (unsigned n = 0; n < 26; ++n) {
        mpz_class& sum = n % 2 == 0 ? result.cosine : result.sine;
        if (n / 2 % 2 == 0)
            sum += term;
        else
            sum -= term;
        term = product(term, r) / (n + 1);
    }
    for (; halvings > 0; --halvings) {
        const mpz_class sine = 2 * product(result.sine, result.cosine);
        result.cosine = 2 * product(result.cosine, result.cosine) - one;
        result.sine = sine;
    }
    return result;
}

mpq_class angle_of(const mpz_class& y, const mpz_class& x) {
    // As doubles of one scale.
    long scale_y = 0;
    long scale_x = 0;
    const double my = mpz_get_d_2exp(&scale_y, y.get_mpz_t());
    const double mx = mpz_get_d_2exp(&scale_x, x.get_mpz_t());
    const long scale = std::max(scale_y, scale_x);
    const double proposal = std::atan2(std::ldexp(my, static_cast<int>(scale_y - scale)),
                                       std::ldexp(mx, static_cast<int>(scale_x - scale)));
    const SineCosine t = sine_cosine(mpq_class(proposal));
    const mpz_class along = x * t.cosine + y * t.sine;
    const mpz_class across = y * t.cosine - x * t.sine;
    if (sgn(along) <= 0 || (abs(across) << 40U) > along)
        throw Error(ErrorCode::Internal, "the arctangent of the C library is far off");
    mpz_class q = across << fixed_bits;
    mpz_fdiv_q(q.get_mpz_t(), q.get_mpz_t(), along.get_mpz_t());
    const mpz_class rest = q - product(product(q, q), q) / 3;
    mpq_class r(rest, mpz_class(1) << fixed_bits);
    r.canonicalize();
    return r + mpq_class(proposal);
}

}  // namespace trisect::detail
