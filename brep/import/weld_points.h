// SPDX-License-Identifier: Apache-2.0
//
// Welding: point numbers by value, independent of the file's indices.
#pragma once

#include <cstddef>
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

/// The same numbering without the tables that only repeated points need: keeps the distinct points
/// and returns the id of each input point, or nothing when all are distinct and keep their indices.
/// `expected` is how many distinct points there may be, a hint for the size of the table.
/// `threads`: how many may take part, 0 means as many as there are here; the outcome does not
/// depend on it.
[[nodiscard]] std::vector<std::uint32_t> weld_in_place(std::vector<LatticePoint>& points,
                                                       std::size_t expected,
                                                       std::uint32_t threads = 1);

}  // namespace trisect::detail
