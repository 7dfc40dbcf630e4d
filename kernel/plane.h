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
/// Widths (V = 2^53 bounds |coordinate|): a plane through three lattice points has |n_i| <= 8 V^2 =
/// 2^109 (differences of coordinates are below 2V, a component is a difference of two products of
/// them) and |d| = |det(a, b, c)| <= 6 V^3 < 2^162. Every other plane that the library makes (edge
/// planes, splitting planes) stays within these bounds. `is_narrow` marks the planes with |n_i| <
/// 2^56 and |d| < 2^83, for which 256-bit predicates suffice: all planes of lattices up to 26 bits,
/// and nearly all of 27 bits.
///
/// Value type of 112 bytes; beside the exact coefficients it carries their nearest doubles for the
/// filtered stage of predicates.
class Plane {
public:
    using Offset = WideInt<3>;

    Plane() = default;
    Plane(Int128 nx, Int128 ny, Int128 nz, const Offset& d);

    /// The plane through a, b, c, counter-clockwise seen from above. \pre not collinear.
    [[nodiscard]] static Plane through(const LatticePoint& a, const LatticePoint& b,
                                       const LatticePoint& c);
    /// The plane through a and b that is parallel to a coordinate axis. Its normal is
    /// (b - a) × e_axis, so its coefficients have one bit more than the coordinates' differences
    /// and one of them is 0. \pre b - a is not parallel to the axis.
    [[nodiscard]] static Plane along_axis(const LatticePoint& a, const LatticePoint& b, int axis);
    /// scale · x_axis - position = 0, scale > 0.
    [[nodiscard]] static Plane axis_aligned(int axis, std::int64_t scale, std::int64_t position);

    [[nodiscard]] Int128 normal(int i) const { return n_[static_cast<std::size_t>(i)]; }
    [[nodiscard]] const Offset& offset() const { return d_; }
    [[nodiscard]] double approx_normal(int i) const { return fn_[static_cast<std::size_t>(i)]; }
    [[nodiscard]] double approx_offset() const { return fd_; }
    [[nodiscard]] bool is_narrow() const { return narrow_; }
    /// False only for a default-constructed plane.
    [[nodiscard]] bool is_valid() const { return n_[0] != 0 || n_[1] != 0 || n_[2] != 0; }

    /// Same point set, other orientation.
    [[nodiscard]] Plane flipped() const;
    /// The axis along which the normal is largest (the first one in a tie): projecting along it
    /// keeps every figure in the plane non-degenerate.
    [[nodiscard]] int dominant_axis() const;

    /// Same coefficients, not merely the same point set (see is_same_plane in predicates.h).
    friend bool operator==(const Plane& a, const Plane& b) { return a.n_ == b.n_ && a.d_ == b.d_; }

private:
    std::array<Int128, 3> n_{};
    Offset d_;
    bool narrow_ = true;
    std::array<double, 3> fn_{};
    double fd_ = 0;
};

/// Whether a, b, c lie on one line (equal points included).
[[nodiscard]] bool are_collinear(const LatticePoint& a, const LatticePoint& b,
                                 const LatticePoint& c);

}  // namespace trisect
