// SPDX-License-Identifier: Apache-2.0

#include <trisect/kernel/pose.h>

#include <cmath>
#include <cstdint>

#include <trisect/kernel/error.h>
#include <trisect/kernel/number/bounded_int.h>
#include <trisect/kernel/pose/reduced_map.h>

namespace trisect {

using detail::BoundedInt;
using detail::IntVector;
using detail::MapNumbers;

// Makes poses of numbers that are not reduced yet, S > 0.
class PoseBuilder {
public:
    static Pose build(MapNumbers map, int m_shift = 0, int t_shift = 0) {
        const int orientation = determinant(map.m[0], map.m[1], map.m[2]).sign();
        if (orientation == 0) throw UsageError("a pose whose matrix is singular");
        remove_odd_factor(map);
        remove_twos(map, m_shift, t_shift, Pose::bits);
        Pose pose;
        for (std::size_t i = 0; i < 3; ++i) {
            for (std::size_t j = 0; j < 3; ++j) pose.m_[3 * i + j] = map.m[i][j].to_wide<7>();
            pose.t_[i] = map.t[i].to_wide<7>();
        }
        pose.s_ = map.s.to_wide<7>();
        pose.mirror_ = orientation < 0;
        pose.approximate_ = pose.rounded();
        return pose;
    }
};

namespace {

// A double is digits 2^exponent.
struct Digits53 {
    std::int64_t digits = 0;
    int exponent = 0;
};

Digits53 split(double v) {
    if (!std::isfinite(v)) throw UsageError("a pose with a number that is not finite");
    int exponent = 0;
    const double m = std::frexp(v, &exponent);
    return {static_cast<std::int64_t>(std::ldexp(m, 53)), exponent - 53};
}

// Fractions of powers of two over a common one. \throw LimitError when they span too many bits.
class CommonPower {
public:
    void add(double v) {
        const Digits53 d = split(v);
        if (d.digits == 0) return;
        const BoundedInt digits(d.digits);
        lowest_ = std::min(lowest_, d.exponent + digits.trailing_zeros());
        highest_ = std::max(highest_, d.exponent + digits.bit_length());
    }
    /// The power S with v S integral for all that were added.
    [[nodiscard]] int exponent() const {
        if (highest_ - lowest_ > Pose::bits)
            throw LimitError("the numbers of a pose span " + std::to_string(highest_ - lowest_) +
                             " bits; the limit is " + std::to_string(Pose::bits));
        return -lowest_;
    }
    [[nodiscard]] BoundedInt integer(double v) const {
        const Digits53 d = split(v);
        const int by = d.exponent - lowest_;
        const BoundedInt digits(d.digits);
        return by >= 0 ? digits.shifted_left(by) : digits.shifted_right(-by);
    }

private:
    int lowest_ = 0;  // 2^0 is always among them: S itself
    int highest_ = 1;
};

}  // namespace

Pose::Pose() : s_(1) {
    for (std::size_t i = 0; i < 3; ++i) m_[4 * i] = Number(1);
}

Pose Pose::from_doubles(const std::array<double, 12>& rows) {
    CommonPower power;
    for (const double v : rows) power.add(v);
    MapNumbers map;
    map.s = BoundedInt(1).shifted_left(power.exponent());
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) map.m[i][j] = power.integer(rows[4 * i + j]);
        map.t[i] = power.integer(rows[4 * i + 3]);
    }
    return PoseBuilder::build(map);
}

Pose Pose::from_translation(const std::array<double, 3>& by) {
    return from_doubles({1, 0, 0, by[0], 0, 1, 0, by[1], 0, 0, 1, by[2]});
}

Pose Pose::from_quaternion(const std::array<std::int64_t, 4>& q,
                           const std::array<double, 3>& translation) {
    constexpr std::int64_t largest = std::int64_t{1} << 53;
    for (const std::int64_t v : q)
        if (v > largest || v < -largest)
            throw UsageError("a quaternion with a component beyond 2^53");
    const BoundedInt a(q[0]);
    const BoundedInt b(q[1]);
    const BoundedInt c(q[2]);
    const BoundedInt d(q[3]);
    const BoundedInt two(2);
    const BoundedInt norm = a * a + b * b + c * c + d * d;
    if (norm.is_zero()) throw UsageError("the quaternion 0 is no rotation");
    CommonPower power;
    for (const double v : translation) power.add(v);
    const BoundedInt scale = BoundedInt(1).shifted_left(power.exponent());
    MapNumbers map;
    map.m[0] = {a * a + b * b - c * c - d * d, two * (b * c - a * d), two * (b * d + a * c)};
    map.m[1] = {two * (b * c + a * d), a * a - b * b + c * c - d * d, two * (c * d - a * b)};
    map.m[2] = {two * (b * d - a * c), two * (c * d + a * b), a * a - b * b - c * c + d * d};
    for (std::size_t i = 0; i < 3; ++i) {
        for (BoundedInt& v : map.m[i]) v = v * scale;
        map.t[i] = power.integer(translation[i]) * norm;
    }
    map.s = norm * scale;
    return PoseBuilder::build(map);
}

Pose Pose::from_integers(std::span<const Number, 9> m, std::span<const Number, 3> t,
                         const Number& s) {
    if (s.is_zero()) throw UsageError("a pose with the denominator 0");
    MapNumbers map;
    map.s = s;
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) map.m[i][j] = m[3 * i + j];
        map.t[i] = t[i];
    }
    return PoseBuilder::build(s.is_negative() ? negated(map) : map);
}

bool Pose::is_translation() const {
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
            if (i == j ? matrix(i, j) != s_ : !matrix(i, j).is_zero()) return false;
    return true;
}

std::array<double, 12> Pose::rounded() const {
    const BoundedInt::Scaled s = BoundedInt(s_).scaled();
    const auto quotient = [&s](const Number& v) {
        const BoundedInt::Scaled n = BoundedInt(v).scaled();
        return n.mantissa == 0 ? 0.0 : std::ldexp(n.mantissa / s.mantissa, n.exponent - s.exponent);
    };
    std::array<double, 12> r{};
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) r[4 * i + j] = quotient(matrix(i, j));
        r[4 * i + 3] = quotient(t_[i]);
    }
    return r;
}

Pose Pose::inverse() const {
    // x = C (S x' - t) / D with C = adj M, D = det M.
    const MapNumbers map = detail::numbers_of(*this);
    MapNumbers r;
    r.m = detail::adjugate(map.m);
    r.s = map.m[0][0] * r.m[0][0] + map.m[0][1] * r.m[1][0] + map.m[0][2] * r.m[2][0];
    for (std::size_t i = 0; i < 3; ++i) {
        r.t[i] = -dot(r.m[i], map.t);
        for (BoundedInt& v : r.m[i]) v = v * map.s;
    }
    return PoseBuilder::build(r.s.sign() < 0 ? negated(r) : r);
}

Pose operator*(const Pose& a, const Pose& b) {
    // (MA (MB x + tB) / SB + tA) / SA = (MA MB x + MA tB + SB tA) / (SA SB)
    const MapNumbers u = detail::numbers_of(a);
    const MapNumbers v = detail::numbers_of(b);
    MapNumbers r;
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j)
            r.m[i][j] = u.m[i][0] * v.m[0][j] + u.m[i][1] * v.m[1][j] + u.m[i][2] * v.m[2][j];
        r.t[i] = dot(u.m[i], v.t) + v.s * u.t[i];
    }
    r.s = u.s * v.s;
    return PoseBuilder::build(r);
}

bool operator==(const Pose& a, const Pose& b) {
    const BoundedInt u(a.s_);
    const BoundedInt v(b.s_);
    const auto same = [&](const Pose::Number& x, const Pose::Number& y) {
        return BoundedInt(x) * v == BoundedInt(y) * u;
    };
    for (std::size_t i = 0; i < 9; ++i)
        if (!same(a.m_[i], b.m_[i])) return false;
    for (std::size_t i = 0; i < 3; ++i)
        if (!same(a.t_[i], b.t_[i])) return false;
    return true;
}

}  // namespace trisect
