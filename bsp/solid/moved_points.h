// SPDX-License-Identifier: Apache-2.0
//
// MovedPoints: exact points under an affine map, rounded once.
#pragma once

#include <array>
#include <optional>

#include <trisect/kernel/lattice.h>
#include <trisect/kernel/number/double_pair.h>
#include <trisect/kernel/number/gmp.h>
#include <trisect/kernel/point.h>
#include <trisect/kernel/pose.h>

namespace trisect::detail {

class MovedPoints {
public:
    using Exact = std::array<mpq_class, 3>;

    MovedPoints(const Pose& pose, Lattice lattice);

    /// In the user's units.
    [[nodiscard]] Exact exact(const Point& point) const;
    /// The nearest doubles, from pairs of doubles where these show them.
    [[nodiscard]] Point3d nearest(const Point& point) const;

private:
    [[nodiscard]] std::optional<Point3d> from_pairs(const Point& point) const;

    Lattice lattice_;
    std::array<std::array<mpz_class, 3>, 3> m_;
    std::array<mpz_class, 3> t_;
    mpz_class s_;
    // The same rounded to pairs: rows of the matrix, and the translation.
    std::array<std::array<DoublePair, 4>, 3> rows_;
};

/// The nearest doubles.
[[nodiscard]] Point3d to_doubles(const MovedPoints::Exact& p);

}  // namespace trisect::detail
