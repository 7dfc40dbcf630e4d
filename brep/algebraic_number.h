// SPDX-License-Identifier: Apache-2.0
//
// AlgebraicNumber: an exact, comparable real root of a rational polynomial.
// The time of first contact of moving solids is such a number.
#pragma once

#include <compare>
#include <memory>
#include <span>
#include <vector>

#include <trisect/brep/exact_rational.h>

namespace trisect {

namespace detail {
class RealRoot;
struct AlgebraicNumberAccess;
}  // namespace detail

/// A rational number, or a root of a polynomial together with an interval that holds no other root.
///
/// Regular value type; copying allocates. Comparison is exact: numbers of different polynomials are
/// equal when both are the same root of the common divisor. It costs a few evaluations unless the
/// numbers are equal or very close. Reading from many threads is safe.
class AlgebraicNumber {
public:
    /// Zero.
    AlgebraicNumber();
    AlgebraicNumber(const ExactRational& v);  // NOLINT(google-explicit-constructor)
    AlgebraicNumber(const AlgebraicNumber& o);
    AlgebraicNumber(AlgebraicNumber&& o) noexcept;
    AlgebraicNumber& operator=(const AlgebraicNumber& o);
    AlgebraicNumber& operator=(AlgebraicNumber&& o) noexcept;
    ~AlgebraicNumber();

    /// Known to be rational: lower() and upper() are the number. A rational root of a polynomial
    /// of higher degree need not be known as such.
    [[nodiscard]] bool is_rational() const;
    /// The number is in the open interval (lower, upper), or equal to both.
    [[nodiscard]] ExactRational lower() const;
    [[nodiscard]] ExactRational upper() const;
    /// The same number in an interval of at most this width.
    /// \throw UsageError when width <= 0.
    [[nodiscard]] AlgebraicNumber refined(const ExactRational& width) const;
    /// The nearest double, ties to even.
    [[nodiscard]] double to_double() const;
    /// Integer coefficients of a square-free polynomial with this root, the constant one first.
    [[nodiscard]] std::vector<ExactRational> polynomial() const;

    /// The sign, -1, 0 or 1, of the polynomial with these coefficients (constant one first) at this
    /// number, exactly.
    [[nodiscard]] int sign_of(std::span<const ExactRational> coefficients) const;

    friend bool operator==(const AlgebraicNumber& a, const AlgebraicNumber& b) {
        return (a <=> b) == 0;
    }
    friend std::strong_ordering operator<=>(const AlgebraicNumber& a, const AlgebraicNumber& b);

private:
    friend struct detail::AlgebraicNumberAccess;

    explicit AlgebraicNumber(const detail::RealRoot& root);

    std::unique_ptr<detail::RealRoot> root_;  // never null
};

/// The distinct real roots in the closed interval [from, to], ascending. Coefficients are given
/// with the constant one first.
///
/// \throw UsageError for the zero polynomial, or when from > to.
[[nodiscard]] std::vector<AlgebraicNumber> roots_between(
    std::span<const ExactRational> coefficients, const ExactRational& from,
    const ExactRational& to);

}  // namespace trisect
