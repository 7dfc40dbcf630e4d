// SPDX-License-Identifier: Apache-2.0
//
// Moving corners, for the checkers of certificates.
// Of the searches for certificates only that of overlaps uses them, through its checker
// (certified_clearance.h).
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include <trisect/bsp/interference/certificate/certified_points.h>
#include <trisect/bsp/interference/certificate/certified_polynomial.h>
#include <trisect/bsp/interference/motion.h>

namespace trisect::detail::certified {

/// A piece of a motion, or what one solid sees of another: points are at (m x + t) / w.
struct Piece {
    Rows m;
    PolynomialVector t;
    Polynomial w;

    [[nodiscard]] PolynomialVector point(const ExactPoint& x) const { return m * constant(x) + t; }
    [[nodiscard]] PolynomialVector direction(const ExactPoint& v) const { return m * constant(v); }
};

/// Of a motion with fewer pieces, which stands still, the last one.
[[nodiscard]] Piece piece_of(const Motion& motion, std::size_t i);

/// Where `viewer` sees the points of `other`:
///     (adj(M) (w (M' x + t') - w' t)) / (det(M) w').
/// The weight is not negative at 0; it has a root where the viewer becomes flat.
[[nodiscard]] Piece seen_from(const Piece& viewer, const Piece& other);

/// A moving point's Bernstein coefficients over a range of time, which are affine in the point: it
/// stays on one side of a plane while all coefficients are there.
class ControlMaps {
public:
    ControlMaps(const Piece& piece, const ExactRational& from, const ExactRational& to);

    /// The planes that the point x must be strictly above, all of them, to stay above a plane; or
    /// to stay where the plane's value plus resting·x is positive.
    [[nodiscard]] std::vector<IntegerPlane> planes(const SeparatingPlane& plane,
                                                   const ExactPoint& resting = {}) const;

private:
    struct Map {
        std::array<ExactPoint, 3> m;
        ExactPoint t;
        ExactRational w;
    };
    std::vector<Map> maps_;
};

}  // namespace trisect::detail::certified
