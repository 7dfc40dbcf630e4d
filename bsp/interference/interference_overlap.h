// SPDX-License-Identifier: Apache-2.0
//
// Overlap of two placed solids as a solid, and its volume.
#pragma once

#include <trisect/brep/exact_rational.h>
#include <trisect/bsp/interference/interference_model.h>
#include <trisect/bsp/solid.h>
#include <trisect/kernel/pose.h>

namespace trisect {

/// A ∩ B of two placed solids.
struct Overlap {
    /// In A's own frame (as if A were not placed), enlarged by `scale`: no operand for A unless
    /// that is 1. For poses of doubles, quarter turns and translations the scale is 1; a rotation
    /// by a fraction with an odd denominator needs the denominator, because corners of solids are
    /// multiples of powers of two.
    Solid scaled_solid;
    ExactRational scale = 1;
    /// Whether the solid is the overlap exactly. Otherwise corners were rounded to a lattice first:
    /// where a corner is no lattice point because a boolean made it, or a coordinate, times the
    /// scale, is no double or not in the range of coordinates (kernel/coordinate.h).
    bool is_exact = true;
    /// How far rounding moved a coordinate at most, in A's frame and the user's units.
    double max_move = 0;
    /// Of the overlap in the world, in the user's units; exact for what `scaled_solid` is.
    ExactRational volume;
};

/// On demand: this is a boolean (bsp/expression.h) and costs what booleans cost.
/// \throw LimitError when the poses are too wide for each other, what evaluate() throws.
[[nodiscard]] Overlap overlap(const InterferenceModel& a, const Pose& pose_a,
                              const InterferenceModel& b, const Pose& pose_b);

}  // namespace trisect
