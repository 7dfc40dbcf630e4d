// SPDX-License-Identifier: Apache-2.0
//
// The filter works on the Bernstein coefficients of the coplanarity, a cubic in s: they are mixed
// determinants of the corners at the start and at the end, so no polynomial in the power basis is
// made. With P, Q, R the three difference vectors at the start and P', Q', R' at the end,
//
//     3 b_1 = [P' Q R] + [P Q' R] + [P Q R'],   b_0 = [P Q R],  and the like for b_2 and b_3.
//
// Coefficients of one sign, errors included, prove that the four points are never coplanar.
//
// Rational coordinates are brought to a common denominator once for each question; then all is
// integers (feature_contact.cpp).

#include <trisect/bsp/interference/moving_points.h>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include <trisect/brep/number/gmp_conversion.h>
#include <trisect/bsp/interference/motion/feature_contact.h>
#include <trisect/kernel/diagnostics.h>
#include <trisect/kernel/number/ball.h>

namespace trisect {

namespace {

using detail::Ball;
using detail::BallVector;
using detail::IntegerPolynomial;
using detail::PolynomialVector;
using detail::RealRoot;

// Start and end of a difference of two paths.
using Difference = std::array<BallVector, 2>;
using FourPaths = std::array<const LinearPath*, 4>;

std::array<BallVector, 2> approximate(const LinearPath& path) {
    std::array<BallVector, 2> r;
    for (std::size_t i = 0; i < 3; ++i) {
        r[0][i] = Ball::rounded(path.from[i].to_double());
        r[1][i] = Ball::rounded(path.to[i].to_double());
    }
    return r;
}

Ball determinant(const BallVector& a, const BallVector& b, const BallVector& c) {
    return dot(cross(a, b), c);
}

// The differences of the coplanarity: of the corners listed from the first one on.
bool certainly_apart(const std::array<Difference, 3>& d) {
    const auto mixed = [&d](std::size_t i, std::size_t j, std::size_t k) {
        return determinant(d[0][i], d[1][j], d[2][k]);
    };
    return detail::sign_of_bernstein<4>(
               {mixed(0, 0, 0), mixed(1, 0, 0) + mixed(0, 1, 0) + mixed(0, 0, 1),
                mixed(0, 1, 1) + mixed(1, 0, 1) + mixed(1, 1, 0), mixed(1, 1, 1)}) != 0;
}

Difference between(const std::array<BallVector, 2>& a, const std::array<BallVector, 2>& b) {
    return {b[0] - a[0], b[1] - a[1]};
}

std::array<PolynomialVector, 4> exact_paths(const FourPaths& corners) {
    std::vector<mpq_class> values;
    values.reserve(24);
    for (const LinearPath* c : corners) {
        for (const ExactRational& v : c->from) values.push_back(detail::to_gmp(v));
        for (const ExactRational& v : c->to) values.push_back(detail::to_gmp(v));
    }
    mpz_class denominator;
    const std::vector<mpz_class> n = detail::common_numerators(values, denominator);
    std::array<PolynomialVector, 4> paths;
    for (std::size_t c = 0; c < 4; ++c)
        for (std::size_t i = 0; i < 3; ++i) {
            const mpz_class& from = n[6 * c + i];
            paths[c][i] = IntegerPolynomial({from, n[6 * c + 3 + i] - from});
        }
    return paths;
}

template <class A, class B>
std::optional<AlgebraicNumber> first_contact_exactly(const A& a, const B& b) {
    MotionCounters& counters = detail::counters_of_thread<MotionCounters>;
    ++counters.exact;
    const IntegerPolynomial coplanar = detail::coplanarity(a, b);
    if (coplanar.is_zero()) ++counters.coplanar;
    const std::optional<RealRoot> s = detail::first_meeting(coplanar, a, b, {0, 1});
    if (!s) return std::nullopt;
    ++counters.contacts;
    return detail::number_of(*s);
}

}  // namespace

MotionCounters& MotionCounters::operator+=(const MotionCounters& o) {
    questions += o.questions;
    filtered += o.filtered;
    exact += o.exact;
    coplanar += o.coplanar;
    contacts += o.contacts;
    return *this;
}

MotionCounters& MotionCounters::operator-=(const MotionCounters& o) {
    questions -= o.questions;
    filtered -= o.filtered;
    exact -= o.exact;
    coplanar -= o.coplanar;
    contacts -= o.contacts;
    return *this;
}

std::optional<AlgebraicNumber> first_contact(const LinearPath& vertex,
                                             const std::array<LinearPath, 3>& face) {
    MotionCounters& counters = detail::counters_of_thread<MotionCounters>;
    ++counters.questions;
    const auto a = approximate(face[0]);
    if (certainly_apart({between(a, approximate(face[1])), between(a, approximate(face[2])),
                         between(a, approximate(vertex))})) {
        ++counters.filtered;
        return std::nullopt;
    }
    const auto p = exact_paths({&face[0], &face[1], &face[2], &vertex});
    return first_contact_exactly(p[3], detail::moving_triangle(p[0], p[1], p[2]));
}

std::optional<AlgebraicNumber> first_contact(const std::array<LinearPath, 2>& a,
                                             const std::array<LinearPath, 2>& b) {
    MotionCounters& counters = detail::counters_of_thread<MotionCounters>;
    ++counters.questions;
    const auto a0 = approximate(a[0]);
    const auto b0 = approximate(b[0]);
    if (certainly_apart(
            {between(a0, approximate(a[1])), between(b0, approximate(b[1])), between(a0, b0)})) {
        ++counters.filtered;
        return std::nullopt;
    }
    const auto p = exact_paths({&a[0], &a[1], &b[0], &b[1]});
    return first_contact_exactly(detail::moving_edge(p[0], p[1]), detail::moving_edge(p[2], p[3]));
}

}  // namespace trisect
