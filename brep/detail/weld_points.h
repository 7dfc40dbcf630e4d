// SPDX-License-Identifier: Apache-2.0
//
// Welding: naming points by value, so that connectivity does not depend on how a file indexes them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <trisect/kernel/lattice_point.h>

namespace trisect::detail {

/// Distinct points in the order of their first appearance.
struct WeldedPoints {
    std::vector<LatticePoint> points;
    std::vector<std::uint32_t> first;  ///< of each distinct point: its first index in the input
    std::vector<std::uint32_t> id;     ///< of each input point: its index in `points`
};

/// O(n) expected; O(n log n) for inputs made to defeat the hash.
[[nodiscard]] WeldedPoints weld_points(std::span<const LatticePoint> points);

}  // namespace trisect::detail
