// SPDX-License-Identifier: Apache-2.0
//
// Motion: an exact placement of a solid for every parameter value.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <trisect/brep/exact_rational.h>
#include <trisect/kernel/point3d.h>
#include <trisect/kernel/pose.h>

namespace trisect {

namespace detail {
struct MotionPiece;
struct MotionAccess;
}  // namespace detail

/// A turn about an axis with a shift along the way: (R(s) (x - center) + center) + s · shift, where
/// R(s) is the rotation by the quaternion (q0, s q1, s q2, s q3).
///
/// s is not the angle but monotone in it: tan(angle / 2) = s · tan(whole angle / 2). So what comes
/// first in s comes first in time, whatever the law of time is. A turn of 180 degrees or more is a
/// chain of smaller ones. The shift is linear in s, not in the angle: a long screw of constant
/// pitch is a chain of short ones, each of which has its pitch at both ends exactly.
struct Screw {
    std::array<std::int64_t, 4> turn{1, 0, 0, 0};  ///< the whole rotation; turn[0] > 0
    Point3d center{};                              ///< a point of the axis
    Point3d shift{};                               ///< over the whole motion
};

/// Pieces of rational motions, one after the other: piece i runs while the parameter goes from i to
/// i + 1. In each piece the pose is a matrix of polynomials in the parameter divided by a
/// polynomial; nothing is sampled and nothing rounded.
///
/// Immutable value; copying shares. Safe to use from many threads. A motion that was moved from
/// stands still where it was modelled.
class Motion {
public:
    /// Stands still where it was modelled, or at a pose; one piece.
    Motion();
    explicit Motion(const Pose& pose);

    /// From a pose, every point moves by this vector with constant velocity.
    /// \throw UsageError when a number is not finite.
    [[nodiscard]] static Motion translation(const Pose& start, const Point3d& by);
    /// Every point moves on a straight line, from its place under one pose to that under the
    /// other. Solids keep their shape at both ends only, unless the poses differ by a translation.
    /// \throw UnsupportedError when the solid would be flat on the way.
    [[nodiscard]] static Motion blend(const Pose& from, const Pose& to);
    /// \throw UsageError when turn[0] <= 0, a component is beyond 2^53 or a number is not finite.
    [[nodiscard]] static Motion screw(const Pose& start, const Screw& screw);
    /// Any rational motion of one piece: coefficients, constant ones first, of the twelve entries
    /// of the 3x4 matrix row by row, and of their common denominator.
    /// \throw UsageError when the denominator has a root in [0, 1], UnsupportedError when the
    /// solid would be flat somewhere.
    [[nodiscard]] static Motion rational(const std::array<std::vector<ExactRational>, 12>& entries,
                                         const std::vector<ExactRational>& denominator);
    /// Straight pieces from pose to pose (blend). \throw UsageError for less than two poses.
    [[nodiscard]] static Motion through(std::span<const Pose> poses);

    /// One after the other; O(pieces), where a chain of then() copies all that came before.
    /// \throw UsageError for none, or when one does not begin where the one before it ends.
    [[nodiscard]] static Motion joined(std::span<const Motion> motions);
    /// This motion, then that one. \throw UsageError when it does not begin where this one ends.
    [[nodiscard]] Motion then(const Motion& next) const;

    /// How many pieces; the parameter runs from 0 to this number.
    [[nodiscard]] std::size_t piece_count() const;
    /// Whether the pose never changes.
    [[nodiscard]] bool is_still() const;
    /// The exact pose at a value of the parameter. \throw UsageError when the value is outside the
    /// range, LimitError when the numbers of the pose do not fit into a Pose.
    [[nodiscard]] Pose pose_at(const ExactRational& s) const;
    /// The pose nearest to double precision, row by row; for pictures.
    [[nodiscard]] std::array<double, 12> approximate_pose_at(double s) const;

private:
    friend struct detail::MotionAccess;

    using Pieces = std::vector<detail::MotionPiece>;
    explicit Motion(Pieces pieces);
    [[nodiscard]] const Pieces& pieces() const { return pieces_ ? *pieces_ : still_pieces(); }
    [[nodiscard]] static const Pieces& still_pieces();

    std::shared_ptr<const Pieces> pieces_;  // not empty; null after a move
};

}  // namespace trisect
