// SPDX-License-Identifier: Apache-2.0
//
// IntegerPolynomial: a univariate polynomial with integer coefficients of any size.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include <trisect/kernel/number/gmp.h>

namespace trisect::detail {

/// c[0] + c[1] s + ... + c[n] s^n with c[n] != 0. The zero polynomial has no coefficients.
///
/// Regular value type. Made for degrees up to some dozens: multiplication and division are
/// quadratic in the degree. Rational polynomials are kept as integer ones: every query here (signs,
/// roots, common roots) is one about the polynomial up to a positive factor.
class IntegerPolynomial {
public:
    IntegerPolynomial() = default;
    IntegerPolynomial(mpz_class constant) {  // NOLINT(google-explicit-constructor)
        if (sgn(constant) != 0) c_.push_back(std::move(constant));
    }
    explicit IntegerPolynomial(std::vector<mpz_class> ascending);

    /// -1 for the zero polynomial.
    [[nodiscard]] int degree() const { return static_cast<int>(c_.size()) - 1; }
    [[nodiscard]] bool is_zero() const { return c_.empty(); }
    [[nodiscard]] const std::vector<mpz_class>& coefficients() const { return c_; }
    /// \pre 0 <= i <= degree()
    [[nodiscard]] const mpz_class& operator[](int i) const {
        return c_[static_cast<std::size_t>(i)];
    }
    /// \pre not zero
    [[nodiscard]] const mpz_class& leading() const { return c_.back(); }

    IntegerPolynomial& operator+=(const IntegerPolynomial& o);
    IntegerPolynomial& operator-=(const IntegerPolynomial& o);
    IntegerPolynomial& operator*=(const mpz_class& factor);
    /// this += factor * o, the step of which products of matrices consist.
    void add_multiple(const IntegerPolynomial& o, const mpz_class& factor);
    friend IntegerPolynomial operator+(IntegerPolynomial a, const IntegerPolynomial& b) {
        return a += b;
    }
    friend IntegerPolynomial operator-(IntegerPolynomial a, const IntegerPolynomial& b) {
        return a -= b;
    }
    friend IntegerPolynomial operator-(IntegerPolynomial a) { return a *= -1; }
    friend IntegerPolynomial operator*(IntegerPolynomial a, const mpz_class& b) { return a *= b; }
    friend IntegerPolynomial operator*(const IntegerPolynomial& a, const IntegerPolynomial& b);
    friend bool operator==(const IntegerPolynomial& a, const IntegerPolynomial& b) {
        return a.c_ == b.c_;
    }

    [[nodiscard]] IntegerPolynomial derivative() const;
    /// Without the common divisor of the coefficients; signs stay.
    [[nodiscard]] IntegerPolynomial primitive() const;
    [[nodiscard]] mpq_class value_at(const mpq_class& s) const;
    /// -1, 0 or 1. \pre the fraction is in lowest terms with a positive denominator.
    [[nodiscard]] int sign_at(const mpq_class& s) const;
    /// A positive multiple of p(from + (to - from) u) as a polynomial in u.
    [[nodiscard]] IntegerPolynomial on_interval(const mpq_class& from, const mpq_class& to) const;

private:
    void trim();

    std::vector<mpz_class> c_;
};

/// The primitive greatest common divisor with a positive leading coefficient; gcd(p, 0) = p made
/// so, and gcd(0, 0) = 0.
[[nodiscard]] IntegerPolynomial gcd(const IntegerPolynomial& a, const IntegerPolynomial& b);
/// Whether one prime proves that the polynomials have no common root. "false" proves nothing.
[[nodiscard]] bool certainly_coprime(const IntegerPolynomial& a, const IntegerPolynomial& b);
/// a / b. \pre b is primitive and divides a.
[[nodiscard]] IntegerPolynomial exact_quotient(const IntegerPolynomial& a,
                                               const IntegerPolynomial& b);
/// The primitive polynomial with the same roots, each of them simple. \pre not zero.
[[nodiscard]] IntegerPolynomial square_free(const IntegerPolynomial& p);

/// The Bernstein coefficients on [0, 1], times a positive number. \pre not zero.
[[nodiscard]] std::vector<mpz_class> bernstein_coefficients(const IntegerPolynomial& p);
/// Splits Bernstein coefficients at the middle of their interval: the two results belong to the
/// two halves, times the same positive number.
[[nodiscard]] std::pair<std::vector<mpz_class>, std::vector<mpz_class>> halve_bernstein(
    const std::vector<mpz_class>& coefficients);

}  // namespace trisect::detail
