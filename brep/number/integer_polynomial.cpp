// SPDX-License-Identifier: Apache-2.0
//
// Polynomials of motions have few coefficients of many bits, so schoolbook products on GMP's
// integers are right. Two things are worth more than speed of a single operation:
//
// Greatest common divisors are needed all the time (are two roots the same? is a root double?) and
// are nearly always 1. Euclid's algorithm modulo one prime of 61 bits proves that in well below a
// microsecond: a common divisor stays one modulo the prime, and keeps its degree when the leading
// coefficients do not vanish. Only when the prime finds a common divisor, the remainder sequence is
// computed over the integers, each remainder made primitive (Knuth, The Art of Computer Programming
// 2, section 4.6.1).
//
// Bernstein coefficients carry a common positive factor instead of fractions: signs are all that
// isolation looks at.

#include <trisect/brep/number/integer_polynomial.h>

#include <algorithm>
#include <cstdint>

#include <trisect/brep/number/gmp_conversion.h>
#include <trisect/kernel/contract.h>
#include <trisect/kernel/wide_int.h>

namespace trisect::detail {

namespace {

std::size_t idx(int i) { return static_cast<std::size_t>(i); }

// Arithmetic modulo the prime 2^61 - 1.
constexpr std::uint64_t prime = (std::uint64_t{1} << 61) - 1;

std::uint64_t times(std::uint64_t a, std::uint64_t b) {
    return static_cast<std::uint64_t>(Uint128{a} * b % prime);
}

std::uint64_t inverse(std::uint64_t a) {  // a^(prime - 2)
    std::uint64_t result = 1;
    for (std::uint64_t e = prime - 2; e != 0; e >>= 1) {
        if ((e & 1U) != 0) result = times(result, a);
        a = times(a, a);
    }
    return result;
}

std::uint64_t modulo_prime(const mpz_class& c) {
    // GMP takes unsigned long, which has 32 bits on some machines.
    if constexpr (sizeof(unsigned long) == sizeof(prime))
        return mpz_fdiv_ui(c.get_mpz_t(), static_cast<unsigned long>(prime));
    const mpz_class divisor = to_gmp(static_cast<std::int64_t>(prime));
    mpz_class rest;
    mpz_fdiv_r(rest.get_mpz_t(), c.get_mpz_t(), divisor.get_mpz_t());
    return static_cast<std::uint64_t>(to_int64(rest));
}

std::vector<std::uint64_t> modulo_prime(const IntegerPolynomial& p) {
    std::vector<std::uint64_t> r;
    r.reserve(p.coefficients().size());
    for (const mpz_class& c : p.coefficients()) r.push_back(modulo_prime(c));
    return r;
}

// a modulo b; b's last coefficient is not 0.
void reduce(std::vector<std::uint64_t>& a, const std::vector<std::uint64_t>& b) {
    const std::uint64_t inverse_of_leading = inverse(b.back());
    while (a.size() >= b.size()) {
        const std::uint64_t factor = times(a.back(), inverse_of_leading);
        const std::size_t shift = a.size() - b.size();
        for (std::size_t i = 0; i < b.size(); ++i) {
            const std::uint64_t product = times(factor, b[i]);
            std::uint64_t& v = a[i + shift];
            v = v >= product ? v - product : v + prime - product;
        }
        while (!a.empty() && a.back() == 0) a.pop_back();
    }
}

// A multiple of a modulo b over the integers, without the common divisor.
IntegerPolynomial primitive_remainder(const IntegerPolynomial& a, const IntegerPolynomial& b) {
    std::vector<mpz_class> r = a.coefficients();
    const std::vector<mpz_class>& d = b.coefficients();
    while (r.size() >= d.size()) {
        const mpz_class factor = r.back();
        const std::size_t shift = r.size() - d.size();
        for (mpz_class& c : r) c *= d.back();
        for (std::size_t i = 0; i < d.size(); ++i) r[i + shift] -= factor * d[i];
        while (!r.empty() && sgn(r.back()) == 0) r.pop_back();
    }
    return IntegerPolynomial(std::move(r)).primitive();
}

IntegerPolynomial with_positive_leading(IntegerPolynomial p) {
    if (!p.is_zero() && sgn(p.leading()) < 0) p *= -1;
    return p;
}

}  // namespace

IntegerPolynomial::IntegerPolynomial(std::vector<mpz_class> ascending) : c_(std::move(ascending)) {
    trim();
}

void IntegerPolynomial::trim() {
    while (!c_.empty() && sgn(c_.back()) == 0) c_.pop_back();
}

IntegerPolynomial& IntegerPolynomial::operator+=(const IntegerPolynomial& o) {
    if (c_.size() < o.c_.size()) c_.resize(o.c_.size());
    for (std::size_t i = 0; i < o.c_.size(); ++i) c_[i] += o.c_[i];
    trim();
    return *this;
}

IntegerPolynomial& IntegerPolynomial::operator-=(const IntegerPolynomial& o) {
    if (c_.size() < o.c_.size()) c_.resize(o.c_.size());
    for (std::size_t i = 0; i < o.c_.size(); ++i) c_[i] -= o.c_[i];
    trim();
    return *this;
}

IntegerPolynomial& IntegerPolynomial::operator*=(const mpz_class& factor) {
    if (sgn(factor) == 0) c_.clear();
    for (mpz_class& c : c_) c *= factor;
    return *this;
}

void IntegerPolynomial::add_multiple(const IntegerPolynomial& o, const mpz_class& factor) {
    if (c_.size() < o.c_.size()) c_.resize(o.c_.size());
    for (std::size_t i = 0; i < o.c_.size(); ++i)
        mpz_addmul(c_[i].get_mpz_t(), o.c_[i].get_mpz_t(), factor.get_mpz_t());
    trim();
}

IntegerPolynomial operator*(const IntegerPolynomial& a, const IntegerPolynomial& b) {
    if (a.is_zero() || b.is_zero()) return {};
    std::vector<mpz_class> r(a.c_.size() + b.c_.size() - 1);
    for (std::size_t i = 0; i < a.c_.size(); ++i)
        for (std::size_t j = 0; j < b.c_.size(); ++j)
            mpz_addmul(r[i + j].get_mpz_t(), a.c_[i].get_mpz_t(), b.c_[j].get_mpz_t());
    return IntegerPolynomial(std::move(r));
}

IntegerPolynomial IntegerPolynomial::derivative() const {
    std::vector<mpz_class> r;
    for (std::size_t i = 1; i < c_.size(); ++i) r.push_back(c_[i] * static_cast<unsigned long>(i));
    return IntegerPolynomial(std::move(r));
}

IntegerPolynomial IntegerPolynomial::primitive() const {
    mpz_class content;
    for (const mpz_class& c : c_) {
        mpz_gcd(content.get_mpz_t(), content.get_mpz_t(), c.get_mpz_t());
        if (content == 1) return *this;
    }
    IntegerPolynomial r = *this;
    for (mpz_class& c : r.c_) mpz_divexact(c.get_mpz_t(), c.get_mpz_t(), content.get_mpz_t());
    return r;
}

mpq_class IntegerPolynomial::value_at(const mpq_class& s) const {
    mpq_class r;
    for (std::size_t i = c_.size(); i-- > 0;) r = r * s + c_[i];
    return r;
}

int IntegerPolynomial::sign_at(const mpq_class& s) const {
    if (c_.empty()) return 0;
    // Horner's rule for denominator^n p(s), in integers.
    mpz_class r = c_.back();
    mpz_class power = 1;
    for (std::size_t i = c_.size() - 1; i-- > 0;) {
        power *= s.get_den();
        r *= s.get_num();
        mpz_addmul(r.get_mpz_t(), c_[i].get_mpz_t(), power.get_mpz_t());
    }
    return sgn(r);
}

IntegerPolynomial IntegerPolynomial::on_interval(const mpq_class& from, const mpq_class& to) const {
    // from + (to - from) u = (a + b u) / d with integers a, b, d > 0.
    const mpq_class length = to - from;
    mpz_class d;
    mpz_lcm(d.get_mpz_t(), from.get_den_mpz_t(), length.get_den_mpz_t());
    const mpz_class a = from.get_num() * mpz_class(d / from.get_den());
    const mpz_class b = length.get_num() * mpz_class(d / length.get_den());
    std::vector<mpz_class> r;
    mpz_class power = 1;
    for (std::size_t i = c_.size(); i-- > 0;) {  // r <- r (a + b u) + c[i] d^(n-i)
        r.emplace_back(0);
        for (std::size_t j = r.size(); j-- > 0;) {
            r[j] *= a;
            if (j > 0) mpz_addmul(r[j].get_mpz_t(), r[j - 1].get_mpz_t(), b.get_mpz_t());
        }
        mpz_addmul(r[0].get_mpz_t(), c_[i].get_mpz_t(), power.get_mpz_t());
        power *= d;
    }
    return IntegerPolynomial(std::move(r));
}

bool certainly_coprime(const IntegerPolynomial& a, const IntegerPolynomial& b) {
    if (a.is_zero() || b.is_zero()) return false;
    std::vector<std::uint64_t> p = modulo_prime(a);
    std::vector<std::uint64_t> q = modulo_prime(b);
    if (p.back() == 0 || q.back() == 0) return false;  // a divisor could lose its degree
    while (!q.empty()) {
        reduce(p, q);
        std::swap(p, q);
    }
    return p.size() == 1;
}

IntegerPolynomial gcd(const IntegerPolynomial& a, const IntegerPolynomial& b) {
    if (certainly_coprime(a, b)) return mpz_class(1);
    IntegerPolynomial p = a.primitive();
    IntegerPolynomial q = b.primitive();
    while (!q.is_zero()) {
        IntegerPolynomial r = primitive_remainder(p, q);
        p = std::move(q);
        q = std::move(r);
    }
    return with_positive_leading(std::move(p));
}

IntegerPolynomial exact_quotient(const IntegerPolynomial& a, const IntegerPolynomial& b) {
    if (a.is_zero()) return {};
    std::vector<mpz_class> r = a.coefficients();
    const std::vector<mpz_class>& d = b.coefficients();
    TRISECT_EXPECTS(!d.empty() && r.size() >= d.size(), "a polynomial divides its multiple");
    std::vector<mpz_class> quotient(r.size() - d.size() + 1);
    for (std::size_t k = quotient.size(); k-- > 0;) {
        mpz_class& c = quotient[k];
        const mpz_class& top = r[k + d.size() - 1];
        TRISECT_EXPECTS(mpz_divisible_p(top.get_mpz_t(), d.back().get_mpz_t()) != 0,
                        "a primitive divisor has integer quotients");
        mpz_divexact(c.get_mpz_t(), top.get_mpz_t(), d.back().get_mpz_t());
        if (sgn(c) == 0) continue;
        for (std::size_t i = 0; i < d.size(); ++i)
            mpz_submul(r[k + i].get_mpz_t(), c.get_mpz_t(), d[i].get_mpz_t());
    }
    TRISECT_EXPECTS(std::all_of(r.begin(), r.end(), [](const mpz_class& c) { return sgn(c) == 0; }),
                    "a polynomial divides its multiple");
    return IntegerPolynomial(std::move(quotient));
}

IntegerPolynomial square_free(const IntegerPolynomial& p) {
    const IntegerPolynomial primitive = p.primitive();
    if (primitive.degree() <= 1) return primitive;
    const IntegerPolynomial common = gcd(primitive, primitive.derivative());
    return common.degree() == 0 ? primitive : exact_quotient(primitive, common);
}

std::vector<mpz_class> bernstein_coefficients(const IntegerPolynomial& p) {
    // b_j = sum over i <= j of C(j, i) / C(n, i) c_i. All C(n, i) divide n!.
    const int n = p.degree();
    mpz_class factorial;
    mpz_fac_ui(factorial.get_mpz_t(), static_cast<unsigned long>(n));
    std::vector<mpz_class> scaled(idx(n + 1));
    mpz_class binomial;
    for (int i = 0; i <= n; ++i) {
        mpz_bin_uiui(binomial.get_mpz_t(), static_cast<unsigned long>(n),
                     static_cast<unsigned long>(i));
        mpz_divexact(binomial.get_mpz_t(), factorial.get_mpz_t(), binomial.get_mpz_t());
        scaled[idx(i)] = p[i] * binomial;
    }
    // Multiplying by Pascal's triangle is n rounds of adding neighbours.
    for (int round = 1; round <= n; ++round)
        for (int j = n; j >= round; --j) scaled[idx(j)] += scaled[idx(j - 1)];
    return scaled;
}

std::pair<std::vector<mpz_class>, std::vector<mpz_class>> halve_bernstein(
    const std::vector<mpz_class>& coefficients) {
    // De Casteljau without the divisions by two: round r carries the factor 2^r.
    const std::size_t n = coefficients.size() - 1;
    std::vector<mpz_class> row = coefficients;
    std::vector<mpz_class> left(n + 1);
    std::vector<mpz_class> right(n + 1);
    for (std::size_t round = 0; round <= n; ++round) {
        left[round] = row.front() << (n - round);
        right[n - round] = row[n - round] << (n - round);
        for (std::size_t j = 0; j + round < n; ++j) row[j] += row[j + 1];
    }
    return {std::move(left), std::move(right)};
}

}  // namespace trisect::detail
