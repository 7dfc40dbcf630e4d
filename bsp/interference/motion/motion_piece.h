// SPDX-License-Identifier: Apache-2.0
//
// MotionPiece, RelativeMotion: rational motions over the unit interval.
// A RelativeMotion is that of one moving solid as seen from another.
#pragma once

#include <array>
#include <cstddef>

#include <trisect/brep/number/integer_polynomial.h>
#include <trisect/bsp/interference/motion.h>
#include <trisect/bsp/interference/motion/feature_contact.h>
#include <trisect/kernel/lattice.h>
#include <trisect/kernel/number/gmp.h>

namespace trisect::detail {

/// Rows of a matrix of polynomials.
using PolynomialMatrix = std::array<PolynomialVector, 3>;

[[nodiscard]] PolynomialMatrix operator*(const PolynomialMatrix& a, const PolynomialMatrix& b);
[[nodiscard]] PolynomialVector operator*(const PolynomialMatrix& a, const PolynomialVector& b);
[[nodiscard]] PolynomialMatrix operator*(const PolynomialMatrix& a, const IntegerPolynomial& b);
[[nodiscard]] PolynomialVector operator*(const PolynomialVector& a, const IntegerPolynomial& b);
[[nodiscard]] PolynomialVector operator+(const PolynomialVector& a, const PolynomialVector& b);
[[nodiscard]] PolynomialMatrix transposed(const PolynomialMatrix& a);
/// Matrix of cofactors: transposed(cofactors(m)) * m = determinant(m) · identity.
[[nodiscard]] PolynomialMatrix cofactors(const PolynomialMatrix& m);
[[nodiscard]] IntegerPolynomial determinant(const PolynomialMatrix& m);

/// The map x -> (matrix(s) x + shift(s)) / weight(s), 0 <= s <= 1. The weight is positive and the
/// determinant of the matrix not zero all over the interval.
struct MotionPiece {
    PolynomialMatrix matrix;
    PolynomialVector shift;
    IntegerPolynomial weight;

    /// The identity for good.
    [[nodiscard]] static MotionPiece still();
    /// Divides all polynomials by what they have in common.
    void reduce();
    [[nodiscard]] int degree() const;
};

/// First b, then a.
[[nodiscard]] MotionPiece operator*(const MotionPiece& a, const MotionPiece& b);
[[nodiscard]] MotionPiece inverse(const MotionPiece& a);
/// What a piece does from one parameter to another one, over [0, 1].
[[nodiscard]] MotionPiece part_of(const MotionPiece& piece, const mpq_class& from,
                                  const mpq_class& to);
/// The rotation by a quaternion of polynomials, of any length, about the origin. \pre not zero
/// anywhere in [0, 1]
[[nodiscard]] MotionPiece rotation_by(const std::array<IntegerPolynomial, 4>& q);
/// Where A sees the points of B: from B's lattice units to A's.
[[nodiscard]] MotionPiece relative_points(const MotionPiece& a, Lattice lattice_a,
                                          const MotionPiece& b, Lattice lattice_b);

/// Solid B as seen from solid A, in lattice units of both, with the maps of planes and lines that
/// follow from that of points. Each of the three maps is divided by all that its entries have in
/// common; for a rational screw against a solid at rest all of them have degree 3, for straight
/// motion degree 1. That is what makes conditions of contact cubics (they are linear in these maps)
/// although a product of the maps as they are would have degree 6.
struct RelativeMotion {
    RelativeMotion(const MotionPiece& a, Lattice lattice_a, const MotionPiece& b,
                   Lattice lattice_b);

    /// Points: B's x is at (matrix x + shift) / weight.
    MotionPiece point;
    /// Planes: B's n·x + d becomes (plane_normal n)·x' + plane_offset d - plane_shift·n, which is
    /// plane_offset (n·x + d). The offset is positive: sides are kept, by mirrors too.
    PolynomialMatrix plane_normal;
    PolynomialVector plane_shift;
    IntegerPolynomial plane_offset;
    /// Lines: direction u and moment x × u become line_direction u and line_moment (x × u) +
    /// line_lever u, both times one number that has no root.
    PolynomialMatrix line_direction;
    PolynomialMatrix line_moment;
    PolynomialMatrix line_lever;
};

/// The way from a Motion to its pieces and back.
struct MotionAccess {
    [[nodiscard]] static const MotionPiece& piece(const Motion& motion, std::size_t i) {
        return motion.pieces()[i];
    }
    [[nodiscard]] static Motion make(const MotionPiece& piece) {
        return Motion(Motion::Pieces{piece});
    }
};

[[nodiscard]] inline const MotionPiece& piece_of(const Motion& motion, std::size_t i) {
    return MotionAccess::piece(motion, i);
}
[[nodiscard]] inline Motion motion_of(const MotionPiece& piece) {
    return MotionAccess::make(piece);
}

}  // namespace trisect::detail
