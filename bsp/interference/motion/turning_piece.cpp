// SPDX-License-Identifier: Apache-2.0
//
// In the middle of the range the rotation is known to 2^-120. From there the half angle runs from
// -e to e, and the quaternion (1, s tan(e) axis), -1 <= s <= 1, turns about the same axis by twice
// arctan(s tan e) instead of 2 s e. For T = tan e <= 1/2 and s >= 0 the series of the two,
//
//     s arctan T - arctan(s T) = -(s - s^3) T^3 / 3 + (s - s^5) T^5 / 5 - ...
//
// alternate with falling terms, because the quotient of neighbours is at most
// T^2 (k + 1) / k <= 2 T^2 < 1; so the difference is at most (s - s^3) T^3 / 3 <= 0.1284 T^3.
//
// Rounding: the quaternion of the middle has components rounded to integers and a length of at
// least 2^63, so its direction is off by less than 2^-61; that of the small turn, rounded to
// multiples of 2^-64, by less than 2^-62. A quaternion whose direction is off by d turns by an
// angle that is off by at most 2 d (1 + d). Together with the angle and the axis, which are known
// far better, all roundings are below 2^-58. Two rotations that are an angle of a apart move a
// point at the distance r to places at most a r apart.

#include <trisect/bsp/interference/motion/turning_piece.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <trisect/brep/number/gmp_conversion.h>
#include <trisect/brep/number/trigonometry.h>
#include <trisect/kernel/number/error_bounds.h>

namespace trisect::detail {

namespace {

using Quaternion = std::array<mpz_class, 4>;

constexpr unsigned middle_bits = 64;
constexpr unsigned small_bits = 64;
// Of the tangent of a quarter of the whole turn.
constexpr double largest_tangent = 0.375;

Quaternion product(const Quaternion& p, const Quaternion& q) {
    return {p[0] * q[0] - p[1] * q[1] - p[2] * q[2] - p[3] * q[3],
            p[0] * q[1] + p[1] * q[0] + p[2] * q[3] - p[3] * q[2],
            p[0] * q[2] - p[1] * q[3] + p[2] * q[0] + p[3] * q[1],
            p[0] * q[3] + p[1] * q[2] - p[2] * q[1] + p[3] * q[0]};
}

std::size_t bit_length_of(const mpz_class& v) { return mpz_sizeinbase(v.get_mpz_t(), 2); }

// The same direction up to 2^-61, with components of about 64 bits.
Quaternion shortened(const Quaternion& q) {
    std::size_t bits = 0;
    for (const mpz_class& v : q) bits = std::max(bits, bit_length_of(v));
    if (bits <= middle_bits) return q;
    Quaternion r;
    for (std::size_t i = 0; i < 4; ++i)
        r[i] = shifted_down(q[i], static_cast<unsigned>(bits - middle_bits));
    return r;
}

Quaternion in_the_middle(const Turning& turning, const mpq_class& t) {
    const SineCosine c = sine_cosine(turning.half_angle * t);
    Quaternion turn{c.cosine << fixed_bits, 0, 0, 0};
    for (std::size_t i = 0; i < 3; ++i) turn[i + 1] = c.sine * turning.axis[i];
    return shortened(product(turning.base, turn));
}

MotionPiece translation(const std::array<mpq_class, 3>& from, const std::array<mpq_class, 3>& to) {
    std::vector<mpq_class> values(from.begin(), from.end());
    for (std::size_t i = 0; i < 3; ++i) values.push_back(to[i] - from[i]);
    mpz_class denominator;
    const std::vector<mpz_class> n = common_numerators(values, denominator);
    MotionPiece r;
    for (std::size_t i = 0; i < 3; ++i) {
        r.matrix[i][i] = denominator;
        r.shift[i] = IntegerPolynomial({n[i], n[3 + i]});
    }
    r.weight = denominator;
    return r;
}

std::array<mpq_class, 3> sum(const std::array<mpq_class, 3>& a, const std::array<mpq_class, 3>& b) {
    return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}

std::array<mpq_class, 3> negated(const std::array<mpq_class, 3>& a) {
    return {-a[0], -a[1], -a[2]};
}

std::array<mpq_class, 3> between(const Turning& turning, const mpq_class& t) {
    std::array<mpq_class, 3> r;
    for (std::size_t i = 0; i < 3; ++i)
        r[i] = turning.from[i] + t * (turning.to[i] - turning.from[i]);
    return r;
}

// Bounds on the Frobenius norm of the matrix of a constant map and on |shift - center|.
struct Sizes {
    double matrix = 0;
    double shift = 0;
};

Sizes sizes_of(const MotionPiece& map, const std::array<mpq_class, 3>& center) {
    const auto square = [](const mpq_class& v) { return v.get_d() * v.get_d(); };
    const mpq_class weight = map.weight.value_at(0);
    Sizes r;
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j)
            r.matrix += square(map.matrix[i][j].value_at(0) / weight);
        r.shift += square(map.shift[i].value_at(0) / weight - center[i]);
    }
    // Rounding, and GMP truncates.
    return {std::sqrt(r.matrix) * surely_more + 0x1p-1000,
            std::sqrt(r.shift) * surely_more + 0x1p-1000};
}

}  // namespace

NearPiece near_piece(const Turning& turning, const mpq_class& t0, const mpq_class& t1) {
    NearPiece r;
    r.by_length = r.constant = std::numeric_limits<double>::infinity();
    const mpq_class small_angle = turning.half_angle * (t1 - t0) / 2;
    if (abs(small_angle) > mpq_class(3, 8)) return r;
    const SineCosine c = sine_cosine(small_angle);
    mpq_class tangent(c.sine, c.cosine);
    tangent.canonicalize();
    const double t = std::abs(tangent.get_d()) * slightly_more;
    if (t > largest_tangent) return r;

    // (1, s T axis) with s from -1 to 1 while the parameter runs from 0 to 1.
    const Quaternion middle = in_the_middle(turning, (t0 + t1) / 2);
    std::array<IntegerPolynomial, 4> turn;
    turn[0] = mpz_class(mpz_class(1) << small_bits);
    for (std::size_t i = 0; i < 3; ++i) {
        const mpz_class scaled = c.sine * turning.axis[i];
        mpz_class w;
        const mpz_class divisor = c.cosine << (fixed_bits - small_bits);
        mpz_fdiv_q(w.get_mpz_t(), scaled.get_mpz_t(), divisor.get_mpz_t());
        turn[i + 1] = IntegerPolynomial({mpz_class(-w), mpz_class(2 * w)});
    }
    MotionPiece rotation =
        rotation_by({middle[0], middle[1], middle[2], middle[3]}) * rotation_by(turn);
    const std::array<mpq_class, 3> back = negated(turning.center);
    r.piece = translation(sum(turning.center, between(turning, t0)),
                          sum(turning.center, between(turning, t1))) *
              (rotation * (translation(back, back) * turning.start));

    const double angle = (2 * 0.1285 * t * t * t + 0x1p-57) * surely_more;
    const Sizes sizes = sizes_of(turning.start, turning.center);
    r.by_length = angle * sizes.matrix;
    r.constant = angle * sizes.shift;
    return r;
}

}  // namespace trisect::detail
