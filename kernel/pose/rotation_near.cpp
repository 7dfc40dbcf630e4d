// SPDX-License-Identifier: Apache-2.0
//
// The unit quaternion of the rotation, in doubles, times the power of two below which the result
// must stay, rounded to integers. The four roundings are at most 1/2 each and the quaternion is
// 2^(bits - 1) long, so its direction turns by at most 2^(1 - bits), the rotation by twice that;
// doubles add some 2^-50.
//
// Rounding alone would spoil angles that have quaternions of few digits: (1, 0, 0, 1) would become
// (370728, 0, 0, 370728), which is the same rotation and is reduced; (1, 1, 1, 1) likewise.

#include <trisect/kernel/pose.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <numeric>

#include <trisect/kernel/error.h>

namespace trisect {

Pose Pose::rotation_near(const std::array<double, 3>& axis, double degrees, int bits) {
    const double largest = std::max({std::fabs(axis[0]), std::fabs(axis[1]), std::fabs(axis[2])});
    if (!std::isfinite(degrees) || !std::isfinite(axis[0] + axis[1] + axis[2]) || largest == 0)
        throw UsageError("a rotation needs a finite angle and an axis that is not zero");
    if (bits < 4 || bits > 52) throw UsageError("a rotation of less than 4 or more than 52 bits");
    const std::array<double, 3> k{axis[0] / largest, axis[1] / largest, axis[2] / largest};
    const double length = std::sqrt(k[0] * k[0] + k[1] * k[1] + k[2] * k[2]);
    const double half = std::remainder(degrees, 360.0) * (std::numbers::pi / 360);
    const double scale = std::ldexp(1.0, bits - 1);
    const double sine = std::sin(half) * scale / length;
    std::array<std::int64_t, 4> q{std::llround(std::cos(half) * scale)};
    for (std::size_t i = 0; i < 3; ++i) q[i + 1] = std::llround(k[i] * sine);
    const std::int64_t common = std::gcd(std::gcd(q[0], q[1]), std::gcd(q[2], q[3]));
    for (std::int64_t& v : q) v /= common;
    return from_quaternion(q);
}

}  // namespace trisect
