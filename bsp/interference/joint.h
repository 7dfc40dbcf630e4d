// SPDX-License-Identifier: Apache-2.0
//
// Joint: the relative motion of an articulated link and its parent.
#pragma once

#include <array>
#include <cstdint>

#include <trisect/kernel/point3d.h>
#include <trisect/kernel/pose.h>

namespace trisect {

/// A fraction of integers. The denominator may be 0 where a joint says what that means.
struct Ratio {
    std::int64_t numerator = 0;
    std::int64_t denominator = 1;
};

/// A joint with at most one parameter, which is a fraction. At every value its motion is an exact
/// rigid motion: rotations are by integer quaternions, and nothing is a sine or a cosine.
///
/// Points and directions are in the coordinates of the frame in which the joint is mounted. Small
/// value type.
class Joint {
public:
    enum class Kind : std::uint8_t { Fixed, Revolute, Prismatic };

    /// No motion. Its only value is 0.
    [[nodiscard]] static Joint fixed();
    /// Turns about the line through the point along the axis. The value r turns by the angle a with
    /// tan(a / 2) = r |axis|, counter-clockwise seen from the tip of the axis; so about a
    /// coordinate axis r is the tangent of half the angle. A denominator 0 is half a turn.
    /// \throw UsageError for the axis (0, 0, 0) and a point that is not finite, LimitError for axes
    /// with components beyond 2^53.
    [[nodiscard]] static Joint revolute(const Point3d& point,
                                        const std::array<std::int64_t, 3>& axis);
    /// Slides along the direction: by r times it. \throw UsageError when it is not finite.
    [[nodiscard]] static Joint prismatic(const Point3d& direction);

    [[nodiscard]] Kind kind() const { return kind_; }

    /// \throw UsageError for a value that the joint cannot have (a fixed one any but 0, a
    /// prismatic one with denominator 0, anything 0/0), LimitError when numbers do not fit: the
    /// quaternion (q, p axis) of a value p/q in lowest terms must have components up to 2^53.
    [[nodiscard]] Pose motion(Ratio value) const;

    /// Of a revolute joint: the value whose motion is the rotation by a + b i + c j + d k.
    /// \throw UsageError when (b, c, d) is no multiple of the axis, or all four are 0; LimitError
    /// when the value does not fit.
    [[nodiscard]] Ratio value_of(const std::array<std::int64_t, 4>& quaternion) const;
    /// Of a revolute joint: a value that turns nearly by so many degrees. Its quaternion has
    /// about `bits` bits, from 1 to 30, and those of the axis: half the angle is off by 2^-bits or
    /// so. Every link of a chain adds twice as many to the poses of those that it carries.
    /// \throw UsageError for a number that is not finite, LimitError when that is beyond 2^53.
    [[nodiscard]] Ratio value_near(double degrees, int bits = 20) const;

private:
    [[nodiscard]] Pose turn(Ratio value) const;
    [[nodiscard]] Pose slide(Ratio value) const;
    void expect_revolute() const;

    Kind kind_ = Kind::Fixed;
    Point3d vector_{};                    // the point, or the direction
    std::array<std::int64_t, 3> axis_{};  // without common factor
};

}  // namespace trisect
