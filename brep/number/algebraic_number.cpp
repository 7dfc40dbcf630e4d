// SPDX-License-Identifier: Apache-2.0

#include <trisect/brep/algebraic_number.h>

#include <cmath>
#include <utility>

#include <trisect/brep/number/gmp_conversion.h>
#include <trisect/brep/number/real_root.h>
#include <trisect/kernel/error.h>

namespace trisect {

namespace {

detail::IntegerPolynomial to_polynomial(std::span<const ExactRational> coefficients) {
    std::vector<mpq_class> values;
    values.reserve(coefficients.size());
    for (const ExactRational& c : coefficients) values.push_back(detail::to_gmp(c));
    mpz_class denominator;
    return detail::IntegerPolynomial(detail::common_numerators(values, denominator));
}

}  // namespace

AlgebraicNumber::AlgebraicNumber() : root_(std::make_unique<detail::RealRoot>()) {}
AlgebraicNumber::AlgebraicNumber(const ExactRational& v)
    : root_(std::make_unique<detail::RealRoot>(detail::to_gmp(v))) {}
AlgebraicNumber::AlgebraicNumber(const detail::RealRoot& root)
    : root_(std::make_unique<detail::RealRoot>(root)) {}
AlgebraicNumber::AlgebraicNumber(const AlgebraicNumber& o) : AlgebraicNumber(*o.root_) {}
// A moved-from number is zero, so that root_ is never null.
AlgebraicNumber::AlgebraicNumber(AlgebraicNumber&& o) noexcept : AlgebraicNumber() {
    std::swap(root_, o.root_);
}
AlgebraicNumber& AlgebraicNumber::operator=(const AlgebraicNumber& o) {
    *root_ = *o.root_;
    return *this;
}
AlgebraicNumber& AlgebraicNumber::operator=(AlgebraicNumber&& o) noexcept {
    std::swap(root_, o.root_);
    return *this;
}
AlgebraicNumber::~AlgebraicNumber() = default;

bool AlgebraicNumber::is_rational() const { return root_->is_rational(); }
ExactRational AlgebraicNumber::lower() const { return detail::from_gmp(root_->lower()); }
ExactRational AlgebraicNumber::upper() const { return detail::from_gmp(root_->upper()); }

AlgebraicNumber AlgebraicNumber::refined(const ExactRational& width) const {
    if (width.sign() <= 0) throw UsageError("the width of an interval must be positive");
    detail::RealRoot root = *root_;
    root.refine(detail::to_gmp(width));
    return AlgebraicNumber(root);
}

double AlgebraicNumber::to_double() const {
    // Narrow until both ends round to the same double or to neighbours; between neighbours the
    // middle decides, and the number may be that middle itself.
    detail::RealRoot root = *root_;
    for (;;) {
        const double low = detail::from_gmp(root.lower()).to_double();
        const double high = detail::from_gmp(root.upper()).to_double();
        if (low == high) return low;
        if (std::nextafter(low, high) != high) {
            root.halve();
            continue;
        }
        const ExactRational tie =
            (ExactRational::from_double(low) + ExactRational::from_double(high)).scaled(-1);
        const auto order = root.compare(detail::to_gmp(tie));
        return order < 0 ? low : order > 0 ? high : tie.to_double();
    }
}

std::vector<ExactRational> AlgebraicNumber::polynomial() const {
    std::vector<ExactRational> result;
    if (const detail::IntegerPolynomial* p = root_->polynomial()) {
        const int sign = sgn(p->leading());
        for (const mpz_class& c : p->coefficients())
            result.push_back(detail::from_gmp(mpz_class(sign * c)));
    } else {
        result.push_back(detail::from_gmp(mpq_class(-root_->lower().get_num())));
        result.push_back(detail::from_gmp(mpq_class(root_->lower().get_den())));
    }
    return result;
}

int AlgebraicNumber::sign_of(std::span<const ExactRational> coefficients) const {
    detail::RealRoot root = *root_;
    return root.sign_of(to_polynomial(coefficients));
}

std::strong_ordering operator<=>(const AlgebraicNumber& a, const AlgebraicNumber& b) {
    detail::RealRoot x = *a.root_;
    detail::RealRoot y = *b.root_;
    return x.compare(y);
}

std::vector<AlgebraicNumber> roots_between(std::span<const ExactRational> coefficients,
                                           const ExactRational& from, const ExactRational& to) {
    const detail::IntegerPolynomial p = to_polynomial(coefficients);
    if (p.is_zero()) throw UsageError("every number is a root of the zero polynomial");
    if (from > to) throw UsageError("roots in an interval whose ends are exchanged");
    std::vector<AlgebraicNumber> result;
    for (const detail::RealRoot& r :
         detail::isolate_roots(p, detail::to_gmp(from), detail::to_gmp(to)))
        result.push_back(detail::number_of(r));
    return result;
}

}  // namespace trisect
