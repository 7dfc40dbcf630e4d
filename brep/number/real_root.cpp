// SPDX-License-Identifier: Apache-2.0
//
// Isolation of roots by Descartes' rule of signs in the Bernstein basis (Lane and Riesenfeld 1981;
// Eigenwillig, Descartes Method, 2008): the changes of sign among the Bernstein coefficients bound
// the number of roots in the open interval, and 0 and 1 are exact. Otherwise the interval is
// halved. For square-free polynomials that ends. A root that is met at an end of an interval shows
// as a zero coefficient there; it is reported as a rational number and the zero left out of the
// count, so nothing needs to be divided off.
//
// An isolated root is refined by bisection with signs. The sign left of the root is remembered
// instead of computed from the lower end, because that end may be another root.
//
// Signs at a root and comparisons never use separation bounds, which are hundreds of bits even for
// cubics: an answer that narrow intervals do not give at once is decided by the common divisor. Is
// it a root of both? Then it is zero, or equal, and that is proved; if not, narrowing must end.

#include <trisect/brep/number/real_root.h>

#include <algorithm>
#include <utility>

#include <trisect/kernel/contract.h>

namespace trisect::detail {

namespace {

// Narrowings before the common divisor is computed.
constexpr int quick_rounds = 4;

int changes_of_sign(const std::vector<mpz_class>& coefficients) {
    int last = 0;
    int changes = 0;
    for (const mpz_class& c : coefficients) {
        const int s = sgn(c);
        if (s == 0) continue;
        if (last != 0 && s != last) ++changes;
        last = s;
    }
    return changes;
}

int first_sign(const std::vector<mpz_class>& coefficients) {
    for (const mpz_class& c : coefficients)
        if (sgn(c) != 0) return sgn(c);
    return 0;
}

mpq_class middle(const mpq_class& a, const mpq_class& b) { return (a + b) / 2; }

std::strong_ordering order(int c) { return c <=> 0; }

}  // namespace

void RealRoot::become(const mpq_class& value) {
    lower_ = value;
    upper_ = lower_;
    polynomial_.reset();
}

void RealRoot::halve() {
    if (is_rational()) return;
    mpq_class m = middle(lower_, upper_);
    const int s = polynomial_->sign_at(m);
    if (s == 0)
        become(m);
    else if (s == sign_above_lower_)
        lower_ = std::move(m);
    else
        upper_ = std::move(m);
}

void RealRoot::refine(const mpq_class& width) {
    while (!is_rational() && upper_ - lower_ > width) halve();
}

RealRoot RealRoot::shifted(unsigned long n) const {
    if (n == 0) return *this;
    RealRoot r = *this;
    r.lower_ += n;
    r.upper_ += n;
    if (polynomial_) {
        const mpz_class zero = -mpz_class(n);
        r.polynomial_ = std::make_shared<const IntegerPolynomial>(
            polynomial_->on_interval(zero, mpz_class(zero + 1)));
    }
    return r;
}

std::strong_ordering RealRoot::compare(const mpq_class& value) {
    if (is_rational()) return order(cmp(lower_, value));
    if (value <= lower_) return std::strong_ordering::greater;
    if (value >= upper_) return std::strong_ordering::less;
    const int s = polynomial_->sign_at(value);
    if (s == 0) {
        become(mpq_class(value));
        return std::strong_ordering::equal;
    }
    if (s == sign_above_lower_) {
        lower_ = value;
        return std::strong_ordering::greater;
    }
    upper_ = value;
    return std::strong_ordering::less;
}

std::strong_ordering RealRoot::compare(RealRoot& other) {
    if (other.is_rational()) return compare(other.lower_);
    if (is_rational()) return 0 <=> other.compare(lower_);
    if (this == &other) return std::strong_ordering::equal;
    for (int round = 0;; ++round) {
        if (is_rational() || other.is_rational()) return compare(other);
        if (upper_ <= other.lower_) return std::strong_ordering::less;
        if (other.upper_ <= lower_) return std::strong_ordering::greater;
        if (round == quick_rounds) {
            // Equal means: this is a root of the other polynomial, and of those the one in the
            // other interval.
            const IntegerPolynomial common = *polynomial_ == *other.polynomial_
                                                 ? *polynomial_
                                                 : gcd(*polynomial_, *other.polynomial_);
            if (common.degree() > 0 && is_root_of_divisor(common)) {
                if (compare(mpq_class(other.lower_)) <= 0) return std::strong_ordering::less;
                if (compare(mpq_class(other.upper_)) >= 0) return std::strong_ordering::greater;
                return std::strong_ordering::equal;
            }
        }
        if (upper_ - lower_ > other.upper_ - other.lower_)
            halve();
        else
            other.halve();
    }
}

// For a divisor of the polynomial: it has at most this root in the interval, and a simple one.
bool RealRoot::is_root_of_divisor(const IntegerPolynomial& divisor) {
    if (is_rational()) return divisor.sign_at(lower_) == 0;
    // Signs at the ends count only where the ends are no roots themselves.
    while (!is_rational() && (divisor.sign_at(lower_) == 0 || divisor.sign_at(upper_) == 0))
        halve();
    if (is_rational()) return divisor.sign_at(lower_) == 0;
    return divisor.sign_at(lower_) != divisor.sign_at(upper_);
}

int RealRoot::sign_of(const IntegerPolynomial& p) {
    if (p.degree() <= 0) return p.is_zero() ? 0 : sgn(p.leading());
    for (int round = 0;; ++round) {
        if (is_rational()) return p.sign_at(lower_);
        const int s = constant_sign(p, lower_, upper_);
        if (s != 0) return s;
        if (round == quick_rounds) {
            const IntegerPolynomial common = gcd(*polynomial_, p);
            if (common.degree() > 0 && is_root_of_divisor(common)) return 0;
        }
        halve();
    }
}

int constant_sign(const IntegerPolynomial& p, const mpq_class& from, const mpq_class& to) {
    if (p.is_zero()) return 0;
    if (from == to) return p.sign_at(from);
    const IntegerPolynomial q = p.on_interval(from, to);
    const std::vector<mpz_class> b = bernstein_coefficients(q);
    const int s = sgn(b.front());
    const bool constant =
        s != 0 && std::all_of(b.begin(), b.end(), [s](const mpz_class& c) { return sgn(c) == s; });
    return constant ? s : 0;
}

std::vector<RealRoot> isolate_roots(const IntegerPolynomial& p, const mpq_class& from,
                                    const mpq_class& to) {
    TRISECT_EXPECTS(!p.is_zero() && from <= to, "roots of a polynomial in an interval");
    std::vector<RealRoot> roots;
    if (from == to) {
        if (p.sign_at(from) == 0) roots.emplace_back(from);
        return roots;
    }
    if (p.degree() == 0) return roots;
    const auto polynomial = std::make_shared<const IntegerPolynomial>(square_free(p));
    if (polynomial->degree() == 1) {
        mpq_class root(-(*polynomial)[0], (*polynomial)[1]);
        root.canonicalize();
        if (from <= root && root <= to) roots.emplace_back(std::move(root));
        return roots;
    }

    struct Part {
        mpq_class from;
        mpq_class to;
        std::vector<mpz_class> coefficients;
        bool is_right_half = false;
    };
    std::vector<Part> parts;  // the leftmost one on top
    parts.push_back({from, to, bernstein_coefficients(polynomial->on_interval(from, to)), false});
    if (sgn(parts.back().coefficients.front()) == 0) roots.emplace_back(from);
    const bool ends_in_root = sgn(parts.back().coefficients.back()) == 0;
    while (!parts.empty()) {
        Part part = std::move(parts.back());
        parts.pop_back();
        // A root in the middle of a part is reported once, by the right one of its halves.
        if (part.is_right_half && sgn(part.coefficients.front()) == 0)
            roots.emplace_back(part.from);
        const int changes = changes_of_sign(part.coefficients);
        if (changes == 0) continue;
        if (changes == 1) {
            roots.emplace_back(polynomial, std::move(part.from), std::move(part.to),
                               first_sign(part.coefficients));
            continue;
        }
        const mpq_class m = middle(part.from, part.to);
        auto [left, right] = halve_bernstein(part.coefficients);
        parts.push_back({m, std::move(part.to), std::move(right), true});
        parts.push_back({std::move(part.from), m, std::move(left), false});
    }
    if (ends_in_root) roots.emplace_back(to);
    return roots;
}

}  // namespace trisect::detail
