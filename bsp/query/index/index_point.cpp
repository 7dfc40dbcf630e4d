// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/query/index/index_point.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include <trisect/kernel/counters.h>
#include <trisect/kernel/error.h>
#include <trisect/kernel/number/dyadic.h>
#include <trisect/kernel/number/error_bounds.h>
#include <trisect/kernel/number/vector3.h>

namespace trisect::detail {

namespace {

// Bits behind the point that the homogeneous form has room for, and the coordinates' limit:
// 2^54 · 2^320 leaves it in the first two tiers.
constexpr int homogeneous_bits = 320;
constexpr double homogeneous_limit = 0x1p54;
// Of coordinates that are not 0 and without error.
constexpr double tiny = 0x1p-500;

// Bits behind the point of the finest coordinate.
int most_fraction_bits(const std::array<double, 3>& c) {
    int bits = 0;
    for (const double v : c) bits = std::max(bits, -dyadic(v).exponent);
    return bits;
}

ExactRational fraction(const HomogeneousPoint::Coordinate& numerator,
                       const HomogeneousPoint::Weight& denominator) {
    return ExactRational(numerator) / ExactRational(denominator);
}

}  // namespace

void IndexPoint::set_huge() {
    if (!(std::isfinite(c_[0]) && std::isfinite(c_[1]) && std::isfinite(c_[2])))
        throw UsageError("a point with a coordinate that is not finite");
    rational_ = Rational{ExactRational::from_double(c_[0]), ExactRational::from_double(c_[1]),
                         ExactRational::from_double(c_[2])};
    for (double& x : c_) x = std::clamp(x, -0x1p600, 0x1p600);
    error_ = HUGE_VAL;
    fits_ = false;
}

// Of rationals.
bool IndexPoint::is_tiny() const {
    for (std::size_t k = 0; k < 3; ++k)
        if (std::fabs(c_[k]) < tiny && (*rational_)[k].sign() != 0) return true;
    return false;
}

IndexPoint::IndexPoint(const Point& p) : c_(p.approximation().c), error_(p.approximation().error) {
    if (p.is_lattice()) {
        error_ = 0;
        return;
    }
    for (const double x : c_)
        if (x != 0 && std::fabs(x) < tiny) error_ = std::max(error_, tiny);
    homogeneous_ = p.homogeneous();
}

IndexPoint::IndexPoint(const FinePoint& p) {
    bool rounded = false;
    for (std::size_t k = 0; k < 3; ++k) {
        c_[k] = rounded_position(p.c[k]);
        if (is_double(p.c[k])) continue;
        rounded = true;
        error_ = std::max(error_, std::fabs(c_[k]) * last_place);
    }
    if (!rounded) return;
    homogeneous_ = HomogeneousPoint({p.c[0], p.c[1], p.c[2]}, splitting_scale);
}

IndexPoint::IndexPoint(Rational p) : fits_(false) {
    const Approximation a = detail::approximate(p);
    c_ = a.c;
    error_ = a.error;
    for (const double x : c_)
        if (!(x < 0x1p600 && x > -0x1p600)) error_ = HUGE_VAL;
    for (double& x : c_) x = std::clamp(x, -0x1p600, 0x1p600);
    rational_ = std::move(p);
    if (is_tiny()) {
        error_ = std::max(error_, tiny);
    } else if (error_ == 0) {
        fits_ = true;  // doubles after all
    }
}

IndexPoint IndexPoint::from_user_slowly(const Vector& p, Lattice lattice) {
    for (const double x : p)
        if (!std::isfinite(x)) throw UsageError("a point with a coordinate that is not finite");
    Rational r;
    for (std::size_t k = 0; k < 3; ++k)
        r[k] = ExactRational::from_double(p[k]).scaled(-lattice.exponent);
    return IndexPoint(std::move(r));
}

// From the bits of the doubles; the functions of the library are calls.
void IndexPoint::find_small() const {
    small_known_ = true;
    if (!is_doubles()) return;
    struct Parts {
        std::int64_t mantissa;  // signed, times 2^exponent
        int exponent;
    };
    std::array<Parts, 3> parts{};
    int bits = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        if (c_[k] == 0) continue;
        constexpr std::uint64_t hidden = std::uint64_t{1} << 52U;
        const auto v = std::bit_cast<std::uint64_t>(c_[k]);
        const auto biased = static_cast<int>(v >> 52U & 0x7ffU);
        if (biased == 0) return;  // far below 2^-62
        const std::uint64_t m = (v & (hidden - 1)) | hidden;
        const int zeros = std::countr_zero(m);
        const auto odd = static_cast<std::int64_t>(m >> zeros);
        parts[k] = {c_[k] < 0 ? -odd : odd, biased - 1075 + zeros};
        bits = std::max(bits, -parts[k].exponent);
    }
    if (bits > 62) return;
    Small s;
    s.bits = bits;
    for (std::size_t k = 0; k < 3; ++k) {
        const std::int64_t m = parts[k].mantissa;
        if (m == 0) continue;
        const int shift = parts[k].exponent + bits;
        const auto size = static_cast<std::uint64_t>(m < 0 ? -m : m);
        if (static_cast<int>(std::bit_width(size)) + shift > 62) return;
        s.c[k] = m * (std::int64_t{1} << shift);
    }
    small_ = s;
}

const HomogeneousPoint* IndexPoint::homogeneous() const {
    if (homogeneous_) return &*homogeneous_;
    if (!fits_) return nullptr;
    const int bits = most_fraction_bits(c_);
    if (bits > homogeneous_bits || largest_component(c_) >= homogeneous_limit) return nullptr;
    std::array<HomogeneousPoint::Coordinate, 3> xyz;
    for (std::size_t k = 0; k < 3; ++k) {
        const Dyadic d = dyadic(c_[k]);
        xyz[k] = HomogeneousPoint::Coordinate(d.mantissa).shifted_left(d.exponent + bits);
    }
    homogeneous_ = HomogeneousPoint(xyz, HomogeneousPoint::Weight(1).shifted_left(bits));
    return &*homogeneous_;
}

const IndexPoint::Rational& IndexPoint::rational() const {
    if (rational_) return *rational_;
    Rational r;
    for (std::size_t k = 0; k < 3; ++k)
        r[k] = is_doubles() ? ExactRational::from_double(c_[k])
                            : fraction(homogeneous_->xyz[k], homogeneous_->w);
    rational_ = std::move(r);
    return *rational_;
}

int IndexPoint::side_of(const Plane& plane) const {
    if (const auto s = filtered_side(approximation(), plane)) {
        ++detail::counters_of_thread<PredicateCounters>.filtered;
        return sign_of(*s);
    }
    if (const HomogeneousPoint* h = homogeneous()) return sign_of(trisect::side_of(*h, plane));
    ++detail::counters_of_thread<PredicateCounters>.exact_wide;
    return value_at(rational(), plane).sign();
}

int IndexPoint::compare_slowly(std::size_t k, double position) const {
    const double d = c_[k] - position;  // its rounding is below the error
    if (d > 2 * error_) return 1;
    if (d < -2 * error_) return -1;
    return (rational()[k] - ExactRational::from_double(position)).sign();
}

int IndexPoint::compare_fine(std::size_t k, std::int64_t position) const {
    const double at = rounded_position(position);
    const double d = c_[k] - at;
    const double slack = 2 * error_ + std::fabs(at) * last_place;
    if (d > slack) return 1;
    if (d < -slack) return -1;
    return (rational()[k] * ExactRational(splitting_scale) - ExactRational(position)).sign();
}

ExactRational value_at(const IndexPoint::Rational& p, const Plane& plane) {
    ExactRational sum(plane.offset());
    for (int k = 0; k < 3; ++k)
        sum += p[static_cast<std::size_t>(k)] * ExactRational(plane.normal(k));
    return sum;
}

Approximation approximate(const IndexPoint::Rational& p) {
    Approximation a;
    for (std::size_t k = 0; k < 3; ++k) {
        a.c[k] = p[k].to_double();
        if (std::isfinite(a.c[k]) && ExactRational::from_double(a.c[k]) == p[k]) continue;
        a.error = std::max(a.error, std::max(std::fabs(a.c[k]) * last_place, 0x1p-1000));
    }
    return a;
}

}  // namespace trisect::detail
