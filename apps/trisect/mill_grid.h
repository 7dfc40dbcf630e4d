// SPDX-License-Identifier: Apache-2.0
//
// MillGrid: the grid of tool corners and tool positions, on the stock's lattice.
#pragma once

#include <trisect/kernel/lattice.h>
#include <trisect/kernel/point3d.h>

namespace trisect::app {

/// Corners of the tool and its positions are rounded to multiples of 2^exponent, once. Sums of two
/// then are exact, so each copy of the tool is congruent to all others and faces that it cuts on
/// one path are flush. Value type.
class MillGrid {
public:
    /// An exponent below the lattice's makes coordinates with fractions: exact, and slower.
    MillGrid(Lattice lattice, int exponent) : lattice_(lattice), exponent_(exponent) {}

    /// The exponent for solids whose coordinates are below `largest`: 28 to 35 bits of them, a
    /// multiple of 8.
    [[nodiscard]] static int exponent_for(double largest);

    [[nodiscard]] Lattice lattice() const { return lattice_; }
    [[nodiscard]] int exponent() const { return exponent_; }

    /// In lattice units. \throw LimitError when it leaves the lattice
    [[nodiscard]] Point3d rounded(const Point3d& user);
    /// The user's units, exactly.
    [[nodiscard]] Point3d to_user(const Point3d& lattice_units) const;

    /// Largest change of a coordinate so far, user's units.
    [[nodiscard]] double max_move() const { return max_move_; }

private:
    Lattice lattice_;
    int exponent_;
    double max_move_ = 0;
};

}  // namespace trisect::app
