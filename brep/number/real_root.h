// SPDX-License-Identifier: Apache-2.0
//
// RealRoot: a real algebraic number as a polynomial and an isolating interval.
#pragma once

#include <compare>
#include <memory>
#include <vector>

#include <trisect/brep/algebraic_number.h>
#include <trisect/brep/number/integer_polynomial.h>
#include <trisect/kernel/number/gmp.h>

namespace trisect::detail {

/// Either a rational number (lower = upper, no polynomial), or the only root of a square-free
/// polynomial in the open interval (lower, upper). The ends may be roots themselves.
///
/// Value type; copies share the polynomial. Questions may narrow the interval, which changes
/// nothing about the number; so they are not const, and one object belongs to one thread.
class RealRoot {
public:
    RealRoot() = default;  // 0
    explicit RealRoot(mpq_class value) : lower_(std::move(value)), upper_(lower_) {}
    /// \pre square-free, exactly one root in the open interval.
    RealRoot(std::shared_ptr<const IntegerPolynomial> polynomial, mpq_class lower, mpq_class upper,
             int sign_above_lower)
        : polynomial_(std::move(polynomial)),
          lower_(std::move(lower)),
          upper_(std::move(upper)),
          sign_above_lower_(sign_above_lower) {}

    [[nodiscard]] const mpq_class& lower() const { return lower_; }
    [[nodiscard]] const mpq_class& upper() const { return upper_; }
    /// Known to be rational. An irrational-looking root may turn out to be rational later.
    [[nodiscard]] bool is_rational() const { return polynomial_ == nullptr; }
    /// Null for rational numbers.
    [[nodiscard]] const IntegerPolynomial* polynomial() const { return polynomial_.get(); }

    /// Halves the interval, or finds the root in its middle.
    void halve();
    /// Narrows the interval to at most this width. \pre width > 0
    void refine(const mpq_class& width);

    /// This number plus n.
    [[nodiscard]] RealRoot shifted(unsigned long n) const;

    [[nodiscard]] std::strong_ordering compare(const mpq_class& value);
    [[nodiscard]] std::strong_ordering compare(RealRoot& other);
    /// The sign of p at this number, exactly.
    [[nodiscard]] int sign_of(const IntegerPolynomial& p);

private:
    void become(const mpq_class& value);
    [[nodiscard]] bool is_root_of_divisor(const IntegerPolynomial& divisor);

    std::shared_ptr<const IntegerPolynomial> polynomial_;
    mpq_class lower_;
    mpq_class upper_;
    int sign_above_lower_ = 0;  // of the polynomial, between lower_ and the root
};

/// The distinct roots of p in the closed interval, ascending. \pre p is not zero, from <= to.
[[nodiscard]] std::vector<RealRoot> isolate_roots(const IntegerPolynomial& p, const mpq_class& from,
                                                  const mpq_class& to);

/// The sign that p has all over the closed interval, if Bernstein coefficients show one; else
/// nothing is known and the answer is 0.
[[nodiscard]] int constant_sign(const IntegerPolynomial& p, const mpq_class& from,
                                const mpq_class& to);

struct AlgebraicNumberAccess {
    [[nodiscard]] static AlgebraicNumber make(const RealRoot& root) {
        return AlgebraicNumber(root);
    }
};

/// The root as a number of the public interface.
[[nodiscard]] inline AlgebraicNumber number_of(const RealRoot& root) {
    return AlgebraicNumberAccess::make(root);
}

}  // namespace trisect::detail
