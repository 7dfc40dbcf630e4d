// SPDX-License-Identifier: Apache-2.0

#include <trisect/brep/exact_rational.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include <trisect/brep/number/gmp_conversion.h>
#include <trisect/kernel/error.h>
#include <trisect/kernel/number/gmp.h>

namespace trisect {

struct ExactRational::Value {
    mpq_class q;
};

namespace {

mpz_class integer_from_limbs(std::span<const std::uint64_t> limbs) {
    mpz_class z;
    mpz_import(z.get_mpz_t(), limbs.size(), -1, sizeof(std::uint64_t), 0, 0, limbs.data());
    return z;
}

long bit_length(const mpz_class& z) {
    return sgn(z) == 0 ? 0 : static_cast<long>(mpz_sizeinbase(z.get_mpz_t(), 2));
}

bool is_decimal(std::string_view digits, bool may_be_negative) {
    if (may_be_negative && !digits.empty() && digits.front() == '-') digits.remove_prefix(1);
    return !digits.empty() &&
           std::all_of(digits.begin(), digits.end(), [](char c) { return c >= '0' && c <= '9'; });
}

// n / d, n > 0, rounded to the nearest double. The quotient is taken to 64 or 65 bits with a sticky
// remainder, then rounded once to as many bits as a double of its size has: std::ldexp on a number
// of 53 bits would round subnormal results a second time.
double nearest_quotient(const mpz_class& n, const mpz_class& d) {
    const long shift = 64 - (bit_length(n) - bit_length(d));
    mpz_class quotient;
    mpz_class rest;
    const mpz_class scaled_n = shift > 0 ? mpz_class(n << static_cast<unsigned long>(shift)) : n;
    const mpz_class scaled_d = shift < 0 ? mpz_class(d << static_cast<unsigned long>(-shift)) : d;
    mpz_fdiv_qr(quotient.get_mpz_t(), rest.get_mpz_t(), scaled_n.get_mpz_t(), scaled_d.get_mpz_t());
    const long bits = bit_length(quotient);
    const long precision = std::min(53L, bits - shift + 1074);
    if (precision < 0) return 0;
    const auto dropped = static_cast<unsigned long>(bits - precision);
    mpz_class kept = quotient >> dropped;
    const mpz_class low = quotient - (kept << dropped);
    const mpz_class half = mpz_class(1) << (dropped - 1);
    if (low > half || (low == half && (sgn(rest) != 0 || mpz_odd_p(kept.get_mpz_t()) != 0))) ++kept;
    const long exponent = std::clamp(static_cast<long>(dropped) - shift, -5000L, 5000L);
    return std::ldexp(kept.get_d(), static_cast<int>(exponent));
}

}  // namespace

ExactRational::ExactRational() noexcept = default;
ExactRational::ExactRational(std::int64_t v) : value_(std::make_unique<Value>()) {
    value_->q = detail::to_gmp(v);
}
ExactRational::ExactRational(const ExactRational& o)
    : value_(o.value_ ? std::make_unique<Value>(*o.value_) : nullptr) {}
ExactRational::ExactRational(ExactRational&& o) noexcept = default;
ExactRational& ExactRational::operator=(const ExactRational& o) {
    if (this != &o) value_ = o.value_ ? std::make_unique<Value>(*o.value_) : nullptr;
    return *this;
}
ExactRational& ExactRational::operator=(ExactRational&& o) noexcept = default;
ExactRational::~ExactRational() = default;

ExactRational ExactRational::from_string(const std::string& text) {
    const std::size_t slash = text.find('/');
    const std::string numerator = text.substr(0, slash);
    const std::string denominator = slash == std::string::npos ? "1" : text.substr(slash + 1);
    if (!is_decimal(numerator, true) || !is_decimal(denominator, false))
        throw UsageError("not a fraction: \"" + text + "\"");
    mpz_class d(denominator, 10);
    if (sgn(d) == 0) throw UsageError("fraction with denominator 0: \"" + text + "\"");
    ExactRational r;
    mpq_class& q = r.mutable_value().q;
    q = mpq_class(mpz_class(numerator, 10), std::move(d));
    q.canonicalize();
    return r;
}

ExactRational ExactRational::from_double(double v) {
    if (!std::isfinite(v)) throw UsageError("fraction of a number that is not finite");
    ExactRational r;
    r.mutable_value().q = v;
    return r;
}

ExactRational ExactRational::from_limbs(bool negative, std::span<const std::uint64_t> numerator,
                                        std::span<const std::uint64_t> denominator) {
    mpz_class n = integer_from_limbs(numerator);
    mpz_class d = integer_from_limbs(denominator);
    if (sgn(d) == 0) throw UsageError("fraction with denominator 0");
    if (negative) n = -n;
    ExactRational r;
    mpq_class& q = r.mutable_value().q;
    q = mpq_class(std::move(n), std::move(d));
    q.canonicalize();
    return r;
}

ExactRational& ExactRational::operator+=(const ExactRational& o) {
    mutable_value().q += o.value().q;
    return *this;
}
ExactRational& ExactRational::operator-=(const ExactRational& o) {
    mutable_value().q -= o.value().q;
    return *this;
}
ExactRational& ExactRational::operator*=(const ExactRational& o) {
    mutable_value().q *= o.value().q;
    return *this;
}
ExactRational& ExactRational::operator/=(const ExactRational& o) {
    if (o.sign() == 0) throw UsageError("division of a fraction by 0");
    mutable_value().q /= o.value().q;
    return *this;
}

ExactRational ExactRational::scaled(int exponent) const {
    ExactRational r = *this;
    mpq_class& q = r.mutable_value().q;
    const auto bits = static_cast<unsigned long>(std::abs(static_cast<long>(exponent)));
    if (exponent >= 0)
        q <<= bits;
    else
        q >>= bits;
    return r;
}

bool operator==(const ExactRational& a, const ExactRational& b) {
    return a.value().q == b.value().q;
}
std::strong_ordering operator<=>(const ExactRational& a, const ExactRational& b) {
    return cmp(a.value().q, b.value().q) <=> 0;
}

int ExactRational::sign() const { return sgn(value().q); }
bool ExactRational::is_integer() const { return value().q.get_den() == 1; }
std::string ExactRational::to_string() const { return value().q.get_str(); }

double ExactRational::to_double() const {
    const mpq_class& q = value().q;
    if (sgn(q) == 0) return 0;
    const double r = nearest_quotient(abs(q.get_num()), q.get_den());
    return sgn(q) < 0 ? -r : r;
}

const ExactRational::Value& ExactRational::value() const {
    static const Value zero;
    return value_ ? *value_ : zero;
}

ExactRational::Value& ExactRational::mutable_value() {
    if (!value_) value_ = std::make_unique<Value>();
    return *value_;
}

namespace detail {

struct ExactRationalAccess {
    static const mpq_class& fraction(const ExactRational& v) { return v.value().q; }
};

mpq_class to_gmp(const ExactRational& value) { return ExactRationalAccess::fraction(value); }

}  // namespace detail

}  // namespace trisect
