// SPDX-License-Identifier: Apache-2.0
//
// Geometric predicates, exact, in three stages.
//   1. symbolic  a point built from a plane lies on it: by name, or by equal coefficients;
//   2. filtered  double arithmetic with a derived error bound, for round-to-nearest (no other
//                assumption: no extended registers, no subnormals, -ffp-contract=off);
//   3. exact     fixed-width integers in five tiers, by the bits that the coefficients at hand
//   have.
// There is no tolerance. Which stage decided is counted (counters.h).
#pragma once

#include <array>
#include <compare>
#include <optional>

#include <trisect/kernel/lattice_point.h>
#include <trisect/kernel/number/error_bounds.h>
#include <trisect/kernel/plane.h>
#include <trisect/kernel/side.h>
#include <trisect/kernel/wide_int.h>

namespace trisect {

/// A point (x/w, y/w, z/w), w > 0. With the widths of plane.h |w| < 2^988 and |x| < 2^1044; on
/// whole coordinates |w| < 2^330 and |x| < 2^384.
struct HomogeneousPoint {
    using Coordinate = WideInt<17>;
    using Weight = WideInt<16>;

    HomogeneousPoint() = default;
    HomogeneousPoint(const std::array<Coordinate, 3>& coordinates, const Weight& weight);

    std::array<Coordinate, 3> xyz;
    Weight w;
    /// The least tier of predicates with room for these numbers, or one above it.
    int tier = 4;
    /// Whether |w| < 2^383 and |x| < 2^447.
    [[nodiscard]] bool is_short() const { return tier <= 1; }
};

/// Certified double coordinates: every exact coordinate is within `error` of its approximation.
struct Approximation {
    std::array<double, 3> c{};
    double error = 0;
};

/// The common point of three planes, or nothing when they do not meet in exactly one point.
[[nodiscard]] std::optional<HomogeneousPoint> intersect(const Plane& p, const Plane& q,
                                                        const Plane& r);
/// Whether three planes meet in exactly one point: det(n_p, n_q, n_r) != 0.
[[nodiscard]] bool meet_in_a_point(const Plane& p, const Plane& q, const Plane& r);

[[nodiscard]] HomogeneousPoint homogeneous(const LatticePoint& p);

/// Double coordinates of p∩q∩r with an error bound; refined by the exact point when the planes are
/// too close to parallel for doubles. \pre the planes meet in a point.
[[nodiscard]] Approximation approximate(const Plane& p, const Plane& q, const Plane& r);
[[nodiscard]] Approximation approximate(const LatticePoint& p);
[[nodiscard]] Approximation approximate(const HomogeneousPoint& p);

/// The double nearest to numerator / denominator, ties to even. \pre denominator > 0.
[[nodiscard]] double nearest_double(const HomogeneousPoint::Coordinate& numerator,
                                    const HomogeneousPoint::Weight& denominator);
/// Correctly rounded coordinates: a function of the exact point alone.
[[nodiscard]] std::array<double, 3> nearest_doubles(const HomogeneousPoint& p);
/// The same for p∩q∩r, given what approximate(p, q, r) returned: filtered, then exact.
[[nodiscard]] std::array<double, 3> nearest_doubles(const Approximation& approximation,
                                                    const Plane& p, const Plane& q, const Plane& r);

/// A plane by corners of a mesh: through three of them, or through two, parallel to an axis.
struct CornerPlane {
    std::array<const LatticePoint*, 3> corners{};
    int axis = -1;                ///< -1: through all three
    bool is_whole = true;         ///< whether all coordinates of the corners are known to be whole
    const Plane* made = nullptr;  ///< this plane, in place of corners
};
/// The same for the common point of such planes, which need not be made; nothing where doubles do
/// not decide.
[[nodiscard]] std::optional<std::array<double, 3>> nearest_doubles(
    const Approximation& approximation, const std::array<CornerPlane, 3>& planes);

/// Side of a lattice point, degree 3.
[[nodiscard]] Side side_of(const LatticePoint& point, const Plane& plane);
/// Side of the point p∩q∩r, whose approximation the caller holds; degree 9.
/// \pre the planes meet in a point.
[[nodiscard]] Side side_of(const Approximation& approximation, const Plane& p, const Plane& q,
                           const Plane& r, const Plane& plane);
/// Side of a homogeneous point (exact stage only).
[[nodiscard]] Side side_of(const HomogeneousPoint& point, const Plane& plane);

/// The filtered stage alone: the side, or nothing when doubles cannot decide. Never answers On.
[[nodiscard]] inline std::optional<Side> filtered_side(const Approximation& a, const Plane& plane);

/// Order of two points along a coordinate axis.
[[nodiscard]] std::strong_ordering compare_coordinate(const HomogeneousPoint& a,
                                                      const HomogeneousPoint& b, int axis);

/// Same point set, whatever the orientation or the common factor of the coefficients.
[[nodiscard]] bool is_same_plane(const Plane& a, const Plane& b);
/// For planes with the same point set: do their normals point to the same side?
[[nodiscard]] bool same_orientation(const Plane& a, const Plane& b);

/// Sign of the component `axis` of n_a × n_b, the direction of the line that two planes share.
[[nodiscard]] int sign_of_cross(const Plane& a, const Plane& b, int axis);
/// Sign of n_a · n_b.
[[nodiscard]] int sign_of_dot(const Plane& a, const Plane& b);
/// Sign of det(n_a, n_b, n_c).
[[nodiscard]] int sign_of_det(const Plane& a, const Plane& b, const Plane& c);

inline std::optional<Side> filtered_side(const Approximation& a, const Plane& plane) {
    // s = Σ n_i c_i + d in doubles. All terms are 0 or at least 2^-400: nothing underflows.
    const double nx = plane.approx_normal(0);
    const double ny = plane.approx_normal(1);
    const double nz = plane.approx_normal(2);
    const double tx = nx * a.c[0];
    const double ty = ny * a.c[1];
    const double tz = nz * a.c[2];
    const double d = plane.approx_offset();
    const auto mag = [](double v) { return v < 0 ? -v : v; };
    const double s = ((tx + ty) + tz) + d;
    const double terms = ((mag(tx) + mag(ty)) + mag(tz)) + mag(d);
    const double normals = (mag(nx) + mag(ny)) + mag(nz);
    const double bound =
        detail::plane_value_rounding * terms + detail::error_slack * (a.error * normals);
    if (s > bound) return Side::Above;
    if (s < -bound) return Side::Below;
    return std::nullopt;
}

}  // namespace trisect
