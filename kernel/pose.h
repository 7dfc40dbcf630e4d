// SPDX-License-Identifier: Apache-2.0
//
// Pose: an exact affine map that places a solid in the world.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include <trisect/kernel/point3d.h>
#include <trisect/kernel/wide_int.h>

namespace trisect {

/// The map x -> (M x + t) / S with integers M (3x3), t and S > 0, in the user's units.
///
/// A pose is exactly what it was made from: twelve doubles are the affine map with these twelve
/// numbers, though no matrix of doubles is quite a rotation; an integer quaternion is a rotation,
/// without any "quite". Solids are never moved by a pose, planes are pulled back through it
/// (moved_predicates.h), so nothing is rounded and what touches keeps touching.
///
/// M is regular. det M < 0 (a mirror) is allowed: the inside stays the inside. M, t and S have no
/// common factor of two, and none at all where the map is not made of doubles alone; so equal maps
/// of one kind have equal numbers.
///
/// Limit: every number is below 2^447. Twelve doubles fit when the highest bit of the largest and
/// the lowest set bit of the smallest are less than 447 places apart. A pair of posed solids needs
/// more: see kernel/pose/relative_pose.h.
///
/// Value type of 830 bytes. Composition and inverse are exact; a microsecond for numbers of
/// doubles, ten when fractions must be reduced.
class Pose {
public:
    using Number = WideInt<7>;
    static constexpr int bits = 447;

    /// The identity.
    Pose();
    /// The map of a 3x4 matrix, row by row: x' = m0 x + m1 y + m2 z + m3, ...
    /// \throw UsageError when a number is not finite or the matrix is singular, LimitError when the
    /// exponents are too far apart.
    [[nodiscard]] static Pose from_doubles(const std::array<double, 12>& rows);
    /// The rotation by the quaternion a + b i + c j + d k of any length, then a translation.
    /// (1, 0, 0, 1) is a quarter turn about z; every rational rotation is one of these.
    /// \throw UsageError for (0, 0, 0, 0), for components beyond 2^53 and translations that are not
    /// finite, LimitError as above.
    [[nodiscard]] static Pose from_quaternion(const std::array<std::int64_t, 4>& q,
                                              const Point3d& translation = {});
    /// A translation by doubles, as they are: 0.1 is not a tenth, so boxes of ten that are placed
    /// at 0.1 and 10.1 overlap by 2^-50. from_integers() has tenths.
    [[nodiscard]] static Pose from_translation(const Point3d& by);
    /// A rotation about an axis through the origin, counter-clockwise seen from its tip, by an
    /// angle near the given one: an exact rotation, by a quaternion of integers below 2^bits. A
    /// turn of less than 2^(3 - bits) radians takes it to the one asked for: half a thousandth of a
    /// degree for 20 bits. None for multiples of 90 degrees about coordinate axes, and of 120
    /// about (1, 1, 1). Predicates under a pose of fewer bits are faster. \throw UsageError for a
    /// zero axis, numbers that are not finite, or bits beyond 4 to 52.
    [[nodiscard]] static Pose rotation_near(const Point3d& axis, double degrees, int bits = 20);
    /// (M x + t) / S. \throw UsageError when M is singular or S = 0.
    [[nodiscard]] static Pose from_integers(std::span<const Number, 9> m,
                                            std::span<const Number, 3> t, const Number& s);

    [[nodiscard]] const Number& matrix(std::size_t row, std::size_t column) const {
        return m_[3 * row + column];
    }
    [[nodiscard]] const Number& translation(std::size_t row) const { return t_[row]; }
    [[nodiscard]] const Number& denominator() const { return s_; }
    /// Whether orientation is turned over: det M < 0.
    [[nodiscard]] bool is_mirror() const { return mirror_; }
    /// Whether M = S: nothing is turned or scaled.
    [[nodiscard]] bool is_translation() const;
    /// The twelve numbers, row by row, each with a relative error below 2^-50.
    [[nodiscard]] const std::array<double, 12>& approximate() const { return approximate_; }

    /// \throw LimitError when the numbers of the inverse do not fit.
    [[nodiscard]] Pose inverse() const;
    /// First b, then a. \throw LimitError when the numbers do not fit.
    friend Pose operator*(const Pose& a, const Pose& b);
    /// Same map.
    friend bool operator==(const Pose& a, const Pose& b);

private:
    friend class PoseBuilder;

    [[nodiscard]] std::array<double, 12> rounded() const;

    std::array<Number, 9> m_;
    std::array<Number, 3> t_;
    Number s_;
    std::array<double, 12> approximate_{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
    bool mirror_ = false;
};

}  // namespace trisect
