// SPDX-License-Identifier: Apache-2.0
//
// Plane: an oriented plane with integer coefficients.
// Booleans never make a new plane, so the width of the coefficients does not grow along a chain.
#pragma once

#include <array>
#include <cstdint>

#include <trisect/kernel/lattice_point.h>
#include <trisect/kernel/wide_int.h>

namespace trisect {

/// The set of points x with n·x + d = 0, oriented by n: Above is n·x + d > 0.
///
/// Widths. Let coordinates be multiples of 2^-f below 2^53, and V = 2^(53 + f) the bound of what
/// they are multiples of. A plane through three such points has a normal n' of multiples of 2^-2f,
/// with |n'_i| <= 8 V^2 2^-2f (differences of coordinates are below 2V, a component is a difference
/// of two products of them), and an offset |d'| = |det(a, b, c)| <= 6 V^3 2^-3f. Both times 2^3f
/// are integers: |n_i| < 2^(109 + 3f) and |d| < 2^(162 + 3f). With f <= fraction_limit that is
/// below 2^328 and 2^381; on whole coordinates below 2^109 and 2^162. Every other plane that the
/// library makes (edge planes, splitting planes) stays within these bounds. The tier of width says
/// how many digits predicates need (predicates.cpp); `is_narrow` marks the first one.
///
/// Value type of 232 bytes; beside the exact coefficients it carries doubles for the filtered stage
/// of predicates.
class Plane {
public:
    using Coefficient = WideInt<6>;

    Plane() = default;
    Plane(const Coefficient& nx, const Coefficient& ny, const Coefficient& nz,
          const Coefficient& d);

    /// The plane through a, b, c, counter-clockwise seen from above. \pre not collinear.
    [[nodiscard]] static Plane through(const LatticePoint& a, const LatticePoint& b,
                                       const LatticePoint& c);
    /// The plane through a and b that is parallel to a coordinate axis. Its normal is
    /// (b - a) × e_axis, so its coefficients have one bit more than the coordinates' differences
    /// and one of them is 0. \pre b - a is not parallel to the axis.
    [[nodiscard]] static Plane along_axis(const LatticePoint& a, const LatticePoint& b, int axis);
    /// scale · x_axis - position = 0, scale > 0.
    [[nodiscard]] static Plane axis_aligned(int axis, std::int64_t scale, std::int64_t position);

    [[nodiscard]] const Coefficient& normal(int i) const { return n_[static_cast<std::size_t>(i)]; }
    [[nodiscard]] const Coefficient& offset() const { return d_; }
    /// The coefficients times 2^-approx_shift(), rounded: the normal's are below 2^109.
    [[nodiscard]] double approx_normal(int i) const { return fn_[static_cast<std::size_t>(i)]; }
    [[nodiscard]] double approx_offset() const { return fd_; }
    /// 0 where the normal has no more than 109 bits.
    [[nodiscard]] int approx_shift() const { return shift_; }
    /// How many digits the coefficients have: the least tier of predicates for it.
    [[nodiscard]] int tier() const { return tier_; }
    [[nodiscard]] bool is_narrow() const { return tier_ == 0; }
    /// False only for a default-constructed plane.
    [[nodiscard]] bool is_valid() const {
        return !n_[0].is_zero() || !n_[1].is_zero() || !n_[2].is_zero();
    }

    /// The normal in lowest terms: planes with equal ones are parallel and oriented alike.
    [[nodiscard]] std::array<Coefficient, 3> direction() const;
    /// Same point set, other orientation.
    [[nodiscard]] Plane flipped() const;
    /// The axis along which the normal is largest, of three; in a tie the one that is named first.
    [[nodiscard]] int largest_normal(int i, int j, int k) const;
    /// The axis along which the normal is largest (the first one in a tie): projecting along it
    /// keeps every figure in the plane non-degenerate.
    [[nodiscard]] int dominant_axis() const;

    /// Same coefficients, not merely the same point set (see is_same_plane in predicates.h).
    friend bool operator==(const Plane& a, const Plane& b) { return a.n_ == b.n_ && a.d_ == b.d_; }

private:
    // Of whole coordinates: up to 112 and 168 bits.
    Plane(const std::array<Int128, 3>& n, const WideInt<3>& d);

    std::array<Coefficient, 3> n_{};
    Coefficient d_;
    std::array<double, 3> fn_{};
    double fd_ = 0;
    std::int16_t shift_ = 0;
    std::uint8_t tier_ = 0;
};
static_assert(sizeof(Plane) == 232);

/// Whether a, b, c lie on one line (equal points included).
[[nodiscard]] bool are_collinear(const LatticePoint& a, const LatticePoint& b,
                                 const LatticePoint& c);

}  // namespace trisect
