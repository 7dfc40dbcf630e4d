// SPDX-License-Identifier: Apache-2.0
//
// Bernstein coefficients over [0, 1] are fractions of integers, rounded once. Over parts of the
// interval they are averages of neighbours (de Casteljau), which are as well-conditioned as can be:
// forty halvings of a cubic cost about 120 roundings of the largest coefficient.

#include <trisect/bsp/interference/motion/ball_motion.h>

#include <algorithm>
#include <vector>

#include <trisect/brep/number/gmp_conversion.h>

namespace trisect::detail {

namespace {

Ball average(Ball a, Ball b) {
    const Ball s = a + b;
    return {s.value / 2, s.error / 2};
}

// The distinct polynomials of a motion and where their coefficients are kept.
template <class Visit>
void for_each_entry(const PolynomialMatrix& m, BallMatrix BallMotion::Maps::*member,
                    Visit&& visit) {
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
            visit(m[i][j], [=](BallMotion::Maps& maps) -> Ball& { return (maps.*member)[i][j]; });
}

template <class Visit>
void for_each_entry(const PolynomialVector& v, BallVector BallMotion::Maps::*member,
                    Visit&& visit) {
    for (std::size_t i = 0; i < 3; ++i)
        visit(v[i], [=](BallMotion::Maps& maps) -> Ball& { return (maps.*member)[i]; });
}

template <class Visit>
void for_each_entry(const MotionPiece& points, Visit&& visit) {
    using Maps = BallMotion::Maps;
    for_each_entry(points.matrix, &Maps::matrix, visit);
    for_each_entry(points.shift, &Maps::shift, visit);
    visit(points.weight, [](Maps& maps) -> Ball& { return maps.weight; });
}

template <class Visit>
void for_each_entry(const RelativeMotion& motion, Visit&& visit) {
    using Maps = BallMotion::Maps;
    for_each_entry(motion.point, visit);
    for_each_entry(motion.plane_normal, &Maps::plane_normal, visit);
    for_each_entry(motion.plane_shift, &Maps::plane_shift, visit);
    visit(motion.plane_offset, [](Maps& maps) -> Ball& { return maps.plane_offset; });
    for_each_entry(motion.line_direction, &Maps::line_direction, visit);
    for_each_entry(motion.line_moment, &Maps::line_moment, visit);
    for_each_entry(motion.line_lever, &Maps::line_lever, visit);
}

template <class Maps>
int degree_of(const Maps& motion) {
    int d = 0;
    for_each_entry(motion,
                   [&d](const IntegerPolynomial& p, const auto&) { d = std::max(d, p.degree()); });
    return d;
}

// A fraction rounded to double; GMP truncates, so it is off by less than one unit in the last
// place.
Ball rounded(const mpq_class& v) { return Ball::rounded(v.get_d()); }

// b_j = sum over i <= j of C(j, i) / C(n, i) c_i, times 1 / scale.
std::array<Ball, BallPolynomial::max_degree + 1> bernstein(const IntegerPolynomial& p,
                                                           std::size_t n, const mpz_class& scale) {
    std::vector<mpq_class> c(n + 1);
    for (std::size_t i = 0; i < p.coefficients().size(); ++i) {
        mpz_class binomial;
        mpz_bin_uiui(binomial.get_mpz_t(), n, i);
        c[i] = mpq_class(p.coefficients()[i], mpz_class(binomial * scale));
        c[i].canonicalize();
    }
    for (std::size_t round = 1; round <= n; ++round)
        for (std::size_t j = n; j >= round; --j) c[j] += c[j - 1];
    std::array<Ball, BallPolynomial::max_degree + 1> r{};
    for (std::size_t j = 0; j <= n; ++j) r[j] = rounded(c[j]);
    return r;
}

// One power of two for all entries of a map keeps doubles in range.
template <class Maps>
mpz_class scale_of(const Maps& motion) {
    std::size_t bits = 0;
    for_each_entry(motion, [&bits](const IntegerPolynomial& p, const auto&) {
        for (const mpz_class& c : p.coefficients())
            bits = std::max(bits, mpz_sizeinbase(c.get_mpz_t(), 2));
    });
    return mpz_class(1) << (bits > 200 ? bits - 200 : 0);
}

template <class Maps>
void fill(const Maps& motion, BallMotion& r) {
    r.degree = static_cast<std::size_t>(degree_of(motion));
    const mpz_class scale = scale_of(motion);
    for_each_entry(motion, [&](const IntegerPolynomial& p, const auto& entry) {
        const auto b = bernstein(p, r.degree, scale);
        for (std::size_t k = 0; k <= r.degree; ++k) entry(r.maps[k]) = b[k];
    });
}

}  // namespace

void halve(const BallPolynomial& p, std::size_t degree, BallPolynomial& left,
           BallPolynomial& right) {
    std::array<Ball, BallPolynomial::max_degree + 1> row = p.b;
    for (std::size_t round = 0; round <= degree; ++round) {
        left.b[round] = row[0];
        right.b[degree - round] = row[degree - round];
        for (std::size_t j = 0; j + round < degree; ++j) row[j] = average(row[j], row[j + 1]);
    }
}

bool BallMotion::fits(const RelativeMotion& motion) {
    return degree_of(motion) <= static_cast<int>(BallPolynomial::max_degree);
}

bool BallMotion::fits(const MotionPiece& points) {
    return degree_of(points) <= static_cast<int>(BallPolynomial::max_degree);
}

BallMotion::BallMotion(const RelativeMotion& motion) { fill(motion, *this); }

BallMotion BallMotion::of_points(const MotionPiece& points) {
    BallMotion r;
    fill(points, r);
    return r;
}

BallMotion BallMotion::half(bool right) const {
    // A struct of balls and nothing else is an array of balls.
    constexpr std::size_t count = sizeof(Maps) / sizeof(Ball);
    static_assert(count * sizeof(Ball) == sizeof(Maps));
    BallMotion r = *this;
    const auto balls = [](Maps& m) { return reinterpret_cast<Ball*>(&m); };
    // Left: coefficient k becomes what the first k + 1 average to; right: mirrored.
    for (std::size_t round = 1; round <= degree; ++round) {
        for (std::size_t j = degree; j >= round; --j) {
            Ball* to_ball = balls(r.maps[right ? degree - j : j]);
            const Ball* other = balls(r.maps[right ? degree - j + 1 : j - 1]);
            for (std::size_t i = 0; i < count; ++i) to_ball[i] = average(to_ball[i], other[i]);
        }
    }
    (right ? r.from : r.to) = middle();
    return r;
}

std::array<double, 3> BallMotion::guessed_image(std::size_t k,
                                                const std::array<double, 3>& x) const {
    const Maps& m = maps[k];
    std::array<double, 3> y{};
    for (std::size_t i = 0; i < 3; ++i)
        y[i] = (m.matrix[i][0].value * x[0] + m.matrix[i][1].value * x[1] +
                m.matrix[i][2].value * x[2] + m.shift[i].value) /
               m.weight.value;
    return y;
}

}  // namespace trisect::detail
