// SPDX-License-Identifier: Apache-2.0
//
// Polynomials over fractions, for the checkers of certificates of motions.
// No other part of the library decides with them. Plain and slow on purpose.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include <trisect/brep/exact_rational.h>
#include <trisect/bsp/interference/interference_certificate.h>

namespace trisect::detail::certified {

/// Coefficients, constant one first, the last one not 0.
class Polynomial {
public:
    Polynomial() = default;
    Polynomial(const ExactRational& c) : c_{c} { trim(); }  // NOLINT
    explicit Polynomial(std::vector<ExactRational> c) : c_(std::move(c)) { trim(); }

    [[nodiscard]] bool is_zero() const { return c_.empty(); }
    [[nodiscard]] std::size_t degree() const { return c_.size() - 1; }
    [[nodiscard]] const ExactRational& coefficient(std::size_t i) const { return c_[i]; }
    [[nodiscard]] ExactRational value_at(const ExactRational& s) const {
        ExactRational r;
        for (std::size_t i = c_.size(); i-- > 0;) r = r * s + c_[i];
        return r;
    }
    [[nodiscard]] int sign_at(const ExactRational& s) const { return value_at(s).sign(); }
    [[nodiscard]] Polynomial derivative() const {
        std::vector<ExactRational> r;
        for (std::size_t i = 1; i < c_.size(); ++i)
            r.push_back(c_[i] * ExactRational(static_cast<std::int64_t>(i)));
        return Polynomial(std::move(r));
    }
    friend Polynomial operator+(const Polynomial& a, const Polynomial& b) {
        std::vector<ExactRational> r(std::max(a.c_.size(), b.c_.size()));
        for (std::size_t i = 0; i < a.c_.size(); ++i) r[i] += a.c_[i];
        for (std::size_t i = 0; i < b.c_.size(); ++i) r[i] += b.c_[i];
        return Polynomial(std::move(r));
    }
    friend Polynomial operator-(const Polynomial& a) {
        std::vector<ExactRational> r;
        for (const ExactRational& c : a.c_) r.push_back(-c);
        return Polynomial(std::move(r));
    }
    friend Polynomial operator-(const Polynomial& a, const Polynomial& b) { return a + (-b); }
    friend Polynomial operator*(const Polynomial& a, const Polynomial& b) {
        if (a.is_zero() || b.is_zero()) return {};
        std::vector<ExactRational> r(a.c_.size() + b.c_.size() - 1);
        for (std::size_t i = 0; i < a.c_.size(); ++i)
            for (std::size_t j = 0; j < b.c_.size(); ++j) r[i + j] += a.c_[i] * b.c_[j];
        return Polynomial(std::move(r));
    }
    // Remainder of the division, with a leading coefficient of 1 or -1. \pre b is not zero
    friend Polynomial remainder(Polynomial a, const Polynomial& b) {
        while (a.c_.size() >= b.c_.size()) {
            const ExactRational factor = a.c_.back() / b.c_.back();
            const std::size_t shift = a.c_.size() - b.c_.size();
            for (std::size_t i = 0; i < b.c_.size(); ++i) a.c_[shift + i] -= factor * b.c_[i];
            a.c_.pop_back();
            a.trim();
        }
        if (a.is_zero()) return a;
        const ExactRational size = a.c_.back().sign() > 0 ? a.c_.back() : -a.c_.back();
        for (ExactRational& c : a.c_) c /= size;
        return a;
    }

    // Of a division without remainder. \pre b divides a
    friend Polynomial quotient(Polynomial a, const Polynomial& b) {
        std::vector<ExactRational> r(a.c_.size() < b.c_.size() ? 0 : a.c_.size() - b.c_.size() + 1);
        while (a.c_.size() >= b.c_.size()) {
            const std::size_t shift = a.c_.size() - b.c_.size();
            r[shift] = a.c_.back() / b.c_.back();
            for (std::size_t i = 0; i < b.c_.size(); ++i) a.c_[shift + i] -= r[shift] * b.c_[i];
            a.c_.pop_back();
            a.trim();
        }
        return Polynomial(std::move(r));
    }

private:
    void trim() {
        while (!c_.empty() && c_.back().sign() == 0) c_.pop_back();
    }
    std::vector<ExactRational> c_;
};

[[nodiscard]] Polynomial common_divisor(Polynomial a, Polynomial b);

/// Distinct roots in the open interval, by Sturm's theorem: as many as the sequence of remainders
/// loses changes of sign. Nothing when an end is a root. \pre p is not zero
[[nodiscard]] std::optional<int> roots_between(const Polynomial& p, const ExactRational& from,
                                               const ExactRational& to);

/// Of p over a range, raised to a degree: p is a mean of them everywhere in it, with positive
/// weights. \pre the degree is p's at least
[[nodiscard]] std::vector<ExactRational> bernstein_coefficients(const Polynomial& p,
                                                                std::size_t degree,
                                                                const ExactRational& from,
                                                                const ExactRational& to);

/// Whether p is positive all over the closed unit interval.
[[nodiscard]] bool is_positive_on_unit(const Polynomial& p);

using PolynomialVector = std::array<Polynomial, 3>;
using Rows = std::array<PolynomialVector, 3>;

inline PolynomialVector operator+(const PolynomialVector& a, const PolynomialVector& b) {
    return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
inline PolynomialVector operator-(const PolynomialVector& a, const PolynomialVector& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline PolynomialVector operator*(const Polynomial& f, const PolynomialVector& a) {
    return {f * a[0], f * a[1], f * a[2]};
}
inline Polynomial dot(const PolynomialVector& a, const PolynomialVector& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline PolynomialVector cross(const PolynomialVector& a, const PolynomialVector& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline PolynomialVector operator*(const Rows& m, const PolynomialVector& v) {
    return {dot(m[0], v), dot(m[1], v), dot(m[2], v)};
}
inline PolynomialVector constant(const ExactPoint& v) { return {v[0], v[1], v[2]}; }

}  // namespace trisect::detail::certified
