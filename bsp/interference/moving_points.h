// SPDX-License-Identifier: Apache-2.0
//
// Exact first contact of features with linearly moving corners.
// The features are a vertex and a triangle, or two edges: the primitive of continuous collision
// detection.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include <trisect/brep/algebraic_number.h>
#include <trisect/brep/exact_rational.h>

namespace trisect {

/// A point that moves from `from` at s = 0 to `to` at s = 1 with constant velocity.
struct LinearPath {
    std::array<ExactRational, 3> from;
    std::array<ExactRational, 3> to;
};

/// The first s in [0, 1] at which the point is on the closed triangle; nothing when there is none,
/// which is a proof.
///
/// The triangle may be flat for some or all s, the point may move in its plane, and nothing need
/// move at all. A contact at s = 0 or s = 1 counts. Cost: some 6 us, spent on
/// rounding the fractions, when doubles prove that there is no contact; some tens otherwise.
[[nodiscard]] std::optional<AlgebraicNumber> first_contact(const LinearPath& vertex,
                                                           const std::array<LinearPath, 3>& face);
/// The same for two closed edges, which may be parallel, or points.
[[nodiscard]] std::optional<AlgebraicNumber> first_contact(const std::array<LinearPath, 2>& a,
                                                           const std::array<LinearPath, 2>& b);

/// What decided questions about moving features (kernel/diagnostics.h).
struct MotionCounters {
    std::uint64_t questions = 0;
    std::uint64_t filtered = 0;  ///< doubles with proved bounds showed that there is no contact
    std::uint64_t exact = 0;     ///< polynomials with integer coefficients decided
    std::uint64_t coplanar = 0;  ///< of those: the features are coplanar for good
    std::uint64_t contacts = 0;  ///< contacts found

    MotionCounters& operator+=(const MotionCounters& o);
    MotionCounters& operator-=(const MotionCounters& o);
};

}  // namespace trisect
