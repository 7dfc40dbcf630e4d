// SPDX-License-Identifier: Apache-2.0
//
// Exact squared distances of lattice points from each other and from edges.
//
// All in units of 2^-fraction_limit of the lattice: coordinates are integers below 2^126, their
// differences below 2^127, a scalar product below 2^256.
#pragma once

#include <array>
#include <cstddef>

#include <trisect/kernel/lattice.h>
#include <trisect/kernel/lattice_point.h>
#include <trisect/kernel/wide_int.h>

namespace trisect::detail {

/// A squared distance: numerator / denominator. The numerator is below 2^513, the denominator
/// positive and below 2^256.
struct SquaredDistance {
    WideInt<9> numerator;
    WideInt<5> denominator = 1;

    /// In lattice units, rounded.
    [[nodiscard]] double root() const;
    friend bool operator<(const SquaredDistance& a, const SquaredDistance& b) {
        return multiply<14>(a.numerator, b.denominator) < multiply<14>(b.numerator, a.denominator);
    }
};

[[nodiscard]] SquaredDistance squared_distance(const LatticePoint& a, const LatticePoint& b);

/// Of a point from a segment, where the foot of the perpendicular is strictly inside of it.
struct FootOnEdge {
    bool is_inside = false;
    WideInt<5> place;          ///< along the edge, from its first end; equal units for one edge
    SquaredDistance distance;  ///< if it is inside
};
/// \pre from != to
[[nodiscard]] FootOnEdge foot_on_edge(const LatticePoint& from, const LatticePoint& to,
                                      const LatticePoint& point);

/// A bound for distances, in the user's units, exact.
class DistanceBound {
public:
    /// \pre finite, not negative
    DistanceBound(double bound, Lattice lattice);
    [[nodiscard]] bool covers(const SquaredDistance& d) const;
    /// In lattice units, not below the bound; possibly infinite.
    [[nodiscard]] double above() const { return above_; }

private:
    WideInt<2> square_;  // of the odd mantissa
    int shift_ = 0;      // times 2^shift_
    double above_ = 0;
};

}  // namespace trisect::detail
