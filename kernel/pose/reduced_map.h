// SPDX-License-Identifier: Apache-2.0
//
// Integers of an affine map (M x + t)/S in lowest terms.
#pragma once

#include <array>
#include <cstddef>

#include <trisect/kernel/number/bounded_int.h>
#include <trisect/kernel/pose.h>

namespace trisect::detail {

struct MapNumbers {
    std::array<IntVector, 3> m;  // rows
    IntVector t;
    BoundedInt s;
};

[[nodiscard]] MapNumbers numbers_of(const Pose& pose);
[[nodiscard]] MapNumbers negated(const MapNumbers& map);
/// adj(m) m = det(m).
[[nodiscard]] std::array<IntVector, 3> adjugate(const std::array<IntVector, 3>& rows);

/// Divides by the odd part of the greatest common divisor. Cheap when S is a power of two.
void remove_odd_factor(MapNumbers& map);
/// Makes integers without a common factor of two of M 2^m_shift, t 2^t_shift and S.
/// \throw LimitError when one of them would need more than `limit` bits.
void remove_twos(MapNumbers& map, int m_shift, int t_shift, int limit);

}  // namespace trisect::detail
