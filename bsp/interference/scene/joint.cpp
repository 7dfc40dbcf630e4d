// SPDX-License-Identifier: Apache-2.0
//
// Why half-angle tangents. A rotation by a given number of degrees has sines and cosines that are
// no fractions, so as soon as it is written down it is no rotation any more, and along a chain of
// links the errors multiply. Rational rotations are those by integer quaternions, and about a fixed
// axis k they are (q, p k): one fraction p/q says all. They lie densely, so what is lost is only
// that an angle like one degree is met within 2^-20 or whatever one pays for in bits, never that
// the motion is not rigid.
#include <trisect/bsp/interference/joint.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <string>

#include <trisect/kernel/error.h>
#include <trisect/kernel/wide_int.h>

namespace trisect {
namespace {

constexpr std::int64_t quaternion_limit = std::int64_t{1} << 53;

Int128 absolute(Int128 v) { return v < 0 ? -v : v; }

Int128 greatest_common_divisor(Int128 a, Int128 b) {
    a = absolute(a);
    b = absolute(b);
    while (b != 0) {
        const Int128 rest = a % b;
        a = b;
        b = rest;
    }
    return a;
}

/// In lowest terms with a denominator that is not negative. \pre not 0/0
Ratio reduced(Int128 numerator, Int128 denominator) {
    const Int128 g = greatest_common_divisor(numerator, denominator);
    const Int128 sign = denominator < 0 || (denominator == 0 && numerator < 0) ? -1 : 1;
    numerator = numerator / g * sign;
    denominator = denominator / g * sign;
    constexpr Int128 most = std::numeric_limits<std::int64_t>::max();
    if (absolute(numerator) > most || denominator > most)
        throw LimitError("the value of a joint needs more than 63 bits");
    return {static_cast<std::int64_t>(numerator), static_cast<std::int64_t>(denominator)};
}

void expect_finite(const std::array<double, 3>& v, const char* what) {
    for (const double c : v) {
        if (!std::isfinite(c)) throw UsageError(std::string(what) + " of a joint is not finite");
    }
}

}  // namespace

Joint Joint::fixed() { return {}; }

Joint Joint::revolute(const std::array<double, 3>& point, const std::array<std::int64_t, 3>& axis) {
    expect_finite(point, "the point");
    Joint joint;
    joint.kind_ = Kind::Revolute;
    joint.vector_ = point;
    joint.axis_ = axis;
    bool any = false;
    for (const std::int64_t c : axis) {
        if (c > quaternion_limit || c < -quaternion_limit)
            throw LimitError("the axis of a joint has components beyond 2^53");
        any = any || c != 0;
    }
    if (!any) throw UsageError("the axis of a joint is (0, 0, 0)");
    return joint;
}

Joint Joint::prismatic(const std::array<double, 3>& direction) {
    expect_finite(direction, "the direction");
    Joint joint;
    joint.kind_ = Kind::Prismatic;
    joint.vector_ = direction;
    return joint;
}

Pose Joint::motion(Ratio value) const {
    if (value.numerator == 0 && value.denominator == 0)
        throw UsageError("the value of a joint is 0/0");
    switch (kind_) {
        case Kind::Revolute:
            return turn(reduced(value.numerator, value.denominator));
        case Kind::Prismatic:
            if (value.denominator == 0)
                throw UsageError("a prismatic joint cannot have a value with denominator 0");
            return slide(reduced(value.numerator, value.denominator));
        case Kind::Fixed:
            break;
    }
    if (value.numerator != 0) throw UsageError("a fixed joint can have no value but 0");
    return {};
}

Pose Joint::turn(Ratio value) const {
    std::array<std::int64_t, 4> q{value.denominator, 0, 0, 0};
    for (std::size_t k = 0; k < 3; ++k) {
        const Int128 component = Int128{value.numerator} * axis_[k];
        if (absolute(component) > quaternion_limit || value.denominator > quaternion_limit)
            throw LimitError("the quaternion of a joint has components beyond 2^53");
        q[k + 1] = static_cast<std::int64_t>(component);
    }
    const std::array<double, 3> back{-vector_[0], -vector_[1], -vector_[2]};
    return Pose::from_translation(vector_) * Pose::from_quaternion(q) *
           Pose::from_translation(back);
}

Pose Joint::slide(Ratio value) const {
    // (x S + t) / S becomes (x S q + t p) / (S q).
    const Pose once = Pose::from_translation(vector_);
    const auto times = [](const Pose::Number& v, std::int64_t factor) {
        if (v.bit_length() + WideInt<1>(factor).bit_length() > Pose::bits)
            throw LimitError("the position of a prismatic joint needs more than " +
                             std::to_string(Pose::bits) + " bits");
        return multiply<7>(v, WideInt<1>(factor));
    };
    const Pose::Number s = times(once.denominator(), value.denominator);
    std::array<Pose::Number, 9> m{};
    m[0] = m[4] = m[8] = s;
    std::array<Pose::Number, 3> t{};
    for (std::size_t k = 0; k < 3; ++k) t[k] = times(once.translation(k), value.numerator);
    return Pose::from_integers(m, t, s);
}

void Joint::expect_revolute() const {
    if (kind_ != Kind::Revolute) throw UsageError("only a revolute joint turns");
}

Ratio Joint::value_of(const std::array<std::int64_t, 4>& q) const {
    expect_revolute();
    std::size_t along = 0;
    for (std::size_t k = 0; k < 3; ++k)
        if (axis_[k] != 0) along = k;
    for (std::size_t k = 0; k < 3; ++k) {
        if (Int128{q[k + 1]} * axis_[along] != Int128{q[along + 1]} * axis_[k])
            throw UsageError("the quaternion does not turn about the axis of the joint");
    }
    if (q[0] == 0 && q[along + 1] == 0) throw UsageError("the quaternion is zero");
    return reduced(q[along + 1], Int128{q[0]} * axis_[along]);
}

Ratio Joint::value_near(double degrees, int bits) const {
    expect_revolute();
    if (!std::isfinite(degrees)) throw UsageError("the angle of a joint is not finite");
    if (bits < 1 || bits > 30) throw UsageError("the bits of an angle must be from 1 to 30");
    // Whole turns go first; what is left is from -180 to 180.
    const double half = std::remainder(degrees, 360.0) * (std::numbers::pi / 360);
    const double length = std::hypot(static_cast<double>(axis_[0]), static_cast<double>(axis_[1]),
                                     static_cast<double>(axis_[2]));
    // Along a long axis a small numerator turns far; it gets as many bits more.
    const double most = std::ldexp(length, bits);
    if (most > static_cast<double>(quaternion_limit))
        throw LimitError("the quaternion of a joint has components beyond 2^53");
    const double sine = std::sin(half) / length;
    const double cosine = std::cos(half);
    const double scale = most / std::max(std::abs(std::sin(half)), std::abs(cosine));
    return reduced(std::llround(sine * scale), std::llround(cosine * scale));
}

}  // namespace trisect
